//! Compensate: what the control has to add to its commands, so that the part comes out right.
//!
//! - [`values`]: per axis and position, in least increments.

pub mod values;
