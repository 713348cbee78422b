//! Identify: what the machine is like, from measurements.
//!
//! So far the coefficient of expansion of a scale or a screw ([`expansion`]).

pub mod expansion;
