//! Reads the tables of an RTCP calibration: axis positions and readings.

use super::study::{ReadingSet, Row, RtcpStudy, command_of};
use std::collections::BTreeMap;
use std::path::Path;
use trueaxis_input::plausible::{Limits, Quantity};
use trueaxis_input::{CsvColumn, CsvTable, Diagnostics, Dimension, Place, Section, Unit};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::errors::{BodyName, ErrorValues};
use trueaxis_measure::measure::path::leaves_travel;

/// More rows in all are a slip of the pen.
const MOST_ROWS: usize = 20_000;
/// No indicator reads more, mm.
pub(super) const LARGE_MM: f64 = 5.0;
/// From which side an axis came: a column of the tables of `identify`, of which the centres know nothing.
const SIDE: &str = "approach";
/// What says that a row was read again.
const LABELS: [&str; 2] = ["time_s", "group"];
/// A tool that stands farther from its ball than this reads something else, mm.
const FAR_MM: f64 = 10.0;

pub(super) fn read_table(section: &Section<'_>, path: &Path) -> Option<CsvTable> {
    let mut problems = Diagnostics::new();
    let text = section.files().text(path, "a table of readings (CSV)", &mut problems);
    let table = text.map(|t| CsvTable::parse(&path.display().to_string(), &t, &mut problems));
    let sound = !problems.has_errors();
    section.take_over(problems);
    table.filter(|_| sound)
}

/// Which column is what: axes by index, readings by channel.
#[derive(Default)]
struct Columns<'t> {
    axes: Vec<(usize, Unit, &'t CsvColumn)>,
    channels: Vec<(usize, Unit, &'t CsvColumn)>,
}

fn columns<'t>(table: &'t CsvTable, machine: &Machine, problems: &mut Diagnostics) -> Columns<'t> {
    let mut found = Columns::default();
    for column in &table.columns {
        let (name, unit) = column.name.split_once('_').unwrap_or((&column.name, ""));
        if LABELS.contains(&column.name.as_str()) || unit == SIDE {
            continue;
        }
        let axis = machine.axes().iter().position(|a| a.name.to_string() == name);
        let channel = ["x", "y", "z"].iter().position(|c| *c == name);
        let (kind, usual) = match (axis, channel) {
            (Some(i), _) if machine.axes()[i].kind == AxisKind::Rotary => (Dimension::Angle, "deg"),
            (Some(_), _) => (Dimension::Length, "mm"),
            (None, Some(_)) => (Dimension::Length, ""),
            _ => {
                let message = format!("`{}` is no axis and no reading", column.name);
                let hint = "known here: the axes by letter (X, A; mm, deg), x_um, y_um, z_um";
                problems.warn("unknown-column", column.place.clone(), message, hint);
                continue;
            }
        };
        let unit = if unit.is_empty() { usual } else { unit };
        match (Unit::find(unit, kind), axis, channel) {
            (Ok(unit), Some(i), _) => found.axes.push((i, unit, column)),
            (Ok(unit), _, Some(c)) => found.channels.push((c, unit, column)),
            (Err(e), ..) => {
                problems.error(e.code(), column.place.clone(), e.to_string(), &e.hint());
            }
            _ => {}
        }
    }
    found
}

/// The rows of a set.
pub(super) fn read_rows(
    section: &Section<'_>,
    study: &RtcpStudy,
    mut set: ReadingSet,
    table: &CsvTable,
    (at, found): (&[(BodyName, f64)], bool),
) -> Option<ReadingSet> {
    let mut problems = Diagnostics::new();
    let columns = columns(table, &study.machine, &mut problems);
    let mut base = Command::default();
    for (i, axis) in study.machine.axes().iter().enumerate() {
        let column = columns.axes.iter().find(|(a, ..)| *a == i);
        let still = at.iter().find(|(name, _)| *name == axis.name);
        let placed = set.tcp && axis.kind == AxisKind::Linear;
        match (column, still) {
            (Some((.., column)), _) if placed => {
                let message = format!("with RTCP on the control places {}", axis.name);
                let hint = "the column is not used; rtcp = false if it was off";
                problems.warn("unused-column", column.place.clone(), message, hint);
            }
            (None, Some((_, q))) => base[i] = *q,
            (None, None) if !placed => {
                let unit = if axis.kind == AxisKind::Linear { "mm" } else { "deg" };
                let message = format!("where did {} stand?", axis.name);
                let hint =
                    format!("a column `{}`, or at = {{ {} = \"0 {unit}\" }}", axis.name, axis.name);
                problems.error("missing-column", Place::whole(&table.file), message, &hint);
            }
            _ => {}
        }
    }
    if columns.channels.is_empty() && !found {
        let message = "the table has no reading".to_owned();
        let hint = "columns x_um, y_um, z_um (those that were read), or found = true if the axes \
                    stand where the indicator reads zero";
        problems.error("missing-column", Place::whole(&table.file), message, hint);
    }
    for row in 0..table.rows().min(MOST_ROWS) {
        let mut value = |unit: &Unit, column: &CsvColumn| match unit.checked(column.values[row]) {
            Ok(value) => value,
            Err(e) => {
                problems.error(e.code(), table.row_place(row), e.to_string(), &e.hint());
                0.0
            }
        };
        let mut command = base;
        for (i, unit, column) in &columns.axes {
            command[*i] = value(unit, column);
        }
        let mut read_mm = [found.then_some(0.0); 3];
        for (c, unit, column) in &columns.channels {
            read_mm[*c] = Some(value(unit, column));
        }
        let line = u32::try_from(table.row_place(row).line).unwrap_or(u32::MAX);
        set.rows.push(Row { command, read_mm, line });
    }
    let sound = !problems.has_errors();
    if sound {
        check_rows(study, &set, (table, &section.limits()), &mut problems);
    }
    if !columns.channels.is_empty() {
        set.rows = without_copies(&set.rows, table, &mut problems);
    }
    let sound = !problems.has_errors();
    section.take_over(problems);
    sound.then_some(set)
}

/// Rows that are equal to an earlier one to the last digit, and do not say that they were read again, count once.
fn without_copies(rows: &[Row], table: &CsvTable, problems: &mut Diagnostics) -> Vec<Row> {
    let labels: Vec<&CsvColumn> = LABELS.iter().filter_map(|name| table.column(name)).collect();
    let mut first: BTreeMap<Vec<u64>, u32> = BTreeMap::new();
    let mut kept = Vec::new();
    let mut copies = 0;
    for (i, row) in rows.iter().enumerate() {
        let read = row.read_mm.iter().map(|v| v.unwrap_or(f64::MAX));
        let numbers = row.command.iter().copied().chain(read);
        let numbers = numbers.chain(labels.iter().map(|c| c.values[i]));
        let key: Vec<u64> = numbers.map(|v| (v + 0.0).to_bits()).collect();
        let Some(line) = first.get(&key) else {
            first.insert(key, row.line);
            kept.push(row.clone());
            continue;
        };
        copies += 1;
        if copies <= MOST_NAMED {
            let message = format!(
                "this row is that of line {line} again, to the last digit: the two count once"
            );
            let hint =
                "a reading that was taken again has another time_s or another group; delete copies";
            problems.warn("copied-rows", table.row_place(i), message, hint);
        }
    }
    if copies > MOST_NAMED {
        let message = format!("{copies} of {} rows are copies in all", rows.len());
        problems.note("copied-rows", Place::whole(&table.file), message, "");
    }
    kept
}

/// Copies that are named one by one.
const MOST_NAMED: usize = 3;

/// Readings that no indicator reads, poses that no control reaches.
fn check_rows(
    study: &RtcpStudy,
    set: &ReadingSet,
    (table, limits): (&CsvTable, &Limits),
    problems: &mut Diagnostics,
) {
    if set.rows.is_empty() || table.rows() > MOST_ROWS {
        let message = format!("{} rows of readings", table.rows());
        let hint = format!("1 to {MOST_ROWS}");
        return problems.error("bad-count", Place::whole(&table.file), message, &hint);
    }
    for c in 0..3 {
        let values: Vec<f64> = set.rows.iter().map(|r| r.read_mm[c].unwrap_or(0.0)).collect();
        let name = ["x", "y", "z"][c];
        limits.judge_column(Quantity::Deviation, (name, &values), |i| table.row_place(i), problems);
    }
    let size = |row: &Row| row.read_mm.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
    let largest =
        (0..set.rows.len()).max_by(|a, b| size(&set.rows[*a]).total_cmp(&size(&set.rows[*b])));
    let noise = set.instrument.noise[0];
    match largest.map(|i| (i, size(&set.rows[i]))) {
        Some((i, mm)) if mm > LARGE_MM => {
            let message = format!("a reading of {mm:.3} mm");
            let hint = "no indicator reads so much: is the unit in the heading right?";
            problems.warn("large-reading", table.row_place(i), message, hint);
        }
        Some((i, mm)) if mm > 0.0 && mm < 0.05 * noise => {
            let message = format!("no reading exceeds {:.2e} µm, far below the noise", mm * 1e3);
            let hint = "are these mm under a heading in µm?";
            problems.warn("small-readings", table.row_place(i), message, hint);
        }
        _ => {}
    }
    let (mut unreached, mut outside, mut far) = (None, None, None);
    for (i, row) in set.rows.iter().enumerate() {
        let Some(command) = command_of(study, set, &row.command) else {
            unreached = unreached.or(Some(i));
            continue;
        };
        outside = outside.or_else(|| Some((i, leaves_travel(&study.machine, &command)?)));
        if far.is_none() && !set.tcp {
            let pose = study.machine.pose(&command, &ErrorValues::default());
            let tip = pose.linear() * set.instrument.tool_point_mm + pose.shift_mm();
            let away = (tip - set.instrument.reference_point_mm).norm();
            far = (away > FAR_MM).then_some((i, away));
        }
    }
    if let Some(i) = unreached {
        let message = "the linear axes cannot bring the tip to the ball".to_owned();
        problems.error(
            "out-of-reach",
            table.row_place(i),
            message,
            "check the rotary axes and `ball`",
        );
    }
    if let Some((i, strayed)) = outside {
        let hint = "check the unit of the column and `ball`";
        problems.warn("outside-travel", table.row_place(i), strayed.to_string(), hint);
    }
    if let Some((i, mm)) = far {
        let message = format!("by the machine file the tool is {mm:.1} mm from the ball");
        let hint = "check `ball`, `tip` and the columns X, Y, Z";
        problems.warn("far-from-ball", table.row_place(i), message, hint);
    }
}
