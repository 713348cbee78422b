//! `[axis.X]` of a plan: the limits of the governor, and the evidence of commissioning.

use crate::governor::{AxisLimits, increments_of};
use crate::model::LiveAxis;
use std::ops::RangeInclusive;
use trueaxis::input::{Dimension, Item, Section};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::AxisKind;
use trueaxis::machine::describe::axis_index;

/// A live axis.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisPlan {
    /// Its place in [`Machine::axes`].
    pub axis: usize,
    /// Its letter.
    pub name: String,
    /// The least increment of its offset. Unit: mm or rad.
    pub increment: f64,
    /// +1 if a larger offset moves the tool in the direction of the axis for the same program, else −1. Unit: 1.
    pub sign: f64,
    /// The limits, in increments.
    pub limits: AxisLimits,
    /// What was measured when an offset was written.
    pub commissioned: Option<Commissioned>,
    /// An offset that is late by more than this is an alarm; none by default. Unit: mm or rad.
    pub lag: Option<f64>,
    /// The ends of the travel, where the control corrects along a line of the position. Unit: mm.
    pub line: Option<[f64; 2]>,
}

impl AxisPlan {
    /// How many offsets of the control are its own: along a line two, one at each end.
    pub fn offsets(&self) -> usize {
        if self.line.is_some() { 2 } else { 1 }
    }
}

impl From<&AxisPlan> for LiveAxis {
    fn from(plan: &AxisPlan) -> Self {
        let AxisPlan { axis, increment, sign, line, .. } = *plan;
        Self { axis, increment, sign, line }
    }
}

/// Evidence that sign and scale are right.
#[derive(Debug, Clone, PartialEq)]
pub struct Commissioned {
    /// The offset that was written. Unit: mm or rad.
    pub wrote: f64,
    /// How far the tool moved. Unit: mm or rad.
    pub measured: f64,
    /// When, by whom, with what.
    pub evidence: String,
}

/// The tool moves as it was written, within a fifth: a wrong sign, diameter or inches are far from that.
pub const RIGHT: RangeInclusive<f64> = 0.8..=1.2;
/// What a ratio that is not right means.
pub const WRONG: &str = "near -1 it is the sign, near 2 a diameter, near 25.4 inches, near 0 nothing acts: correct sign, increment or the control, and measure again";

impl Commissioned {
    /// How much of what was written the tool has moved, in the direction that the sign says. Unit: 1.
    pub fn ratio(&self, sign: f64) -> f64 {
        sign * self.measured / self.wrote
    }
}

/// What an axis needs, with an example of each.
const LIMITS: [(&str, &str, &str); 5] = [
    ("limit", "limit = \"300 um\"", "limit = \"0.01 deg\""),
    ("slew", "slew = \"1 um/s\"", "slew = \"0.001 deg/s\""),
    ("step", "step = \"2 um\"", "step = \"0.0001 deg\""),
    ("jump", "jump = \"20 um\"", "jump = \"0.001 deg\""),
    ("dead_band", "dead_band = \"1 um\"", "dead_band = \"0.0001 deg\""),
];

pub(super) fn read_axes(root: &Section<'_>, machine: &Machine) -> Vec<AxisPlan> {
    // An axis that could not be read is not missing: its own fault is named.
    let mut is_stated = false;
    let found = root.section("axis", |section| {
        let mut axes = Vec::new();
        is_stated = !section.entries().is_empty();
        for (letter, place, item) in section.entries() {
            let Some(axis) = axis_index(machine, letter) else {
                let message = format!("the machine has no axis `{letter}`");
                section.error_at(place, "unknown-axis", message, &machine.chain_text());
                continue;
            };
            axes.extend(
                item.section(&section.path(letter), |s| read_axis(s, machine, axis)).flatten(),
            );
        }
        axes
    });
    let axes = found.unwrap_or_default();
    if axes.is_empty() && !is_stated {
        let hint = "[axis.X] with increment, limit, slew, step, jump and dead_band for each axis that is corrected";
        root.error("live-no-axis", "no axis is corrected".to_owned(), hint);
    }
    axes
}

fn read_axis(section: &Section<'_>, machine: &Machine, axis: usize) -> Option<AxisPlan> {
    let is_linear = machine.axes()[axis].kind == AxisKind::Linear;
    let (length, speed) = match is_linear {
        true => (Dimension::Length, Dimension::Velocity),
        false => (Dimension::Angle, Dimension::AngularVelocity),
    };
    let name = machine.axes()[axis].name.to_string();
    let hint = if is_linear { "increment = \"1 um\"" } else { "increment = \"0.0001 deg\"" };
    let increment = section.require("increment", hint);
    let increment = increment.and_then(|item| above_zero(&item, "increment", (length, hint)));
    let sign = read_sign(section);
    let lag_hint = if is_linear { "lag = \"2 um\"" } else { "lag = \"0.0002 deg\"" };
    let lag = section.get("lag").and_then(|item| above_zero(&item, "lag", (length, lag_hint)));
    let commissioned = section.section("commissioned", |s| read_commissioned(s, length)).flatten();
    let mut values = Vec::new();
    for (key, linear, rotary) in LIMITS {
        let dimension = if key == "slew" { speed } else { length };
        let Some(item) = section.get(key) else {
            let message = format!("axis {name} has no `{key}`: without limits there is no start");
            section.error("live-no-limit", message, if is_linear { linear } else { rotary });
            continue;
        };
        let hint = if is_linear { linear } else { rotary };
        values.extend(above_zero(&item, key, (dimension, hint)));
    }
    // Its fault is named: an axis that is left out without a word would move the offsets of the others to other places.
    let increment = increment?;
    let [limit, slew, step, jump, dead_band] = values[..] else { return None };
    let whole = |key: &str, value: f64| {
        let found = increments_of((value / increment + 1e-9).floor()).filter(|n| *n >= 1);
        if found.is_none() {
            let message = format!(
                "`{key}` of axis {name} is less than one increment, or beyond 32 bits of them"
            );
            section.error("live-limit", message, "at least one increment of the control");
        }
        found
    };
    let limits = AxisLimits {
        limit: whole("limit", limit)?,
        step: whole("step", step)?,
        slew_per_s: slew / increment,
        jump: whole("jump", jump)?,
        dead_band: dead_band / increment,
    };
    if limits.dead_band < 1.0 - 1e-9 {
        let message = format!(
            "the dead band of axis {name} is less than one increment: its offset would dither"
        );
        section.error("live-limit", message, "at least one increment of the control");
    }
    if let Some(evidence) = &commissioned {
        check_ratio(section, &name, evidence, sign);
    }
    Some(AxisPlan { axis, name, increment, sign, limits, commissioned, lag, line: None })
}

/// A value above zero.
fn above_zero(item: &Item<'_>, key: &str, (dimension, hint): (Dimension, &str)) -> Option<f64> {
    let value = item.unjudged(dimension)?;
    if value <= 0.0 {
        item.error("not-positive", format!("`{key}` is above zero"), hint);
        return None;
    }
    Some(value)
}

fn read_sign(section: &Section<'_>) -> f64 {
    let Some(item) = section.get("sign") else { return 1.0 };
    match item.number() {
        Some(sign) if sign == 1.0 || sign == -1.0 => sign,
        Some(sign) => {
            item.error("bad-sign", format!("{sign} is no sign"), "1, or -1");
            1.0
        }
        None => 1.0,
    }
}

fn read_commissioned(section: &Section<'_>, dimension: Dimension) -> Option<Commissioned> {
    let hint = "commissioned = { wrote = \"10 um\", measured = \"10 um\", evidence = \"date, name, instrument\" }";
    let wrote = section.require("wrote", hint).and_then(|item| item.unjudged(dimension));
    let measured = section.require("measured", hint).and_then(|item| item.unjudged(dimension));
    let evidence = section.require("evidence", hint).and_then(|item| item.text());
    Some(Commissioned { wrote: wrote?, measured: measured?, evidence: evidence?.to_owned() })
}

fn check_ratio(section: &Section<'_>, name: &str, evidence: &Commissioned, sign: f64) {
    let ratio = evidence.ratio(sign);
    if !RIGHT.contains(&ratio) {
        let message = format!(
            "axis {name}: what was written moved the tool by {ratio:.2} times as much as it should"
        );
        section.error("live-commissioning", message, WRONG);
    }
}
