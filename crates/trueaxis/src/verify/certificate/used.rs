//! Poses that the identification has used: a validation on them would prove nothing.

use super::inputs::Inputs;
use trueaxis_input::{CsvTable, Diagnostics, Item, Place, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::describe::{axis_index, command, to_inner};

/// Poses nearer than this in all axes are the same: mm.
const SAME_MM: f64 = 1.0;
/// The same of rotary axes, rad.
const SAME_RAD: f64 = 0.1 * std::f64::consts::PI / 180.0;

/// A pose that was used, and its place in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct UsedPose {
    /// The command.
    pub command: Command,
    /// File and line.
    pub place: Place,
}

/// The used pose that coincides with a pose.
pub fn twin<'u>(machine: &Machine, used: &'u [UsedPose], pose: &Command) -> Option<&'u UsedPose> {
    let same = |used: &&UsedPose| {
        machine.axes().iter().enumerate().all(|(i, axis)| {
            let near = if axis.kind == AxisKind::Linear { SAME_MM } else { SAME_RAD };
            (used.command[i] - pose[i]).abs() < near
        })
    };
    used.iter().find(same)
}

/// Reads `used`: tables of poses, headed by the letters of the axes (mm, deg); or
/// `{ table = "X.csv", axis = "X", at = "Y=.. Z=.." }`: positions of one axis in the first column, the
/// others standing still.
pub fn read_used(
    section: &Section<'_>,
    machine: &Machine,
    inputs: &mut Inputs,
) -> Option<Vec<UsedPose>> {
    let mut all = Vec::new();
    let Some(item) = section.get("used") else { return Some(all) };
    for item in item.list()? {
        let read = match item.is_table() {
            true => item.section("determination.used", |s| read_line(s, machine, inputs))?,
            false => read_table(section, &item, machine, inputs),
        };
        all.extend(read?);
    }
    Some(all)
}

fn read_line(
    section: &Section<'_>,
    machine: &Machine,
    inputs: &mut Inputs,
) -> Option<Vec<UsedPose>> {
    let table =
        section.require("table", "table = \"X.csv\": a table whose first column is positions");
    let axis = section.require("axis", "axis = \"X\": the axis that moved")?;
    let start = match section.get("at") {
        Some(item) => read_at(section, &item, machine)?,
        None => Command::default(),
    };
    let index = axis_index(machine, axis.text()?);
    if index.is_none() {
        let hint = format!("the chain of the machine: {}", machine.chain_text());
        axis.error("unknown-axis", "the machine has no such axis".to_owned(), &hint);
    }
    let (name, index) = (table?.text()?, index?);
    let table = csv(section, name, inputs)?;
    let positions = &table.columns.first()?.values;
    let pose = |(row, q): (usize, &f64)| {
        let mut command = start;
        command[index] = to_inner(machine, index, *q);
        UsedPose { command, place: table.row_place(row) }
    };
    Some(positions.iter().enumerate().map(pose).collect())
}

fn read_table(
    section: &Section<'_>,
    item: &Item<'_>,
    machine: &Machine,
    inputs: &mut Inputs,
) -> Option<Vec<UsedPose>> {
    let name = item.text()?;
    let table = csv(section, name, inputs)?;
    let axes: Vec<(usize, &[f64])> = table
        .columns
        .iter()
        .filter_map(|c| Some((axis_index(machine, &c.name)?, &c.values[..])))
        .collect();
    if axes.is_empty() {
        let message = format!("{name} has no column of an axis");
        let hint = "head them by letters: X,Y,Z (mm), A (deg); or { table, axis, at }";
        item.error("missing-column", message, hint);
        return None;
    }
    let pose = |row: usize| {
        let mut command = Command::default();
        axes.iter().for_each(|(i, values)| command[*i] = to_inner(machine, *i, values[row]));
        UsedPose { command, place: table.row_place(row) }
    };
    Some((0..table.rows()).map(pose).collect())
}

fn csv(section: &Section<'_>, name: &str, inputs: &mut Inputs) -> Option<CsvTable> {
    let mut problems = Diagnostics::new();
    let text = inputs.text("poses of the identification", name, &mut problems);
    let table =
        text.map(|(path, text)| CsvTable::parse(&path.display().to_string(), &text, &mut problems));
    let failed = problems.has_errors();
    section.take_over(problems);
    table.filter(|_| !failed)
}

/// Reads `"X=3100 Y=1250 C=0"`, mm and degrees; axes that are not named stand at 0.
pub fn read_at(section: &Section<'_>, item: &Item<'_>, machine: &Machine) -> Option<Command> {
    let mut positions = Vec::new();
    for word in item.text()?.split_whitespace() {
        let pair = word.split_once('=');
        let Some(pair) = pair.and_then(|(axis, q)| Some((axis, q.parse::<f64>().ok()?))) else {
            let message = format!("`{word}` is not an axis, =, and a number");
            item.error("bad-position", message, "\"X=3100 Y=1250 C=0\", mm and degrees");
            return None;
        };
        positions.push(pair);
    }
    let mut problems = Diagnostics::new();
    let command = command(machine, positions, &item.place(), &mut problems);
    section.take_over(problems);
    command
}
