//! A prediction for a part of any shape in text and on a page.

use super::drawing_document::extremes;
use super::drawing_pictures::deviation_map;
use crate::predict::drawing::{
    CompensatedPart, CutPoint, Drawn, ManyParts, Measurement, PartPrediction, PartStudy, PartValue,
    effects,
};
use crate::predict::{Sampling, Spread};
use trueaxis_part::part::{Characteristic, Limits};
use trueaxis_part::tolerance::Outcome;
use trueaxis_report::{Report, Section, Standing, Table};

/// Errors in the table of a characteristic.
const MOST_ERRORS: usize = 3;

/// The prediction.
pub fn drawing_report<'a>(study: &'a PartStudy, prediction: &'a PartPrediction) -> Report<'a> {
    let (standing, title, sentence) = match prediction.outcome {
        Outcome::Pass => (Standing::Good, "PASS", "the part will be in tolerance".to_owned()),
        Outcome::Fail => {
            (Standing::Bad, "FAIL", named(study, prediction, Outcome::Fail, "out of tolerance"))
        }
        Outcome::Undecided => (
            Standing::Open,
            "UNDECIDED",
            named(study, prediction, Outcome::Undecided, "within U of its limit"),
        ),
    };
    let report = Report::new(&study.name)
        .line(format!("{}, {}", study.job.machine.name(), study.job.machine.chain_text()))
        .line(match study.part.source.is_empty() {
            true => study.part.name.clone(),
            false => format!("{}, {}", study.part.name, study.part.source),
        })
        .line(format!("{}, {} steps of tools", study.job.program.file(), prediction.steps))
        .verdict(standing, title, sentence)
        .section(characteristics(study, prediction));
    let many = study.sampling.zip(prediction.drawn.as_ref());
    let report = match many {
        Some((sampling, drawn)) => report.section(many_machines(study, sampling, drawn)),
        None => report,
    };
    let report = match &study.measurement {
        Some(by) => report.section(measurement(study, prediction, by)),
        None => report,
    };
    let report = match &prediction.compensated {
        Some(found) => report.section(compensated(study, prediction, found)),
        None => report,
    };
    report.section(budget(study, prediction)).section(features(study, prediction))
}

/// The part as a measuring machine would find it.
fn measurement<'a>(
    study: &PartStudy,
    prediction: &PartPrediction,
    by: &Measurement,
) -> Section<'a> {
    let mut table = Table::new(["all in µm", "value", "measured, mean", "u of the measurement"]);
    for (asked, value) in study.part.characteristics.iter().zip(&prediction.values) {
        let Some(measured) = value.measured else { continue };
        let [true_um, mean, u] = [value.value_mm, measured.mean_mm, measured.u_mm].map(um);
        table = table.row([asked.name.clone(), true_um, mean, u]);
    }
    let points = (by.point_u_mm > 0.0).then(|| {
        let u = um(by.point_u_mm);
        format!("Each point of the features with u = {u} µm, independent of the others: forms are found larger than they are.")
    });
    let common = [
        (by.length_u, "of all lengths"),
        (by.scale_u, "of each axis of the measuring machine"),
        (by.squareness_u_rad, "of the squareness of each two axes"),
    ];
    let common: Vec<String> = common
        .into_iter()
        .filter(|(u, _)| *u > 0.0)
        .map(|(u, of)| format!("{} µm/m {of}", um(1e3 * u)))
        .collect();
    let common =
        (!common.is_empty()).then(|| format!("In common to all points u = {}.", common.join(", ")));
    let all = points.into_iter().chain(common).collect::<Vec<_>>().join(" ");
    let note = format!("{all} The u of the measurement counts in a verdict by ISO 14253-1.");
    Section::new("As it would be measured").table(table.note(note))
}

/// The part before and after its program is compensated.
fn compensated<'a>(
    study: &PartStudy,
    prediction: &PartPrediction,
    found: &CompensatedPart,
) -> Section<'a> {
    let CompensatedPart { zero_kept, zero_set } = found;
    let sentence = match (zero_kept.outcome, zero_set.outcome) {
        (Outcome::Pass, Outcome::Pass) => {
            "Cut by the compensated program, the part will be in tolerance."
        }
        (_, Outcome::Pass) => {
            "Cut by the compensated program, the part will be in tolerance if the zero is set again."
        }
        (Outcome::Pass, _) => {
            "Cut by the compensated program, the part will be in tolerance if the zero is kept."
        }
        _ => "The compensated program does not bring the part surely into tolerance.",
    };
    let note = "By the program that `compensate program` writes (residual and increment 1 µm), on the same machine, with the same u. \
                Zero kept: where it was set without compensation, so that what counts from it keeps the error of the tip there. Zero set \
                again: by motion that is compensated, too.";
    let table = compensated_table(study, prediction, found);
    Section::new("With the program compensated").paragraph(sentence).table(table.note(note))
}

/// The characteristics before and after a compensation, with the zero where it was set and set again.
pub fn compensated_table(
    study: &PartStudy,
    prediction: &PartPrediction,
    CompensatedPart { zero_kept, zero_set }: &CompensatedPart,
) -> Table {
    let headings =
        ["all in µm", "before", "zero kept", "verdict", "zero set again", "verdict", "allowed"];
    let mut table = Table::new(headings);
    for (i, (asked, value)) in study.part.characteristics.iter().zip(&prediction.values).enumerate()
    {
        table = table.row([
            asked.name.clone(),
            um(value.value_mm),
            um(zero_kept.values_mm[i]),
            zero_kept.outcomes[i].word().to_owned(),
            um(zero_set.values_mm[i]),
            zero_set.outcomes[i].word().to_owned(),
            allowed(&asked.limits),
        ]);
    }
    table
}

/// The characteristics with one outcome.
fn named(study: &PartStudy, prediction: &PartPrediction, outcome: Outcome, what: &str) -> String {
    let all = study.part.characteristics.iter().zip(&prediction.values);
    let names: Vec<&str> =
        all.filter(|(_, v)| v.outcome == outcome).map(|(c, _)| c.name.as_str()).collect();
    format!("{what}: {}", names.join(", "))
}

/// µm with two digits, no minus before a zero.
pub(super) fn um(mm: f64) -> String {
    format!("{:.2}", (mm * 1e5).round() / 100.0 + 0.0)
}

/// Limits in µm.
pub(super) fn allowed(limits: &Limits) -> String {
    match limits.ends_mm() {
        (None, high_mm) => um(high_mm),
        (Some(low_mm), high_mm) => format!("{} … {}", um(low_mm), um(high_mm)),
    }
}

fn characteristics<'a>(study: &PartStudy, prediction: &PartPrediction) -> Section<'a> {
    let row = |(asked, value): (&Characteristic, &PartValue)| {
        [
            asked.name.clone(),
            um(value.value_mm),
            um(value.u_mm),
            um(value.points_mm),
            um(value.nominal_mm),
            allowed(&asked.limits),
            format!("{:.0} %", 100.0 * value.used_ratio),
            value.outcome.word().to_owned(),
        ]
    };
    let rows = study.part.characteristics.iter().zip(&prediction.values).map(row);
    let headings =
        ["all in µm", "value", "u", "points", "program alone", "allowed", "used", "verdict"];
    let unknown = match prediction.errors_without_u.len() {
        0 => String::new(),
        1 => " One error of it states none and adds nothing to u.".to_owned(),
        count => format!(" {count} errors of it state none and add nothing to u."),
    };
    let note = format!(
        "u: standard uncertainty by those of the machine file; where a value is at its least, the root mean square over drawn \
         machines.{unknown} Points: by how much the value changes with half \
         of the points; a smaller `spacing` makes it smaller. Both count in a verdict by ISO 14253-1. Program alone: what this \
         program leaves on a machine without errors."
    );
    Section::new("Characteristics").table(Table::new(headings).rows(rows).note(note))
}

fn many_machines<'a>(study: &PartStudy, sampling: Sampling, drawn: &ManyParts) -> Section<'a> {
    let row = |(asked, drawn): (&Characteristic, &Drawn)| {
        let Spread { mean_mm, u_mm, low_mm, high_mm } = drawn.spread;
        [
            asked.name.clone(),
            um(mean_mm),
            um(u_mm),
            format!("{} … {}", um(low_mm), um(high_mm)),
            percent(drawn.good_ratio),
        ]
    };
    let rows = study.part.characteristics.iter().zip(&drawn.characteristics).map(row);
    let note = format!(
        "Monte Carlo: {} machines whose errors are drawn within their stated uncertainties, seed {}. All characteristics are in \
         tolerance on {} of them.",
        sampling.samples,
        sampling.seed,
        percent(drawn.good_ratio)
    );
    let headings = ["all in µm", "mean", "u", "95 % of machines", "in tolerance"];
    Section::new("Many machines").table(Table::new(headings).rows(rows).note(note))
}

/// A share; what is not all is not called 100 %, what is not none not 0 %.
fn percent(ratio: f64) -> String {
    match 100.0 * ratio {
        p if p > 99.9 && p < 100.0 => "> 99.9 %".to_owned(),
        p if p > 0.0 && p < 0.1 => "< 0.1 %".to_owned(),
        p => format!("{p:.1} %"),
    }
}

fn budget<'a>(study: &PartStudy, prediction: &PartPrediction) -> Section<'a> {
    let mut table = Table::new(["characteristic", "error", "value without it, µm", "change, µm"]);
    for (asked, value) in study.part.characteristics.iter().zip(&prediction.values) {
        for effect in effects(value, MOST_ERRORS) {
            table = table.row([
                asked.name.clone(),
                effect.error.to_string(),
                um(effect.without_mm),
                um(effect.without_mm - value.value_mm),
            ]);
        }
    }
    let note = "The errors whose absence changes a value most, to first order.";
    Section::new("Error budget").paragraph(correction(prediction)).table(table.note(note))
}

/// Which single correction is sufficient.
fn correction(prediction: &PartPrediction) -> String {
    let names: Vec<String> = prediction.sufficient.iter().map(ToString::to_string).collect();
    match (prediction.outcome, &names[..]) {
        (Outcome::Pass, _) => "No correction is necessary.".to_owned(),
        (_, []) => "No single correction brings all characteristics into tolerance.".to_owned(),
        (_, [one]) => {
            format!("The correction of {one} alone brings all characteristics into tolerance.")
        }
        (_, [first, others @ ..]) => format!(
            "The correction of {first} alone brings all characteristics into tolerance; so does that of {}.",
            others.join(", of ")
        ),
    }
}

fn features<'a>(study: &PartStudy, prediction: &'a PartPrediction) -> Section<'a> {
    let place = |p: &CutPoint| {
        // Lines of the main program need no name of a file.
        let subprogram = match p.origin.program {
            0 => String::new(),
            other => format!(" {}", prediction.programs.get(other as usize).map_or("", |f| f)),
        };
        format!(
            "{} at X {:.2} Y {:.2} Z {:.2}, T{}{subprogram} line {}, {:.1} s",
            um(p.deviation_mm),
            p.nominal_mm.x,
            p.nominal_mm.y,
            p.nominal_mm.z,
            p.origin.tool,
            p.origin.line,
            p.origin.time_s
        )
    };
    let mut table = Table::new(["feature", "points", "most material left, µm", "most missing, µm"]);
    for (feature, cut) in study.part.features.iter().zip(&prediction.features) {
        let [most, least] = extremes(&cut.points);
        let count = cut.points.len().to_string();
        table = table.row([feature.name.clone(), count, place(most), place(least)]);
    }
    let note = "Deviations along the normals, with the block that cut the point and its time from the start.";
    Section::new("Surfaces").figure(deviation_map(prediction)).table(table.note(note))
}
