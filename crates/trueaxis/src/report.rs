//! Machines, poses, comparisons and certificates as text, JSON and pages; the reports of the other verbs are
//! handed on here.

mod before_after;
mod before_after_document;
mod calibrations;
mod calibrations_document;
mod certificate;
mod certificate_document;
mod certificate_pictures;
mod check;
mod check_document;
mod comparison;
mod comparison_document;
mod description_document;
mod diagnostic;
mod error_tables;
mod error_tables_document;
mod expansion;
mod expansion_document;
mod frames;
mod part;
mod part_document;
mod pose;
mod pose_document;
mod post;
mod post_document;
mod solve;
mod solve_document;
mod trace;
mod trace_document;

pub use before_after::{BeforeAfterReport, before_after_report};
pub use before_after_document::BeforeAfterDocument;
pub use calibrations::{CalibrationsReport, calibrations_report};
pub use calibrations_document::DiffDocument;
pub use certificate::certificate_report;
pub use certificate_document::CertificateDocument;
pub use check::check_report;
pub use check_document::{CheckDocument, check_json};
pub use comparison::comparison_report;
pub use comparison_document::VerifyDocument;
pub use description_document::{DescriptionDocument, description_json};
pub use diagnostic::{DiagnosticEntry, RefusedDocument, diagnostic_json, refused_json, remarks};
pub use error_tables::error_tables_report;
pub use error_tables_document::{TablesFound, TablesFoundDocument};
pub use expansion::expansion_report;
pub use expansion_document::{ExpansionDocument, ExpansionsDocument, ScaleFound};
pub use frames::{FrameEntry, frames, frames_section};
pub use part::part_report;
pub use part_document::VerifyPartDocument;
pub use pose::{Bodies, Budget, PoseReport, array, bodies, budget, pose_report};
pub use pose_document::{PoseDocument, PoseRowsDocument};
pub use post::{PostReport, post_report};
pub use post_document::PostDocument;
pub use solve::solve_report;
pub use solve_document::{SolveDocument, SolvePathDocument, solve_json, solve_path_json};
pub use trace::{TraceReport, trace_report};
pub use trace_document::TraceDocument;

pub use trueaxis_calibrate::report::*;
pub use trueaxis_condition::history_report::HistoryDocument;
pub use trueaxis_correct::report::*;
pub use trueaxis_measure::report::*;
pub use trueaxis_motion::report::*;
pub use trueaxis_predict::report::*;
#[cfg(feature = "schemas")]
pub use trueaxis_report::named_schema;
pub use trueaxis_report::{
    Band, DrawingError, English, Item, Keyed, Language, Picture, Polar, PolarLine, Report, Scatter,
    Section, Table, Verdict, document, numbers,
};
pub use trueaxis_rtcp::report::*;
pub use trueaxis_standards::report::*;
pub use trueaxis_thermal::report::*;
