//! A thermal model for programs: `trueaxis/identify/1` with `what` = `thermal`.

use super::thermal_score::ScoringEntry;
use crate::thermal::{Coefficient, Logs, Score, Scoring, Term, ThermalModel};
use serde::Serialize;
use trueaxis_report::JsonSchema;

/// A thermal model of one error, from logs of temperatures and displacements.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ThermalDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify/1"))]
    pub schema: &'static str,
    /// Which form of it: `thermal`.
    #[schemars(extend("const" = "thermal"))]
    pub what: &'static str,
    /// Name of the study.
    pub name: &'a str,
    /// The error, such as `EZ0t`.
    pub error: &'a str,
    /// Where the displacement is zero: `cycle`, `start` or `common`.
    pub zero: &'static str,
    /// `model` or `refused`.
    pub verdict: &'static str,
    /// Why the model is refused; null if it is not.
    pub refusal: Option<&'a str>,
    /// Share of the mean square drift of held-out cycles that the model explains, at most 1. Unit: 1.
    pub explained: f64,
    /// Root mean square without a model, µm.
    pub no_model_um: f64,
    /// Root mean square of the residual on the rows of the fit, µm.
    pub in_sample_um: f64,
    /// The same with single rows held out, µm.
    pub row_wise_um: f64,
    /// The same with whole cycles held out, µm.
    pub held_out_um: f64,
    /// The same, counted from the first row of each cycle, µm.
    pub held_out_since_start_um: f64,
    /// Standard uncertainty of one reading, µm.
    pub repeatability_um: f64,
    /// Whether it is stated; if not, it comes from neighbouring readings.
    pub repeatability_stated: bool,
    /// Number of terms of the chosen model.
    pub chosen_terms: usize,
    /// The coefficients of the chosen model.
    pub coefficients: Vec<CoefficientEntry<'a>>,
    /// Correlations of the coefficients, −1 to 1, row by row. Unit: 1.
    pub correlation: &'a [Vec<f64>],
    /// The displacement where all sensors read the reference, µm; null if the zero is free.
    pub intercept_um: Option<f64>,
    /// Where the model is zero, °C.
    pub reference_celsius: f64,
    /// The models tried, from no term on.
    pub scores: Vec<ThermalScoreEntry<'a>>,
    /// The model of all terms at once.
    pub all_terms: ThermalScoreEntry<'a>,
    /// The cycles.
    pub cycles: Vec<CycleEntry<'a>>,
    /// The lines for the machine file; null if there are none.
    pub machine_file: Option<&'a str>,
    /// Why there are no such lines; else null.
    pub no_machine_file_because: Option<&'a str>,
    /// What to observe when the model is used.
    pub warnings: &'a [String],
    /// How later logs agree with it; null without later logs.
    pub later: Option<ScoringEntry<'a>>,
}

/// A coefficient.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CoefficientEntry<'a> {
    /// The sensor and its lag.
    #[serde(flatten)]
    pub term: TermEntry<'a>,
    /// The coefficient, µm/K.
    pub um_per_k: f64,
    /// Its standard uncertainty, µm/K.
    pub u_um_per_k: f64,
    /// The least and the greatest temperature in the logs, °C.
    pub range_celsius: [f64; 2],
}

/// A term of a model.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TermEntry<'a> {
    /// The sensor.
    pub sensor: &'a str,
    /// Time constant of its lag, s; null without lag.
    pub lag_s: Option<f64>,
}

/// How well a model of some terms does.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ThermalScoreEntry<'a> {
    /// Its terms.
    pub terms: Vec<TermEntry<'a>>,
    /// Root mean square of the residual on the rows of the fit, µm.
    pub in_sample_um: f64,
    /// The same with single rows held out, µm.
    pub row_wise_um: f64,
    /// The same with whole cycles held out, µm.
    pub held_out_um: f64,
    /// Its square, µm².
    pub held_out_um2: f64,
    /// Standard uncertainty of the square, µm².
    pub u_held_out_um2: f64,
    /// Root mean square of each cycle, held out, µm.
    pub by_cycle_um: Vec<f64>,
    /// How many times the same terms were chosen with one cycle held out.
    pub chosen_again: usize,
    /// Condition number of the columns; null if they are linearly dependent. Unit: 1.
    pub condition: Option<f64>,
}

/// A cycle of the logs.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CycleEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// Number of its rows.
    pub rows: usize,
    /// Root mean square without a model, µm.
    pub no_model_um: f64,
    /// Root mean square of the residual, predicted without this cycle, µm.
    pub held_out_um: f64,
}

impl<'a> ThermalDocument<'a> {
    /// The document of a model; `lines` are those of the report.
    pub fn of(
        logs: &'a Logs,
        model: &'a ThermalModel,
        lines: &'a Result<String, String>,
        scoring: Option<&'a Scoring>,
    ) -> Self {
        let (none, chosen) = (&model.scores[0], model.score());
        let cycles = logs.cycles.iter().enumerate().map(|(g, cycle)| CycleEntry {
            name: &cycle.name,
            rows: cycle.displacement_mm.len(),
            no_model_um: none.by_cycle_mm[g] * 1e3,
            held_out_um: chosen.by_cycle_mm[g] * 1e3,
        });
        Self {
            schema: "trueaxis/identify/1",
            what: "thermal",
            name: &logs.name,
            error: &logs.error,
            zero: logs.zero.name(),
            verdict: if model.refusal.is_some() { "refused" } else { "model" },
            refusal: model.refusal.as_deref(),
            explained: model.explained(),
            no_model_um: none.held_out_mm * 1e3,
            in_sample_um: chosen.in_sample_mm * 1e3,
            row_wise_um: chosen.row_wise_mm * 1e3,
            held_out_um: chosen.held_out_mm * 1e3,
            held_out_since_start_um: model.since_start_mm * 1e3,
            repeatability_um: model.repeatability_mm * 1e3,
            repeatability_stated: model.repeatability_stated,
            chosen_terms: model.chosen,
            coefficients: model.coefficients.iter().map(|c| coefficient(logs, c)).collect(),
            correlation: &model.correlation,
            intercept_um: model.intercept_mm.map(|mm| mm * 1e3),
            reference_celsius: logs.reference_celsius,
            scores: model.scores.iter().map(|s| score(logs, s)).collect(),
            all_terms: score(logs, &model.all_terms),
            cycles: cycles.collect(),
            machine_file: lines.as_deref().ok(),
            no_machine_file_because: lines.as_ref().err().map(String::as_str),
            warnings: &model.warnings,
            later: scoring.map(|s| ScoringEntry::of(logs, s)),
        }
    }
}

fn term<'a>(logs: &'a Logs, term: &Term) -> TermEntry<'a> {
    TermEntry { sensor: &logs.sensors[term.sensor], lag_s: term.lag_s }
}

fn coefficient<'a>(logs: &'a Logs, c: &Coefficient) -> CoefficientEntry<'a> {
    CoefficientEntry {
        term: term(logs, &c.term),
        um_per_k: c.mm_per_k * 1e3,
        u_um_per_k: c.u_mm_per_k * 1e3,
        range_celsius: c.range_celsius,
    }
}

fn score<'a>(logs: &'a Logs, score: &Score) -> ThermalScoreEntry<'a> {
    ThermalScoreEntry {
        terms: score.terms.iter().map(|t| term(logs, t)).collect(),
        in_sample_um: score.in_sample_mm * 1e3,
        row_wise_um: score.row_wise_mm * 1e3,
        held_out_um: score.held_out_mm * 1e3,
        held_out_um2: score.held_out_mm.powi(2) * 1e6,
        u_held_out_um2: score.u_held_out_mm2 * 1e6,
        by_cycle_um: score.by_cycle_mm.iter().map(|v| v * 1e3).collect(),
        chosen_again: score.chosen_again,
        condition: score.condition.is_finite().then_some(score.condition),
    }
}
