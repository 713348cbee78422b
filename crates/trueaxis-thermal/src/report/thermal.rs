//! A thermal model in text and on a page.

use super::thermal_pictures::{cycle_picture, scores_picture};
use super::thermal_score::{score_section as later_section, sentence};
use crate::thermal::{Logs, Score, Scoring, ThermalModel, Zero};
use std::fmt::Write as _;
use trueaxis_machine::errors::ErrorName;
use trueaxis_report::{Columns, Figure, Report, Section, Standing, Table};

/// More cycles are not drawn one by one.
const MOST_DRAWN: usize = 24;

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
fn verdict(model: &ThermalModel) -> String {
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

fn names(logs: &Logs, score: &Score) -> String {
    match score.terms.is_empty() {
        true => "none".to_owned(),
        false => score.terms.iter().map(|t| t.name(logs)).collect::<Vec<_>>().join(", "),
    }
}

/// What is free in each cycle, in words.
fn zero(logs: &Logs) -> &'static str {
    match logs.zero {
        Zero::Cycle => "free in each cycle (the zero of the probe is unknown)",
        Zero::Start => "the first reading of each cycle",
        Zero::Common => "common to all cycles",
    }
}

/// One row of the table of scores.
fn score_row(logs: &Logs, score: &Score, names: String) -> [String; 7] {
    let um = |mm: f64| format!("{:.2}", mm * 1e3);
    // With nothing to choose the same is always chosen.
    let again = match score.terms.is_empty() {
        true => "–".to_owned(),
        false => format!("{}/{}", score.chosen_again, logs.cycles.len()),
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
        names,
    ]
}

/// Of the root, from that of the mean square, first order.
fn u_of_root(score: &Score) -> f64 {
    if score.held_out_mm > 0.0 { score.u_held_out_mm2 / (2.0 * score.held_out_mm) } else { 0.0 }
}

/// The model in text and on a page.
pub fn thermal_report<'a>(
    logs: &'a Logs,
    model: &'a ThermalModel,
    scoring: Option<&'a Scoring>,
) -> Report<'a> {
    let rows: usize = logs.cycles.iter().map(|c| c.displacement_mm.len()).sum();
    let (standing, word, said) = match (&model.refusal, scoring) {
        (Some(refusal), _) => (Standing::Bad, "no model", refusal.clone()),
        (None, None) => (Standing::Good, "MODEL", verdict(model)),
        (None, Some(s)) if s.as_promised() => (Standing::Good, "AS PROMISED", sentence(s)),
        (None, Some(s)) => (Standing::Bad, "WORSE THAN PROMISED", sentence(s)),
    };
    let lines = match thermal_lines(logs, model) {
        Ok(lines) => Section::new("In the machine file").code(lines),
        Err(why) => Section::new("").paragraph(format!("Nothing for the machine file: {why}.")),
    };
    Report::new(&logs.name)
        .line(format!(
            "Thermal model of {} from {} cycles, {rows} rows; zero: {}",
            logs.error,
            logs.cycles.len(),
            zero(logs)
        ))
        .verdict(standing, word, said)
        .sections(scoring.map(|s| later_section(logs, s)))
        .section(score_section(logs, model))
        .section(
            Section::new("More terms: better on what is known, not on what comes")
                .figure(Figure::new("", || scores_picture(model))),
        )
        .section(coefficient_section(logs, model))
        .section(lines)
        .section(cycle_section(logs, model))
        .section(
            Section::new("What to know of this model")
                .on_page()
                .list(model.warnings.iter().cloned()),
        )
}

fn score_section<'a>(logs: &Logs, model: &ThermalModel) -> Section<'a> {
    let stated = if model.repeatability_stated { "stated" } else { "from neighbouring readings" };
    let headings = [
        "terms",
        "in sample",
        "single rows out",
        "whole cycles out",
        "again",
        "condition number",
        "sensors",
    ];
    let mut table = Table::new(headings);
    for (i, score) in model.scores.iter().enumerate() {
        let names = names(logs, score);
        table = match i == model.chosen {
            true => table.bold_row(score_row(logs, score, format!("{names} (chosen)"))),
            false => table.row(score_row(logs, score, names)),
        };
    }
    let all = score_row(logs, &model.all_terms, "all at once: over-fitted".to_owned());
    Section::new("What it is worth, rms in µm")
        .table(table.row(all).note(
            "In sample: on the rows that the coefficients come from. Single rows out: what leaving out \
             one row at a time claims; its neighbours are still there. Whole cycles out: sensors chosen \
             and coefficients fitted without the cycle, ± standard uncertainty; this one counts. Again: \
             without how many cycles the same sensors were chosen. Condition: from 30 on the columns \
             are not separable.",
        ))
        .paragraph(format!(
            "Repeatability of a reading {:.2} µm ({stated}); held out and counted from the first row of \
             each cycle {:.2} µm.",
            model.repeatability_mm * 1e3,
            model.since_start_mm * 1e3
        ))
}

fn coefficient_section<'a>(logs: &Logs, model: &ThermalModel) -> Section<'a> {
    let refused = if model.refusal.is_some() { " (refused)" } else { "" };
    let rows = model.coefficients.iter().map(|c| {
        let [low, high] = c.range_celsius;
        let [k, u] = [c.mm_per_k, c.u_mm_per_k].map(|v| format!("{:.3}", v * 1e3));
        [c.term.name(logs), k, u, format!("{low:.1} … {high:.1}")]
    });
    let section = Section::new(format!("Coefficients{refused}"))
        .table(Table::new(["sensor", "µm/K", "u, µm/K", "logged, °C"]).rows(rows));
    match model.intercept_mm.filter(|_| !model.coefficients.is_empty()) {
        Some(mm) => section.paragraph(format!(
            "Where all read {} °C: {:.3} µm.",
            logs.reference_celsius,
            mm * 1e3
        )),
        None => section,
    }
}

fn cycle_section<'a>(logs: &'a Logs, model: &'a ThermalModel) -> Section<'a> {
    let (none, with) = (&model.scores[0].by_cycle_mm, &model.score().by_cycle_mm);
    let rows = logs.cycles.iter().enumerate().map(|(g, cycle)| {
        let um = |mm: f64| format!("{:.2}", mm * 1e3);
        [cycle.name.clone(), um(none[g]), um(with[g])]
    });
    let figures = logs.cycles.iter().enumerate().take(MOST_DRAWN).map(move |(g, cycle)| {
        let caption = format!("{}: {:.2} µm left", cycle.name, with[g] * 1e3);
        Figure::new(caption, move || cycle_picture(cycle, g, model))
    });
    Section::new("Each cycle, predicted by a model that has not seen it")
        .table(Table::new(["cycle", "without a model, rms, µm", "held out, rms, µm"]).rows(rows))
        .grid(Columns::AsFit, figures)
}
