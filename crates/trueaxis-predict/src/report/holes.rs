//! A prediction for holes in text and on a page.

use super::holes_pictures::plans;
use crate::predict::holes::{Applied, HolePrediction, HoleSet, HoleStudy};
use trueaxis_report::{Columns, Report, Section, Standing, Table};

/// Each compensation in words.
const NAMES: [&str; 4] =
    ["without compensation", "machine only", "comprehensive", "with what acted"];

/// The prediction.
pub fn holes_report<'a>(study: &'a HoleStudy, prediction: &'a HolePrediction) -> Report<'a> {
    let applied = prediction.sets.iter().find(|s| s.compensation == study.applied);
    let (standing, word, sentence) = match applied.and_then(HoleSet::keeps_tolerances) {
        Some(true) => (Standing::Good, "PASS", stated(study, "will be in tolerance")),
        Some(false) => (Standing::Bad, "FAIL", failed(applied)),
        None => (Standing::Open, "NO VERDICT", "the study states no tolerance".to_owned()),
    };
    let near = applied.and_then(|set| near_limit(study, set)).unwrap_or_default();
    let with = match study.applied {
        Applied::By(compensation) => format!("with compensation: {}", compensation.name()),
        Applied::Acted => "with what acted while it was made".to_owned(),
    };
    let sentence = format!("{sentence}, {with}{near}");
    let warnings = prediction.warnings.iter().map(|(_, w)| format!("WARNING: {w}"));
    Report::new(&study.name)
        .line(format!("{}, {}", study.machine.name(), study.machine.chain_text()))
        .verdict(standing, word, sentence)
        .section(Section::new("").list(warnings))
        .section(worst(study, prediction))
        .section(location(study, prediction))
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

fn stated(study: &HoleStudy, what: &str) -> String {
    let subject = match (study.tolerance_mm, study.location_tolerance_mm) {
        (Some(_), Some(_)) => "every hole and the location diameter",
        (None, Some(_)) => "the location diameter",
        _ => "every hole",
    };
    format!("{subject} {what}")
}

fn failed(applied: Option<&HoleSet>) -> String {
    let of = |f: fn(&HoleSet) -> Option<bool>| applied.and_then(f) == Some(false);
    let places = of(|set| set.in_tolerance);
    let subject = match (places, of(|set| set.location_in_tolerance)) {
        (true, true) => "a hole and the location diameter",
        (false, true) => "the location diameter",
        _ => "a hole",
    };
    format!("{subject} will be out of tolerance")
}

/// A value that is nearer to its limit than its expanded uncertainty.
fn near_limit(study: &HoleStudy, set: &HoleSet) -> Option<String> {
    let place = study.tolerance_mm.map(|t| (t, set.worst_mm, set.u_worst_mm));
    let circle = study.location_tolerance_mm.zip(set.location).map(|(t, circle)| {
        let (error, u) = circle.largest_mm();
        (t, error.abs(), u)
    });
    let within = |(t, value, u): &(f64, f64, f64)| (t - value).abs() < 2.0 * u;
    let near = place.into_iter().chain(circle).find(within)?;
    let (t, value, u) = near;
    Some(format!(
        "; {} of {} µm allowed are within U = {} µm (k = 2) of the limit: measure before relying on it",
        um(value),
        um(t),
        um(2.0 * u)
    ))
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
fn location<'a>(study: &HoleStudy, prediction: &HolePrediction) -> Section<'a> {
    let row = |set: &HoleSet| {
        let circle = set.location?;
        let pair = |which: usize| match (circle.opposite_mm, circle.u_opposite_mm) {
            (Some(values), Some(u)) => [um(values[which]), um(u[which])],
            _ => ["–", "–"].map(String::from),
        };
        let ([low, u_low], [high, u_high]) = (pair(0), pair(1));
        let verdict = match set.location_in_tolerance {
            Some(true) => "pass",
            Some(false) => "fail",
            None => "–",
        };
        let allowed =
            study.location_tolerance_mm.map_or("–".to_owned(), |t| format!("±{}", um(t)));
        let [x, y] = circle.centre_mm.map(um);
        let (name, diameter) = (set.compensation.name().to_owned(), um(circle.diameter_error_mm));
        let u = um(circle.u_diameter_mm);
        Some([name, diameter, u, low, u_low, high, u_high, allowed, verdict.to_owned(), x, y])
    };
    let headings = [
        "compensation",
        "diameter, µm",
        "u, µm",
        "opposite, least, µm",
        "u, µm",
        "largest, µm",
        "u, µm",
        "allowed, µm",
        "in tolerance",
        "centre x, µm",
        "y, µm",
    ];
    let note = "Diameter of the circle of the holes at 20 °C less the nominal one, by least squares and from \
                opposite holes, with standard uncertainties u, and where its centre is. It is not sensitive to a \
                shift of the whole pattern, the distance from place is. Judged: the opposite holes that deviate \
                most; the least-squares diameter where the number of holes is odd.";
    let rows = prediction.sets.iter().filter_map(row);
    Section::new("Location diameter").table(Table::new(headings).rows(rows).note(note))
}

fn holes<'a>(study: &HoleStudy, prediction: &HolePrediction) -> Section<'a> {
    let mut headings: Vec<String> = ["hole", "x, mm", "y, mm"].map(String::from).into();
    let has_times = study.temperatures.is_some() || study.acted.is_some();
    if has_times {
        headings.push("after, s".to_owned());
    }
    for name in prediction.sets.iter().map(|set| set.compensation.name()) {
        headings.extend([format!("dx, {name}"), format!("dy, {name}")]);
    }
    headings.extend(["u(dx)", "u(dy)"].map(String::from));
    let rows = study.holes_mm.iter().enumerate().map(|(i, place)| {
        let mut row =
            vec![(i + 1).to_string(), format!("{:.3}", place.x), format!("{:.3}", place.y)];
        if has_times {
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
    if let Some(record) = &study.acted {
        let warm = if study.states_temperatures { "as the study states" } else { "as recorded" };
        pairs.push(("what acted", format!("{}; temperatures {warm}", record.file)));
    }
    if !prediction.without_u.is_empty() {
        pairs.push(("u lacks", format!("{} (none stated)", prediction.without_u.join(", "))));
    }
    Section::new("Inputs").table(Table::pairs(pairs))
}
