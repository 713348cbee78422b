//! An evaluation as text, JSON and a page.

mod evaluation;
mod evaluation_circular;
mod evaluation_document;
mod evaluation_others;
mod evaluation_positioning;

pub use evaluation::{Contents, Evaluation, evaluation_report};
pub use evaluation_document::EvaluationDocument;
