//! Where are the rotary axes, and which numbers must the control have for its tool-centre-point control?
//!
//! ```text
//!     readings of a tool against a ball ──rtcp──> offsets and directions of the rotary axes, numbers of five controls
//! ```
//!
//! Errors of the whole machine from any instrument are the subject of `trueaxis-calibrate`.

pub mod report;
pub mod rtcp;

use report::RtcpDocument;
use trueaxis_report::{NamedSchema, named_schema};

/// The JSON Schemas of the documents of this crate, by name.
pub fn schemas() -> Vec<NamedSchema> {
    vec![named_schema::<RtcpDocument<'_>>("identify-rtcp")]
}
