//! The machine at one moment of a simulation.

use super::super::tool_path::{errors_near, path_frame};
use super::Recording;
use super::columns::{RAPID, WAITS};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::errors::ErrorValues;

/// Where everything is at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// From the start of the program, s.
    pub time_s: f64,
    /// Axis positions, mm and rad.
    pub command: Command,
    /// From which side the axes come.
    pub approach: Approach,
    /// Nominal tip in the workpiece frame, mm.
    pub tip_mm: Vec3,
    /// Deviation of the tip, µm.
    pub off_tip_um: Vec3,
    /// Deviation of the tool axis, µrad.
    pub off_axis_urad: Vec3,
    /// Deviation of the tip along feed, normal and binormal, µm.
    pub along_path_um: Vec3,
    /// Along the path. Unit: mm/s or deg/s.
    pub speed: f64,
    /// The number of the program whose block is executed.
    pub program: u32,
    /// Its line.
    pub line: u32,
    /// The tool in the spindle.
    pub tool: u32,
    /// The axes go as fast as they can.
    pub rapid: bool,
    /// The axes wait.
    pub waits: bool,
}

impl Recording {
    /// Where everything is at a time; before the start and after the end as there. Between two
    /// nodes each axis goes evenly:
    ///
    /// ```text
    ///     q(t) = qᵢ₋₁ + (qᵢ − qᵢ₋₁)·(t − tᵢ₋₁)/(tᵢ − tᵢ₋₁)         docs/model.md eq. 157
    /// ```
    ///
    /// and tool and deviation at q(t) are computed from the machine. `None` where nothing was simulated.
    pub fn at(&self, time_s: f64) -> Option<Moment> {
        let columns = &self.columns;
        let (first_s, last_s) = (*columns.time_s.first()?, self.end_s());
        let time_s = if time_s.is_nan() { first_s } else { time_s.clamp(first_s, last_s) };
        let i = columns.time_s.partition_point(|t| *t < time_s);
        let (before, part) = self.part(i, time_s);
        let [from, to] = [before, i].map(|k| columns.command(k));
        let between = |a: f64, b: f64| if part >= 1.0 { b } else { a + (b - a) * part };
        let command = std::array::from_fn(|axis| between(from[axis], to[axis]));
        let approach = columns.approach[i].map(f64::from);
        let machine = self.machine_at(time_s);
        let errors = errors_near(&machine, &command, &approach);
        let deviation = machine.deviation(&command, &errors);
        let axis = deviation.nominal_axis.vector();
        let along = path_frame(self.tangent(i), axis).map(|d| d.dot(&deviation.tip_mm) * 1e3);
        let [slow, fast] = [before, i].map(|k| f64::from(columns.speed[k]));
        Some(Moment {
            time_s,
            command,
            approach,
            tip_mm: deviation.nominal_tip.vector(),
            off_tip_um: deviation.tip_mm * 1e3,
            off_axis_urad: deviation.axis * 1e6,
            along_path_um: along.into(),
            speed: between(slow, fast),
            program: columns.program[i],
            line: columns.line[i],
            tool: self.stretch(time_s).map_or(0, |s| s.tool),
            rapid: columns.flags[i] & RAPID != 0,
            waits: columns.flags[i] & WAITS != 0,
        })
    }

    /// The node before another one, and which part of the path between them is completed at a time.
    pub(super) fn part(&self, i: usize, time_s: f64) -> (usize, f64) {
        let (before, times) = (i.saturating_sub(1), &self.columns.time_s);
        let took_s = times[i] - times[before];
        (before, if took_s > 0.0 { (time_s - times[before]) / took_s } else { 1.0 })
    }

    /// The direction in which the tip went last, up to a node.
    fn tangent(&self, i: usize) -> Vec3 {
        let tip = |k: usize| Vec3::from(self.columns.tip_mm[k]);
        let tool = |k: usize| self.stretch(self.columns.time_s[k]).map(|s| s.tip_mm);
        let step = |k: usize| {
            let step = (tip(k) - tip(k - 1)).try_normalize(1e-9)?;
            // Another tool is no step of the path.
            (tool(k) == tool(k - 1)).then_some(step)
        };
        (1..=i).rev().find_map(step).unwrap_or(Vec3::x())
    }

    /// The machine with its tool and at its temperatures at a time.
    pub fn machine_at(&self, time_s: f64) -> Machine {
        let Some(stretch) = self.stretch(time_s) else { return self.machine.clone() };
        let warm = self.warming.as_ref().and_then(|warming| warming.at(stretch.since_s));
        let machine = warm.map_or_else(|| self.machine.clone(), |(machine, _)| machine);
        machine.with_tip(stretch.tip_mm)
    }

    /// The nominal and the actual place of every body at a moment, in the order of the machine.
    pub fn bodies(&self, at: &Moment) -> Vec<[Pose<Bed, Body>; 2]> {
        let machine = self.machine_at(at.time_s);
        let errors = errors_near(&machine, &at.command, &at.approach);
        let nominal = machine.body_poses(&at.command, &ErrorValues::default());
        let actual = machine.body_poses(&at.command, &errors);
        nominal.into_iter().zip(actual).map(|(n, a)| [n, a]).collect()
    }
}
