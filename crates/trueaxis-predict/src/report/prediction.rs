//! A prediction in text and on a page.

use super::prediction_pictures::{along_azimuth, cone, contributions, motions, sections};
use super::{decisive, feature, ranked, relief};
use crate::predict::{Decision, Index, Prediction, Sensitivity, Share, Study};
use trueaxis_machine::describe::command_words;
use trueaxis_machine::errors::ErrorKind;
use trueaxis_part::tolerance::Outcome;
use trueaxis_report::{Columns, Report, Section, Standing, Table};

/// How many errors the table of the error budget shows.
const MOST_ERRORS: usize = 8;
/// How many corrections are shown.
const MOST_CORRECTIONS: usize = 8;

/// The prediction.
pub fn prediction_report<'a>(study: &'a Study, prediction: &'a Prediction) -> Report<'a> {
    let machine = &study.machine;
    let (standing, word, sentence) = match prediction.outcome() {
        Outcome::Pass => (Standing::Good, "PASS", "the part will be in tolerance"),
        Outcome::Fail => (Standing::Bad, "FAIL", "the part will be out of tolerance"),
        Outcome::Undecided => {
            (Standing::Open, "UNDECIDED", "the tolerance lies within the uncertainty")
        }
    };
    let mut head = Report::new(&study.name)
        .line(format!("{}, {}", machine.name(), machine.chain_text()))
        .line(study.test_piece.name.clone());
    if !study.what_if.is_empty() {
        head = head.line(format!("with {}", study.what_if.join(", ")));
    }
    let zero = command_words(machine.axes(), &prediction.setting_command);
    head.line(format!("zero set at {zero}"))
        .verdict(standing, word, sentence)
        .section(Section::new("Warnings").list(prediction.warnings.iter().cloned()))
        .section(indices(study, prediction))
        .sections(conditions(prediction))
        .section(positions(prediction))
        .section(Section::new("Error along the azimuth").on_page().figure(along_azimuth(prediction)))
        .section(
            Section::new("Sections, magnified")
                .on_page()
                .note(
                    "Blue: the profile; black: the nominal circle; the fitted circles with the roundness \
                     about their centre. Only the deviations are magnified, so that a circle off the \
                     centre does not look round.",
                )
                .grid(Columns::AsFit, sections(prediction)),
        )
        .sections(cone(study, prediction).map(|figure| {
            Section::new("Error on the cone, unrolled").on_page().figure(figure)
        }))
        .section(
            Section::new("Axis motions")
                .on_page()
                .note(format!("Zero set at {zero}."))
                .grid(Columns::AsFit, motions(study, prediction)),
        )
        .sections(budget(prediction))
        .section(corrections(prediction))
        .section(sensitivities(prediction))
        .section(variants(prediction))
        .section(published(study, prediction))
        .section(inputs(study, prediction))
}

fn um(mm: f64) -> String {
    // + 0.0: no minus before a zero.
    format!("{:.2}", (mm * 1e5).round() / 100.0 + 0.0)
}

fn rule(study: &Study) -> String {
    match study.decision {
        Decision::Simple => "simple acceptance, value against limit".to_owned(),
        Decision::Guarded { coverage } => format!("ISO 14253-1 with U = {coverage} u"),
    }
}

fn indices<'a>(study: &Study, prediction: &Prediction) -> Section<'a> {
    let sampled = prediction.indices.iter().any(|i| i.spread.is_some());
    let mut headings = vec!["all in µm", "value", "u"];
    if sampled {
        headings.extend(["u (Monte Carlo)", "95 % interval"]);
    }
    let guarded = prediction.verdict.judgements.iter().any(|j| j.expanded_mm.is_some());
    headings.extend(guarded.then_some("U"));
    headings.extend(["allowed", "used", "verdict"]);
    let mut table = Table::new(headings).note(format!(
        "u: standard uncertainty, by linear propagation and by Monte Carlo. The indices with a verdict decide, \
         after ISO; those of the paper are for comparison. Rule: {}.",
        rule(study)
    ));
    for index in &prediction.indices {
        let row = index_row(prediction, index, [sampled, guarded]);
        table = if index.name.decisive { table.bold_row(row) } else { table.row(row) };
    }
    Section::new("Indices").table(table)
}

fn index_row(prediction: &Prediction, index: &Index, [sampled, guarded]: [bool; 2]) -> Vec<String> {
    let mut row = vec![index.name.title().to_owned(), um(index.value_mm), um(index.u_mm)];
    if sampled {
        let [u, interval] = index.spread.map_or([String::new(), String::new()], |s| {
            [um(s.u_mm), format!("{} … {}", um(s.low_mm), um(s.high_mm))]
        });
        row.extend([u, interval]);
    }
    let judged = prediction.verdict.judgements.iter().find(|j| j.index.key == index.name.key);
    if let Some(j) = judged {
        let used = format!("{:.0} %", j.used_ratio * 100.0);
        row.extend(guarded.then(|| j.expanded_mm.map_or(String::new(), um)));
        row.extend([um(j.limit_mm), used, j.outcome.word().to_owned()]);
    }
    row
}

/// The part at the feed of every cutting condition.
fn conditions<'a>(prediction: &Prediction) -> Option<Section<'a>> {
    if prediction.conditions.is_empty() {
        return None;
    }
    let of_index = |(_, index): (usize, &Index)| {
        [
            feature(&index.name).to_owned(),
            "u".to_owned(),
            "feed adds".to_owned(),
            "servo alone".to_owned(),
        ]
    };
    let headings = ["condition", "feed, m/min", "tip, m/min"].map(str::to_owned).into_iter();
    let headings = headings.chain(decisive(prediction).flat_map(of_index));
    let headings = headings.chain(["verdict".to_owned()]);
    let rows = prediction.conditions.iter().map(|c| {
        let [low, high] = c.speed_mm_per_s.map(|v| format!("{:.1}", v * 0.06));
        let speed = if low == high { low } else { format!("{low} … {high}") };
        let feed = c.condition.feed_mm_per_min.unwrap_or(0.0) * 1e-3;
        let verdict = c.verdict.outcome.word();
        let values = decisive(prediction).flat_map(|(i, index)| {
            let adds = c.indices_mm[i] - index.value_mm;
            [um(c.indices_mm[i]), um(c.u_mm[i]), um(adds), um(c.servo_alone_mm[i])]
        });
        let first = [c.condition.name.clone(), format!("{feed}"), speed];
        first.into_iter().chain(values).chain([verdict.to_owned()]).collect::<Vec<_>>()
    });
    let table = Table::new(headings).rows(rows).note(
        "All in µm. Feed adds: against the same part cut without following errors. Servo alone: on a machine without \
         errors. The tool goes round with the feed at its tip, as fast as the axes allow.",
    );
    Some(Section::new("At the feeds of the cutting conditions").table(table))
}

/// The form at each measuring position.
fn positions<'a>(prediction: &Prediction) -> Section<'a> {
    let is_form = |index: &Index| {
        ["roundness", "coaxiality"].iter().any(|family| index.name.key.starts_with(family))
    };
    let forms = || prediction.indices.iter().enumerate().filter(|(_, index)| is_form(index));
    let headings = ["position", "z, mm"].into_iter().chain(forms().map(|(_, i)| i.name.title()));
    let rows = prediction.sections.iter().enumerate().map(|(n, result)| {
        let values = forms().map(|(i, _)| result.section.indices_mm[i].map_or(String::new(), um));
        let place = [(n + 1).to_string(), format!("{:.0}", result.section.z_mm)];
        place.into_iter().chain(values).collect::<Vec<_>>()
    });
    Section::new("At every position, µm").on_page().table(Table::new(headings).rows(rows))
}

/// The contribution of each error, of each body, of each kind.
fn budget(prediction: &Prediction) -> Vec<Section<'_>> {
    let budget = &prediction.budget;
    if budget.errors.is_empty() {
        return Vec::new();
    }
    let note = "Alone: the index if there were only this error. Gain: what the index loses if the error is \
                removed; a negative gain means that it compensates others.";
    let headings =
        decisive(prediction).flat_map(|(_, index)| [feature(&index.name), "alone", "gain"]);
    let ranked: Vec<_> = decisive(prediction)
        .map(|(i, _)| (i, ranked(prediction, i, &budget.errors, MOST_ERRORS)))
        .collect();
    let rows = (0..MOST_ERRORS.min(budget.errors.len())).map(|rank| {
        ranked.iter().flat_map(move |(i, shares)| {
            let share = shares[rank];
            let [alone, gain] = share_cells(prediction, *i, share);
            [share.of.to_string(), alone, gain]
        })
    });
    let table = Table::new(headings).rows(rows);
    vec![
        Section::new("Error budget, µm").on_terminal().note(note).table(table),
        Section::new("Error budget")
            .on_page()
            .note(note)
            .grid(Columns::AsFit, contributions(prediction)),
        Section::new("Groups of errors, µm: alone / gain").table(groups(prediction)),
    ]
}

/// The index with this share alone, and what it loses without it, µm.
fn share_cells<T>(prediction: &Prediction, index: usize, share: &Share<T>) -> [String; 2] {
    let gain = relief(prediction, index, share);
    // + 0.0: no minus before a zero.
    let tenth = |mm: f64| (mm * 1e4).round() / 10.0 + 0.0;
    [format!("{:.1}", tenth(share.alone_mm[index])), format!("{:+.1}", tenth(gain))]
}

fn groups(prediction: &Prediction) -> Table {
    fn row<T>(prediction: &Prediction, name: String, share: &Share<T>) -> Vec<String> {
        let cells =
            decisive(prediction).map(|(i, _)| share_cells(prediction, i, share).join(" / "));
        [name].into_iter().chain(cells).collect()
    }
    let kinds = prediction.budget.kinds.iter().map(|share| {
        let word = match share.of {
            ErrorKind::Location => "all location errors",
            ErrorKind::Motion => "all error motions",
        };
        row(prediction, word.to_owned(), share)
    });
    let bodies = prediction.budget.bodies.iter();
    let bodies = bodies.map(|share| row(prediction, format!("all errors of {}", share.of), share));
    Table::new(by_index("group", prediction)).rows(kinds).rows(bodies)
}

/// A heading, then the decisive indices.
fn by_index<'a>(first: &'a str, prediction: &'a Prediction) -> impl Iterator<Item = &'a str> {
    [first].into_iter().chain(decisive(prediction).map(|(_, index)| feature(&index.name)))
}

fn corrections<'a>(prediction: &Prediction) -> Section<'a> {
    let section = Section::new("One correction that is sufficient");
    if prediction.corrections.is_empty() {
        return match prediction.verdict.outcome {
            Outcome::Pass => section,
            _ => section
                .paragraph("No single location error can be corrected so that the part passes."),
        };
    }
    let rows = prediction.corrections.iter().take(MOST_CORRECTIONS).map(|correction| {
        let change = match correction.error.component.is_rotation() {
            true => format!("{:+.1} µrad", correction.change * 1e6),
            false => format!("{:+.1} µm", correction.change * 1e3),
        };
        let after = decisive(prediction).map(|(i, _)| um(correction.indices_mm[i]));
        [format!("shim {} by", correction.error), change]
            .into_iter()
            .chain(after)
            .collect::<Vec<_>>()
    });
    let indices = decisive(prediction).map(|(_, index)| feature(&index.name));
    let table = Table::new(["location error", "change"].into_iter().chain(indices));
    section
        .note("The smallest first; 1 µrad counts as 1 µm. The indices after it, in µm.")
        .table(table.rows(rows))
}

fn sensitivities<'a>(prediction: &Prediction) -> Section<'a> {
    let scale = |s: &Sensitivity| if s.error.component.is_rotation() { 1e-3 } else { 1.0 };
    let most = |s: &Sensitivity| {
        let slopes = decisive(prediction).map(|(i, _)| s.slope[i].abs() * scale(s));
        slopes.fold(0.0_f64, f64::max)
    };
    let mut felt: Vec<&Sensitivity> =
        prediction.sensitivities.iter().filter(|s| most(s) > 5e-5).collect();
    felt.sort_by(|a, b| most(b).total_cmp(&most(a)));
    let rows = felt.into_iter().map(|s| {
        let slopes = decisive(prediction).map(|(i, _)| slope(s.slope[i] * scale(s)));
        [s.error.to_string()].into_iter().chain(slopes).collect::<Vec<_>>()
    });
    Section::new("Sensitivity to location errors")
        .on_page()
        .note("µm of the index per µm (shifts) or per µrad (rotations).")
        .table(Table::new(by_index("location error", prediction)).rows(rows))
}

/// Four decimals; a plain 0 where they are all zero.
fn slope(slope: f64) -> String {
    if slope.abs() < 5e-5 { "0".to_owned() } else { format!("{slope:+.4}") }
}

fn variants<'a>(prediction: &Prediction) -> Section<'a> {
    if prediction.variants.is_empty() {
        return Section::new("");
    }
    let row = |name: &str, values: &dyn Fn(usize) -> f64| {
        let values = decisive(prediction).map(|(i, _)| um(values(i)));
        [name.to_owned()].into_iter().chain(values).collect::<Vec<_>>()
    };
    let studied = row("as studied", &|i| prediction.indices[i].value_mm);
    let others = prediction.variants.iter().map(|v| row(&v.name, &|i| v.indices_mm[i]));
    let table = Table::new(by_index("the same part, µm", prediction)).row(studied).rows(others);
    Section::new("Setting point and datum").table(table)
}

fn published<'a>(study: &Study, prediction: &Prediction) -> Section<'a> {
    let Some(published) = &study.published else { return Section::new("") };
    let ours = |key: &str| prediction.indices.iter().find(|i| i.name.key == key);
    let rows = published.rows.iter().map(|row| {
        let (index, measured) = (ours(&row.key), &row.measured_mm);
        let mean = measured.iter().sum::<f64>() / measured.len() as f64;
        [
            index.map_or(row.key.clone(), |i| i.name.title().to_owned()),
            index.map_or(String::new(), |i| um(i.value_mm)),
            row.predicted_mm.map_or(String::new(), um),
            measured.iter().map(|m| um(*m)).collect::<Vec<_>>().join(", "),
            if measured.is_empty() { String::new() } else { um(mean) },
            row.note.clone(),
        ]
    });
    let headings = ["index, µm", "here", "published prediction", "measured", "mean of these", ""];
    Section::new("Comparison with published figures")
        .on_page()
        .note(published.source.clone())
        .table(Table::new(headings).rows(rows))
}

fn inputs<'a>(study: &Study, prediction: &Prediction) -> Section<'a> {
    let (machine, tip) = (&study.machine, study.machine.tip_mm());
    let datum = study.reference.datum.to_string();
    let mut pairs = vec![
        ("study".to_owned(), study.path.display().to_string()),
        ("machine".to_owned(), study.machine_path.display().to_string()),
        ("source of the machine".to_owned(), machine.source().to_owned()),
        ("stated errors".to_owned(), machine.stated_errors().len().to_string()),
        (
            "tool tip in the holder, mm".to_owned(),
            format!("{} {} {}", tip.x + 0.0, tip.y + 0.0, tip.z + 0.0),
        ),
        ("datum".to_owned(), datum),
        ("rule".to_owned(), rule(study)),
    ];
    pairs.extend(study.tolerances.0.iter().map(|t| {
        (t.index.title().to_owned(), format!("at most {} µm; {}", um(t.limit_mm), t.source))
    }));
    pairs.push(("test piece".to_owned(), study.test_piece.name.clone()));
    pairs.push(("source of the test piece".to_owned(), study.test_piece.source.clone()));
    let (positions, heights) = (prediction.commands.len(), prediction.sections.len());
    pairs.push(("tool positions × heights".to_owned(), format!("{positions} × {heights}")));
    pairs.extend(
        study
            .sampling
            .map(|s| ("Monte Carlo".to_owned(), format!("{} samples, seed {}", s.samples, s.seed))),
    );
    Section::new("Inputs").on_page().table(Table::pairs(pairs))
}
