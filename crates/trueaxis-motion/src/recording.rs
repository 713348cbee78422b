//! A whole simulation, kept so that a user can go back and forth in it.
//!
//! ```text
//!     Batch ──Recorder──> Columns (a row for each node) + Pyramid (extents of 4, 16, 64 … nodes)
//!     Recording ──at──> Moment          the machine itself at the command of a time
//!               ──curves──> extents     of any stretch of time, from the pyramid
//!               ──path──> points        as many as a picture needs
//! ```
//!
//! Between two nodes each axis goes evenly (docs/model.md eq. 157); tool, deviations and bodies are
//! computed there, not interpolated.

mod blocks;
mod columns;
mod curves;
mod detail;
mod moment;
mod path;
mod pyramid;
mod recorder;
#[cfg(test)]
mod tests;

pub use curves::{Curves, QuantityRange};
pub use moment::Moment;
pub use path::{Colour, PathPoints};
pub use recorder::Recorder;

use super::summary::shown;
use super::summary::unit;
use blocks::Blocks;
use columns::Columns;
use pyramid::Pyramid;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Command, Travel};
use trueaxis_machine::heat::WarmingMachine;

/// What an axis may do, in the units of text output: mm or deg.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisRange {
    /// Its ISO 841 letter.
    pub name: String,
    /// mm or deg.
    pub unit: &'static str,
    /// The ends of its travel, if it has any. Unit: that of `unit`.
    pub travel: Option<[f64; 2]>,
    /// Its greatest velocity, if stated. Unit: that of `unit` per s.
    pub velocity: Option<f64>,
    /// Its greatest acceleration, if stated. Unit: that of `unit` per s².
    pub acceleration: Option<f64>,
}

/// One tool at one set of temperatures.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Stretch {
    /// It is valid after this time, s.
    after_s: f64,
    tool: u32,
    tip_mm: Vec3,
    /// The time whose temperatures hold, s.
    since_s: f64,
}

/// A whole simulation.
#[derive(Debug)]
pub struct Recording {
    /// With the workpiece frame of the results.
    machine: Machine,
    warming: Option<WarmingMachine>,
    /// The velocities that the axes may have, mm/s and rad/s.
    velocities: Command,
    columns: Columns,
    pyramid: Pyramid,
    stretches: Vec<Stretch>,
    blocks: Blocks,
    /// How much of the picture each node carries, mm.
    detail: Vec<f32>,
    seen: usize,
}

impl Recording {
    /// Nodes of the simulation.
    pub fn nodes(&self) -> usize {
        self.seen
    }

    /// How many of them are kept.
    pub fn kept(&self) -> usize {
        self.columns.len()
    }

    /// There were more nodes than may be kept: of each few consecutive ones that with the greatest
    /// deviation stayed. The extents of curves are those of all nodes nevertheless.
    pub fn is_thinned(&self) -> bool {
        self.kept() < self.seen
    }

    /// When it ends, s.
    pub fn end_s(&self) -> f64 {
        self.columns.time_s.last().copied().unwrap_or(0.0)
    }

    /// What the axes may do, in the order of the machine.
    pub fn axes(&self) -> Vec<AxisRange> {
        let machine = &self.machine;
        let range = |(i, axis): (usize, &trueaxis_machine::axis::Axis)| AxisRange {
            name: axis.name.to_string(),
            unit: unit(machine, i),
            travel: match axis.travel {
                Travel::Between(low, high) => Some([low, high].map(|q| shown(machine, i, q))),
                Travel::Unlimited | Travel::Unknown => None,
            },
            velocity: axis.limits.velocity.map(|v| shown(machine, i, v)),
            acceleration: axis.limits.acceleration.map(|a| shown(machine, i, a)),
        };
        machine.axes().iter().enumerate().map(range).collect()
    }

    /// The machine whose workpiece frame is that of the results, with the first tool.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// When the block of a time, or else the next one, ends; s.
    pub fn next_block(&self, time_s: f64) -> f64 {
        self.blocks.next(&self.columns, time_s).unwrap_or(self.end_s())
    }

    /// When the block before that of a time ends; s.
    pub fn previous_block(&self, time_s: f64) -> f64 {
        self.blocks.previous(&self.columns, time_s).unwrap_or(0.0)
    }

    /// When a block of a program ends for the first time, s: that of a line, or else of the next line
    /// that moves something; `None` if none does.
    pub fn block_of_line(&self, program: u32, line: u32) -> Option<f64> {
        self.blocks.of_line(&self.columns, program, line)
    }

    fn stretch(&self, time_s: f64) -> Option<&Stretch> {
        let after = self.stretches.partition_point(|s| s.after_s < time_s);
        self.stretches.get(after.saturating_sub(1))
    }
}
