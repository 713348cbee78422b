//! Thermal models as text, page and document.

mod thermal;
mod thermal_document;
mod thermal_pictures;

pub use thermal::{thermal_lines, thermal_report};
pub use thermal_document::ThermalDocument;
