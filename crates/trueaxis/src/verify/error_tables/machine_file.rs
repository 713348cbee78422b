//! The machine file with the tables and squarenesses that were found.
//!
//! All other lines stay as they are. The new file is read back: its virtual instruments must read what the
//! instruments read.

use super::reduce::{Role, directions, role, side};
use super::{ErrorReadings, ErrorTable, ReferenceLine, Removed, Squareness, TableStudy};
use crate::verify::iso230_2::Direction;
use nalgebra::{DMatrix, DVector};
use std::fmt::Write as _;
use trueaxis_geometry::{AxisKind, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::chain::Link;
use trueaxis_machine::describe::lines::{Lines, header};
use trueaxis_machine::describe::replacement::{
    Entry, NewTables, machine_of_text, measured_and_closed, plain, put, take_out_of_table,
};
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorName, ErrorValues, Measurement};
use trueaxis_machine::file::Tables;
use trueaxis_machine::models::Shape;
use trueaxis_machine::twist::Reference;

/// What rounding and products of errors may change of a reading: mm, rad; and in proportion to it.
const ROUNDING: f64 = 2e-7;
const PRODUCTS: f64 = 1e-3;

/// A machine file with the tables that it names.
#[derive(Debug, Clone)]
pub struct MachineFiles {
    /// The machine file.
    pub text: String,
    /// Name and text of every table that it names, new and old.
    pub tables: Vec<(String, String)>,
    /// The files of solid models that it names; they are not among the tables.
    pub models: Vec<String>,
    /// The greatest difference between the mean of a reading and what the new machine shows, by error; what the
    /// set-up hides does not count. Unit: mm or rad.
    pub read_back: Vec<(ErrorName, f64)>,
}

/// Puts tables and squarenesses into the text of a machine file.
///
/// # Errors
/// In words, why it cannot be.
pub fn machine_files(
    study: &TableStudy,
    tables: &[ErrorTable],
    squarenesses: &[Squareness],
    old: &str,
    beside: &dyn Tables,
) -> Result<MachineFiles, String> {
    let mut file = Lines::of(old);
    let mut written: Vec<(String, String)> = Vec::new();
    let origin = format!("from {}", one_line(&study.name));
    for table in tables {
        let header = header(table.name);
        let outside = file.key(&header, "outside").and_then(|at| file.value(at).map(str::to_owned));
        take_out_of_table(&mut file, table.name, &origin, &mut written, beside);
        let csv = format!("{}-table.csv", table.name);
        written.push((csv.clone(), csv_text(study, table)));
        let mut entry = format!("{{ table = \"{csv}\", interpolation = \"not-a-knot\"");
        if let Some(outside) = outside.filter(|_| file.key(&header, "outside").is_none()) {
            let _ = write!(entry, ", outside = {outside}");
        }
        entry += &measured_and_closed(&measured(table));
        put(&mut file, table.name, &Entry::Value(entry), &origin);
    }
    for found in squarenesses {
        let value =
            format!("\"{} ± {} urad\"", plain(found.value_rad * 1e6), plain(found.u_rad * 1e6));
        put(&mut file, found.name, &Entry::Value(value), &origin);
    }
    let text = file.text();
    let seen = NewTables::of(&written, beside);
    let machine = machine_of_text(&text, &seen)?;
    let tables_read = seen.read();
    let mut read_back = Vec::new();
    for readings in &study.readings {
        let table = tables.iter().find(|t| t.name == readings.name);
        let removed = table.map_or(Removed::Zero, |t| t.removed);
        read_back.push((readings.name, difference(&machine, readings, removed)?));
    }
    let model = |shape: &Shape| match shape {
        Shape::Stl { path, .. } => Some(path.clone()),
        _ => None,
    };
    let models = machine.models().iter().filter_map(|m| model(&m.shape)).collect();
    Ok(MachineFiles { text, tables: tables_read, models, read_back })
}

impl MachineFiles {
    /// The machine of these files.
    ///
    /// # Errors
    /// In words, why it cannot be read.
    pub fn machine(&self, beside: &dyn Tables) -> Result<Machine, String> {
        machine_of_text(&self.text, &NewTables::of(&self.tables, beside))
    }
}

fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}

fn measured(table: &ErrorTable) -> Measurement {
    Measurement {
        instrument: table.instrument.clone(),
        date: table.date.clone(),
        temperature_celsius: table.celsius,
    }
}

fn csv_text(study: &TableStudy, table: &ErrorTable) -> String {
    let (scale, unit) = match table.name.component.is_rotation() {
        true => (1e6, "urad"),
        false => (1e3, "um"),
    };
    let is_rotary = study.machine.axes()[table.axis].kind == AxisKind::Rotary;
    let position = if is_rotary { "position_deg" } else { "position_mm" };
    let name = table.name;
    let mut text = format!(
        "# {name} from {}: the error of the body, mean of {} runs\n",
        one_line(&study.name),
        table.runs
    );
    // Writing into a text cannot fail.
    let _ = match table.both {
        true => writeln!(text, "{position},{name}_up_{unit},{name}_down_{unit},u_{name}_{unit}"),
        false => writeln!(text, "{position},{name}_{unit},u_{name}_{unit}"),
    };
    for (i, q) in table.positions.iter().enumerate() {
        let q = if is_rotary { (q.to_degrees() * 1e9).round() / 1e9 } else { *q };
        let _ = write!(text, "{q},{}", plain(table.up[i] * scale));
        if table.both {
            let _ = write!(text, ",{}", plain(table.down[i] * scale));
        }
        let _ = writeln!(text, ",{}", plain(table.u[i] * scale));
    }
    text
}

/// How far the instrument would read otherwise on the new machine.
///
/// It goes through the whole chain, with all error motions of the axis: the point of the tool for a length, the turn of
/// the tool for an angle.
fn difference(
    machine: &Machine,
    readings: &ErrorReadings,
    removed: Removed,
) -> Result<f64, String> {
    let mut differences = Vec::new();
    let mut places = Vec::new();
    let mut largest: f64 = 0.0;
    for target in &readings.measurement.targets {
        for (direction, approach) in [(Direction::Up, 1.0), (Direction::Down, -1.0)] {
            let rows = target.of(direction);
            if rows.is_empty() {
                continue;
            }
            let mean = rows.iter().map(|r| r.deviation).sum::<f64>() / rows.len() as f64;
            differences.push(shown(machine, readings, target.position, approach)? - mean);
            places.push(target.position);
            largest = largest.max(mean.abs());
        }
    }
    let worst = left(&places, &differences, removed);
    match worst <= ROUNDING + PRODUCTS * largest {
        true => Ok(worst),
        false => {
            let (scale, unit) = match readings.name.component.is_rotation() {
                true => (1e6, "µrad"),
                false => (1e3, "µm"),
            };
            Err(format!(
                "{} would be read back {:.3} {unit} otherwise: do several readings contradict each other?",
                readings.name,
                worst * scale
            ))
        }
    }
}

/// What remains of the differences when the set-up of the instrument is fitted again.
fn left(places: &[f64], differences: &[f64], removed: Removed) -> f64 {
    let row = |q: f64| match removed {
        Removed::Line(line) if line != ReferenceLine::None => vec![1.0, q],
        Removed::Eccentricity => vec![1.0, q.cos(), q.sin()],
        _ => vec![1.0],
    };
    let rows: Vec<Vec<f64>> = places.iter().map(|q| row(*q)).collect();
    let a = DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]);
    let b = DVector::from_column_slice(differences);
    let Ok(x) = a.clone().svd(true, true).solve(&b, 1e-12) else { return f64::INFINITY };
    (b - a * x).amax()
}

/// What the instrument reads on a machine with the error motions of this axis.
fn shown(
    machine: &Machine,
    readings: &ErrorReadings,
    q: f64,
    approach: f64,
) -> Result<f64, String> {
    let axis = &machine.axes()[readings.axis];
    let mut command = readings.at;
    command[readings.axis] = q;
    let mut from = [0.0; 6];
    from[readings.axis] = approach;
    let all = machine.errors_at(&command, &from).map_err(|fault| fault.to_string())?;
    let mut errors = ErrorValues::default();
    for component in Component::ALL {
        let index = ErrorIndex { component, ..readings.index };
        errors.set(index, all.get(index));
    }
    let (actual, nominal) = match readings.stands_on {
        Reference::Workpiece => {
            let pose = |e: &ErrorValues| -> Link { machine.pose(&command, e).relabel() };
            (pose(&errors), pose(&Default::default()))
        }
        Reference::Bed => {
            let pose = |e: &ErrorValues| -> Link { machine.tool_on_bed(&command, e).relabel() };
            (pose(&errors), pose(&Default::default()))
        }
    };
    let component = readings.name.component;
    let direction: Vec3 = directions(machine, readings, q).column(component as usize % 3).into();
    let along = if component.is_rotation() {
        let turn = actual.linear() * nominal.linear().transpose();
        let half =
            [turn[(2, 1)] - turn[(1, 2)], turn[(0, 2)] - turn[(2, 0)], turn[(1, 0)] - turn[(0, 1)]];
        0.5 * Vec3::from(half).dot(&direction)
    } else {
        let moved = actual.linear() * readings.optics_mm + actual.shift_mm()
            - nominal.linear() * readings.optics_mm
            - nominal.shift_mm();
        moved.dot(&direction)
    };
    let own = match role(axis, component) {
        Role::Positioning => axis.sense * side(machine, readings.index),
        _ => 1.0,
    };
    Ok(if readings.of_workpiece { -own * along } else { own * along })
}
