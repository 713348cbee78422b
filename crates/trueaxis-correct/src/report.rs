//! Compensations as text, JSON and pages.

mod adapt;
mod adapt_document;
mod adapt_maps;
mod adapt_pictures;
mod compensation;
mod compensation_document;
mod program;
mod program_document;
mod tables;
mod tables_document;

pub use adapt::{AdaptReport, AdaptedProgram, adapt_report};
pub use adapt_document::AdaptDocument;
pub use compensation::{compensation_csv, compensation_report, compensation_warnings};
pub use compensation_document::{CompensationDocument, compensation_json};
pub use program::{ProgramReport, program_report};
pub use program_document::ProgramDocument;
pub use tables::{PartWithTables, TablesReport, tables_report};
pub use tables_document::TablesDocument;

/// The JSON Schemas of the documents.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use trueaxis_report::named_schema;
    vec![
        named_schema::<CompensationDocument>("compensate"),
        named_schema::<TablesDocument>("compensate-tables"),
        named_schema::<ProgramDocument>("compensate-program"),
        named_schema::<AdaptDocument>("compensate-adapt"),
    ]
}
