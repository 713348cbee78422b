//! Compensate: what the control has to add to its commands, and programs that fit this machine.
//!
//! - [`values`]: per axis and position, in least increments;
//! - [`adapt`](mod@adapt): a path moved onto the blank that was probed, and what wall it leaves;
//! - [`program`]: an NC program, so that the actual tool goes where it says;
//! - [`post`](mod@post): cutter locations into an NC program of one control, with its proof.
//! - [`tables`](mod@tables): tables of controls, read back and proved.

pub mod adapt;
pub mod post;
pub mod program;
pub mod tables;
pub mod values;
