//! Identify: what the machine is like, from measurements.
//!
//! So far the coefficient of expansion of a scale or a screw ([`expansion`]), and linear models of
//! errors that drift with temperatures ([`thermal`]).

pub mod expansion;
pub mod thermal;
