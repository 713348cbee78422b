//! Plans, measurements and identifications as text, JSON and pages.

mod identification;
mod identification_arrows;
mod identification_page;
mod measurement;
mod plan;
mod plan_page;
mod probe;
mod probe_page;
mod rtcp;
mod surface;
mod thermal;
mod thermal_page;

pub use identification::{
    IdentificationReport, conventions_json, conventions_text, identification_json,
    identification_text,
};
pub use identification_arrows::Arrow;
pub use identification_page::identification_html;
pub use measurement::{MeasuredReport, measurement_html, measurement_json, measurement_text};
pub use plan::{plan_json, plan_text};
pub use plan_page::plan_html;
pub use probe::{corrected_csv, probe_json, probe_table_csv, probe_text};
pub use probe_page::probe_html;
pub use rtcp::{RtcpReport, rtcp_json, rtcp_text};
pub use surface::{surface_json, surface_text};
pub use thermal::{thermal_json, thermal_lines, thermal_text};
pub use thermal_page::thermal_html;
