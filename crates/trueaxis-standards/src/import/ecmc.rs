//! The Markdown reports of the ECMC motion test scripts: readings and printed parameters.

use super::{Beside, Imported, Printed, one_axis_only};
use crate::Standard;
use crate::iso230_2::Quantity;
use std::borrow::Cow;
use trueaxis_input::{Diagnostics, Dimension, Place, Unit};

const UP: &str = "### Data forward direction";
const DOWN: &str = "### Data backward direction";
/// More runs than this are another table.
const MOST_RUNS: usize = 1000;

/// Their parameters, and those of ISO 230-2 with the same name.
const FIGURES: [(&str, Quantity); 12] = [
    ("A", Quantity::A),
    ("A_fwd", Quantity::AUp),
    ("A_bwd", Quantity::ADown),
    ("R", Quantity::R),
    ("R_fwd", Quantity::RUp),
    ("R_bwd", Quantity::RDown),
    ("E", Quantity::E),
    ("E_fwd", Quantity::EUp),
    ("E_bwd", Quantity::EDown),
    ("M", Quantity::M),
    ("B", Quantity::B),
    ("B_avg", Quantity::BMean),
];

/// Why a printed value may differ.
pub(super) fn reason(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::R => {
            "these reports take the larger of R↑ and R↓; the standard's R contains the reversal at \
             each target"
        }
        Quantity::E => {
            "these reports do not take the range of both directions together; the standard's E does"
        }
        _ => "the results here are those of the readings in the report",
    }
}

/// One row of readings.
struct Row<'t> {
    line: usize,
    up: bool,
    cells: Vec<&'t str>,
}

pub(super) fn read(
    standard: Standard,
    file: &str,
    text: &str,
    problems: &mut Diagnostics,
) -> Option<Imported<'static>> {
    one_axis_only(standard, "a report of positions along one axis", file, problems)?;
    let mut rows = Vec::new();
    let mut printed = Vec::new();
    let mut unit = Some("mm");
    let mut up = None;
    for (i, line) in text.lines().enumerate() {
        let line = line.trim();
        match line {
            UP => up = Some(true),
            DOWN => up = Some(false),
            _ if line.starts_with('#') => up = None,
            _ => {}
        }
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        if let ["Unit", stated] = cells[..] {
            unit = Unit::find(stated, Dimension::Length).is_ok().then_some(stated);
        }
        match up {
            Some(up) if cells[0].parse::<usize>().is_ok() => {
                rows.push(Row { line: i + 1, up, cells });
            }
            _ => printed.extend(figure(line, i + 1)),
        }
    }
    let Some(unit) = unit else {
        let message = "the readings of the report are not in a length".to_owned();
        let hint = "only reports of linear axes in mm are supported; write the readings as CSV";
        problems.error("unknown-unit", Place::whole(file), message, hint);
        return None;
    };
    let runs = rows.iter().map(|r| r.cells.len().saturating_sub(2)).max().unwrap_or(0);
    if !(1..=MOST_RUNS).contains(&runs) {
        let message = "the report has no readings".to_owned();
        let hint = "they are expected in tables under `### Data forward direction` and `### Data backward \
                    direction`";
        problems.error("empty-table", Place::whole(file), message, hint);
        return None;
    }
    if let Some(short) = rows.iter().find(|r| r.cells.len() < 3) {
        let place = Place { file: file.to_owned(), line: short.line, column: 1 };
        let message = "this row of the table has no reading".to_owned();
        let hint = "number | target | readings; is the report cut off here?";
        problems.error("short-row", place, message, hint);
        return None;
    }
    let table = table(&rows, runs, unit);
    Some(Imported { table: Cow::Owned(table), printed, ..Imported::default() })
}

/// `target_mm,actual_up_1_mm …,actual_down_1_mm …`, each row with the half of its direction.
fn table(rows: &[Row<'_>], runs: usize, unit: &str) -> String {
    let mut table = Beside::default();
    let mut heading = format!("target_{unit}");
    for word in ["up", "down"] {
        for run in 1..=runs {
            heading += &format!(",actual_{word}_{run}_{unit}");
        }
    }
    table.row(1, &heading);
    for row in rows {
        let readings = &row.cells[2..];
        let padding = ",".repeat(runs - readings.len());
        let (half, empty) = (readings.join(",") + &padding, ",".repeat(runs - 1));
        let [first, second] = if row.up { [&half, &empty] } else { [&empty, &half] };
        table.row(row.line, &format!("{},{first},{second}", row.cells[1]));
    }
    table.into_text()
}

/// `**A_fwd = 0.02008 [mm]**`.
fn figure(line: &str, number: usize) -> Option<Printed> {
    let (name, rest) = line.trim_matches('*').split_once(" = ")?;
    let (value, unit) = rest.split_once(' ')?;
    let unit = Unit::find(unit.trim().trim_matches(['[', ']']), Dimension::Length).ok()?;
    let value: f64 = value.parse().ok()?;
    let (theirs, quantity) = FIGURES.into_iter().find(|(theirs, _)| *theirs == name)?;
    let value_mm = unit.to_inner(value);
    value_mm.is_finite().then_some(Printed { theirs, quantity, value_mm, line: number })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_without_a_reading_is_named() {
        let text = format!("{UP}\n0 | 10 | 10.01 |\n1\n");
        let mut problems = Diagnostics::new();
        assert!(read(Standard::Iso230_2, "r.md", &text, &mut problems).is_none());
        let first = problems.iter().next().map(|d| (d.code, d.place.line));
        assert_eq!(first, Some(("short-row", 3)));
    }
}
