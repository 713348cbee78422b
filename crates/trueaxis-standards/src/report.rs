//! An evaluation as text, JSON and a page.

mod evaluation;
mod evaluation_circular;
mod evaluation_document;
mod evaluation_html;
mod evaluation_others;
mod evaluation_positioning;

pub use evaluation::{Evaluation, Sheets, evaluation_text};
pub use evaluation_document::{EvaluationDocument, evaluation_json};
pub use evaluation_html::evaluation_html;
