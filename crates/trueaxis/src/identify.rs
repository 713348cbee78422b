//! Identify: what the machine is like, from measurements.
//!
//! - [`expansion`]: the coefficient of expansion of a scale or a screw;
//! - [`thermal`]: linear models of errors that drift with temperatures;
//! - the errors of the machine from any mix of instruments: [`term`] says what is sought, a
//!   [`design`] how readings follow it, a [`fit`] finds it, [`confusion`] says what cannot be told
//!   apart.

pub mod confusion;
pub mod design;
pub mod expansion;
pub mod fit;
pub mod minimal;
pub mod term;
pub mod thermal;
