//! What is the machine like? What instruments read, what a measurement will show before anybody measures,
//! and which errors readings show.
//!
//! ```text
//!     instruments ──> unknowns ──> measure ──> plan ──> identify
//!     what is read    what is      campaigns   before   after the
//!                     unknown                           measurement
//! ```
//!
//! ```
//! use trueaxis_calibrate::unknowns::minimal::minimal_location_errors;
//! use trueaxis_machine::{Machine, file::NoTables};
//! let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n";
//! let mill = Machine::check("mill.toml", text, &NoTables).0.unwrap();
//! // Three squarenesses say how three linear axes are arranged, two tilts how the spindle stands to them.
//! assert_eq!(minimal_location_errors(&mill).len(), 5);
//! ```
//!
//! It does not know what the errors do to a part, nor how they are compensated.

pub mod identify;
pub mod instruments;
pub mod measure;
pub mod plan;
pub mod report;
pub mod unknowns;

use report::{
    IdentificationDocument, MeasurementDocument, PlanDocument, ProbeDocument, RtcpDocument,
    SurfaceDocument, ThermalDocument,
};
use trueaxis_report::{NamedSchema, named_schema};

/// The JSON Schemas of the documents of this crate, by name; forms of `identify/1` have names of their own.
pub fn schemas() -> Vec<NamedSchema> {
    vec![
        named_schema::<IdentificationDocument<'_>>("identify-errors"),
        named_schema::<ProbeDocument<'_>>("identify-probe"),
        named_schema::<RtcpDocument<'_>>("identify-rtcp"),
        named_schema::<ThermalDocument<'_>>("identify-thermal"),
        named_schema::<MeasurementDocument<'_>>("measure"),
        named_schema::<PlanDocument<'_>>("plan"),
        named_schema::<SurfaceDocument<'_>>("plan-probe-surface"),
    ]
}
