//! What do instruments read on this machine? Instruments, the errors that are unknown, and campaigns of
//! readings, real or virtual.
//!
//! ```text
//!     instruments ──> unknowns ──> measure
//!     what is read    what is      campaigns
//!                     unknown
//! ```
//!
//! ```
//! use trueaxis_measure::unknowns::minimal::minimal_location_errors;
//! use trueaxis_machine::{Machine, file::NoTables};
//! let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n";
//! let mill = Machine::check("mill.toml", text, &NoTables).0.unwrap();
//! // Three squarenesses say how three linear axes are arranged, two tilts how the spindle stands to them.
//! assert_eq!(minimal_location_errors(&mill).len(), 5);
//! ```
//!
//! What readings say of the machine is the subject of `trueaxis-calibrate`.

pub mod instruments;
pub mod measure;
pub mod report;
pub mod unknowns;

/// The JSON Schemas of the documents of this crate, by name.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use report::MeasurementDocument;
    use trueaxis_report::named_schema;
    vec![named_schema::<MeasurementDocument<'_>>("measure")]
}
