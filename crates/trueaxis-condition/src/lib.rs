//! What is wrong with the machine?
//!
//! ```text
//!     circle of a ball-bar + machine ──ball_bar──> errors by their ISO 230-1 names, machine file, read back
//! ```
//!
//! [`history`]: figures of machine files and evaluations over the years; [`certificate_head`]: who, where, with which
//! instruments.
//!
//! The figures of the standards come from `trueaxis-standards`, the machine from `trueaxis-machine`.

pub mod ball_bar;
pub mod certificate_head;
pub mod history;
pub mod history_report;
pub mod report;
pub mod virtual_circle;

/// The JSON Schemas of the documents of this crate, by name.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use trueaxis_report::named_schema;
    vec![
        named_schema::<report::EvaluatedDocument<'_>>("evaluate"),
        named_schema::<history_report::HistoryDocument<'_>>("history"),
    ]
}
