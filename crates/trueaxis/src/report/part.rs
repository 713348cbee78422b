//! Measured parts against their tolerances and their prediction, as text and page.

use super::certificate::standing;
use crate::verify::part::{
    IndexComparison, Measurements, PartResult, PartSections, PartStudy, PredictionSource,
};
use trueaxis_part::testpiece::PartSection;
use trueaxis_part::tolerance::Outcome;
use trueaxis_report::{Picture, Polar, PolarLine, Report, Section, Table};

fn um(mm: f64) -> String {
    // + 0.0: no minus before a zero.
    format!("{:.2}", (mm * 1e5).round() / 100.0 + 0.0)
}

pub(super) fn rule(task: &PartStudy) -> String {
    let k = task.rule.coverage_factor;
    match task.rule.guarded {
        true => format!("every index + U (k = {k}) within its limit, ISO 14253-1"),
        false => "every index within its limit (simple acceptance)".to_owned(),
    }
}

/// What the prediction is.
pub(super) fn prediction_words(task: &PartStudy) -> String {
    match &task.prediction {
        PredictionSource::Study(study) => {
            format!("{} (datum: {})", study.name, study.reference.datum)
        }
        PredictionSource::Typed { source, .. } if source.is_empty() => "none".to_owned(),
        PredictionSource::Typed { source, .. } => source.clone(),
    }
}

/// What was measured.
fn measured_words(task: &PartStudy, found: &PartResult) -> String {
    let parts = if found.count == 1 { "part" } else { "parts" };
    match &task.measured {
        Measurements::Points(points) => {
            let count: usize = points.parts.iter().map(|p| p.points.len()).sum();
            format!(
                "{} {parts}, {count} points, u = {} µm each; frame: {}",
                found.count,
                um(points.point_u_mm),
                points.frame
            )
        }
        Measurements::Typed { source, .. } => format!("{} {parts}: {source}", found.count),
    }
}

/// Measured parts as text and page.
pub fn part_report<'a>(task: &'a PartStudy, found: &'a PartResult) -> Report<'a> {
    let head = Report::new(&task.name)
        .line(task.piece.name.clone())
        .line(format!("measured: {}", measured_words(task, found)))
        .line(format!("predicted: {}", prediction_words(task)))
        .line(format!("rule: {}", rule(task)))
        .verdict(
            standing(found.outcome),
            found.outcome.word().to_uppercase(),
            found.reason.clone(),
        );
    head.section(Section::new("Warnings").list(found.warnings.iter().cloned()))
        .section(Section::new("The parts").table(values(found)))
        .section(Section::new("Measured and predicted").table(agreement(found)))
        .section(Section::new("Circles of the sections, µm").table(circles(found)))
        .sections(pictures(found).map(|p| Section::from(Picture::Polar(p)).on_page()))
}

/// Every part by index.
fn values(found: &PartResult) -> Table {
    let numbers = (0..found.count).map(|k| match found.count {
        1 => "measured".to_owned(),
        _ => format!("part {}", k + 1),
    });
    let headings = ["all in µm".to_owned()].into_iter().chain(numbers);
    let headings = headings.chain(["u", "allowed", "verdict"].map(str::to_owned));
    let mut table = Table::new(headings);
    for index in &found.indices {
        let value = |k: usize| index.measured.get(k).map_or("–".to_owned(), |m| um(m.value_mm));
        let u_mm = index.measured.iter().map(|m| m.u_mm).fold(0.0, f64::max);
        let u = if index.u_is_known { um(u_mm) } else { String::new() };
        let limit = index.limit_mm.map_or(String::new(), um);
        let verdict = index.limit_mm.map_or(String::new(), |_| outcome_word(index));
        let row = [index.name.title().to_owned()].into_iter().chain((0..found.count).map(value));
        let row = row.chain([u, limit, verdict]);
        table = if index.name.decisive { table.bold_row(row) } else { table.row(row) };
    }
    table.note("u: the largest standard uncertainty of a part; the indices in bold decide")
}

fn outcome_word(index: &IndexComparison) -> String {
    if index.outcomes.is_empty() {
        return "not measured".to_owned();
    }
    let has = |outcome| index.outcomes.contains(&outcome);
    let word = match (has(Outcome::Fail), has(Outcome::Undecided)) {
        (true, _) => "fail",
        (_, true) => "undecided",
        _ => "pass",
    };
    word.to_owned()
}

fn agreement(found: &PartResult) -> Table {
    let headings = [
        "all in µm",
        "predicted",
        "u",
        "noise adds",
        "measured mean",
        "u",
        "predicted/measured",
        "E_n",
        "",
        "",
    ];
    let rows = found.indices.iter().filter_map(|index| {
        let (value, u) = index.predicted?;
        let a = index.agreement?;
        let ratio = match index.printed_ratio_percent {
            Some(printed) if (printed - a.ratio_percent).abs() > 0.005 => {
                format!("{printed:.2} % ({:.2} % of the values)", a.ratio_percent)
            }
            _ => format!("{:.2} %", a.ratio_percent),
        };
        let finite = a.normalised.is_finite();
        Some([
            index.name.title().to_owned(),
            um(value),
            u.map_or(String::new(), um),
            if index.noise_mm == 0.0 { String::new() } else { um(index.noise_mm) },
            um(a.mean_mm),
            um(a.u_mean_mm),
            ratio,
            if finite { format!("{:.2}", a.normalised) } else { "–".to_owned() },
            match (finite, a.agrees()) {
                (false, _) => "no u",
                (_, true) => "agrees",
                _ => "differs",
            }
            .to_owned(),
            index.note.clone(),
        ])
    });
    Table::new(headings).rows(rows).note(
        "predicted/measured: the ratio of Fig 20 of Wu et al. 2022. E_n = |measured − predicted| over U of this \
         difference, after what the noise of the points adds to the prediction: up to 1 both agree within their uncertainties; above, one of them is wrong or its u too small. \
         With several parts u of the mean contains their spread.",
    )
}

/// Least squares and minimum zone of every section.
fn circles(found: &PartResult) -> Table {
    let headings = [
        "part",
        "z, mm",
        "points",
        "centre x",
        "centre y",
        "radius − nominal",
        "least squares",
        "minimum zone",
        "predicted zone",
    ];
    let mut rows = Vec::new();
    for (k, part) in found.parts.iter().enumerate() {
        for section in &part.sections {
            let predicted = predicted_at(found, section);
            let c = &section.circles;
            rows.push([
                (k + 1).to_string(),
                format!("{:.0}", section.z_mm),
                section.azimuth_rad.len().to_string(),
                um(c.lsc.center_mm[0]),
                um(c.lsc.center_mm[1]),
                um(c.lsc.radius_mm - section.radius_mm),
                um(c.lsc.width_mm()),
                um(c.mzc.width_mm()),
                predicted.map_or(String::new(), |p| um(p.circles.mzc.width_mm())),
            ]);
        }
    }
    Table::new(headings).rows(rows)
}

pub(super) fn predicted_at<'a>(
    found: &'a PartResult,
    section: &PartSection,
) -> Option<&'a PartSection> {
    found.predicted.iter().find(|p| p.height_mm == section.height_mm)
}

/// Each measured section with the predicted one, its deviations magnified.
fn pictures(found: &PartResult) -> impl Iterator<Item = Polar> + '_ {
    let sections = found.parts.iter().enumerate();
    sections.flat_map(move |(k, part)| {
        part.sections.iter().map(move |section| picture(found, (k, part), section))
    })
}

fn picture(found: &PartResult, (k, part): (usize, &PartSections), section: &PartSection) -> Polar {
    let mut lines = vec![line("measured", 0, section)];
    lines.extend(predicted_at(found, section).map(|p| line("predicted", 1, p)));
    let which = if found.parts.len() == 1 { String::new() } else { format!("part {}, ", k + 1) };
    Polar {
        title: format!("{which}section at z = {:.0} mm", section.z_mm),
        note: format!(
            "{}: deviations from the nominal radius of {:.3} mm, magnified; positive: material left",
            part.name, section.radius_mm
        ),
        lines,
    }
}

/// Radial deviations around, closed.
fn line(label: &str, colour: usize, section: &PartSection) -> PolarLine {
    let around = section.azimuth_rad.iter().zip(&section.profile_mm);
    let mut points: Vec<(f64, f64)> =
        around.map(|(a, p)| (*a, (p[0].hypot(p[1]) - section.radius_mm) * 1e3)).collect();
    points.extend(points.first().copied());
    PolarLine { label: label.to_owned(), colour, points }
}
