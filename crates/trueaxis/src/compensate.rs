//! Compensate: programs that fit this machine.
//!
//! - [`post`](mod@post): cutter locations into an NC program of one control, with its proof.

pub mod post;
