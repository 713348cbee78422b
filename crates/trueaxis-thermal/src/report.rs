//! Thermal models as text, page and document.

mod thermal;
mod thermal_document;
mod thermal_pictures;
mod thermal_score;

pub use thermal::{thermal_lines, thermal_report};
pub use thermal_document::ThermalDocument;
pub use thermal_score::{ScoringEntry, outside_pattern};
