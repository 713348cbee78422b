//! What is the machine like? What a measurement will show before anybody measures, and which errors readings
//! show.
//!
//! ```text
//!     plan ──────> identify
//!     before       after the measurement
//! ```
//!
//! It does not know what the errors do to a part, nor how they are compensated.

pub mod identify;
pub mod plan;
pub mod report;

/// The JSON Schemas of the documents of this crate, by name; forms of `identify/1` have names of their own.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use report::{
        HitsDocument, IdentificationDocument, MeasuredToolsDocument, PlanDocument, ProbeDocument,
        SurfaceDocument, ToolSettingDocument,
    };
    use trueaxis_report::named_schema;
    vec![
        named_schema::<IdentificationDocument<'_>>("identify-errors"),
        named_schema::<ProbeDocument<'_>>("identify-probe"),
        named_schema::<HitsDocument<'_>>("identify-surface"),
        named_schema::<MeasuredToolsDocument<'_>>("identify-tools"),
        named_schema::<PlanDocument<'_>>("plan"),
        named_schema::<SurfaceDocument<'_>>("plan-probe-surface"),
        named_schema::<ToolSettingDocument<'_>>("plan-tool-setting"),
    ]
}
