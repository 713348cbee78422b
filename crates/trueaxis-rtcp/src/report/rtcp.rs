//! An RTCP calibration in text and on a page.

use crate::rtcp::forecast::{Forecast, Strays};
use crate::rtcp::screen::screen;
use crate::rtcp::{AngleError, Calibration, NewSlot, RtcpStudy};
use trueaxis_geometry::statistics::chi_square_above;
use trueaxis_report::{Report, Section, Standing, Table};

/// What stands in a report of an RTCP calibration.
#[derive(Debug, Clone, Copy)]
pub struct RtcpReport<'a> {
    /// The study.
    pub study: &'a RtcpStudy,
    /// What was found.
    pub found: &'a Calibration,
    /// Before and after.
    pub forecast: Option<&'a Forecast>,
}

/// The calibration.
pub fn rtcp_report<'a>(answer: &RtcpReport<'_>) -> Report<'a> {
    let (study, found) = (answer.study, answer.found);
    let verdict = found.verdict();
    let (word, sentence) = verdict.split_once(": ").unwrap_or((&verdict, ""));
    let standing = match word {
        "yes" => Standing::Good,
        "no" => Standing::Bad,
        _ => Standing::Open,
    };
    let offsets = found.offsets.iter().map(|offset| {
        let [value, u] = match offset.found_mm {
            Some((mm, u)) => [mm, u].map(|v| format!("{:.2}", v * 1e3)),
            None => ["not seen".to_owned(), String::new()],
        };
        [offset.name.clone(), offset.words.clone(), value, u]
    });
    let unseen = found.unseen.iter().map(|u| format!("not seen: {}: {}", u.combination, u.words));
    Report::new(&study.name)
        .line(format!("{}, {}", study.machine.name(), study.centres.topology.words()))
        .verdict(standing, word, sentence)
        .section(
            Section::new("Offsets of the rotary axes")
                .table(Table::new(["true − machine file", "", "µm", "u (k = 1), µm"]).rows(offsets))
                .list(unseen),
        )
        .section(angles(found))
        .sections(numbers(answer))
        .sections(segments(study))
        .sections(fields(answer))
        .section(fit(found))
        .section(answer.forecast.map_or_else(
            || Section::new("Forecast").paragraph("no forecast: not all offsets are known"),
            forecast,
        ))
}

/// The directions of the rotary axes.
fn angles<'a>(found: &Calibration) -> Section<'a> {
    let row = |a: &AngleError| {
        let [value, expanded, angle] = match (a.found_rad, a.expected_u_rad) {
            (Some((rad, u)), _) => [
                format!("{:.1}", rad * 1e6),
                format!("{:.1}", 2e6 * u),
                format!("{:.4}", rad.to_degrees() + 0.0),
            ],
            (None, Some(u)) => {
                ["not asked for".to_owned(), format!("would be {:.1}", 2e6 * u), String::new()]
            }
            (None, None) => ["not observable".to_owned(), String::new(), String::new()],
        };
        [a.name.clone(), a.words.clone(), value, expanded, angle]
    };
    let table = Table::new(["true value", "", "µrad", "U (k = 2), µrad", "°"]);
    let further = found.angles.iter().filter_map(|a| {
        Some(format!(
            "{} is not observable; what would determine it: {}",
            a.name,
            a.further.as_ref()?
        ))
    });
    let section = Section::new("Angle errors of the rotary axes")
        .table(table.rows(found.angles.iter().map(row)))
        .list(further);
    match found.angles_wanted {
        true => section,
        false => section.paragraph(
            "The offsets above hold if the directions are those of the machine file; angles = \"found\" \
             determines them together with the offsets.",
        ),
    }
}

/// What segments keep the chord error.
fn segments<'a>(study: &RtcpStudy) -> Option<Section<'a>> {
    let s = study.segments.as_ref()?;
    let step = s.largest_step_rad();
    let mut table = Table::new(["", "value", "unit"])
        .row(["largest chord error".to_owned(), format!("{}", s.chord_error_mm * 1e3), "µm".into()])
        .row([
            "distance from the rotary axes".to_owned(),
            format!("{}", s.distance_mm),
            "mm".into(),
        ])
        .row([
            "largest step of one rotary axis, the tip standing still".to_owned(),
            format!("{:.4}", step.to_degrees()),
            "deg".into(),
        ])
        .row([
            "steps of a full turn".to_owned(),
            format!("{:.0}", (std::f64::consts::TAU / step).ceil()),
            "1".into(),
        ]);
    if let Some(rho) = s.sharpest_rad_per_mm {
        table = table.row([
            format!("longest segment where the path turns by {:.3} deg/mm", rho.to_degrees()),
            format!("{:.4}", s.longest_mm(rho)),
            "mm".into(),
        ]);
    }
    for (name, length) in [("shortest", s.shortest_mm), ("first", s.first_mm)] {
        let Some(length) = length else { continue };
        table = table.row([
            format!("turning that the {name} segment of {length} mm allows"),
            format!("{:.4}", s.largest_turn_rad_per_mm(length).to_degrees()),
            "deg/mm".into(),
        ]);
    }
    Some(Section::new("Segments of a path with tool-centre point").table(table))
}

/// The screen of the control, field by field.
fn fields<'a>(answer: &RtcpReport<'_>) -> Option<Section<'a>> {
    let fields = screen(answer.study, answer.found);
    if fields.is_empty() {
        return None;
    }
    let rows = fields.into_iter().map(|f| {
        let enter = f.enter.unwrap_or_else(|| "—".to_owned());
        [
            format!("{} ({})", f.name, f.printed),
            f.unit.to_owned(),
            f.shown.to_owned(),
            enter,
            f.words,
        ]
    });
    let table = Table::new(["field", "unit", "in the picture", "enter", ""]).rows(rows);
    Some(Section::new("RTCP screen (Zhang et al. 2023, Fig 2)").table(table))
}

/// The numbers of the control.
fn numbers<'a>(answer: &RtcpReport<'_>) -> Option<Section<'a>> {
    let slots = answer.study.slots.as_ref()?;
    let decimals = usize::from(answer.study.decimals);
    let mm = |value: f64| format!("{:.decimals$}", value + 0.0);
    let rows = answer.found.new.iter().map(|new| {
        let [value, u] = match new.new_mm {
            Some((value, u)) if is_known(new) => [mm(value), format!("{:.2}", u * 1e3)],
            Some((value, _)) => [mm(value), "unchanged".to_owned()],
            None => ["not seen".to_owned(), String::new()],
        };
        [new.slot.name.clone(), mm(new.old_mm), value, u, new.slot.words.clone()]
    });
    let table = Table::new(["number", "old, mm", "new, mm", "u, µm", "meaning"]).rows(rows);
    let without = slots.without_slot.iter().map(|k| {
        let words = answer.study.centres.words(&answer.study.machine, *k);
        let title = slots.names.title();
        format!("no number of {title} takes in {words}: correct it at the machine or in its zero")
    });
    Some(Section::new(slots.names.title()).table(table).list(without))
}

/// A number that the centres change.
pub(super) fn is_known(new: &NewSlot) -> bool {
    new.slot.slopes.iter().any(|s| *s != 0.0)
}

fn fit<'a>(found: &Calibration) -> Section<'a> {
    let limit = chi_square_above(0.01, found.degrees_of_freedom.max(1) as f64);
    let mut section = Section::new("Fit").paragraph(format!(
        "{} readings, {} degrees of freedom: χ² = {:.1} (99 %: {limit:.1}), {:.2} µm RMS left",
        found.numbers,
        found.degrees_of_freedom,
        found.chi_square,
        found.rms_residual_mm * 1e3
    ));
    if let Some(worst) = &found.worst {
        section = section.paragraph(format!(
            "worst: {}:{} {}, {:+.2} µm off ({:+.1} of its standard deviations{})",
            worst.place.file,
            worst.place.line,
            worst.channel,
            worst.residual_mm * 1e3,
            worst.standardised,
            if worst.is_outlier { ", more than chance" } else { "" }
        ));
    }
    if found.birge <= 1.0 {
        return section;
    }
    let suspicions = match found.suspicions.is_empty() {
        true => vec!["no single wrong sign explains that".to_owned()],
        false => found.suspicions.iter().map(|s| format!("suspicion: {s}")).collect(),
    };
    let times = found.birge;
    section
        .paragraph(format!(
            "the uncertainties above are {times:.1} times those of the stated noise"
        ))
        .list(suspicions)
}

fn forecast<'a>(f: &Forecast) -> Section<'a> {
    let row = |words: &str, strays: &Strays| {
        let at = strays.at.iter().map(|(name, q)| format!("{name} {:.0}°", q.to_degrees()));
        let at = at.collect::<Vec<_>>().join(", ");
        let [worst, rms] = [strays.worst_mm, strays.rms_mm].map(|v| format!("{:.2}", v * 1e3));
        [words.to_owned(), worst, rms, at]
    };
    let table = Table::new(["", "worst, µm", "RMS, µm", "at"])
        .row(row("with the old numbers", &f.before))
        .row(row("with the new ones as entered, if the centres are right", &f.after))
        .row([
            "to be expected (k = 2; RMS)".to_owned(),
            format!("U = {:.2}", 2e3 * f.u_after_mm),
            format!("{:.2}", f.expected_rms_mm * 1e3),
        ]);
    Section::new(format!("Tip over {} poses, the zero touched at rotary 0", f.poses)).table(table)
}
