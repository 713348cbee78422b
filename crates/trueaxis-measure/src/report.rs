//! A measurement as text, JSON and page.

mod measurement;
mod measurement_document;

pub use measurement::{MeasuredReport, measurement_report};
pub use measurement_document::MeasurementDocument;
