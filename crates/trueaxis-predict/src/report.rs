//! Predictions as text, JSON and pages.

mod drawing;
mod drawing_document;
mod drawing_pictures;
mod holes;
mod holes_document;
mod holes_pictures;
mod part_file;
mod prediction;
mod prediction_document;
mod prediction_pictures;

pub use drawing::{compensated_table, drawing_report};
pub use drawing_document::DrawingDocument;
pub use holes::holes_report;
pub use holes_document::HolesDocument;
pub use part_file::{PartFileDocument, draft_report, part_report};
pub use prediction::prediction_report;
pub use prediction_document::PredictionDocument;

use crate::predict::{Index, Prediction, Share};
use trueaxis_part::testpiece::{Family, Feature, IndexName};

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
