//! Plans, measurements and identifications as text, JSON and pages.

mod adequacy;
mod hits;
mod hits_document;
mod identification;
mod identification_arrows;
mod identification_document;
mod identification_pictures;
mod plan;
mod plan_document;
mod probe;
mod probe_document;
mod probe_pictures;
mod stages;
mod surface;
mod surface_document;
mod tool_setting;
mod tool_setting_document;

pub use hits::{deviations_csv, deviations_report};
pub use hits_document::HitsDocument;
pub use identification::{IdentificationReport, identification_report};
pub use identification_arrows::Arrow;
pub use identification_document::IdentificationDocument;
pub use plan::plan_report;
pub use plan_document::PlanDocument;
pub use probe::{corrected_csv, probe_report, probe_table_csv};
pub use probe_document::ProbeDocument;
pub use surface::surface_report;
pub use surface_document::SurfaceDocument;
pub use tool_setting::{setting_report, tools_report};
pub use tool_setting_document::{MeasuredToolsDocument, ToolSettingDocument};
