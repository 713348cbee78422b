//! Time along the path: laws over random programs, notations of the feed, the price of the jerk limit, ruckig.

mod drawn;
mod elements;
mod feeds;
mod laws;
mod oracle;
mod programs;
