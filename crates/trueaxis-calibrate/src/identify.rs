//! Identify: what the machine is like, from measurements.
//!
//! - [`expansion`]: the coefficient of expansion of a scale or a screw;
//! - [`thermal`]: linear models of errors that drift with temperatures;
//! - [`rtcp`]: the rotary centres for the tool-centre-point control;
//! - [`probe`]: the offset of a stylus ball and its pre-travel by direction;
//! - the errors of the machine from any mix of instruments: [`term`] says what is sought, a
//!   [`design`] how readings follow it, a [`fit`] finds it, [`confusion`] says what cannot be told
//!   apart; [`errors`](mod@errors) is the whole way from readings to a verdict.

pub mod checks;
pub mod conflict;
pub mod convention;
pub mod errors;
pub mod expansion;
pub mod influence;
pub mod leftover;
pub mod machine_file;
pub mod probe;
pub mod records;
pub mod rtcp;
pub mod score;
pub mod selection;
pub mod thermal;
