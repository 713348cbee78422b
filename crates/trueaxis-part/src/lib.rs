//! Test pieces: their ideal tool path, the evaluation of the cut surface and the verdict.
//!
//! ```text
//! TestPieceFile ──read──> TestPiece ──tool_positions──> the ideal path of the tool
//!       │                     │
//!       │                     └─evaluate(CutSurface)──> indices in mm ─┐
//!       │                              │                               │
//!       │                              └ fit::circle: LSC MZC MIC MCC  │
//!       └──────────────────────── Tolerances ──judge───────────────────┴──> Verdict
//! ```
//!
//! ```
//! use trueaxis_input::SourceText;
//! use trueaxis_part::TestPieceFile;
//! use trueaxis_part::testpiece::CutSurface;
//! use trueaxis_part::tolerance::{Acceptance, Outcome};
//!
//! let text = include_str!("../../../testpieces/nas979-gbt33150.toml");
//! let source = SourceText::new("nas979-gbt33150.toml", text);
//! let file = source.read(|root| TestPieceFile::read(root)).expect("the shipped file is good");
//! let piece = file.piece();
//!
//! // A faultless machine cuts a faultless cone.
//! let ideal = piece.ideal_deviation_mm();
//! let mut indices_mm = vec![0.0; piece.index_names().len()];
//! piece.evaluate(&CutSurface::about_ideal_axis(&ideal), &mut piece.scratch(), &mut indices_mm)?;
//! assert!(indices_mm.iter().all(|v| *v < 1e-12));
//! let verdict = file.tolerances.judge(piece.index_names(), &indices_mm, Acceptance::Simple)?;
//! assert_eq!(verdict.outcome, Outcome::Pass);
//! # Ok::<(), trueaxis_part::Error>(())
//! ```
//!
//! All lengths are in mm, in the workpiece frame. `examples/roundness.rs` evaluates the four
//! reference circles of a small profile.
//!
//! The crate knows nothing of machines and programs: it states the ideal positions of the tool and
//! evaluates the deviations from them. It opens no file.

// On top of the list of the workspace, as this crate has no hits.
#![warn(clippy::needless_pass_by_value, clippy::redundant_closure_for_method_calls)]
// Numbers decide here: a cast that could change one is checked or has a reason.
#![warn(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

mod error;
mod file;
pub mod fit;
pub mod part;
pub mod qif;
pub mod testpiece;
pub mod tolerance;

pub use error::Error;
pub use file::{CuttingCondition, SetUp, Shape, TestPieceFile};
