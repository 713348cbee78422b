//! Instruments: where they stand, what they read.

pub mod drift;
pub mod instrument;
mod judged;
mod kind;
pub mod material;
mod motion;
mod readings;

pub use instrument::Instrument;
pub use kind::Kind;
pub use material::MaterialCompensation;
pub use motion::{Moment, Motion};
pub use readings::{Reading, Readings};
