//! The path as a table, written while it comes: CSV. The columns are those of Parquet, too.

use super::summary::{shown, unit};
use super::{Batch, Observer};
use std::fmt::Write as _;
use std::io::{self, Write};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::MAX_AXES;

/// Writes each node as a line: time, block, axes, nominal tool, deviation.
pub struct CsvTable<W: Write> {
    machine: Machine,
    out: W,
    line: String,
    /// The first error of the disk; nothing is written after it.
    pub failed: Option<io::Error>,
}

impl<W: Write> CsvTable<W> {
    /// Writes the headings.
    pub fn new(machine: &Machine, mut out: W) -> Self {
        let failed = out.write_all(format!("{}\n", headings(machine).join(",")).as_bytes()).err();
        Self { machine: machine.clone(), out, line: String::new(), failed }
    }

    /// Writes what is still in the buffer.
    ///
    /// # Errors
    /// The first error of the disk.
    pub fn finish(mut self) -> io::Result<W> {
        match self.failed.take() {
            Some(error) => Err(error),
            None => self.out.flush().map(|()| self.out),
        }
    }
}

/// The columns that hold whole numbers, after the time: program, line, tool, rapid (1 or 0).
pub(super) const WHOLE: [&str; 4] = ["program", "line", "tool", "rapid"];

/// The columns of a pose of the tool: nominal tip and axis, then how far the actual ones are off.
pub const POSE_COLUMNS: [&str; 12] = [
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

/// The columns, each with its unit.
pub fn headings(machine: &Machine) -> Vec<String> {
    let mut columns = vec!["time_s".to_owned()];
    columns.extend(WHOLE.map(Into::into));
    columns.push("speed_mm_per_min".to_owned());
    let axes = machine.axes().iter().enumerate();
    columns.extend(axes.map(|(i, a)| format!("{}_{}", a.name, unit(machine, i))));
    columns.extend(POSE_COLUMNS.map(Into::into));
    columns.extend(["dev_feed_um", "dev_normal_um", "dev_binormal_um"].map(Into::into));
    columns
}

/// One node: the columns [`WHOLE`], and all others in their order.
pub(super) struct Row {
    pub whole: [u32; WHOLE.len()],
    numbers: [f64; 2 + MAX_AXES + 15],
    count: usize,
}

impl Row {
    /// The row of a node.
    pub fn of(machine: &Machine, batch: &Batch<'_>, i: usize) -> Self {
        let (node, stamp, deviation) = (&batch.nodes[i], &batch.stamps[i], batch.deviation(i));
        let rapid = u32::from(node.is_rapid());
        let whole = [node.origin.program, node.origin.line, batch.tool, rapid];
        let mut row = Self { whole, numbers: [0.0; 2 + MAX_AXES + 15], count: 0 };
        row.add([stamp.time_s, stamp.speed * 60.0]);
        let axes = node.command.iter().take(machine.axes().len()).enumerate();
        row.add(axes.map(|(axis, q)| shown(machine, axis, *q)));
        row.add(deviation.nominal_tip.vector().iter().copied());
        row.add(deviation.nominal_axis.vector().iter().copied());
        row.add(deviation.tip_mm.iter().map(|v| v * 1e3));
        row.add(deviation.axis.iter().map(|v| v * 1e6));
        row.add(batch.along_path_mm[i].iter().map(|v| v * 1e3));
        row
    }

    fn add(&mut self, values: impl IntoIterator<Item = f64>) {
        for value in values {
            self.numbers[self.count] = value;
            self.count += 1;
        }
    }

    /// Time, speed, axes, tip, axis of the tool, deviations.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
}

impl<W: Write> Observer for CsvTable<W> {
    fn path(&mut self, batch: &Batch<'_>) {
        if self.failed.is_some() {
            return;
        }
        for i in 0..batch.nodes.len() {
            let row = Row::of(&self.machine, batch, i);
            self.line.clear();
            let [program, line, tool, rapid] = row.whole;
            // Writing into a text cannot fail.
            let _ = write!(self.line, "{},{program},{line},{tool},{rapid}", row.numbers()[0]);
            for value in &row.numbers()[1..] {
                let _ = write!(self.line, ",{value}");
            }
            self.line.push('\n');
            if let Err(error) = self.out.write_all(self.line.as_bytes()) {
                self.failed = Some(error);
                return;
            }
        }
    }
}
