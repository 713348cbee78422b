//! The tool at each position of a table: computed in blocks, once to see whether all of it can be, and again while it is written, so that a
//! table of millions of rows needs little more memory than its own numbers.

use crate::POSE_COLUMNS;
use serde_json::{Map, Value, json};
use std::io::{self, Write};
use trueaxis_input::CsvTable;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::batch::{BatchError, Commands, CompiledMachine, DeviationTable};
use trueaxis_machine::describe::{axis_index, to_inner};
use trueaxis_report::numbers::push_exact;

/// Rows of a block.
const BLOCK: usize = 4096;
/// Blocks that are made ready at once, by all threads.
const AHEAD: usize = 8;

/// Positions of a table, and the machine that takes them.
#[derive(Debug)]
pub struct PoseTable {
    machine: CompiledMachine,
    approach: Approach,
    table: CsvTable,
    /// The axis of each column.
    axes: Vec<usize>,
    /// A row that is not believed, under its number.
    conspicuous: Map<String, Value>,
}

impl PoseTable {
    /// Of a table whose columns are axes of the machine.
    pub fn new(machine: &Machine, approach: Approach, table: CsvTable) -> Self {
        let axes = table.columns.iter().filter_map(|c| axis_index(machine, &c.name)).collect();
        let machine = CompiledMachine::new(machine);
        Self { machine, approach, table, axes, conspicuous: Map::new() }
    }

    /// The table as it was read.
    pub fn table(&self) -> &CsvTable {
        &self.table
    }

    /// The machine.
    pub fn machine(&self) -> &Machine {
        self.machine.machine()
    }

    /// Where the axes stand in a row.
    pub fn command(&self, row: usize) -> Command {
        let mut command = Command::default();
        for (column, axis) in self.table.columns.iter().zip(&self.axes) {
            command[*axis] = to_inner(self.machine(), *axis, column.values[row]);
        }
        command
    }

    /// Whether the machine has a pose in every row; keeps the first row for which `is` holds of a number and its heading.
    pub fn examine(&mut self, is: impl Fn(&str, f64) -> bool + Sync) -> bool {
        use rayon::prelude::*;
        let names = self.names();
        let examined = |rows: [usize; 2]| {
            let found = self.block(rows).ok()?;
            let (mut row, mut first) = (rows[0], None);
            self.each_row(&found, row, |numbers| {
                if first.is_none() && names.iter().zip(numbers).any(|(n, x)| is(n, *x)) {
                    let entries = names.iter().cloned().zip(numbers.iter().map(|x| json!(x)));
                    first = Some((row.to_string(), Value::Object(entries.collect())));
                }
                row += 1;
            });
            Some(first)
        };
        let all: Option<Vec<_>> = self.blocks().into_par_iter().map(examined).collect();
        self.conspicuous = all.iter().flatten().flatten().next().cloned().into_iter().collect();
        all.is_some()
    }

    /// The row that was kept, as an object under its number; empty if none was.
    pub fn conspicuous(&self) -> Map<String, Value> {
        self.conspicuous.clone()
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
    pub fn names(&self) -> Vec<String> {
        let given = self.table.columns.iter().map(|c| c.name.clone());
        given.chain(POSE_COLUMNS.map(Into::into)).collect()
    }

    /// The numbers of each row of a block that begins at a row, in the order of the headings.
    fn each_row(&self, found: &DeviationTable, from: usize, mut with: impl FnMut(&[f64])) {
        let mut numbers = Vec::with_capacity(self.axes.len() + POSE_COLUMNS.len());
        for k in 0..found.len() {
            let (d, row) = (found.at(k), from + k);
            let (tip, axis) = (d.nominal_tip.vector(), d.nominal_axis.vector());
            numbers.clear();
            numbers.extend(self.table.columns.iter().map(|c| c.values[row] + 0.0));
            for vector in [tip, axis, d.tip_mm * 1e3, d.axis * 1e6] {
                numbers.extend(vector.iter().map(|x| x + 0.0));
            }
            with(&numbers);
        }
    }

    /// Writes all rows by their `text`, block after block in order; while some are written, the next are made ready.
    fn write_blocks(
        &self,
        out: &mut dyn Write,
        text: impl Fn(&DeviationTable, usize) -> Vec<u8> + Sync,
    ) -> io::Result<()> {
        use rayon::prelude::*;
        let blocks = self.blocks();
        let ready = |some: &[[usize; 2]]| -> Vec<Vec<u8>> {
            // Every row was computed before.
            let computed = |rows: &[usize; 2]| Some(text(&self.block(*rows).ok()?, rows[0]));
            some.par_iter().filter_map(computed).collect()
        };
        let mut texts: Vec<Vec<u8>> = Vec::new();
        // After the last some only what is ready is written.
        for some in blocks.chunks(AHEAD).chain([&[][..]]) {
            let mut next = Vec::new();
            rayon::in_place_scope(|scope| {
                scope.spawn(|_| next = ready(some));
                texts.iter().try_for_each(|text| out.write_all(text))
            })?;
            texts = next;
        }
        Ok(())
    }

    /// As a CSV table.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", self.names().join(","))?;
        self.write_blocks(out, |found, from| {
            let mut text = String::new();
            self.each_row(found, from, |numbers| {
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
    pub fn write_json_rows(&self, out: &mut dyn Write) -> io::Result<()> {
        let names = self.names();
        let keys: Vec<String> =
            names.iter().map(|n| format!("\n      {}: ", Value::from(n.as_str()))).collect();
        self.write_blocks(out, |found, from| {
            let mut text = Vec::new();
            let is_first = from == 0;
            let mut count = 0;
            self.each_row(found, from, |numbers| {
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
}
