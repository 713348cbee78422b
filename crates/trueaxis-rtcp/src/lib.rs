//! Where are the rotary axes, and which numbers must the control have for its tool-centre-point control?
//!
//! ```text
//!     readings of a tool against a ball ──rtcp──> offsets and directions of the rotary axes, numbers of five controls
//! ```
//!
//! Errors of the whole machine from any instrument are the subject of `trueaxis-calibrate`.

pub mod report;
pub mod rtcp;

/// The JSON Schemas of the documents of this crate, by name.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use report::RtcpDocument;
    use trueaxis_report::named_schema;
    vec![named_schema::<RtcpDocument<'_>>("identify-rtcp")]
}
