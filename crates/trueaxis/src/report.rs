//! A prediction for people and for programs.
//!
//! [`text`] is what the terminal shows, [`json`] the document `trueaxis/predict/1`, [`html`] one
//! page that opens offline.

mod html;
mod json;
mod page;
mod plots;
mod text;

pub use html::html;
pub use json::json;
pub use plots::DrawingError;
pub use text::text;

use crate::predict::{Index, Prediction, Share};
use trueaxis_machine::axis::{Axis, AxisKind, Command};
use trueaxis_part::testpiece::{Family, Feature, IndexName};

/// What an index is called in tables.
fn title(name: &IndexName) -> String {
    let words = match name.key {
        "roundness_eq18_mm" => "roundness, paper Eq 18",
        "angularity_eq19_mm" => "angularity, paper Eq 19",
        "coaxiality_eq20_mm" => "coaxiality, paper Eq 20",
        "coaxiality_diameter_mm" => "coaxiality, Eq 20 as diameter",
        "roundness_lsc_mm" => "roundness, least squares",
        "roundness_mzc_mm" => "roundness, minimum zone",
        "roundness_mic_mm" => "roundness, maximum inscribed",
        "roundness_mcc_mm" => "roundness, minimum circumscribed",
        "coaxiality_lsc_mm" => "coaxiality, diameter",
        "angularity_zone_mm" => "angularity, zone",
        "volumetric_max_mm" => "greatest deviation of the tip",
        other => other,
    };
    words.to_owned()
}

/// The feature in one word.
fn feature(name: &IndexName) -> &'static str {
    match name.feature {
        Feature::Roundness => "roundness",
        Feature::Coaxiality => "coaxiality",
        Feature::Angularity => "angularity",
        Feature::Volumetric => "volumetric",
    }
}

/// The indices that the verdict hangs on, with their place in every list of values.
fn decisive(prediction: &Prediction) -> impl Iterator<Item = (usize, &Index)> {
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
fn relief<T>(prediction: &Prediction, index: usize, share: &Share<T>) -> f64 {
    prediction.indices[index].value_mm - share.without_mm[index]
}

/// The shares that matter most for one index: by relief, then alone.
fn ranked<'a, T>(
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

/// mm or degrees.
fn shown(axis: &Axis, value: f64) -> f64 {
    match axis.kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => value.to_degrees(),
    }
}

fn unit(axis: &Axis) -> &'static str {
    match axis.kind {
        AxisKind::Linear => "mm",
        AxisKind::Rotary => "deg",
    }
}

/// `X 3114.7601 mm  C 0.0000 deg`.
fn command_words(axes: &[Axis], command: &Command) -> String {
    let words: Vec<String> = axes
        .iter()
        .zip(command)
        // + 0.0: no minus before a zero.
        .map(|(axis, q)| format!("{} {:.4} {}", axis.name, shown(axis, *q) + 0.0, unit(axis)))
        .collect();
    words.join("  ")
}
