//! A thermal model as one self-contained page.

use super::thermal::{SCORES, beside, names, score_cells, thermal_lines, verdict, zero};
use crate::identify::thermal::{Cycle, Logs, Score, ThermalModel};
use maud::{Markup, PreEscaped, html};
use trueaxis_report::DrawingError;
use trueaxis_report::page::document;
use trueaxis_report::plots::{Curve, Labels, curves};

/// More cycles are not drawn one by one.
const MOST_DRAWN: usize = 24;
/// A curve of more points shows no more.
const MOST_POINTS: usize = 600;

/// The report as the text of an HTML file.
///
/// # Errors
/// What the drawing library says.
pub fn thermal_html(logs: &Logs, model: &ThermalModel) -> Result<String, DrawingError> {
    let scores = scores_picture(model)?;
    let mut cycles = Vec::new();
    for (g, cycle) in logs.cycles.iter().enumerate().take(MOST_DRAWN) {
        cycles.push((cycle, model.score().by_cycle_mm[g], cycle_picture(cycle, g, model)?));
    }
    let kind = if model.refusal.is_some() { "verdict fail" } else { "verdict pass" };
    let word = if model.refusal.is_some() { "REFUSED" } else { "MODEL" };
    let content = html! {
        h1 { (logs.name) }
        p.soft {
            "Thermal model of " (logs.error) " from " (logs.cycles.len())
            " cycles; zero: " (zero(logs))
        }
        section class=(kind) { strong { (word) } span { (verdict(model)) } }
        section { h2 { "What it is worth" } (scores_table(logs, model)) }
        section {
            h2 { "More terms: better on what is known, not on what comes" }
            (PreEscaped(&scores))
        }
        (coefficients(logs, model))
        section.long {
            h2 { "Each cycle, foretold by a model that has not seen it" }
            div.grid style="grid-template-columns:repeat(auto-fit,minmax(420px,1fr))" {
                @for (cycle, rms_mm, svg) in &cycles {
                    figure {
                        (PreEscaped(svg))
                        figcaption {
                            (cycle.name) ": " (format!("{:.2}", rms_mm * 1e3)) " µm left"
                        }
                    }
                }
            }
            @if logs.cycles.len() > cycles.len() {
                p.soft { "and " (logs.cycles.len() - cycles.len()) " more cycles" }
            }
        }
        @if !model.warnings.is_empty() {
            section {
                h2 { "What to know of this model" }
                ul { @for warning in &model.warnings { li { (warning) } } }
            }
        }
        p.soft { "made by trueaxis " (trueaxis_report::VERSION) }
    };
    Ok(document(&logs.name, &content))
}

fn scores_table(logs: &Logs, model: &ThermalModel) -> Markup {
    let all = [(None, &model.all_terms)];
    let rows = model.scores.iter().enumerate().map(|(i, s)| (Some(i), s)).chain(all);
    html! {
        div.scroll { table.small {
            thead { tr {
                @for heading in SCORES { th { (heading) } }
                th style="text-align:left" { "sensors" }
            } }
            tbody { @for (i, score) in rows {
                tr class=(if i == Some(model.chosen) { "decisive" } else { "" }) {
                    @for cell in score_cells(logs, score) { td { (cell) } }
                    td style="text-align:left" {
                        @match i {
                            None => "all at once: over-fitted",
                            Some(i) => {
                                (names(logs, score))
                                @if i == model.chosen { " (chosen)" }
                            },
                        }
                    }
                }
            } }
        } }
        p.soft {
            "rms in µm. In sample: on the rows that the coefficients come from. Single rows out: what \
             leaving out one row at a time claims; its neighbours are still there. Whole cycles out: \
             sensors chosen and coefficients fitted without the cycle, ± standard uncertainty; this one \
             counts. Again: without how many cycles the same sensors were chosen. Condition: from 30 on \
             the columns cannot be told apart."
        }
        p.soft { (beside(model)) "." }
    }
}

fn coefficients(logs: &Logs, model: &ThermalModel) -> Markup {
    html! {
        section {
            h2 { "Coefficients" }
            @if !model.coefficients.is_empty() {
                div.scroll { table {
                    thead { tr {
                        th { "sensor" } th { "µm/K" } th { "u, µm/K" } th { "logged, °C" }
                    } }
                    tbody { @for c in &model.coefficients { tr {
                        td { (c.term.name(logs)) }
                        td { (format!("{:.3}", c.mm_per_k * 1e3)) }
                        td { (format!("{:.3}", c.u_mm_per_k * 1e3)) }
                        td { (format!("{:.1} … {:.1}", c.range_celsius[0], c.range_celsius[1])) }
                    } } }
                } }
            }
            @match thermal_lines(logs, model) {
                Ok(lines) => { p { "In the machine file:" } pre { code { (lines) } } },
                Err(why) => p { "Nothing for the machine file: " (why) "." },
            }
        }
    }
}

fn scores_picture(model: &ThermalModel) -> Result<String, DrawingError> {
    let point = |s: &Score, of: fn(&Score) -> f64| (s.terms.len() as f64, of(s) * 1e3);
    let curve = |label: &str, of: fn(&Score) -> f64| Curve {
        label: label.to_owned(),
        // Without any term all three are the same, and so much that nothing else would be seen.
        points: model
            .scores
            .iter()
            .skip(1)
            .chain([&model.all_terms])
            .map(|s| point(s, of))
            .collect(),
    };
    let lines = [
        curve("in sample", |s| s.in_sample_mm),
        curve("single rows out", |s| s.row_wise_mm),
        curve("whole cycles out", |s| s.held_out_mm),
    ];
    curves(
        (1000, 320),
        &Labels { x: "number of terms, from 1; at the end all", y: "rms, µm" },
        &lines,
    )
}

fn cycle_picture(cycle: &Cycle, g: usize, model: &ThermalModel) -> Result<String, DrawingError> {
    let (x, scale) = match &cycle.times_s {
        Some(_) => ("time, min", 60.0),
        None => ("row", 1.0),
    };
    let at = |i: usize| cycle.times_s.as_ref().map_or(i as f64, |t| t[i]) / scale;
    let curve = |label: &str, values: &[f64]| Curve {
        label: label.to_owned(),
        points: (0..values.len())
            .step_by(values.len().div_ceil(MOST_POINTS).max(1))
            .map(|i| (at(i), values[i] * 1e3))
            .collect(),
    };
    let (measured, foretold) = (&model.measured_mm[g], &model.predicted_mm[g]);
    let left: Vec<f64> = measured.iter().zip(foretold).map(|(m, p)| m - p).collect();
    let lines = [curve("measured", measured), curve("foretold", foretold), curve("left", &left)];
    curves((500, 300), &Labels { x, y: "µm" }, &lines)
}
