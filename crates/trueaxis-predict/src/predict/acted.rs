//! What acted while a part was made: the record that a live run keeps of it (`trueaxis live part`).
//!
//! ```text
//!     time_s, block, followed, known, tcp, X_mm, …, X_acted_um, …, scale_x_degC, …
//! ```
//!
//! A row stands at the end of each block, and wherever X and Y have stood. A hole is where they stood last at its place.

use super::holes::HoleStudy;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvColumn, CsvTable, Diagnostics, Dimension, Place, Section, Unit};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisKind, Command};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::heat::Conditions;

/// A hole is made where X and Y stand within so much of its place. Unit: mm.
pub const SAME_PLACE_MM: f64 = 0.5;

/// One row of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct ActedRow {
    /// The clock of the run. Unit: s.
    pub time_s: f64,
    /// Where the program had the axes. Unit: mm or rad.
    pub at: Command,
    /// What acted on the axes. Unit: mm or rad.
    pub by: Command,
    /// The offsets were added to tip and angles, not to the axes.
    pub tcp: bool,
    /// The correction followed its target from the beginning of the block to its end.
    pub followed: bool,
    /// The temperatures are those of that time, not the last known ones.
    pub known: bool,
    /// The temperatures of that time.
    pub conditions: Conditions,
    /// Its line.
    pub place: Place,
}

/// The record of one part.
#[derive(Debug, Clone, PartialEq)]
pub struct ActedRecord {
    /// The file as the user named it.
    pub file: String,
    /// In the order of time.
    pub rows: Vec<ActedRow>,
}

impl ActedRecord {
    /// The record that `acted` of a section names.
    pub(super) fn named(section: &Section<'_>, folder: &Path, machine: &Machine) -> Option<Self> {
        let path = section.get("acted")?.text()?;
        let path = folder.join(path);
        let mut problems = Diagnostics::new();
        let text = section.files().text(&path, "the record of a part", &mut problems);
        let shown = path.display().to_string();
        let record = text.and_then(|text| Self::parse(&shown, &text, machine, &mut problems));
        section.take_over(problems);
        record
    }

    /// Reads a record for a machine; a position of every axis that it names must be there.
    pub fn parse(
        file: &str,
        text: &str,
        machine: &Machine,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let mut found = Diagnostics::new();
        let table = CsvTable::parse(file, text, &mut found);
        let record = if found.has_errors() { None } else { read(&table, machine, &mut found) };
        let sound = !found.has_errors();
        problems.append(found);
        record.filter(|_| sound)
    }

    /// The last row at a place: within [`SAME_PLACE_MM`] of it in every linear axis but Z.
    pub fn at(&self, machine: &Machine, command: &Command) -> Option<&ActedRow> {
        let same = |row: &&ActedRow| {
            let mut axes = machine.axes().iter().enumerate().filter(|(_, axis)| is_lateral(axis));
            axes.all(|(i, _)| (row.at[i] - command[i]).abs() <= SAME_PLACE_MM)
        };
        self.rows.iter().rfind(same)
    }
}

/// Whether a hole is at a place of this axis: all linear ones but that along which it is drilled.
pub fn is_lateral(axis: &Axis) -> bool {
    axis.kind == AxisKind::Linear && axis.name.to_string() != "Z"
}

/// A column in the inner unit of what follows its last underscore.
fn column(
    table: &CsvTable,
    (name, dimension): (&str, Dimension),
    problems: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let of = |c: &&CsvColumn| {
        let (stem, unit) = c.name.rsplit_once('_').unwrap_or((&c.name, ""));
        stem == name && Unit::find(unit, dimension).is_ok()
    };
    let column = table.columns.iter().find(of)?;
    let unit = Unit::find(column.name.rsplit_once('_')?.1, dimension).ok()?;
    table.in_unit(column, unit, problems)
}

/// Whether a heading is one of a record: an offset under a name of its own would count as none.
fn is_known(heading: &str, machine: &Machine) -> bool {
    let (stem, unit) = heading.rsplit_once('_').unwrap_or((heading, ""));
    let of_axis = machine.axes().iter().any(|axis| {
        let rest = stem.strip_prefix(&axis.name.to_string());
        rest.is_some_and(|rest| ["", "_acted", "_target", "_left", "_left_largest"].contains(&rest))
    });
    let plain = ["time_s", "date_s", "program", "block", "followed", "known", "tcp"];
    plain.contains(&heading) || stem == "time" || unit == "degC" || of_axis
}

fn read(table: &CsvTable, machine: &Machine, problems: &mut Diagnostics) -> Option<ActedRecord> {
    for column in table.columns.iter().filter(|column| !is_known(&column.name, machine)) {
        let message = format!("`{}` is no column of the record of a part", column.name);
        let hint = "time_s, block, followed, known, tcp, X_mm, X_acted_um, X_target_um, X_left_um, scale_x_degC, with the axes of the machine file";
        problems.error("unknown-column", column.place.clone(), message, hint);
    }
    if problems.has_errors() {
        return None;
    }
    let needed = |name: &str, dimension: Dimension, problems: &mut Diagnostics| {
        let found = column(table, (name, dimension), problems);
        if found.is_none() && !problems.has_errors() {
            let message = format!("the record has no column of `{name}`");
            let hint = "it is written by `trueaxis live part PLAN --begin NAME`, parts/NAME.csv in the folder of the run";
            problems.error("missing-column", Place::whole(&table.file), message, hint);
        }
        found
    };
    let times_s = needed("time", Dimension::Time, problems)?;
    let axes = machine.axes();
    let (mut at, mut by) = (Vec::new(), Vec::new());
    for axis in axes {
        let name = axis.name.to_string();
        let dimension = match axis.kind {
            AxisKind::Linear => Dimension::Length,
            AxisKind::Rotary => Dimension::Angle,
        };
        at.push(needed(&name, dimension, problems)?);
        by.push(column(table, (&format!("{name}_acted"), dimension), problems));
    }
    if by.iter().all(Option::is_none) {
        let message = "the record says of no axis what acted".to_owned();
        let hint = "a column such as X_acted_um";
        problems.error("missing-column", Place::whole(&table.file), message, hint);
        return None;
    }
    let flag = |name: &str, row: usize| table.column(name).is_some_and(|c| c.values[row] != 0.0);
    let readings = table.columns.iter().filter_map(|c| Some((c.name.strip_suffix("_degC")?, c)));
    let sensors: Vec<(&str, &CsvColumn)> = readings.collect();
    let command = |columns: &[Option<&Vec<f64>>], row: usize| {
        let mut command = Command::default();
        for (to, column) in command.iter_mut().zip(columns) {
            *to = column.map_or(0.0, |values| values[row]);
        }
        command
    };
    let at: Vec<_> = at.iter().map(Some).collect();
    let by: Vec<_> = by.iter().map(Option::as_ref).collect();
    let rows = times_s.iter().enumerate().map(|(row, time_s)| ActedRow {
        time_s: *time_s,
        at: command(&at, row),
        by: command(&by, row),
        tcp: flag("tcp", row),
        followed: flag("followed", row),
        known: flag("known", row),
        conditions: sensors.iter().fold(Conditions::default(), |found, (sensor, celsius)| {
            found.with_reading(sensor, celsius.values[row])
        }),
        place: table.row_place(row),
    });
    Some(ActedRecord { file: table.file.clone(), rows: rows.collect() })
}

/// The machine while a hole was made.
///
/// # Errors
/// Why it cannot be known.
pub(super) fn machine_then(study: &HoleStudy, row: &ActedRow) -> Result<Option<Machine>, String> {
    if study.states_temperatures {
        return Ok(None);
    }
    if !row.known {
        return Err("a sensor was lost while it was made: state [temperature]".to_owned());
    }
    let mut problems = Diagnostics::new();
    let machine = study.machine.at(&row.conditions, &mut problems);
    let unknown = machine.as_ref().and_then(|m| m.unknown_growth(&row.conditions));
    if unknown.is_some() {
        return Err("its row has no temperature of the workpiece".to_owned());
    }
    let first = problems.iter().find(|d| d.severity == trueaxis_input::Severity::Error);
    let why = first.map_or_else(|| "its temperatures are none".to_owned(), |d| d.message.clone());
    machine.map(Some).ok_or(why)
}

/// How an offset moves the nominal tip, mm, and the command at which the errors are felt.
pub(super) fn moved(machine: &Machine, command: &Command, row: &ActedRow) -> (Vec3, Command) {
    let exact = ErrorValues::default();
    let tip = |at: &Command| machine.deviation(at, &exact).nominal_tip.vector();
    let there: Command = std::array::from_fn(|i| command[i] + row.by[i]);
    if !row.tcp {
        return (tip(&there) - tip(command), there);
    }
    // With tool-centre-point control X, Y, Z are those of the workpiece: the axes with all rotary axes at 0.
    let (zero, axes) = (Command::default(), machine.axes().iter().enumerate());
    let linear = axes.filter(|(_, axis)| axis.kind == AxisKind::Linear);
    let added = linear.map(|(i, _)| {
        let mut one = zero;
        one[i] += 1.0;
        row.by[i] * (tip(&one) - tip(&zero))
    });
    (added.sum(), there)
}
