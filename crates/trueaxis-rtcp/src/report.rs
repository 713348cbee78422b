//! Rotary centres as text, JSON and pages.

mod rtcp;
mod rtcp_document;

pub use rtcp::{RtcpReport, rtcp_report};
pub use rtcp_document::RtcpDocument;
