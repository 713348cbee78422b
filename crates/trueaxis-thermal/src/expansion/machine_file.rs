//! The machine file with the scale that was found: its error table, its coefficient, its sensor.
//!
//! All other lines stay as they are. The new file is read back and must give the runs again at the
//! temperatures at which they were measured.

use super::{Expansion, GeometricTable, Runs};
use std::fmt::Write as _;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisKind, Command, Travel, iso_841_direction};
use trueaxis_machine::describe::axis_index;
use trueaxis_machine::describe::lines::Lines;
use trueaxis_machine::describe::replacement::{
    Entry, NewTables, machine_of_text, measured_and_closed, plain, put, quoted, take_out_of_table,
};
use trueaxis_machine::errors::{Component, ErrorKind, ErrorName, Measurement};
use trueaxis_machine::file::Tables;
use trueaxis_machine::heat::Conditions;
use trueaxis_machine::models::{Model, Shape};

/// What rounding in the file may change, mm.
const ROUNDING_MM: f64 = 1e-6;
/// A scale may end a little before the travel does: more than this share beyond it is another axis or unit.
const BEYOND_SHARE: f64 = 0.05;

/// A machine file with the tables that it names.
#[derive(Debug, Clone, PartialEq)]
pub struct ScaleFiles {
    /// The machine file.
    pub text: String,
    /// Name and text of every table that it names, new and old.
    pub tables: Vec<(String, String)>,
    /// The files of solid models that it names; they are not among the tables.
    pub models: Vec<String>,
    /// The greatest difference between a run and what the new machine shows at its temperature, each from
    /// its own mean, mm.
    pub worst_mm: f64,
}

/// Puts the scale that was found into the text of a machine file.
///
/// # Errors
/// In words, why it cannot be.
pub fn scale_files(
    data: &Runs,
    found: &Expansion,
    table: &GeometricTable,
    old: &str,
    beside: &dyn Tables,
) -> Result<ScaleFiles, String> {
    let machine = machine_of_text(old, beside)?;
    let letter = data.scale.axis.as_deref().unwrap_or_default();
    let index = axis_index(&machine, letter).ok_or_else(|| {
        format!("it has no axis `{letter}` (its chain: {})", machine.chain_text())
    })?;
    let axis = &machine.axes()[index];
    let name = positioning_error(axis)?;
    check_travel(axis, table)?;

    let mut file = Lines::of(old);
    let mut tables = Vec::new();
    let origin = origin(data);
    let header = format!("motion.{}", axis.name);
    // How the old table was continued outside goes away with it.
    let outside = file.key(&header, "outside").and_then(|at| file.value(at).map(str::to_owned));
    take_out_of_table(&mut file, name, &origin, &mut tables, beside);
    let csv = format!("{}-scale.csv", axis.name);
    tables.push((csv.clone(), table_text(data, table, name, axis.sense)));
    let mut entry = format!("{{ table = \"{csv}\", interpolation = \"not-a-knot\"");
    if let Some(outside) = outside.filter(|_| file.key(&header, "outside").is_none()) {
        let _ = write!(entry, ", outside = {outside}");
    }
    entry += &measured_and_closed(&measured(data, table));
    put(&mut file, name, &Entry::Value(entry), &origin);
    put_scale(&mut file, &machine, index, (data, found, table), &origin);

    let text = file.text();
    let seen = NewTables::of(&tables, beside);
    let read = machine_of_text(&text, &seen)?;
    let tables = seen.read();
    let worst_mm = check(&read, index, data, found)?;
    let model = |m: &Model| match &m.shape {
        Shape::Stl { path, .. } => Some(path.clone()),
        _ => None,
    };
    let models = read.models().iter().filter_map(model).collect();
    Ok(ScaleFiles { text, tables, models, worst_mm })
}

/// EXX of an axis along X.
fn positioning_error(axis: &Axis) -> Result<ErrorName, String> {
    let along = iso_841_direction(axis.name);
    if (axis.direction - along).norm() > 1e-9 {
        return Err(format!(
            "{} does not move along a machine axis: its positioning error has parts in several \
             directions, write them by hand",
            axis.name
        ));
    }
    let letter = [Component::X, Component::Y, Component::Z]
        .into_iter()
        .find(|c| along[*c as usize] == 1.0 && axis.kind == AxisKind::Linear)
        .ok_or_else(|| format!("{} is no linear axis", axis.name))?;
    Ok(ErrorName { kind: ErrorKind::Motion, component: letter, body: axis.name })
}

/// Positions far outside the travel belong to another axis or are in another unit.
fn check_travel(axis: &Axis, table: &GeometricTable) -> Result<(), String> {
    let Travel::Between(low, high) = axis.travel else { return Ok(()) };
    let beyond = BEYOND_SHARE * (high - low);
    let outside = |p: &&f64| **p < low - beyond || **p > high + beyond;
    match table.positions_mm.iter().find(outside) {
        None => Ok(()),
        Some(p) => Err(format!(
            "the laser runs go to {p} mm, the travel of {} is {low} to {high} mm: is it another axis, or \
             another unit?",
            axis.name
        )),
    }
}

fn origin(data: &Runs) -> String {
    let one_line = |text: &str| text.replace(['\n', '\r'], " ");
    let date = data.scale.date.as_deref().map(|d| format!(", {}", one_line(d)));
    format!(
        "from {} laser runs ({}{})",
        data.runs.len(),
        one_line(&data.name),
        date.unwrap_or_default()
    )
}

fn measured(data: &Runs, table: &GeometricTable) -> Measurement {
    Measurement {
        instrument: data.laser.instrument.clone(),
        date: data.scale.date.clone(),
        // As `table_temperature` of the scale: two that differ in the last digit would be refused.
        temperature_celsius: plain(table.reference_celsius).parse().ok(),
    }
}

/// The table in the sign of the machine file: the error of the *body*, not of the command.
fn table_text(data: &Runs, table: &GeometricTable, name: ErrorName, sense: f64) -> String {
    let mut text =
        format!("# {name} {}\n# at {} degC", origin(data), plain(table.reference_celsius));
    if sense < 0.0 {
        text += "; sign changed: the body moves against its command";
    }
    let _ = writeln!(text, "\nposition_mm,{name}_um,u_{name}_um");
    for ((p, e), u) in table.positions_mm.iter().zip(&table.errors_mm).zip(&table.u_mm) {
        // Writing into a text cannot fail.
        let _ = writeln!(text, "{p},{},{}", plain(sense * e * 1e3), plain(u * 1e3));
    }
    text
}

/// The section of the scale: its coefficient is replaced, what it says of sensors stays.
fn put_scale(
    file: &mut Lines,
    machine: &Machine,
    index: usize,
    (data, found, table): (&Runs, &Expansion, &GeometricTable),
    origin: &str,
) {
    let axis = &machine.axes()[index];
    let header = format!("scale.{}", axis.name);
    let mut set = |key: &str, value: &str, is_new: bool| match file.key(&header, key) {
        Some(at) => {
            file.set_value(at, value);
        }
        None if is_new => file.add(&header, &format!("{key} = {value} # {origin}")),
        None => {}
    };
    let (alpha, u) = (plain(found.per_k * 1e6), plain(found.u_per_k * 1e6));
    set("expansion", &format!("\"{alpha} ± {u} um/(m K)\""), true);
    let scale = machine.heat().scales.iter().find(|s| s.axis == index);
    let fixed_mm = data.scale.fixed_mm.or(scale.map(|s| s.anchor.fixed_mm));
    let fixed_mm = fixed_mm.unwrap_or(0.0);
    set("fixed_point", &format!("\"{fixed_mm} mm\""), true);
    set("table_temperature", &format!("\"{} degC\"", plain(table.reference_celsius)), false);
    let is_heated = scale.is_some_and(|s| s.heated.is_some());
    let usual = format!("scale_{}", axis.name).to_lowercase();
    let sensor = data.scale.sensor.clone();
    if !is_heated && (scale.is_none() || sensor.is_some()) {
        let sensor = sensor.unwrap_or(usual);
        set("sensors", &format!("{{ {} = \"{fixed_mm} mm\" }}", quoted(&sensor)), true);
    }
}

/// The new machine shows each run at its temperature: to rounding what the model says, and the greatest
/// difference from the run.
fn check(machine: &Machine, index: usize, data: &Runs, found: &Expansion) -> Result<f64, String> {
    let scale = machine.heat().scales.iter().find(|s| s.axis == index);
    let scale = scale.ok_or("the scale would not be read")?;
    if (scale.expansion_per_k.value - found.per_k).abs() > 1e-12 {
        return Err("the coefficient would be read as another value".to_owned());
    }
    if scale.heated.is_some() {
        // Its field needs more temperatures than a run has.
        return Ok(found.residual_mm);
    }
    let mut worst_mm: f64 = 0.0;
    for run in &data.runs {
        let conditions = scale.sensors.iter().fold(Conditions::default(), |c, sensor| {
            c.with_reading(&sensor.name, run.celsius.value)
        });
        let warm = machine.at(&conditions, &mut Diagnostics::new());
        let warm = warm.ok_or("the machine has no errors at the temperature of a run")?;
        let shown = data.positions_mm.iter().map(|p| shown_mm(&warm, index, *p));
        let shown = shown.collect::<Option<Vec<f64>>>();
        let shown = shown.ok_or("the new table does not reach over all positions of the runs")?;
        let left: Vec<f64> = shown.iter().zip(&run.errors_mm).map(|(s, e)| s - e).collect();
        let mean = left.iter().sum::<f64>() / left.len() as f64;
        worst_mm = left.iter().map(|d| (d - mean).abs()).fold(worst_mm, f64::max);
    }
    // The model leaves `residual`; a table that is read in another way leaves more.
    let count = (data.runs.len() * data.positions_mm.len()) as f64;
    match worst_mm <= found.residual_mm * count.sqrt() + ROUNDING_MM {
        true => Ok(worst_mm),
        false => Err(format!("the runs would be read back with {:.3} µm", worst_mm * 1e3)),
    }
}

/// What a laser reads along the axis.
fn shown_mm(machine: &Machine, index: usize, position_mm: f64) -> Option<f64> {
    let axis = &machine.axes()[index];
    let component = [0, 1, 2].into_iter().find(|i| axis.direction[*i] != 0.0)?;
    let errors = machine.errors_at(&only(index, position_mm), &Default::default()).ok()?;
    let name = ErrorName {
        kind: ErrorKind::Motion,
        component: Component::ALL[component],
        body: axis.name,
    };
    Some(axis.sense * errors.get(machine.error_index(name)?))
}

fn only(index: usize, position_mm: f64) -> Command {
    let mut command = Command::default();
    command[index] = position_mm;
    command
}
