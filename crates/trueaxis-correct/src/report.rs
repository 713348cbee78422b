//! Predictions and compensations as text, JSON and pages.

mod adapt;
mod adapt_maps;
mod adapt_page;
mod compensation;
mod holes;
mod holes_html;
mod prediction_json;
mod prediction_page;
mod prediction_text;
mod program;
mod program_page;
mod tables;

pub use adapt::{AdaptReport, AdaptedProgram, adapt_json, adapt_text};
pub use adapt_page::adapt_html;
pub use compensation::{
    compensation_csv, compensation_json, compensation_text, compensation_warnings,
};
pub use holes::{holes_json, holes_text};
pub use holes_html::holes_html;
pub use prediction_json::json;
pub use prediction_page::html;
pub use prediction_text::text;
pub use program::{ProgramReport, program_json, program_text};
pub use program_page::program_html;
pub use tables::{TablesReport, tables_json, tables_text};

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
