//! A prediction for holes in text and on a page.

use super::holes_pictures::plans;
use crate::predict::holes::{HolePrediction, HoleSet, HoleStudy};
use trueaxis_report::{Columns, Report, Section, Standing, Table};

/// Each compensation in words.
const NAMES: [&str; 3] = ["without compensation", "machine only", "comprehensive"];

/// The prediction.
pub fn holes_report<'a>(study: &'a HoleStudy, prediction: &'a HolePrediction) -> Report<'a> {
    let applied = prediction.sets.iter().find(|s| s.compensation == study.applied);
    let (standing, word, sentence) = match applied.and_then(|s| s.in_tolerance) {
        Some(true) => (Standing::Good, "PASS", "every hole will be in tolerance"),
        Some(false) => (Standing::Bad, "FAIL", "a hole will be out of tolerance"),
        None => (Standing::Open, "NO VERDICT", "the study states no tolerance"),
    };
    let sentence = format!("{sentence}, with compensation: {}", study.applied.name());
    let warnings = prediction.warnings.iter().map(|w| format!("WARNING: {w}"));
    Report::new(&study.name)
        .line(format!("{}, {}", study.machine.name(), study.machine.chain_text()))
        .verdict(standing, word, sentence)
        .section(Section::new("").list(warnings))
        .section(worst(study, prediction))
        .section(location(prediction))
        .section(
            Section::new("Plan view")
                .on_page()
                .note(
                    "Seen along the tool, X to the right, Y upwards, in the workpiece frame. Each arrow goes \
                     from where a hole should be to where it will be; arrows are magnified, each picture by \
                     its own factor.",
                )
                .grid(Columns::AsFit, plans(study, prediction, NAMES)),
        )
        .section(holes(study, prediction))
        .section(inputs(study, prediction))
}

pub(super) fn um(mm: f64) -> String {
    // No minus before a zero.
    format!("{:.1}", (mm * 1e4).round() / 10.0 + 0.0)
}

fn worst<'a>(study: &HoleStudy, prediction: &HolePrediction) -> Section<'a> {
    let row = |set: &HoleSet, when: &str| {
        let verdict = match set.in_tolerance {
            Some(true) => "pass",
            Some(false) => "fail",
            None => "–",
        };
        let allowed = study.tolerance_mm.map_or(String::new(), um);
        let name = format!("{}{when}", set.compensation.name());
        [name, um(set.worst_mm), um(set.u_worst_mm), allowed, verdict.to_owned()]
    };
    let note =
        "Distance of a hole from its place in X and Y at 20 °C, with its standard uncertainty u.";
    let headings = ["compensation", "worst hole, µm", "u, µm", "allowed, µm", "in tolerance"];
    let mut table = Table::new(headings).note(note);
    for set in &prediction.sets {
        table = match set.compensation == study.applied {
            true => table.bold_row(row(set, " (applied)")),
            false => table.row(row(set, "")),
        };
    }
    let held = prediction.held.iter().flatten();
    let held = held.map(|set| row(set, ", temperatures of the start held"));
    Section::new("Worst hole").table(table.rows(held))
}

/// The diameter of the circle of the holes, as a drawing tolerates it.
fn location<'a>(prediction: &HolePrediction) -> Section<'a> {
    let row = |set: &HoleSet| {
        let circle = set.location?;
        let [low, high] = match circle.opposite_mm {
            Some(both) => both.map(um),
            None => ["–", "–"].map(String::from),
        };
        let name = set.compensation.name().to_owned();
        let [x, y] = circle.centre_mm.map(um);
        Some([name, um(circle.diameter_error_mm), low, high, x, y])
    };
    let headings = [
        "compensation",
        "diameter, µm",
        "opposite, least, µm",
        "largest, µm",
        "centre x, µm",
        "y, µm",
    ];
    let note = "Diameter of the circle of the holes at 20 °C less the nominal one, by least squares and from \
                opposite holes, and where its centre is. It is not sensitive to a shift of the whole pattern, \
                the distance from place is.";
    let rows = prediction.sets.iter().filter_map(row);
    Section::new("Location diameter").table(Table::new(headings).rows(rows).note(note))
}

fn holes<'a>(study: &HoleStudy, prediction: &HolePrediction) -> Section<'a> {
    let mut headings: Vec<String> = ["hole", "x, mm", "y, mm"].map(String::from).into();
    if study.temperatures.is_some() {
        headings.push("after, s".to_owned());
    }
    for name in ["none", "machine", "comprehensive"] {
        headings.extend([format!("dx, {name}"), format!("dy, {name}")]);
    }
    headings.extend(["u(dx)", "u(dy)"].map(String::from));
    let rows = study.holes_mm.iter().enumerate().map(|(i, place)| {
        let mut row =
            vec![(i + 1).to_string(), format!("{:.3}", place.x), format!("{:.3}", place.y)];
        if study.temperatures.is_some() {
            row.push(format!("{:.0}", prediction.times_s[i]));
        }
        let errors = prediction.sets.iter().map(|set| set.holes[i].error_mm);
        let u = prediction.sets[0].holes[i].u_mm;
        row.extend(errors.chain([u]).flat_map(|v| [um(v.x), um(v.y)]));
        row
    });
    let note = "dx and dy in µm at 20 °C, under each compensation, in the workpiece frame; u is a standard \
                uncertainty, without compensation.";
    Section::new("Holes").table(Table::new(headings).rows(rows).note(note))
}

fn inputs<'a>(study: &HoleStudy, prediction: &HolePrediction) -> Section<'a> {
    let mut pairs = vec![
        ("machine", study.machine.name().to_owned()),
        ("source of the machine", study.machine.source().to_owned()),
        ("increment of a compensation", format!("{} µm", um(study.increment_mm))),
    ];
    if let Some(running) = &study.temperatures {
        let last_s = prediction.times_s.last().copied().unwrap_or(0.0);
        let (file, start_s) = (running.run.log.file(), running.run.start_s);
        let log = format!(
            "{file}, from {start_s:.1} s of its time, within 0.01 K; the last hole after {last_s:.1} s"
        );
        pairs.push(("temperatures", log));
    }
    if !prediction.without_u.is_empty() {
        pairs.push(("u lacks", format!("{} (none stated)", prediction.without_u.join(", "))));
    }
    Section::new("Inputs").table(Table::pairs(pairs))
}
