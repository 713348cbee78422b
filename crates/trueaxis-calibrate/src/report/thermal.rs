//! A thermal model as text and JSON.

use crate::identify::thermal::{Logs, Score, ThermalModel, Zero};
use std::fmt::Write;
use trueaxis_machine::errors::ErrorName;

/// The lines for the machine file, or why there are none.
///
/// # Errors
/// In words: the model is refused, has lags, or is of no error of a machine.
pub fn thermal_lines(logs: &Logs, model: &ThermalModel) -> Result<String, String> {
    if model.refusal.is_some() {
        return Err("the model is refused".to_owned());
    }
    if model.coefficients.iter().any(|c| c.term.lag_s.is_some()) {
        let why = "the machine file has no lags, so this model is shown, not written; a study without \
                   `lags` finds the best model of the readings alone";
        return Err(why.to_owned());
    }
    let Some(error) = ErrorName::parse(&logs.error) else {
        return Err(format!("`{}` is no error of a machine file, such as EZ0t", logs.error));
    };
    let mut lines = format!("[heat.{error}]\n");
    for c in &model.coefficients {
        let (name, k, u) = (&logs.sensors[c.term.sensor], c.mm_per_k * 1e3, c.u_mm_per_k * 1e3);
        // Writing to a String cannot fail.
        let _ = writeln!(lines, "{} = \"{k:.4} ± {u:.4} um/K\"", key(name));
    }
    let _ = writeln!(lines, "reference = \"{} degC\"", logs.reference_celsius);
    Ok(lines)
}

/// A TOML key, quoted where it must be.
fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(bare) {
        true => name.to_owned(),
        false => {
            let plain = |c: char| if c.is_control() { ' ' } else { c };
            let inner: String = name.chars().map(plain).collect();
            format!("\"{}\"", inner.replace('\\', "\\\\").replace('"', "\\\""))
        }
    }
}

/// What the model is worth, in one sentence.
pub(super) fn verdict(model: &ThermalModel) -> String {
    if let Some(refusal) = &model.refusal {
        return format!("no model: {refusal}");
    }
    let score = model.score();
    format!(
        "{} of the mean square drift of cycles that it has not seen: {:.2} µm without a model, \
         {:.2} µm left; one reading has {:.2} µm",
        percent(model.explained()),
        model.scores[0].held_out_mm * 1e3,
        score.held_out_mm * 1e3,
        model.repeatability_mm * 1e3
    )
}

fn percent(share: f64) -> String {
    format!("{:.0} %", share * 100.0)
}

pub(super) fn names(logs: &Logs, score: &Score) -> String {
    match score.terms.is_empty() {
        true => "none".to_owned(),
        false => score.terms.iter().map(|t| t.name(logs)).collect::<Vec<_>>().join(", "),
    }
}

/// What is free in each cycle, in words.
pub(super) fn zero(logs: &Logs) -> &'static str {
    match logs.zero {
        Zero::Cycle => "free in each cycle (the zero of the probe is unknown)",
        Zero::Start => "the first reading of each cycle",
        Zero::Common => "common to all cycles",
    }
}

/// Headings and rows of the table of scores.
pub(super) const SCORES: [&str; 6] =
    ["terms", "in sample", "single rows out", "whole cycles out", "again", "condition"];

/// One row of the table of scores, without the names of the sensors.
pub(super) fn score_cells(logs: &Logs, score: &Score) -> [String; 6] {
    let um = |mm: f64| format!("{:.2}", mm * 1e3);
    let cycles = logs.cycles.len();
    // With nothing to choose the same is always chosen.
    let again = match score.terms.is_empty() {
        true => "-".to_owned(),
        false => format!("{}/{cycles}", score.chosen_again),
    };
    let condition = match score.condition.is_finite() {
        true => format!("{:.0}", score.condition),
        false => "∞".to_owned(),
    };
    [
        score.terms.len().to_string(),
        um(score.in_sample_mm),
        um(score.row_wise_mm),
        format!("{} ± {}", um(score.held_out_mm), um(u_of_root(score))),
        again,
        condition,
    ]
}

/// Of the root, from that of the mean square, first order.
fn u_of_root(score: &Score) -> f64 {
    if score.held_out_mm > 0.0 { score.u_held_out_mm2 / (2.0 * score.held_out_mm) } else { 0.0 }
}

/// The model as a table, with the verdict first.
pub fn thermal_text(logs: &Logs, model: &ThermalModel) -> String {
    let rows: usize = logs.cycles.iter().map(|c| c.displacement_mm.len()).sum();
    let mut text = format!("{}\n\n", logs.name);
    // Writing to a String cannot fail.
    let _ = writeln!(text, "  error     {}", logs.error);
    let _ = writeln!(text, "  logs      {} cycles, {rows} rows", logs.cycles.len());
    let _ = writeln!(text, "  zero      {}", zero(logs));
    let _ = writeln!(text, "\n  {}\n", verdict(model));
    let [a, b, c, d, e, f] = SCORES;
    let _ = writeln!(text, "  rms, µm   {a:>5} {b:>10} {c:>16} {d:>18} {e:>7} {f:>10}  sensors");
    for (i, score) in model.scores.iter().enumerate() {
        let mark = if i == model.chosen { "->" } else { "  " };
        score_line(&mut text, mark, logs, score, &names(logs, score));
    }
    score_line(&mut text, "all", logs, &model.all_terms, "all at once: over-fitted");
    let _ = writeln!(text, "\n  {}", beside(model));
    coefficients(&mut text, logs, model);
    let _ = writeln!(text, "\n  cycle                      without a model   held out, rms, µm");
    for (g, cycle) in logs.cycles.iter().enumerate() {
        let (none, with) = (model.scores[0].by_cycle_mm[g], model.score().by_cycle_mm[g]);
        let name = &cycle.name;
        let _ = writeln!(text, "  {name:<28} {:>13.2} {:>19.2}", none * 1e3, with * 1e3);
    }
    match thermal_lines(logs, model) {
        Ok(lines) => {
            let _ = write!(text, "\n  in the machine file:\n\n{lines}");
        }
        Err(why) => {
            let _ = writeln!(text, "\n  nothing for the machine file: {why}");
        }
    }
    text
}

/// What stands beside the scores.
pub(super) fn beside(model: &ThermalModel) -> String {
    let stated = if model.repeatability_stated { "stated" } else { "from neighbouring readings" };
    format!(
        "repeatability of a reading {:.2} µm ({stated}); held out and counted from the first row of each \
         cycle {:.2} µm",
        model.repeatability_mm * 1e3,
        model.since_start_mm * 1e3
    )
}

fn score_line(text: &mut String, mark: &str, logs: &Logs, score: &Score, names: &str) {
    let [a, b, c, d, e, f] = score_cells(logs, score);
    let _ = writeln!(text, "  {mark:<9} {a:>5} {b:>10} {c:>16} {d:>18} {e:>7} {f:>10}  {names}");
}

fn coefficients(text: &mut String, logs: &Logs, model: &ThermalModel) {
    if model.coefficients.is_empty() {
        return;
    }
    let refused = if model.refusal.is_some() { " (refused)" } else { "" };
    let _ = writeln!(text, "\n  coefficient, µm/K, with standard uncertainty{refused}");
    for c in &model.coefficients {
        let [low, high] = c.range_celsius;
        let _ = writeln!(
            text,
            "  {:<28} {:>9.3} ± {:.3}   logged from {low:.1} to {high:.1} °C",
            c.term.name(logs),
            c.mm_per_k * 1e3,
            c.u_mm_per_k * 1e3
        );
    }
    if let Some(intercept_mm) = model.intercept_mm {
        let _ = writeln!(
            text,
            "  {:<28} {:>9.3} µm",
            format!("where all read {} °C", logs.reference_celsius),
            intercept_mm * 1e3
        );
    }
}
