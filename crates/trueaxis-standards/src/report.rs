//! An evaluation as text, JSON and a page.

mod circular_document;
mod decisions;
mod diagnosis;
mod evaluation;
mod evaluation_circular;
mod evaluation_document;
mod evaluation_geometric;
mod evaluation_others;
mod evaluation_positioning;
mod evaluation_probing;
mod form;
mod form_document;

pub use decisions::DecisionsEntry;
pub use diagnosis::cause_in_words;
pub use evaluation::{Contents, Evaluation, evaluation_report};
pub use evaluation_document::EvaluationDocument;
pub use form::{FormShown, form_report};
pub use form_document::{ContactEntry, FormDocument, LeastSquaresEntry, ReferenceEntry};
