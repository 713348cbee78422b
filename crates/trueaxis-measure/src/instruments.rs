//! Instruments: where they stand, what they read.

pub mod drift;
mod element;
pub mod instrument;
mod judged;
mod kind;
pub mod material;
mod motion;
mod points;
mod poses;
mod rate;
mod readings;

pub use element::Element;
pub use instrument::Instrument;
pub use kind::Kind;
pub use material::MaterialCompensation;
pub use motion::{Moment, Motion};
pub use readings::{Reading, Readings};
