//! Plans, measurements and identifications as text, JSON and pages.

mod identification;
mod identification_arrows;
mod identification_document;
mod identification_page;
mod measurement;
mod measurement_document;
mod plan;
mod plan_document;
mod plan_page;
mod probe;
mod probe_document;
mod probe_page;
mod rtcp;
mod surface;
mod surface_document;
mod thermal;
mod thermal_document;
mod thermal_page;

pub use identification::{IdentificationReport, identification_text};
pub use identification_arrows::Arrow;
pub use identification_document::{IdentificationDocument, identification_json};
pub use identification_page::identification_html;
pub use measurement::{MeasuredReport, measurement_html, measurement_text};
pub use measurement_document::{MeasurementDocument, measurement_json};
pub use plan::plan_text;
pub use plan_document::{PlanDocument, plan_json};
pub use plan_page::plan_html;
pub use probe::{corrected_csv, probe_table_csv, probe_text};
pub use probe_document::{ProbeDocument, probe_json};
pub use probe_page::probe_html;
pub use rtcp::{RtcpDocument, RtcpReport, rtcp_json, rtcp_text};
pub use surface::surface_text;
pub use surface_document::{SurfaceDocument, surface_json};
pub use thermal::{thermal_lines, thermal_text};
pub use thermal_document::{ThermalDocument, thermal_json};
pub use thermal_page::thermal_html;
