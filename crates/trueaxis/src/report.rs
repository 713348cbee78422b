//! Machines, poses, comparisons and certificates as text, JSON and pages; the reports of the other verbs are
//! handed on here.

mod calibrations;
mod certificate;
mod certificate_blocks;
mod certificate_page;
mod check;
mod check_document;
mod comparison;
mod description;
mod diagnostic;
mod pose;

pub use calibrations::{
    CalibrationsReport, calibrations_html, calibrations_json, calibrations_text,
};
pub use certificate::{certificate_json, certificate_text};
pub use certificate_page::certificate_html;
pub use check::check_text;
pub use check_document::{CheckDocument, check_json};
pub use comparison::{comparison_html, comparison_json, comparison_text};
pub use description::description_json;
pub use diagnostic::{DiagnosticEntry, diagnostic_json, remarks};
pub use pose::{
    Bodies, Budget, PoseReport, array, bodies, bodies_json, bodies_table, budget, budget_json,
    budget_table, deviation_json, pose_json, pose_text,
};

pub use trueaxis_calibrate::report::*;
pub use trueaxis_correct::report::*;
pub use trueaxis_motion::report::*;
pub use trueaxis_report::{Band, Block, DrawingError, Picture, Polar, PolarLine, Scatter, numbers};
pub use trueaxis_standards::report::*;
