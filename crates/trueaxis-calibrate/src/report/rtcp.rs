//! An RTCP calibration in text and on a page.

use crate::identify::rtcp::forecast::{Forecast, Strays};
use crate::identify::rtcp::{Calibration, NewSlot, RtcpStudy};
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
        .sections(numbers(answer))
        .section(fit(found))
        .section(answer.forecast.map_or_else(
            || Section::new("Forecast").paragraph("no forecast: not all offsets are known"),
            forecast,
        ))
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
