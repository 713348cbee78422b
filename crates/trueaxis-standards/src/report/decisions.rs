//! Figures against their tolerances: as a table, a verdict and for programs.

use super::diagnosis::freedom_in_words;
use super::evaluation::cell;
use crate::judge::{Decision, Judged, overall};
use serde::Serialize;
use trueaxis_input::Dimension;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Keyed, Standing, Table};

/// Figures against their tolerances.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DecisionsEntry {
    /// `ISO 14253-1` or `simple`.
    pub rule: &'static str,
    /// `conforming`, `not conforming` or `neither proved`: the worst of all.
    pub decision: &'static str,
    /// Every figure that has a tolerance.
    pub figures: Vec<DecisionEntry>,
}

/// A figure with its tolerance.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DecisionEntry {
    /// Its name.
    pub figure: String,
    /// `value`, `U` and `tolerance`, each key with its unit `_um`, `_arcsec` or `_degC`; `U` is null where it is not known.
    #[serde(flatten)]
    pub numbers: Keyed<Option<f64>>,
    /// Effective degrees of freedom of U; null for infinitely many, and where U is not known. Unit: 1.
    pub degrees_of_freedom: Option<f64>,
    /// The coverage factor of U; null where U is not known. Unit: 1.
    pub k: Option<f64>,
    /// `conforming`, `not conforming` or `neither proved`.
    pub decision: &'static str,
}

/// Unit in words and in keys, with the factor from mm, rad or °C.
fn unit(dimension: Dimension) -> (&'static str, &'static str, f64) {
    match dimension {
        Dimension::Angle => ("arcsec", "arcsec", 1f64.to_degrees() * 3600.0),
        Dimension::Temperature => ("°C", "degC", 1.0),
        _ => ("µm", "um", 1e3),
    }
}

fn rule(judged: &[Judged]) -> &'static str {
    if judged.iter().any(|j| j.is_guarded) { "ISO 14253-1" } else { "simple" }
}

impl DecisionsEntry {
    pub(super) fn of(judged: &[Judged]) -> Option<Self> {
        let decision = overall(judged)?.word();
        let entry = |j: &Judged| {
            let (_, unit, scale) = unit(j.figure.dimension);
            let uncertainty = j.figure.uncertainty;
            let numbers = [
                (format!("value_{unit}"), Some(j.figure.value * scale)),
                (format!("U_{unit}"), uncertainty.map(|u| u.expanded() * scale)),
                (format!("tolerance_{unit}"), Some(j.limit * scale)),
            ];
            DecisionEntry {
                figure: j.figure.name.clone(),
                numbers: numbers.into_iter().collect(),
                degrees_of_freedom: uncertainty.and_then(|u| u.degrees_of_freedom),
                k: uncertainty.map(|u| u.coverage_factor),
                decision: j.decision.word(),
            }
        };
        Some(Self { rule: rule(judged), decision, figures: judged.iter().map(entry).collect() })
    }
}

pub(super) fn table(judged: &[Judged]) -> Option<(String, Table)> {
    if judged.is_empty() {
        return None;
    }
    let row = |j: &Judged| {
        let (unit, _, scale) = unit(j.figure.dimension);
        let u = j.figure.uncertainty;
        [
            j.figure.name.clone(),
            cell(Some(j.figure.value), scale),
            cell(u.map(|u| u.expanded()), scale),
            cell(Some(j.limit), scale),
            unit.to_owned(),
            freedom_in_words(u),
            u.map_or("–".to_owned(), |u| format!("{:.2}", u.coverage_factor)),
            j.decision.word().to_owned(),
        ]
    };
    let note = match rule(judged) {
        "simple" => "Simple acceptance: the value alone counts.",
        _ => {
            "ISO 14253-1: conforming where the size + U ≤ tolerance, not conforming where the size − U > tolerance. \
              k = 2 with ν = ∞ where ISO/TR 230-9 prescribes k = 2 for contributions that are stated."
        }
    };
    let table = Table::new(["figure", "value", "U", "tolerance", "", "ν", "k", "decision"]);
    Some(("Tolerances".to_owned(), table.rows(judged.iter().map(row)).note(note)))
}

/// Standing, word and sentence of the verdict.
pub(super) fn verdict(judged: &[Judged]) -> Option<(Standing, String, String)> {
    let decision = overall(judged)?;
    let (standing, word) = match decision {
        Decision::Conforming => (Standing::Good, "PASS"),
        Decision::NotConforming => (Standing::Bad, "FAIL"),
        Decision::NotProved => (Standing::Open, "UNDECIDED"),
    };
    let of = |wanted: Decision| -> Vec<&str> {
        judged.iter().filter(|j| j.decision == wanted).map(|j| j.figure.name.as_str()).collect()
    };
    let sentence = match decision {
        Decision::Conforming => format!("every tolerance is kept ({})", rule(judged)),
        other => format!("{}: {} ({})", of(other).join(", "), other.word(), rule(judged)),
    };
    Some((standing, word.to_owned(), sentence))
}
