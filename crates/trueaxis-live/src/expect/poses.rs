//! The same for a control that takes tip and tool axis together: poses over the whole travel.
//!
//! ```text
//!     by(t, q)   = q_c − q of the sample before, in whole increments, follows with a dead band      crate::pose
//!     left(t, q) = actual pose at q + by  −  nominal pose at q
//! ```

use super::losses::{ExpectedLoss, HOUR_S, TEN_MINUTES_S};
use super::{Column, Heat, column};
use crate::file::{Plan, SensorPlan};
use crate::model::Part;
use crate::pose::{PoseCorrection, turns};
use schemars::JsonSchema;
use serde::Serialize;
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, AxisKind, Command, Travel};
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::heat::TemperatureLog;
use trueaxis::machine::volume::commands;

/// Poses beside the corners of the travel.
const POSES: u32 = 40;
/// Rows of the log that are evaluated, at most.
const MOST_ROWS: usize = 60;

/// Tip and tool axis over the day, in poses over the whole travel, standing still.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpectedPoses {
    /// Poses: the corners of the travel, and others that fill it evenly.
    pub poses: usize,
    /// Rows of the log.
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
    /// The places of the rows in the log.
    at: Vec<usize>,
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
    let step = log.times_s().len().div_ceil(MOST_ROWS).max(1);
    let poses = inside(machine);
    let turns = turns(machine, |i| plan.axes.iter().any(|axis| axis.axis == i));
    let cold = PoseCorrection::of(machine, turns)?;
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
        at: (0..log.times_s().len()).step_by(step).collect(),
    };
    let own = |sensor: &SensorPlan| column(sensor).to_owned();
    let rows = day.rows(&own)?;
    if rows.is_empty() {
        return Err("the log has no row".to_owned());
    }
    let held = day.held(&rows);
    let found = day.found(&rows, &held)?;
    Ok((found, day.losses(&rows, &held, without)?))
}

impl Day<'_> {
    fn rows(&self, column: Column<'_>) -> Result<Vec<Row>, String> {
        let mut heat = Heat::of(self.plan, self.log, column);
        let row = |at: &usize| {
            let warm = heat.machine_at(*at)?;
            let hot = PoseCorrection::of(&warm, self.turns)?;
            let wanted = self.poses.iter().zip(&self.tables).map(|(pose, table)| {
                let to = hot.corrected(pose)?;
                Ok(std::array::from_fn(|i| to[i] - pose[i] - table[i]))
            });
            let wanted = wanted.collect::<Result<_, String>>()?;
            Ok(Row { at_s: self.log.times_s()[*at], warm, wanted })
        };
        self.at.iter().map(row).collect()
    }

    /// What stands in the control at each row: the sample of the row before, in whole increments, within the limits.
    fn held(&self, rows: &[Row]) -> Vec<Vec<Command>> {
        let mut all: Vec<Vec<Command>> = Vec::with_capacity(rows.len());
        for i in 0..rows.len() {
            let sampled = &rows[i.saturating_sub(1)];
            let before = all.last();
            let pose = |(k, wanted): (usize, &Command)| {
                self.counted(wanted, before.map(|poses| &poses[k]))
            };
            let held = sampled.wanted.iter().enumerate().map(pose).collect();
            all.push(held);
        }
        all
    }

    fn counted(&self, wanted: &Command, before: Option<&Command>) -> Command {
        let mut held = Command::default();
        for own in &self.plan.axes {
            let limit = f64::from(own.limits.limit);
            let target = (wanted[own.axis] / own.increment).clamp(-limit, limit);
            let stays = before.map(|before| before[own.axis] / own.increment);
            let stays = stays.filter(|n| (target - n).abs() < own.limits.dead_band.max(1.0));
            held[own.axis] = stays.unwrap_or_else(|| target.round()) * own.increment;
        }
        held
    }

    /// How far the actual tool at a pose with its offset is from the nominal one without.
    fn off(&self, warm: &Machine, pose: &Command, by: &Command) -> Result<Off, String> {
        let (tip_mm, axis) = left(warm, pose, by)?;
        Ok(Off { tip_mm: tip_mm.norm(), axis_rad: axis.norm() })
    }

    fn found(&self, rows: &[Row], held: &[Vec<Command>]) -> Result<ExpectedPoses, String> {
        let (mut before, mut after, mut by_age) = (Off::default(), Off::default(), 0.0_f64);
        let mut worst = (0, 0);
        let mut needed = Command::default();
        for (i, row) in rows.iter().enumerate() {
            let sampled = &rows[i.saturating_sub(1)].wanted;
            for (k, pose) in self.poses.iter().enumerate() {
                let without = self.off(&row.warm, pose, &self.tables[k])?;
                if without.tip_mm > before.tip_mm {
                    worst = (i, k);
                }
                before = before.largest(without);
                after = after.largest(self.off(&row.warm, pose, &self.with(k, &held[i][k]))?);
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
            rows: rows.len(),
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
    fn losses(
        &self,
        rows: &[Row],
        held: &[Vec<Command>],
        without: Option<&str>,
    ) -> Result<Vec<ExpectedLoss>, String> {
        let sensors = self.plan.sensors.iter();
        let wanted = sensors.filter(|s| without.is_none_or(|name| name == s.settings.name));
        let mut hold = None;
        let mut losses = Vec::new();
        for sensor in wanted {
            let other = sensor.settings.instead.map(|i| &self.plan.sensors[i]);
            let [after_10_min, after_1_h, rest_of_day] = match other {
                Some(other) => {
                    let left = self.stands_in(rows, sensor, other)?;
                    [left.clone(), left.clone(), left]
                }
                None => {
                    if hold.is_none() {
                        hold = Some(self.hold(rows, held)?);
                    }
                    hold.clone().unwrap_or_default()
                }
            };
            losses.push(ExpectedLoss {
                sensor: sensor.settings.name.clone(),
                instead: other.map(|other| other.settings.name.clone()),
                after_10_min,
                after_1_h,
                rest_of_day,
            });
        }
        Ok(losses)
    }

    /// The offset stays as it is, at the pose where it was: largest errors up to each of three times.
    fn hold(&self, rows: &[Row], held: &[Vec<Command>]) -> Result<[Vec<f64>; 3], String> {
        let mut worst = [Off::default(); 3];
        for (i, lost) in rows.iter().enumerate() {
            for later in &rows[i..] {
                for (k, pose) in self.poses.iter().enumerate() {
                    let off = self.off(&later.warm, pose, &self.with(k, &held[i][k]))?;
                    let spans_s = [TEN_MINUTES_S, HOUR_S, f64::INFINITY];
                    for (worst, most_s) in worst.iter_mut().zip(spans_s) {
                        if later.at_s - lost.at_s <= most_s {
                            *worst = worst.largest(off);
                        }
                    }
                }
            }
        }
        Ok(worst.map(shown))
    }

    /// Another sensor takes its place.
    fn stands_in(
        &self,
        rows: &[Row],
        lost: &SensorPlan,
        other: &SensorPlan,
    ) -> Result<Vec<f64>, String> {
        let swapped = |sensor: &SensorPlan| {
            let is_lost = sensor.settings.name == lost.settings.name;
            column(if is_lost { other } else { sensor }).to_owned()
        };
        let mut worst = Off::default();
        for (row, read) in rows.iter().zip(self.rows(&swapped)?) {
            for (k, pose) in self.poses.iter().enumerate() {
                let by = self.with(k, &self.counted(&read.wanted[k], None));
                worst = worst.largest(self.off(&row.warm, pose, &by)?);
            }
        }
        Ok(shown(worst))
    }
}

fn shown(off: Off) -> Vec<f64> {
    vec![off.tip_mm * 1e3, off.axis_rad * 1e6]
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
