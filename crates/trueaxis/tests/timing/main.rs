//! Time along the path: laws over random programs, the price of the jerk limit, ruckig.

mod drawn;
mod elements;
mod laws;
mod oracle;
mod programs;
