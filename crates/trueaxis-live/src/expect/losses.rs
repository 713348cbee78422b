//! What the loss of a sensor costs on the day of a forecast.
//!
//! ```text
//!     it stands in for another: left(t, q) = e(t, q) + offset of the sample before, with the other one's value
//!     else the run holds:       left(t + T, q) = e(t + T, q) + offset(t, q),  T up to 10 min, 1 h, the rest of the day
//! ```

use super::found::{largest, shown};
use super::{Column, Errors, Offsets, Rows, column, follow};
use crate::file::{Plan, SensorPlan};
use crate::model::Model;
use serde::Serialize;
use trueaxis::machine::heat::TemperatureLog;
use trueaxis_report::JsonSchema;

pub(super) const TEN_MINUTES_S: f64 = 600.0;
pub(super) const HOUR_S: f64 = 3600.0;
/// How long a sensor is lost.
pub(super) const SPANS_S: [f64; 3] = [TEN_MINUTES_S, HOUR_S, f64::INFINITY];

/// The loss of one sensor. Errors are the largest over the day and the travel, whenever it is lost; in the order of the axes, in
/// their units; of a control that takes whole poses tip (µm) and tool axis (µrad).
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExpectedLoss {
    /// The sensor of the plan.
    pub sensor: String,
    /// The sensor that stands in for it; null: the run holds.
    pub instead: Option<String>,
    /// Ten minutes after the loss. Unit: that of `unit`.
    pub after_10_min: Vec<f64>,
    /// An hour after it. Unit: that of `unit`.
    pub after_1_h: Vec<f64>,
    /// On the rest of the day. Unit: that of `unit`.
    pub rest_of_day: Vec<f64>,
}

/// The rows of a day.
pub(super) struct Day<'a> {
    pub plan: &'a Plan,
    pub model: &'a Model,
    pub log: &'a TemperatureLog,
    pub places: &'a [Vec<f64>],
    /// The errors of each row.
    pub errors: Vec<Errors>,
    /// What stood in the control at those that are shown, with their places.
    pub held: Vec<(usize, Offsets)>,
    /// The largest that remains of each axis while no sensor is lost, in its unit.
    pub after: Vec<f64>,
}

/// The loss of every sensor, or of one: `hold` gives what remains after three times where nothing stands in, `stands_in` what
/// remains where another one does.
pub(super) fn losses(
    plan: &Plan,
    without: Option<&str>,
    hold: impl FnOnce() -> Result<[Vec<f64>; 3], String>,
    stands_in: impl Fn(Column<'_>) -> Result<Vec<f64>, String>,
) -> Result<Vec<ExpectedLoss>, String> {
    let hold = hold()?;
    let wanted = plan.sensors.iter();
    let wanted = wanted.filter(|s| without.is_none_or(|name| name == s.settings.name));
    let loss = |lost: &SensorPlan| {
        let other = lost.settings.instead.map(|i| &plan.sensors[i]);
        let [after_10_min, after_1_h, rest_of_day] = match other {
            Some(other) => {
                let left = stands_in(&|sensor| {
                    let is_lost = sensor.settings.name == lost.settings.name;
                    column(if is_lost { other } else { sensor }).to_owned()
                })?;
                [left.clone(), left.clone(), left]
            }
            None => hold.clone(),
        };
        let instead = other.map(|other| other.settings.name.clone());
        let sensor = lost.settings.name.clone();
        Ok(ExpectedLoss { sensor, instead, after_10_min, after_1_h, rest_of_day })
    };
    wanted.map(loss).collect()
}

impl Day<'_> {
    pub fn losses(&self, without: Option<&str>) -> Result<Vec<ExpectedLoss>, String> {
        losses(self.plan, without, || Ok(self.hold()), |column| self.stands_in(column))
    }

    /// The offset stays as it is: largest errors up to each of three times.
    fn hold(&self) -> [Vec<f64>; 3] {
        let times = self.log.times_s();
        // Whichever row it is lost at, that one is among them.
        let mut worst = SPANS_S.map(|_| self.after.clone());
        for (i, held) in &self.held {
            for (later, errors) in self.errors.iter().enumerate().skip(*i) {
                let since_s = times[later] - times[*i];
                for (live, held) in held.iter().enumerate() {
                    let left = errors[live].iter().zip(held).map(|(e, h)| e + h);
                    let left = largest(left) * shown(self.plan, live);
                    for (worst, most_s) in worst.iter_mut().zip(SPANS_S) {
                        if since_s <= most_s {
                            worst[live] = worst[live].max(left);
                        }
                    }
                }
            }
        }
        worst
    }

    /// Another sensor takes its place.
    fn stands_in(&self, swapped: Column<'_>) -> Result<Vec<f64>, String> {
        let mut worst = vec![0.0f64; self.plan.axes.len()];
        let mut rows = Rows::of(self.plan, self.model, (self.log, swapped), self.places)?;
        let (mut sampled, mut before): (Option<Errors>, Option<Offsets>) = (None, None);
        for (at, now) in self.errors.iter().enumerate() {
            rows.go_to(at)?;
            let read = rows.row()?.errors.clone();
            let last = sampled.as_ref().unwrap_or(&read);
            let held = follow(self.plan, (last, self.places), before.as_ref());
            for (live, worst) in worst.iter_mut().enumerate() {
                let left = now[live].iter().zip(&held[live]).map(|(e, h)| e + h);
                *worst = worst.max(largest(left) * shown(self.plan, live));
            }
            (sampled, before) = (Some(read), Some(held));
        }
        Ok(worst)
    }
}
