//! The path as a table, written while it comes: CSV.

use super::summary::{shown, unit};
use super::{Batch, Observer};
use std::fmt::Write as _;
use std::io::{self, Write};
use trueaxis_machine::Machine;

/// Writes each node as a line: time, block, axes, nominal tool, deviation.
pub struct CsvTable<W: Write> {
    machine: Machine,
    out: W,
    line: String,
    /// The first error of the disk; nothing is written behind it.
    pub failed: Option<io::Error>,
}

impl<W: Write> CsvTable<W> {
    /// Writes the headings.
    pub fn new(machine: &Machine, mut out: W) -> Self {
        let failed = out.write_all(format!("{}\n", headings(machine).join(",")).as_bytes()).err();
        Self { machine: machine.clone(), out, line: String::new(), failed }
    }

    /// Writes what is still on its way.
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

/// The columns, each with its unit.
pub fn headings(machine: &Machine) -> Vec<String> {
    let mut columns: Vec<String> =
        ["time_s", "program", "line", "tool", "rapid", "speed_mm_per_min"].map(Into::into).into();
    let axes = machine.axes().iter().enumerate();
    columns.extend(axes.map(|(i, a)| format!("{}_{}", a.name, unit(machine, i))));
    let fixed = [
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
        "dev_feed_um",
        "dev_normal_um",
        "dev_binormal_um",
    ];
    columns.extend(fixed.map(Into::into));
    columns
}

impl<W: Write> Observer for CsvTable<W> {
    fn path(&mut self, batch: &Batch<'_>) {
        if self.failed.is_some() {
            return;
        }
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            let deviation = batch.deviation(i);
            self.line.clear();
            // Writing into a text cannot fail.
            let _ = write!(
                self.line,
                "{},{},{},{},{},{}",
                stamp.time_s,
                node.origin.program,
                node.origin.line,
                batch.tool,
                u8::from(node.is_rapid()),
                stamp.speed * 60.0
            );
            for (axis, q) in node.command[..self.machine.axes().len()].iter().enumerate() {
                let _ = write!(self.line, ",{}", shown(&self.machine, axis, *q));
            }
            let tip = deviation.nominal_tip.vector();
            let axis = deviation.nominal_axis.vector();
            for value in tip.iter().chain(axis.iter()) {
                let _ = write!(self.line, ",{value}");
            }
            let along = &batch.along_path_mm[i];
            let (off, turn) = (deviation.tip_mm * 1e3, deviation.axis * 1e6);
            for value in off.iter().chain(turn.iter()) {
                let _ = write!(self.line, ",{value}");
            }
            for value in along.iter() {
                let _ = write!(self.line, ",{}", value * 1e3);
            }
            self.line.push('\n');
            if let Err(error) = self.out.write_all(self.line.as_bytes()) {
                self.failed = Some(error);
                return;
            }
        }
    }
}
