//! Where a forecast follows and the run would not: what its sensors and limits would refuse.

use super::{LiveExpectDocument, column};
use crate::file::{Plan, SensorPlan, Source};
use crate::sensor::DIGIT_K;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::machine::heat::TemperatureLog;
use trueaxis_report::numbers::fixed;

/// The correction does not use a reading outside the range of its sensor; a forecast from it is one of another plan.
pub(super) fn on_sensors(plan: &Plan, log: &TemperatureLog, problems: &mut Diagnostics) {
    for sensor in &plan.sensors {
        let Some(celsius) = log.celsius(column(sensor)) else { continue };
        on_rows(plan, sensor, (log.times_s(), celsius), problems);
        let [low, high] = sensor.settings.range;
        let outside: Vec<f64> =
            celsius.iter().copied().filter(|c| !(low..=high).contains(c)).collect();
        let Some(first) = outside.first() else { continue };
        let name = &sensor.settings.name;
        let message = format!(
            "{} of {} readings of `{name}` are outside its range of {low} to {high} °C, {first} °C for one: the correction \
             would not use them, this forecast does",
            outside.len(),
            celsius.len()
        );
        let hint = format!("is range of [sensor.{name}] right for this day?");
        problems.warn("live-range", Place::whole(&plan.path.display().to_string()), message, &hint);
    }
}

/// Rows that come later than a sample may be old, and readings that change faster than a sensor can.
fn on_rows(
    plan: &Plan,
    sensor: &SensorPlan,
    (times_s, celsius): (&[f64], &[f64]),
    problems: &mut Diagnostics,
) {
    let (own, name) = (&sensor.settings, &sensor.settings.name);
    // A plan that replays a log faster counts its ages on the clock of the run.
    let speed = if let Source::Log { speed, .. } = sensor.source { speed } else { 1.0 };
    let steps = times_s.windows(2).zip(celsius.windows(2));
    let steps: Vec<(f64, f64)> =
        steps.map(|(t, c)| ((t[1] - t[0]) / speed, (c[1] - c[0]).abs())).collect();
    let late = |(s, _): &&(f64, f64)| *s > own.stale_s;
    let fast = |(s, k): &&(f64, f64)| *s <= own.stale_s && *k > own.rate_k_per_s * s + DIGIT_K;
    let late: Vec<f64> = steps.iter().filter(late).map(|(s, _)| *s).collect();
    let fast: Vec<f64> = steps.iter().filter(fast).map(|(_, k)| *k).collect();
    let place = || Place::whole(&plan.path.display().to_string());
    let (count, of) = (|found: &[f64]| format!("{} of {} rows", found.len(), steps.len()), own);
    if let Some(longest) = late.iter().copied().reduce(f64::max) {
        let message = format!(
            "{} of the log come up to {} s after the one before, and a sample of `{name}` is used for {} s: the correction \
             would hold in between, this forecast follows",
            count(&late),
            fixed(longest, 0),
            of.stale_s
        );
        let hint = format!("a log with finer rows, or another `stale` of [sensor.{name}]");
        problems.warn("live-not-followed", place(), message, &hint);
    }
    if let Some(most) = fast.iter().copied().reduce(f64::max) {
        let message = format!(
            "`{name}` changes by up to {} K in {} of the log, faster than its rate: the correction would hold, this forecast \
             follows",
            fixed(most, 2),
            count(&fast)
        );
        let hint = format!("is rate_k_per_min of [sensor.{name}] right for this day?");
        problems.warn("live-not-followed", place(), message, &hint);
    }
}

/// Offsets that would have to change faster than their slew for the temperatures alone.
pub(super) fn on_slew(plan: &Plan, found: &LiveExpectDocument, problems: &mut Diagnostics) {
    for axis in found.axes.iter().filter(|axis| axis.warms_per_s > axis.slew_per_s) {
        let message = format!(
            "the temperatures of the log move the offset of {} by up to {} {} each second, its slew allows {}: the correction \
             would come later, this forecast is at once there",
            axis.axis,
            fixed(axis.warms_per_s, 3),
            axis.unit,
            fixed(axis.slew_per_s, 3)
        );
        let hint = format!("is slew of [axis.{}] right for this day?", axis.axis);
        let place = Place::whole(&plan.path.display().to_string());
        problems.warn("live-not-followed", place, message, &hint);
    }
}
