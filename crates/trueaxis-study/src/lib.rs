//! What do many machines do on many days?
//!
//! A study varies errors, temperatures and set-ups of a machine by distributions, and asks of every sample what `predict` asks
//! of one machine: how many machines of a series will hold the part, what the summer of the hall does, which tolerance of a
//! guideway is worth its money.
//!
//! ```text
//! study.toml ──read_study──> Study { cases, inputs, design }
//! sample number ──place──> machine, day ──Drawer──> inputs ──case──> outputs        any sample at any time, the same bits
//! [outputs] ──findings──> spread, shares of good parts and machines, sensitivity ──> answer
//! ```
//!
//! It stands above the facade; `trueaxis study` and the package for Python are its doors.

mod cases;
mod correlation;
mod design;
mod distribution;
mod draw;
mod evaluate;
mod file;
pub mod findings;
mod inputs;
mod points;
mod question;
pub mod report;
pub mod sensitivity;
mod study;
mod table;

pub use cases::{Case, Output};
pub use correlation::Correlation;
pub use design::{Design, Matrix, Place};
pub use distribution::Distribution;
pub use evaluate::SampleFault;
pub use file::{Changes, read_study};
pub use inputs::{Input, Level, Term, Varied};
pub use points::{Column, ColumnPlan, Set, Spreading, sobol_dimensions};
pub use question::{AskStudy, StudyAnswer};
pub use study::{Requirement, Study};
pub use table::input_unit;

/// The JSON Schemas of the documents.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use report::StudyDocument;
    use trueaxis_report::named_schema;
    vec![named_schema::<StudyDocument>("study")]
}
