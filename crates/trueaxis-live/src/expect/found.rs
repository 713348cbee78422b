//! What a forecast of axes has found so far.

use super::{
    Errors, ExpectedAxis, ExpectedLoss, ExpectedTime, LiveExpectDocument, Offsets, command_at,
};
use crate::cycle::AGE_PERIODS;
use crate::file::Plan;
use crate::model::Model;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command};
use trueaxis::machine::heat::TemperatureLog;

/// What was found so far, mm and rad.
#[derive(Default)]
pub(super) struct Found {
    axes: Vec<Worst>,
    times: Vec<ExpectedTime>,
    other_mm: f64,
    turned_rad: f64,
}

#[derive(Default, Clone)]
struct Worst {
    before: f64,
    after: f64,
    by_age: f64,
    by_increment: f64,
    slope: f64,
    warms_per_s: f64,
    needed: f64,
    u: Option<f64>,
}

pub(super) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).fold(0.0, f64::max)
}

pub(super) fn shown(plan: &Plan, live: usize) -> f64 {
    match plan.machine.axes()[plan.axes[live].axis].kind {
        AxisKind::Linear => 1e3,
        AxisKind::Rotary => 1e6,
    }
}

impl Found {
    pub fn new(plan: &Plan) -> Self {
        let axes = vec![Worst::default(); plan.axes.len()];
        Self { axes, times: Vec::new(), other_mm: 0.0, turned_rad: 0.0 }
    }

    /// One row; of those that are not shown the one before takes the largest.
    pub fn add(
        &mut self,
        plan: &Plan,
        (time_s, is_shown): (f64, bool),
        (errors, sampled, held): (&Errors, &Errors, &Offsets),
        places: &[Vec<f64>],
    ) {
        let (mut before, mut after) = (Vec::new(), Vec::new());
        for (live, worst) in self.axes.iter_mut().enumerate() {
            let (errors, then, held) = (&errors[live], &sampled[live], &held[live]);
            let left = errors.iter().zip(held).map(|(e, h)| e + h);
            let (without, with) = (largest(errors.iter().copied()), largest(left));
            worst.before = worst.before.max(without);
            worst.after = worst.after.max(with);
            worst.by_age = worst.by_age.max(largest(errors.iter().zip(then).map(|(e, t)| e - t)));
            worst.by_increment =
                worst.by_increment.max(largest(then.iter().zip(held).map(|(t, h)| t + h)));
            worst.needed = worst.needed.max(largest(then.iter().copied()));
            let steps = errors.windows(2).zip(places[live].windows(2));
            // A control that follows the position by itself is not late with it.
            if plan.axes[live].line.is_none() {
                let slopes = steps.map(|(e, q)| (e[1] - e[0]) / (q[1] - q[0]));
                worst.slope = worst.slope.max(largest(slopes));
            }
            before.push(without * shown(plan, live));
            after.push(with * shown(plan, live));
        }
        match self.times.last_mut().filter(|_| !is_shown) {
            None => self.times.push(ExpectedTime { time_s, before, after }),
            Some(last) => {
                let pairs = last.before.iter_mut().zip(before);
                for (most, now) in pairs.chain(last.after.iter_mut().zip(after)) {
                    *most = most.max(now);
                }
            }
        }
    }

    /// How fast the temperatures alone move the offsets.
    pub fn changes(&mut self, since_s: Option<f64>, before: Option<&Errors>, now: &Errors) {
        let Some((before, since_s)) = before.zip(since_s.filter(|s| *s > 0.0)) else { return };
        for (worst, (before, now)) in self.axes.iter_mut().zip(before.iter().zip(now)) {
            let moved = largest(before.iter().zip(now).map(|(a, b)| b - a));
            worst.warms_per_s = worst.warms_per_s.max(moved / since_s);
        }
    }

    /// The largest that remains of each axis so far, in its unit.
    pub fn after(&self, plan: &Plan) -> Vec<f64> {
        self.axes.iter().enumerate().map(|(live, worst)| worst.after * shown(plan, live)).collect()
    }

    /// What the live axes do not correct: of the deviation at each place that which is not the error of an axis in its own
    /// direction, and the tool axis.
    pub fn others(
        &mut self,
        plan: &Plan,
        (model, warm): (&Model, &Machine),
        places: &[Vec<f64>],
    ) -> Result<(), String> {
        for (live, places) in places.iter().enumerate() {
            for place in places {
                let command = command_at(plan, live, *place);
                let errors = warm.errors_at(&command, &[0.0; 6]).map_err(|e| e.to_string())?;
                let deviation = warm.deviation(&command, &errors);
                let mut tip_mm = deviation.tip_mm;
                for axis in &plan.axes {
                    if plan.machine.axes()[axis.axis].kind != AxisKind::Linear {
                        continue;
                    }
                    // Of another live axis where it stands meanwhile.
                    let error =
                        model.error(warm, axis.axis, &command).map_err(|r| r.to_string())?;
                    let mut step = command;
                    step[axis.axis] += 1.0;
                    let none = Default::default();
                    let along =
                        warm.pose(&step, &none).shift_mm() - warm.pose(&command, &none).shift_mm();
                    tip_mm -= along * error;
                }
                self.other_mm = self.other_mm.max(tip_mm.norm());
                self.turned_rad = self.turned_rad.max(deviation.axis.norm());
            }
        }
        Ok(())
    }

    /// The uncertainty of one row.
    pub fn uncertainty(&mut self, plan: &Plan, warm: &Machine, places: &[Vec<f64>]) {
        use trueaxis::compensate::values::{Order, compensation_values};
        for (live, worst) in self.axes.iter_mut().enumerate() {
            let axis = &plan.axes[live];
            let (positions, increment) = (places[live].clone(), axis.increment);
            let order = Order {
                axis: axis.axis,
                command: Command::default(),
                positions,
                increment,
                of: plan.of,
            };
            let table = compensation_values(warm, &order).ok();
            let u = table.iter().flat_map(|t| &t.nodes).filter_map(|n| n.u);
            worst.u = u.fold(worst.u, |most: Option<f64>, u| Some(most.map_or(u, |m| m.max(u))));
        }
    }

    pub fn document(
        self,
        plan: &Plan,
        log: &TemperatureLog,
        losses: Vec<ExpectedLoss>,
    ) -> LiveExpectDocument {
        let axis = |(live, worst): (usize, &Worst)| {
            let (own, scale) = (&plan.axes[live], shown(plan, live));
            let machine = &plan.machine.axes()[own.axis];
            let speed = machine.limits.velocity;
            ExpectedAxis {
                axis: own.name.clone(),
                unit: if machine.kind == AxisKind::Linear { "um" } else { "urad" },
                on_line: own.line.is_some(),
                before: worst.before * scale,
                after: worst.after * scale,
                by_age: worst.by_age * scale,
                by_increment: worst.by_increment * scale,
                moving: speed.map(|v| v * worst.slope * AGE_PERIODS * plan.period_s * scale),
                needed_per_s: speed.map(|v| v * worst.slope * scale),
                warms_per_s: worst.warms_per_s * scale,
                slew_per_s: own.limits.slew_per_s * own.increment * scale,
                needed: worst.needed * scale,
                limit: f64::from(own.limits.limit) * own.increment * scale,
                expanded_uncertainty: worst.u.map(|u| 2.0 * u * scale),
            }
        };
        LiveExpectDocument {
            schema: "trueaxis/live-expect/1",
            name: plan.name.clone(),
            log: log.file().to_owned(),
            axes: self.axes.iter().enumerate().map(axis).collect(),
            times: self.times,
            losses,
            poses: None,
            tool_axis_urad: (self.turned_rad > 0.0).then_some(self.turned_rad * 1e6),
            other_tip_um: Some(self.other_mm * 1e3),
        }
    }
}
