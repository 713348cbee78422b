//! Measure: which instrument stands where, what it reads, and what it would read.
//!
//! ```text
//!     campaign.toml ──read_campaign──> Campaign {machine, instruments, unknowns}
//!     readings.csv  ──read_readings──> Readings {commands, values}      ──> identify
//! ```

pub mod calibration;
mod campaign;
mod drift;
mod element;
mod material;
mod motion;
pub mod path;
pub mod prior;
pub mod repeats;
mod servo;
pub mod stages;
mod tables;
pub mod virtual_campaign;

pub use crate::instruments::{Element, Instrument, Kind, Motion, Reading, Readings, instrument};
pub use campaign::{Campaign, read_campaign, readings_file};
pub use motion::fill_motion;
pub use tables::{read_table, without_copies};
