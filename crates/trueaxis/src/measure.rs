//! Measure: which instrument stands where, what it reads, and what it would read.
//!
//! ```text
//!     campaign.toml ──read_campaign──> Campaign {machine, instruments, unknowns}
//!     readings.csv  ──read_readings──> Readings {commands, values}      ──> identify
//! ```

mod campaign;
pub mod instrument;
mod kind;
pub mod path;
mod readings;
pub mod virtual_campaign;

pub use campaign::{Campaign, read_campaign, usual_setup};
pub use instrument::Instrument;
pub use kind::Kind;
pub use readings::{Reading, Readings};
