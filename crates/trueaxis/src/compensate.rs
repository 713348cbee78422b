//! Compensate: what the control has to add to its commands, and programs that fit this machine.
//!
//! - [`values`]: per axis and position, in least increments;
//! - [`post`](mod@post): cutter locations into an NC program of one control, with its proof.

pub mod post;
pub mod values;
