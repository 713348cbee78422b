//! The loop: describe · simulate · predict · plan (and measure) · identify · compensate · verify.
//!
//! One machine file goes through all of it:
//!
//! - *describe*: [`machine`] (a checked machine tool, its poses and errors), [`describe`](mod@describe)
//!   (the machine as data, one error put into its file) and [`files`];
//! - *simulate*: [`simulate`](mod@simulate): an NC program on the actual machine: path, time, poses,
//!   deviations, issues;
//! - *predict*: [`predict`](mod@predict): the deviations of a test piece with their uncertainty, its verdict and
//!   error budget;
//! - *plan*: [`plan`](mod@plan): the errors that a measurement determines, its programs, the most informative poses;
//! - *identify*: [`identify`]: errors of the machine from any mix of instruments, the expansion of
//!   a scale, thermal models from logs; [`measure`]: readings of instruments on a virtual machine;
//! - *compensate*: [`compensate`]: values and tables for the control, corrected programs, and
//!   programs from cutter locations;
//! - *verify*: [`verify`]: readings of instruments evaluated by ISO 230, compared and certified;
//! - [`report`]: all of it as text, JSON and self-contained HTML pages; [`schemas`] of the JSON documents;
//! - [`questions`]: one question with its answer for each command; [`explain`]: the meaning of diagnostics.
//!
//! This crate reads and writes files ([`files`]); the others, which it re-exports under the names of the verbs,
//! do not.
//!
//! ```no_run
//! use trueaxis::predict::{predict, read_study};
//! let (study, problems) = read_study(&trueaxis::files::disk(), "nas979-on-xkas2525.toml".as_ref());
//! assert!(!problems.has_errors());
//! let prediction = predict(&study.unwrap(), &|_| {}).unwrap();
//! for judgement in &prediction.verdict.judgements {
//!     println!("{}: {} mm of {} mm", judgement.index.key, judgement.value_mm, judgement.limit_mm);
//! }
//! ```

pub mod explain;
pub use trueaxis_files as files;
pub mod questions;
pub mod report;
#[cfg(feature = "schemas")]
mod schemas;
pub mod verify;

#[cfg(feature = "schemas")]
pub use schemas::{add_diagnostics, schemas};

pub use trueaxis_calibrate::plan;
pub use trueaxis_cl as cl;
pub use trueaxis_correct::compensate;
pub use trueaxis_cut as cut;
pub use trueaxis_form as form;
pub use trueaxis_geometry as geometry;
pub use trueaxis_input as input;
pub use trueaxis_machine as machine;
pub use trueaxis_machine::describe;
pub use trueaxis_measure::{instruments, measure, unknowns};
pub use trueaxis_motion as simulate;
pub use trueaxis_nc as nc;
pub use trueaxis_part as part;
pub use trueaxis_post as post;
pub use trueaxis_predict::predict;
pub use trueaxis_writer as writer;

#[cfg(feature = "schemas")]
pub use trueaxis_report::NamedSchema;
pub use trueaxis_report::{JsonSchema, VERSION};

/// What is the machine like: errors from readings, and how they follow temperatures.
pub mod identify {
    pub use trueaxis_calibrate::identify::*;
    pub use trueaxis_rtcp::rtcp;
    pub use trueaxis_thermal::{expansion, thermal};
}

#[cfg(feature = "schemas")]
/// A JSON Schema.
pub use schemars::Schema;

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
