//! A plan for people and for programs: what each path sees, what to expect, what stays hidden.

use crate::plan::{Chosen, Expectation, Expected, PlanReport, PlannedPath};
use crate::unknowns::design::Design;
use std::fmt::Write;
use trueaxis_motion::report::clock;

/// Lines of a check that are shown.
const MOST_SHOWN: usize = 5;

/// µm, µrad or 1, with the factor from mm, rad or 1.
pub(super) fn shown_unit(design: &Design, expected: &Expected) -> (&'static str, f64) {
    use crate::instruments::instrument::SetupError;
    use crate::unknowns::design::Unknown;
    match design.unknown(expected.unknown) {
        Some(Unknown::Setup(_, s)) if s.error == SetupError::Scale => ("µm/m", 1e6),
        _ if expected.is_angle => ("µrad", 1e6),
        _ => ("µm", 1e3),
    }
}

/// Three digits that count.
pub(super) fn figure(value: f64) -> String {
    let digits = match value.abs() {
        v if v >= 99.95 => 0,
        v if v >= 9.995 => 1,
        v if v >= 0.9995 => 2,
        _ => 3,
    };
    format!("{value:.digits$}")
}

/// The plan as text.
pub fn plan_text(report: &PlanReport<'_>) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = written(report, &mut text);
    text
}

fn written(report: &PlanReport<'_>, text: &mut String) -> std::fmt::Result {
    let campaign = &report.plan.campaign;
    let machine = &campaign.machine;
    writeln!(text, "{}\n  {}, {}\n", campaign.name, machine.name(), machine.chain_text())?;
    writeln!(text, "Paths and their programs")?;
    for planned in &report.paths {
        write_path(planned, text)?;
    }
    write_seen(report, text)?;
    write_expected(report, text)?;
    if let Some(chosen) = &report.chosen {
        write_choice(report, chosen, text)?;
    }
    write_hidden(&report.expectation, text)
}

fn write_path(planned: &PlannedPath, text: &mut String) -> std::fmt::Result {
    let path = &planned.path;
    let how = match path.feed_mm_per_s {
        Some(feed) => format!("moving at {:.0} mm/min", feed * 60.0),
        None => format!("standing {} s at each", figure(path.dwell_s)),
    };
    let count = path.stations.len();
    match &planned.check {
        Err(why) => {
            writeln!(text, "  {:<10} {count:>5} stations, {how}; no program: {why}", path.name)
        }
        Ok(check) => {
            let verdict = match check.is_sound() {
                true => "nothing in the way",
                false => "NOT SAFE",
            };
            let runs = clock(check.duration_s);
            writeln!(
                text,
                "  {:<10} {count:>5} stations, {how}; runs {runs}; {verdict}",
                path.name
            )?;
            let all = || check.errors.iter().chain(&check.grave);
            for line in all().take(MOST_SHOWN) {
                writeln!(text, "      ! {line}")?;
            }
            if all().count() > MOST_SHOWN {
                writeln!(text, "      … and {} more", all().count() - MOST_SHOWN)?;
            }
            match check.minor.first() {
                Some(line) => writeln!(text, "      {} minor, such as {line}", check.minor.len()),
                None => Ok(()),
            }
        }
    }
}

fn write_seen(report: &PlanReport<'_>, text: &mut String) -> std::fmt::Result {
    writeln!(
        text,
        "\nWhat each path sees: largest reading, µm or µrad, for 10 µm or 10 µrad of each error"
    )?;
    let head = |planned: &PlannedPath| {
        format!("{} ({})", short(&planned.path.name, 16), planned.channels.join(", "))
    };
    let cells: Vec<Vec<String>> = report
        .paths
        .iter()
        .map(|planned| {
            let rows = (0..planned.seen.len()).map(|k| readings(planned, k));
            std::iter::once(head(planned)).chain(rows).collect()
        })
        .collect();
    let widths: Vec<usize> =
        cells.iter().map(|c| c.iter().map(|t| t.chars().count()).max().unwrap_or(0)).collect();
    let names = report.paths.first().into_iter().flat_map(|p| &p.seen).map(|s| s.name.as_str());
    for (k, name) in std::iter::once("").chain(names).enumerate() {
        write!(text, "  {name:<14}")?;
        for (column, width) in cells.iter().zip(&widths) {
            write!(text, "  {:>width$}", column.get(k).map_or("", String::as_str))?;
        }
        writeln!(text)?;
    }
    Ok(())
}

fn short(name: &str, most: usize) -> String {
    name.chars().take(most).collect()
}

/// The channels of one error on one path, µm or µrad.
fn readings(planned: &PlannedPath, k: usize) -> String {
    let one = |v: &f64| match v * 1e3 {
        v if v < 5e-4 => "–".to_owned(),
        v => figure(v),
    };
    let scale = |v: &f64| if planned.channels == ["angle"] { v * 1e3 } else { *v };
    let largest = planned.seen.get(k).map(|s| s.largest.iter().map(|v| one(&scale(v))).collect());
    largest.map_or_else(String::new, |all: Vec<String>| all.join(" "))
}

fn write_expected(report: &PlanReport<'_>, text: &mut String) -> std::fmt::Result {
    let e = &report.expectation;
    writeln!(
        text,
        "\nWhat to expect before anybody measures ({} of {} combinations seen, condition {})",
        e.rank,
        e.unknowns.len(),
        figure(e.condition)
    )?;
    writeln!(text, "  {:<22} {:>9} {:>9}", "", "u", "U (k=2)")?;
    for expected in &e.unknowns {
        let (unit, scale) = shown_unit(report.design, expected);
        match expected.u {
            Some(u) => writeln!(
                text,
                "  {:<22} {:>9} {:>9} {unit}",
                expected.name,
                figure(u * scale),
                figure(2.0 * u * scale)
            )?,
            None => writeln!(text, "  {:<22} {:>9} {:>9}", expected.name, "–", "hidden")?,
        }
    }
    Ok(())
}

fn write_choice(report: &PlanReport<'_>, chosen: &Chosen, text: &mut String) -> std::fmt::Result {
    let swaps = chosen.history.len().saturating_sub(1);
    writeln!(
        text,
        "\nChosen: {} of {} poses, {} readings, {} (by per_hit and per_pose), {swaps} exchanges",
        chosen.poses,
        chosen.candidates,
        chosen.stations.len(),
        clock(chosen.time_s)
    )?;
    if chosen.blocked > 0 {
        writeln!(
            text,
            "  {} poses were left out: the tool would run into something",
            chosen.blocked
        )?;
    }
    let Some((count, grid)) = &chosen.grid else { return Ok(()) };
    writeln!(text, "  U (k=2) {:>22} {:>14}", "chosen", format!("grid of {count}"))?;
    for (a, b) in chosen.expectation.unknowns.iter().zip(&grid.unknowns) {
        let (unit, scale) = shown_unit(report.design, a);
        let one = |u: Option<f64>| u.map_or("hidden".to_owned(), |u| figure(2.0 * u * scale));
        writeln!(text, "  {:<20} {:>9} {:>14} {unit}", a.name, one(a.u), one(b.u))?;
    }
    Ok(())
}

fn write_hidden(expectation: &Expectation, text: &mut String) -> std::fmt::Result {
    if expectation.unobservable.is_empty() {
        return writeln!(text, "\nEverything that is sought can be told.");
    }
    writeln!(text, "\nWhat cannot be told")?;
    for hidden in &expectation.unobservable {
        writeln!(text, "  {}", hidden.words)?;
        writeln!(text, "      {} = ?", hidden.combination)?;
        match &hidden.resolve_with {
            Some(set_up) => writeln!(text, "      would tell: {set_up}")?,
            None => writeln!(text, "      none of the set-ups that were tried would tell")?,
        }
    }
    Ok(())
}
