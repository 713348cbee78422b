//! Predictions and compensations as text, JSON and pages.

mod adapt;
mod adapt_document;
mod adapt_maps;
mod adapt_pictures;
mod compensation;
mod compensation_document;
mod holes;
mod holes_document;
mod holes_pictures;
mod prediction;
mod prediction_document;
mod prediction_pictures;
mod program;
mod program_document;
mod tables;
mod tables_document;

pub use adapt::{AdaptReport, AdaptedProgram, adapt_report};
pub use adapt_document::AdaptDocument;
pub use compensation::{compensation_csv, compensation_report, compensation_warnings};
pub use compensation_document::{CompensationDocument, compensation_json};
pub use holes::holes_report;
pub use holes_document::HolesDocument;
pub use prediction::prediction_report;
pub use prediction_document::PredictionDocument;
pub use program::{ProgramReport, program_report};
pub use program_document::ProgramDocument;
pub use tables::{TablesReport, tables_report};
pub use tables_document::TablesDocument;

use crate::predict::{Index, Prediction, Share};
use trueaxis_part::testpiece::{Family, Feature, IndexName};
use trueaxis_report::{NamedSchema, named_schema};

/// The feature in one word.
pub(crate) fn feature(name: &IndexName) -> &'static str {
    match name.feature {
        Feature::Roundness => "roundness",
        Feature::Coaxiality => "coaxiality",
        Feature::Angularity => "angularity",
        Feature::Volumetric => "volumetric",
    }
}

/// The indices that the verdict hangs on, with their place in every list of values.
pub(crate) fn decisive(prediction: &Prediction) -> impl Iterator<Item = (usize, &Index)> {
    prediction.indices.iter().enumerate().filter(|(_, i)| i.name.decisive)
}

fn family_key(family: Family) -> Option<&'static str> {
    match family {
        Family::Paper => Some("paper"),
        Family::Iso => Some("iso"),
        Family::Spatial => None,
    }
}

/// How much an index falls if an error is taken away, mm.
pub(crate) fn relief<T>(prediction: &Prediction, index: usize, share: &Share<T>) -> f64 {
    prediction.indices[index].value_mm - share.without_mm[index]
}

/// The shares that matter most for one index: by the larger of relief and effect alone.
pub(crate) fn ranked<'a, T>(
    prediction: &Prediction,
    index: usize,
    shares: &'a [Share<T>],
    most: usize,
) -> Vec<&'a Share<T>> {
    let mut ranked: Vec<_> = shares.iter().collect();
    let weight = |s: &Share<T>| relief(prediction, index, s).abs().max(s.alone_mm[index].abs());
    ranked.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    ranked.truncate(most);
    ranked
}

/// The JSON Schemas of the documents.
pub fn schemas() -> Vec<NamedSchema> {
    vec![
        named_schema::<PredictionDocument>("predict"),
        named_schema::<HolesDocument>("predict-holes"),
        named_schema::<CompensationDocument>("compensate"),
        named_schema::<TablesDocument>("compensate-tables"),
        named_schema::<ProgramDocument>("compensate-program"),
        named_schema::<AdaptDocument>("compensate-adapt"),
    ]
}
