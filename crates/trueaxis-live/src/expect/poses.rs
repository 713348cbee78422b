//! The same for a control that takes tip and tool axis together: poses over the whole travel.
//!
//! ```text
//!     by(t, q)   = q_c − q of the sample before, in whole increments, follows with a dead band      crate::pose
//!     left(t, q) = actual pose at q + by  −  nominal pose at q
//! ```
//!
//! What was off of the tip where the zero of the part was touched is in the zero: `by` does not move the tip by it, and it is not
//! left.

use super::losses::{ExpectedLoss, SPANS_S, losses};
use super::{Column, Heat, column, columns, followed, moments, off_at_touch};
use crate::file::{Plan, SensorPlan};
use crate::model::Part;
use crate::pose::{Frame, PoseCorrection, World, turns};
use serde::Serialize;
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, AxisKind, Command, Travel};
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::heat::TemperatureLog;
use trueaxis::machine::volume::commands;
use trueaxis_report::JsonSchema;

/// Poses beside the corners of the travel.
const POSES: u32 = 40;
/// Rows of the log that are shown, at most.
const MOST_ROWS: usize = 60;

/// Tip and tool axis over the day, in poses over the whole travel, standing still.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpectedPoses {
    /// Poses: the corners of the travel, and others that fill it evenly.
    pub poses: usize,
    /// Rows of the log that are shown.
    pub rows: usize,
    /// Tip: the largest distance from where it should be, without the correction and with it.
    pub tip_um: [f64; 2],
    /// Of it: the temperatures have changed since the last sample.
    pub tip_by_age_um: f64,
    /// Expanded uncertainty (k = 2) of the tip at the pose that is worst without the correction, by the machine file; null where it states none.
    pub tip_expanded_uncertainty_um: Option<f64>,
    /// Tool axis: the largest angle, without the correction and with it; null without rotary axes.
    pub tool_axis_urad: Option<[f64; 2]>,
    /// Each live axis: what the plan must allow.
    pub axes: Vec<ExpectedOffset>,
}

/// The offset of one live axis.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpectedOffset {
    /// Its letter.
    pub axis: String,
    /// um or urad.
    pub unit: &'static str,
    /// The largest offset of the axis that is needed. Unit: that of `unit`.
    pub needed: f64,
    /// The limit of the plan. Unit: that of `unit`.
    pub limit: f64,
}

/// What is off: of the tip mm, of the tool axis rad.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Off {
    tip_mm: f64,
    axis_rad: f64,
}

impl Off {
    fn largest(self, other: Self) -> Self {
        let (tip_mm, axis_rad) = (self.tip_mm.max(other.tip_mm), self.axis_rad.max(other.axis_rad));
        Self { tip_mm, axis_rad }
    }
}

/// The machine of a row, and the offsets that it wants in each pose. Unit: mm or rad.
struct Row {
    at_s: f64,
    warm: Machine,
    wanted: Vec<Command>,
}

/// A day in poses.
pub(super) struct Day<'a> {
    plan: &'a Plan,
    log: &'a TemperatureLog,
    poses: Vec<Command>,
    turns: bool,
    /// What tables in the control add in each pose where only the thermal part goes live; they count as exact. Unit: mm or rad.
    tables: Vec<Command>,
    /// The places of the rows in the log, and which are shown.
    at: Vec<(usize, bool)>,
    /// What was off of the tip where the zero of the part was touched: X, Y and Z of the control, and in the workpiece. Unit: mm.
    at_touch: [Vec3; 2],
    world: World,
}

/// Poses over the travel, a hundredth of it away from its ends: there an offset has no room.
fn inside(machine: &Machine) -> Vec<Command> {
    let mut poses = commands(machine.axes(), POSES);
    for (i, axis) in machine.axes().iter().enumerate() {
        if let Travel::Between(from, to) = axis.travel {
            let middle = 0.5 * (from + to);
            poses.iter_mut().for_each(|pose| pose[i] = middle + 0.98 * (pose[i] - middle));
        }
    }
    poses
}

/// The forecast of a day, with the loss of every sensor or of one.
pub(super) fn expect(
    plan: &Plan,
    log: &TemperatureLog,
    without: Option<&str>,
) -> Result<(ExpectedPoses, Vec<ExpectedLoss>), String> {
    let machine = &plan.machine;
    let poses = inside(machine);
    let turns = turns(machine, |i| plan.axes.iter().any(|axis| axis.axis == i));
    let (cold, world) = (PoseCorrection::of(machine, turns)?, World::of(machine)?);
    let table = |pose: &Command| match plan.part {
        Part::Whole => Ok(Command::default()),
        Part::Thermal => cold.corrected(pose).map(|to| std::array::from_fn(|i| to[i] - pose[i])),
    };
    let day = Day {
        plan,
        log,
        tables: poses.iter().map(table).collect::<Result<_, String>>()?,
        poses,
        turns,
        at: moments(log, &columns(plan), MOST_ROWS).into_iter().collect(),
        at_touch: tip_at_touch(plan, &world)?,
        world,
    };
    let own = |sensor: &SensorPlan| column(sensor).to_owned();
    let rows = day.rows(&own)?;
    if rows.is_empty() {
        return Err("the log has no row".to_owned());
    }
    let held = day.held(&rows);
    let found = day.found(&rows, &held)?;
    let hold = || day.hold(&rows, &held);
    let lost = losses(plan, without, hold, |column| day.stands_in(&rows, column))?;
    Ok((found, lost))
}

impl Day<'_> {
    fn rows(&self, column: Column<'_>) -> Result<Vec<Row>, String> {
        let mut heat = Heat::of(self.plan, self.log, column);
        let row = |(at, _): &(usize, bool)| {
            let warm = heat.machine_at(*at)?;
            let hot = PoseCorrection::of(&warm, self.turns)?;
            let wanted = self.poses.iter().zip(&self.tables).map(|(pose, table)| {
                let to = hot.corrected(pose)?;
                let kept = self.world.moving_tip(Frame::Machine, pose, &self.at_touch[0]);
                Ok(std::array::from_fn(|i| to[i] - pose[i] - table[i] + kept[i]))
            });
            let wanted = wanted.collect::<Result<_, String>>()?;
            Ok(Row { at_s: self.log.times_s()[*at], warm, wanted })
        };
        self.at.iter().map(row).collect()
    }

    /// What stands in the control at each row that is shown, with its place among the rows.
    fn held(&self, rows: &[Row]) -> Vec<(usize, Vec<Command>)> {
        let mut all: Vec<(usize, Vec<Command>)> = Vec::new();
        for i in self.shown() {
            let sampled = &rows[i.saturating_sub(1)];
            let before = all.last().map(|(_, poses)| poses);
            let pose = |(k, wanted): (usize, &Command)| {
                self.counted(wanted, before.map(|poses| &poses[k]))
            };
            let held = sampled.wanted.iter().enumerate().map(pose).collect();
            all.push((i, held));
        }
        all
    }

    /// The rows that are shown, by their places.
    fn shown(&self) -> impl Iterator<Item = usize> {
        self.at.iter().enumerate().filter(|(_, (_, is_shown))| *is_shown).map(|(i, _)| i)
    }

    fn counted(&self, wanted: &Command, before: Option<&Command>) -> Command {
        let mut held = Command::default();
        for own in &self.plan.axes {
            let before = before.map(|before| before[own.axis]);
            held[own.axis] = followed(own, wanted[own.axis], before);
        }
        held
    }

    /// How far the actual tool at a pose with its offset is from the nominal one without.
    fn off(&self, warm: &Machine, pose: &Command, by: &Command) -> Result<Off, String> {
        let (tip_mm, axis) = left(warm, pose, by)?;
        let tip_mm = tip_mm - self.at_touch[1];
        Ok(Off { tip_mm: tip_mm.norm(), axis_rad: axis.norm() })
    }

    fn found(&self, rows: &[Row], held: &[(usize, Vec<Command>)]) -> Result<ExpectedPoses, String> {
        let (mut before, mut after, mut by_age) = (Off::default(), Off::default(), 0.0_f64);
        let mut worst = (0, 0);
        let mut needed = Command::default();
        for (i, held) in held {
            let (row, sampled) = (&rows[*i], &rows[i.saturating_sub(1)].wanted);
            for (k, pose) in self.poses.iter().enumerate() {
                let without = self.off(&row.warm, pose, &self.tables[k])?;
                if without.tip_mm > before.tip_mm {
                    worst = (*i, k);
                }
                before = before.largest(without);
                after = after.largest(self.off(&row.warm, pose, &self.with(k, &held[k]))?);
                let exact = self.with(k, &self.live(&sampled[k]));
                by_age = by_age.max(self.off(&row.warm, pose, &exact)?.tip_mm);
                for (most, wanted) in needed.iter_mut().zip(&row.wanted[k]) {
                    *most = f64::max(*most, wanted.abs());
                }
            }
        }
        let kind = |axis: usize| self.plan.machine.axes()[axis].kind;
        let axes = self.plan.axes.iter().map(|own| {
            let linear = kind(own.axis) == AxisKind::Linear;
            let (unit, scale) = if linear { ("um", 1e3) } else { ("urad", 1e6) };
            let limit = f64::from(own.limits.limit) * own.increment * scale;
            ExpectedOffset { axis: own.name.clone(), unit, needed: needed[own.axis] * scale, limit }
        });
        let has_turns = self.plan.machine.axes().iter().any(|axis| axis.kind == AxisKind::Rotary);
        Ok(ExpectedPoses {
            poses: self.poses.len(),
            rows: held.len(),
            tip_um: [before.tip_mm, after.tip_mm].map(|mm| mm * 1e3),
            tip_by_age_um: by_age * 1e3,
            tip_expanded_uncertainty_um: uncertainty(&rows[worst.0].warm, &self.poses[worst.1])?
                .map(|mm| 2e3 * mm),
            tool_axis_urad: has_turns
                .then(|| [before.axis_rad, after.axis_rad].map(|rad| rad * 1e6)),
            axes: axes.collect(),
        })
    }

    /// What tables in the control add, and the live offset.
    fn with(&self, pose: usize, by: &Command) -> Command {
        std::array::from_fn(|i| self.tables[pose][i] + by[i])
    }

    /// Only what the live axes take.
    fn live(&self, wanted: &Command) -> Command {
        let mut by = Command::default();
        self.plan.axes.iter().for_each(|own| by[own.axis] = wanted[own.axis]);
        by
    }
}

/// What the loss of a sensor costs: tip (µm) and tool axis (µrad).
impl Day<'_> {
    /// The offset stays as it is, at the pose where it was: largest errors up to each of three times.
    fn hold(&self, rows: &[Row], held: &[(usize, Vec<Command>)]) -> Result<[Vec<f64>; 3], String> {
        let mut worst = [Off::default(); 3];
        for (i, held) in held {
            for later in &rows[*i..] {
                let since_s = later.at_s - rows[*i].at_s;
                for (k, pose) in self.poses.iter().enumerate() {
                    let off = self.off(&later.warm, pose, &self.with(k, &held[k]))?;
                    for (worst, most_s) in worst.iter_mut().zip(SPANS_S) {
                        if since_s <= most_s {
                            *worst = worst.largest(off);
                        }
                    }
                }
            }
        }
        Ok(worst.map(shown))
    }

    /// Another sensor takes its place.
    fn stands_in(&self, rows: &[Row], swapped: Column<'_>) -> Result<Vec<f64>, String> {
        let mut worst = Off::default();
        let read = self.rows(swapped)?;
        for (i, held) in self.held(&read) {
            for (k, pose) in self.poses.iter().enumerate() {
                worst = worst.largest(self.off(&rows[i].warm, pose, &self.with(k, &held[k]))?);
            }
        }
        Ok(shown(worst))
    }
}

fn shown(off: Off) -> Vec<f64> {
    vec![off.tip_mm * 1e3, off.axis_rad * 1e6]
}

/// What was off of the tip at the touch that the plan knows of, as the control names it and in the workpiece. Unit: mm.
fn tip_at_touch(plan: &Plan, world: &World) -> Result<[Vec3; 2], String> {
    let mut xyz = Vec3::zeros();
    for (own, off) in plan.axes.iter().zip(off_at_touch(plan)?) {
        if let Some(i) = world.linear().iter().position(|axis| *axis == own.axis) {
            xyz[i] = off;
        }
    }
    Ok([xyz, world.vector(&xyz)])
}

/// The actual tool at a pose with an offset of its axes, less the nominal one without: tip (mm) and tool axis.
fn left(warm: &Machine, pose: &Command, by: &Command) -> Result<(Vec3, Vec3), String> {
    let there: Command = std::array::from_fn(|i| pose[i] + by[i]);
    let errors = warm.errors_at(&there, &Approach::default()).map_err(|e| e.to_string())?;
    let (due, is) =
        (warm.deviation(pose, &ErrorValues::default()), warm.deviation(&there, &errors));
    let tip_mm = is.nominal_tip.vector() + is.tip_mm - due.nominal_tip.vector();
    Ok((tip_mm, is.nominal_axis.vector() + is.axis - due.nominal_axis.vector()))
}

/// Standard uncertainty of the distance of the tip by the machine file, mm; none where it states none.
fn uncertainty(warm: &Machine, pose: &Command) -> Result<Option<f64>, String> {
    let errors = warm.errors_at(pose, &Approach::default()).map_err(|e| e.to_string())?;
    let quantities = warm.uncertain_quantities();
    if quantities.is_empty() {
        return Ok(None);
    }
    let known = warm.uncertainties_at(pose, &quantities);
    let along = warm.deviation(pose, &errors).tip_mm.try_normalize(1e-12).unwrap_or_else(Vec3::x);
    let effect = |quantity: usize| {
        let tip = |z: f64| warm.deviation(pose, &known.displaced_by(&errors, quantity, z)).tip_mm;
        0.5 * along.dot(&(tip(1.0) - tip(-1.0)))
    };
    let u = (0..quantities.len()).map(effect).fold(0.0, f64::hypot);
    Ok(Some(u).filter(|u| *u > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis::machine::file::NoTables;

    /// A hundredth of the travel is left at each end: 10 mm of 1000 mm, 6 mm of 600 mm.
    #[test]
    fn the_poses_of_a_day_leave_room_at_the_ends() {
        let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n[axis.X]\ntravel = [\"100 mm\", \"1100 mm\"]\n\
                    [axis.Y]\ntravel = [\"-300 mm\", \"300 mm\"]\n";
        let machine = Machine::check("mill.toml", text, &NoTables).0.expect("a machine");
        let poses = inside(&machine);
        let range = |i: usize| {
            let values = poses.iter().map(|p| p[i]);
            [values.clone().fold(f64::MAX, f64::min), values.fold(f64::MIN, f64::max)]
        };
        for (i, due) in [(0, [110.0, 1090.0]), (1, [-294.0, 294.0])] {
            let found = range(i);
            assert!(
                (found[0] - due[0]).abs() < 1e-9 && (found[1] - due[1]).abs() < 1e-9,
                "{found:?}"
            );
        }
    }
}
