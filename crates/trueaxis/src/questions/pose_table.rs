//! The tool at each position of a table: computed in blocks, once to see whether all of it can be, and again while it is written, so that a
//! table of millions of rows needs little more memory than its own numbers.

use serde_json::{Map, Value, json};
use std::io::{self, Write};
use trueaxis_input::CsvTable;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::batch::{BatchError, Commands, CompiledMachine, DeviationTable};
use trueaxis_machine::describe::{axis_index, to_inner};
use trueaxis_motion::POSE_COLUMNS;
use trueaxis_report::numbers::push_exact;

/// Rows of a block.
const BLOCK: usize = 4096;
/// Blocks that are made ready at once, by all threads.
const AHEAD: usize = 16;

/// Positions of a table, and the machine that takes them.
#[derive(Debug)]
pub struct PoseTable {
    machine: CompiledMachine,
    approach: Approach,
    table: CsvTable,
    /// The axis of each column.
    axes: Vec<usize>,
}

impl PoseTable {
    /// Of a table whose columns are axes of the machine.
    pub(super) fn new(machine: &Machine, approach: Approach, table: CsvTable) -> Self {
        let axes = table.columns.iter().filter_map(|c| axis_index(machine, &c.name)).collect();
        Self { machine: CompiledMachine::new(machine), approach, table, axes }
    }

    /// The table as it was read.
    pub(super) fn table(&self) -> &CsvTable {
        &self.table
    }

    /// The machine.
    pub(super) fn machine(&self) -> &Machine {
        self.machine.machine()
    }

    /// Where the axes stand in a row.
    pub(super) fn command(&self, row: usize) -> Command {
        let mut command = Command::default();
        for (column, axis) in self.table.columns.iter().zip(&self.axes) {
            command[*axis] = to_inner(self.machine(), *axis, column.values[row]);
        }
        command
    }

    /// Whether the machine has a pose in every row.
    pub(super) fn is_sound(&self) -> bool {
        use rayon::prelude::*;
        self.blocks().into_par_iter().all(|rows| self.block(rows).is_ok())
    }

    fn blocks(&self) -> Vec<[usize; 2]> {
        let count = self.table.rows();
        (0..count).step_by(BLOCK).map(|from| [from, (from + BLOCK).min(count)]).collect()
    }

    /// The deviations of some rows.
    fn block(&self, [from, to]: [usize; 2]) -> Result<DeviationTable, BatchError> {
        let machine = self.machine();
        let count = to - from;
        let mut positions = vec![vec![0.0; count]; machine.axes().len()];
        for (column, axis) in self.table.columns.iter().zip(&self.axes) {
            let values = &column.values[from..to];
            let inner = values.iter().map(|v| to_inner(machine, *axis, *v));
            positions[*axis].iter_mut().zip(inner).for_each(|(p, v)| *p = v);
        }
        let sides = self.approach.map(|side| vec![side; count]);
        let positions: Vec<&[f64]> = positions.iter().map(Vec::as_slice).collect();
        let sides: Vec<&[f64]> = sides[..positions.len()].iter().map(Vec::as_slice).collect();
        let mut found = DeviationTable::zeros(count);
        let commands = Commands::new(&positions).approached(&sides);
        self.machine.deviations(&commands, &mut found.columns())?;
        Ok(found)
    }

    /// The headings: the columns of the table, then those of the tool.
    pub(super) fn names(&self) -> Vec<String> {
        let given = self.table.columns.iter().map(|c| c.name.clone());
        given.chain(POSE_COLUMNS.map(Into::into)).collect()
    }

    /// The numbers of each row of a block, in the order of the headings.
    fn each_row(&self, rows: [usize; 2], mut with: impl FnMut(&[f64])) {
        let Ok(found) = self.block(rows) else { return };
        let mut numbers = Vec::with_capacity(self.axes.len() + POSE_COLUMNS.len());
        for (k, row) in (rows[0]..rows[1]).enumerate() {
            let d = found.at(k);
            let (tip, axis) = (d.nominal_tip.vector(), d.nominal_axis.vector());
            numbers.clear();
            numbers.extend(self.table.columns.iter().map(|c| c.values[row] + 0.0));
            for vector in [tip, axis, d.tip_mm * 1e3, d.axis * 1e6] {
                numbers.extend(vector.iter().map(|x| x + 0.0));
            }
            with(&numbers);
        }
    }

    /// Writes all rows by their `text`, block after block in order.
    fn write_blocks(
        &self,
        out: &mut dyn Write,
        text: impl Fn([usize; 2]) -> Vec<u8> + Sync,
    ) -> io::Result<()> {
        use rayon::prelude::*;
        for some in self.blocks().chunks(AHEAD) {
            let texts: Vec<Vec<u8>> = some.par_iter().map(|rows| text(*rows)).collect();
            texts.iter().try_for_each(|text| out.write_all(text))?;
        }
        Ok(())
    }

    /// As a CSV table.
    pub(super) fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", self.names().join(","))?;
        self.write_blocks(out, |rows| {
            let mut text = String::new();
            self.each_row(rows, |numbers| {
                for (i, number) in numbers.iter().enumerate() {
                    if i > 0 {
                        text.push(',');
                    }
                    push_exact(&mut text, *number);
                }
                text.push('\n');
            });
            text.into_bytes()
        })
    }

    /// The rows between the brackets of `"rows": []` of a document, indented as the rest of it.
    pub(super) fn write_json_rows(&self, out: &mut dyn Write) -> io::Result<()> {
        let names = self.names();
        let keys: Vec<String> =
            names.iter().map(|n| format!("\n      {}: ", Value::from(n.as_str()))).collect();
        self.write_blocks(out, |rows| {
            let mut text = Vec::new();
            let is_first = rows[0] == 0;
            let mut count = 0;
            self.each_row(rows, |numbers| {
                text.extend_from_slice(if is_first && count == 0 {
                    b"\n    {"
                } else {
                    b",\n    {"
                });
                count += 1;
                for (i, (key, number)) in keys.iter().zip(numbers).enumerate() {
                    if i > 0 {
                        text.push(b',');
                    }
                    text.extend_from_slice(key.as_bytes());
                    // A vector takes every byte.
                    let _ = serde_json::to_writer(&mut text, number);
                }
                text.extend_from_slice(b"\n    }");
            });
            text
        })?;
        out.write_all(b"\n  ")
    }

    /// The first row for which `is` holds of its numbers, as an object under the number of the row.
    pub(super) fn first_row(&self, is: impl Fn(&str, f64) -> bool + Sync) -> Map<String, Value> {
        use rayon::prelude::*;
        let names = self.names();
        let first = |rows: [usize; 2]| {
            let (mut row, mut found) = (rows[0], None);
            self.each_row(rows, |numbers| {
                if found.is_none() && names.iter().zip(numbers).any(|(n, x)| is(n, *x)) {
                    let entries = names.iter().cloned().zip(numbers.iter().map(|x| json!(x)));
                    found = Some((row.to_string(), Value::Object(entries.collect())));
                }
                row += 1;
            });
            found
        };
        let found = self.blocks().into_par_iter().find_map_first(first);
        found.into_iter().collect()
    }
}
