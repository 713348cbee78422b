//! The answer of a study as text, document and page.

mod document;
mod pictures;
mod text;

pub use document::StudyDocument;
pub use text::study_report;
