//! Many positions: a CSV table in, a CSV table or one document out.

use crate::arguments;
use crate::output::{Answer, Format};
use std::path::Path;
use trueaxis::input::{CsvTable, Diagnostics};
use trueaxis::machine::axis::{Approach, Command};
use trueaxis::machine::{Deviation, Machine};
use trueaxis::report::numbers::exact;
use trueaxis::report::{PoseReport, array, pose_rows_json};

const COLUMNS: [&str; 12] = [
    "tip_x_mm",
    "tip_y_mm",
    "tip_z_mm",
    "axis_i",
    "axis_j",
    "axis_k",
    "dev_x_um",
    "dev_y_um",
    "dev_z_um",
    "dev_i_urad",
    "dev_j_urad",
    "dev_k_urad",
];

pub fn answer(
    machine: &Machine,
    path: &Path,
    approach: &Approach,
    format: Format,
    problems: &mut Diagnostics,
) -> Option<Answer> {
    let table = arguments::table(path, "a CSV table of axis positions", problems)?;
    let columns = axis_columns(machine, &table, problems);
    if problems.has_errors() {
        return None;
    }
    let commands: Vec<Command> =
        (0..table.rows()).map(|row| command(machine, &table, &columns, row)).collect();
    warn_beyond_travel(machine, &table, &commands, problems);
    // Every row is tried, so that all rows with problems are reported at once.
    let mut rows = Vec::with_capacity(commands.len());
    for (row, command) in commands.iter().enumerate() {
        let place = table.row_place(row);
        let found = PoseReport::at(machine, command, approach, &place, problems);
        rows.extend(found.map(|found| numbers(&table, row, &found.deviation)));
    }
    let names: Vec<&str> = table.columns.iter().map(|c| c.name.as_str()).chain(COLUMNS).collect();
    Some(match format {
        Format::Json => Answer::Json(pose_rows_json(&names, &rows)),
        Format::Text => Answer::Text(csv(&names, &rows)),
    })
}

fn axis_columns(machine: &Machine, table: &CsvTable, problems: &mut Diagnostics) -> Vec<usize> {
    let mut columns = Vec::new();
    for column in &table.columns {
        match arguments::axis_index(machine, &column.name) {
            Some(axis) => columns.push(axis),
            None => {
                let message = format!("the machine has no axis `{}`", column.name);
                let hint = "name each column by an axis of the machine, mm and degrees";
                problems.error("unknown-axis", column.place.clone(), message, hint);
            }
        }
    }
    columns
}

fn command(machine: &Machine, table: &CsvTable, columns: &[usize], row: usize) -> Command {
    let mut command = Command::default();
    for (column, &axis) in table.columns.iter().zip(columns) {
        command[axis] = arguments::to_inner(machine, axis, column.values[row]);
    }
    command
}

/// One warning for each axis, at the first row that it concerns.
fn warn_beyond_travel(
    machine: &Machine,
    table: &CsvTable,
    commands: &[Command],
    problems: &mut Diagnostics,
) {
    for (index, axis) in machine.axes().iter().enumerate() {
        let beyond = |c: &Command| !axis.travel.contains(c[index]);
        let Some(first) = commands.iter().position(beyond) else { continue };
        let count = commands.iter().filter(|c| beyond(c)).count();
        let rows = commands.len();
        let message = format!("{} stands outside its travel in {count} of {rows} rows", axis.name);
        let hint = "the machine cannot go there; this is the first such row";
        problems.warn("outside-travel", table.row_place(first), message, hint);
    }
}

fn numbers(table: &CsvTable, row: usize, d: &Deviation) -> Vec<f64> {
    let given = table.columns.iter().map(|c| c.values[row] + 0.0);
    let vectors =
        [d.nominal_tip.vector(), d.nominal_axis.vector(), d.tip_mm * 1e3, d.axis * 1e6].map(array);
    given.chain(vectors.into_iter().flatten()).collect()
}

fn csv(names: &[&str], rows: &[Vec<f64>]) -> String {
    let mut csv = names.join(",") + "\n";
    for row in rows {
        let fields: Vec<String> = row.iter().map(|x| exact(*x)).collect();
        csv += &(fields.join(",") + "\n");
    }
    csv
}
