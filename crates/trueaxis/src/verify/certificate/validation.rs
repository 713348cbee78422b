//! The readings before and after the compensation, on poses that the identification has not used.

use super::file::{Circumstances, above_zero, read_circumstances};
use super::inputs::Inputs;
use super::used::{UsedPose, read_at, twin};
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Place, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Axis, Command};
use trueaxis_machine::twist::Reference;
use trueaxis_measure::instruments::instrument::Instrument;
use trueaxis_measure::measure::{Kind, Readings, without_copies};

/// Commands that differ by less are the same row of both tables, mm and rad.
const SAME: f64 = 1e-9;

/// The readings that prove the compensation.
#[derive(Debug, Clone, PartialEq)]
pub struct Validation {
    /// Who measured when with what.
    pub circumstances: Circumstances,
    /// Where the instrument was set to zero; without it deviations are from the workpiece frame itself.
    pub zero: Option<Command>,
    /// Standard uncertainty of one coordinate of one reading, mm.
    pub u_mm: f64,
    /// The poses.
    pub poses: Vec<MeasuredValue>,
}

/// One pose that was measured twice.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredValue {
    /// What was programmed, mm and rad.
    pub command: Command,
    /// From which side each axis came.
    pub approach: Approach,
    /// Actual less programmed tip in the workpiece frame without the compensation, mm.
    pub before_mm: Vec3,
    /// The same with it.
    pub after_mm: Vec3,
    /// Where the second reading stands.
    pub place: Place,
}

/// The poses that a validation may use.
pub struct AllowedPoses<'a> {
    /// Not these.
    pub used: &'a [UsedPose],
    /// Between the ends of these axes.
    pub zone: &'a [Axis],
}

/// Reads `[validation]`.
pub fn read_validation(
    section: &Section<'_>,
    machine: &Machine,
    allowed: &AllowedPoses<'_>,
    inputs: &mut Inputs,
) -> Option<Validation> {
    let circumstances = read_circumstances(section);
    let zero = match section.get("zero") {
        Some(item) => Some(read_at(section, &item, machine)?),
        None => None,
    };
    let hint =
        "u = \"1 um\": standard uncertainty of one coordinate of one reading, calibration included";
    let u_mm = section.require("u", hint).and_then(|item| above_zero(&item, Dimension::Length));
    let columns = "a table of the axes and x_um, y_um, z_um: actual less programmed tip";
    let [before, after] = ["before", "after"].map(|key| section.require(key, columns));
    let mut read = |item: Option<trueaxis_input::Item<'_>>, role| {
        let item = item?;
        let mut problems = Diagnostics::new();
        let rows = rows(item.text()?, role, machine, inputs, &mut problems);
        let failed = problems.has_errors();
        section.take_over(problems);
        rows.filter(|_| !failed)
    };
    let before = read(before, "readings before the compensation");
    let after = read(after, "readings after the compensation");
    let mut problems = Diagnostics::new();
    let poses = pairs(before?, after?, &mut problems);
    for pose in &poses {
        check_unused(machine, allowed.used, pose, &mut problems);
        check_zone(allowed.zone, pose, &mut problems);
    }
    let failed = problems.has_errors();
    section.take_over(problems);
    if failed {
        return None;
    }
    Some(Validation { circumstances: circumstances?, zero, u_mm: u_mm?, poses })
}

/// The rows of one table.
struct Rows {
    readings: Readings,
    deviations_mm: Vec<Vec3>,
    file: String,
}

impl Rows {
    fn place(&self, row: usize) -> Place {
        Place { line: self.readings.lines[row] as usize, ..Place::whole(&self.file) }
    }
}

fn rows(
    name: &str,
    role: &'static str,
    machine: &Machine,
    inputs: &mut Inputs,
    problems: &mut Diagnostics,
) -> Option<Rows> {
    let (path, text) = inputs.text(role, name, problems)?;
    let table = CsvTable::parse(&path.display().to_string(), &text, problems);
    if problems.has_errors() {
        return None;
    }
    if table.rows() == 0 {
        let message = "the table has headings, but no row".to_owned();
        let hint = "one row for each pose of the validation";
        problems.error("empty-table", Place::whole(&table.file), message, hint);
        return None;
    }
    let place = tip_in_workpiece(machine);
    let readings = Readings::parse(&table, machine, &place, 0, problems)?;
    readings.judge(&table, (machine, &place), &inputs.limits, problems);
    let readings = without_copies(&readings, &table, problems);
    let deviation = |i: usize| {
        let read = Vec3::from(readings.values[i]);
        read - Vec3::from(place.nominal_reading(machine, &readings.commands[i], Vec3::x()))
    };
    let deviations_mm = (0..readings.len()).map(deviation).collect();
    Some(Rows { readings, deviations_mm, file: table.file })
}

/// An instrument that reads the position of the tip in the workpiece frame.
fn tip_in_workpiece(machine: &Machine) -> Instrument {
    Instrument {
        name: "tip".to_owned(),
        kind: Kind::CutPiece,
        sight: Kind::CutPiece.sight(),
        reference: Reference::Workpiece,
        tool_point_mm: machine.tip_mm(),
        reference_point_mm: Vec3::zeros(),
        direction: Vec3::x(),
        length_mm: 0.0,
        // Not known here: readings are judged by their size alone.
        noise: [0.0; 3],
        unknowns: Vec::new(),
        material: None,
        reads: Default::default(),
        assumed: Default::default(),
        drift: Default::default(),
    }
}

fn is_same(a: &Readings, i: usize, b: &Readings, k: usize) -> bool {
    let near = |a: &[f64; 6], b: &[f64; 6]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME);
    near(&a.commands[i], &b.commands[k]) && near(&a.approaches[i], &b.approaches[k])
}

/// Every pose of one table with that of the other.
fn pairs(before: Rows, after: Rows, problems: &mut Diagnostics) -> Vec<MeasuredValue> {
    let hint = "measure the same poses before and after, each once";
    let mut poses = Vec::new();
    let mut taken = vec![false; before.readings.len()];
    for i in 0..after.readings.len() {
        let place = after.place(i);
        let partner = (0..taken.len())
            .find(|k| !taken[*k] && is_same(&after.readings, i, &before.readings, *k));
        let Some(k) = partner else {
            let message = format!("this pose is not (again) among those of {}", before.file);
            problems.error("unpaired-pose", place, message, hint);
            continue;
        };
        taken[k] = true;
        poses.push(MeasuredValue {
            command: after.readings.commands[i],
            approach: after.readings.approaches[i],
            before_mm: before.deviations_mm[k],
            after_mm: after.deviations_mm[i],
            place,
        });
    }
    for k in (0..taken.len()).filter(|k| !taken[*k]) {
        let message = format!("this pose is not among those of {}", after.file);
        problems.error("unpaired-pose", before.place(k), message, hint);
    }
    poses
}

fn check_unused(
    machine: &Machine,
    used: &[UsedPose],
    pose: &MeasuredValue,
    problems: &mut Diagnostics,
) {
    let Some(twin) = twin(machine, used, &pose.command) else { return };
    let message = format!(
        "this pose was used for the identification ({}:{}): nearer than 1 mm and 0.1 deg in all axes",
        twin.place.file, twin.place.line
    );
    let hint = "a validation uses poses that the identification has not used: leave it out";
    problems.error("used-pose", pose.place.clone(), message, hint);
}

fn check_zone(zone: &[Axis], pose: &MeasuredValue, problems: &mut Diagnostics) {
    let outside = zone.iter().zip(&pose.command).filter(|(axis, q)| !axis.travel.contains(**q));
    let names: Vec<String> = outside.map(|(axis, _)| axis.name.to_string()).collect();
    if !names.is_empty() {
        let message = format!("{} is outside the zone of the certificate", names.join(" "));
        let hint = "the zone is the travel of the axes, or as stated in [zone]";
        problems.error("outside-zone", pose.place.clone(), message, hint);
    }
}
