//! What will the machine do to the part?
//!
//! - [`predict`](mod@predict): is the part that this machine cuts within its tolerances, with what
//!   uncertainty, and what does each error contribute;
//! - [`report`]: the answer as text, JSON and page.
//!
//! ```
//! use trueaxis_predict::predict::holes::compensation_increments;
//! // 54 increments of 1 µm take away an error of −54.4 µm; halves are rounded away from zero.
//! assert_eq!(compensation_increments(-0.0544, 0.001), 54);
//! assert_eq!(compensation_increments(0.0005, 0.001), -1);
//! ```
//!
//! It takes the errors as they are stated: where they come from is the subject of `trueaxis-calibrate`;
//! `trueaxis-correct` says what the machine must be commanded instead.

pub mod predict;
pub mod report;

/// The JSON Schemas of the documents.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use report::{DrawingDocument, HolesDocument, PredictionDocument};
    use trueaxis_report::named_schema;
    vec![
        named_schema::<PredictionDocument>("predict"),
        named_schema::<HolesDocument>("predict-holes"),
        named_schema::<DrawingDocument>("predict-part"),
    ]
}
