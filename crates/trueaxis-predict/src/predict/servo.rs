//! `[servo]` of a study: how the axes follow while the part is cut.
//!
//! ```text
//! ṁ = Kv (q − m) + k q̇        s = clamp(s, m − b/2, m + b/2)        a = s − h d e^{−(t − t_r)/t_s}
//!                                                                       docs/model.md eq. 213
//! ```
//!
//! q the command, m the motor, s the slide, a where the axis is; the quantities of `[unknown.servo]` of a campaign,
//! as `trueaxis identify` finds them.

use trueaxis_input::{Dimension, Item, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};
use trueaxis_machine::errors::BodyName;

/// A number and its standard uncertainty.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Known {
    /// The number. Unit: that of `unit`.
    pub value: f64,
    /// Its standard uncertainty. Unit: that of `unit`.
    pub u: f64,
}

/// How one axis follows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxisServo {
    /// By how much time it lags at constant velocity, (1 − k)/Kv. Unit: s.
    pub lag: Known,
    /// Velocity feedforward k. Unit: 1.
    pub feedforward: f64,
    /// Its play b. Unit: mm or rad.
    pub lost_motion: Known,
    /// How far it sticks where it turns, h. Unit: mm or rad.
    pub friction: Known,
    /// The time constant with which it comes free, s.
    pub friction_time_s: f64,
}

/// How all axes follow.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Servo(pub [AxisServo; MAX_AXES]);

/// One of its uncertain numbers: the axis, and which.
pub(super) type ServoQuantity = (usize, usize);

impl Servo {
    /// Whether every axis follows exactly.
    pub fn is_exact(&self) -> bool {
        self.0
            .iter()
            .all(|a| a.lag.value == 0.0 && a.lost_motion.value == 0.0 && a.friction.value == 0.0)
    }

    /// The numbers that have an uncertainty.
    pub(super) fn uncertain(&self) -> Vec<ServoQuantity> {
        let has = |(i, k): &ServoQuantity| self.0[*i].number(*k).u > 0.0;
        (0..MAX_AXES).flat_map(|i| (0..3).map(move |k| (i, k))).filter(has).collect()
    }

    /// With one number moved by that many of its standard uncertainties, and how many it really was: neither a lag nor a
    /// play is negative.
    pub(super) fn displaced(&self, (axis, which): ServoQuantity, z: f64) -> (Self, f64) {
        let mut servo = *self;
        let of = &mut servo.0[axis];
        let number = match which {
            0 => &mut of.lag,
            1 => &mut of.lost_motion,
            _ => &mut of.friction,
        };
        let before = number.value;
        number.value = (before + z * number.u).max(0.0);
        let moved = (number.value - before) / number.u;
        (servo, moved)
    }

    /// Where the axes are after one turn of a closed path that was gone before, at every node.
    ///
    /// Commands are straight in time between the nodes; `closing` is what the last node has more than the first
    /// (a turn of an axis that goes round). The first node is the last of the turn before.
    pub(super) fn follow(
        &self,
        nodes: &[Command],
        times_s: &[f64],
        closing: &Command,
    ) -> Vec<Command> {
        let mut actual = nodes.to_vec();
        for (i, axis) in self.0.iter().enumerate() {
            let turn = AxisTurn { nodes, times_s, i, closing: closing[i] };
            if *axis != AxisServo::default() {
                turn.follow(axis, &mut actual);
            }
        }
        actual
    }
}

impl AxisServo {
    fn number(&self, which: usize) -> Known {
        match which {
            0 => self.lag,
            1 => self.lost_motion,
            _ => self.friction,
        }
    }
}

/// After so many time constants a transient is nothing (e⁻⁴⁰ = 4·10⁻¹⁸).
const SETTLED: f64 = 40.0;
/// The path before the first node is gone at least once.
const MOST_TURNS: f64 = 1000.0;

/// One axis on a closed path.
struct AxisTurn<'a> {
    nodes: &'a [Command],
    times_s: &'a [f64],
    i: usize,
    closing: f64,
}

impl AxisTurn<'_> {
    fn q(&self, node: usize) -> f64 {
        self.nodes[node][self.i]
    }

    fn follow(&self, axis: &AxisServo, actual: &mut [Command]) {
        let last = self.nodes.len() - 1;
        let tau = match axis.feedforward {
            k if k < 1.0 => axis.lag.value / (1.0 - k),
            _ => 0.0,
        };
        let whole_s = self.times_s[last] - self.times_s[0];
        let turns = (SETTLED * tau / whole_s).ceil().clamp(1.0, MOST_TURNS);
        // Steady at first, which is exact for an axis at constant velocity.
        let speed =
            |k: usize| (self.q(k) - self.q(k - 1)) / (self.times_s[k] - self.times_s[k - 1]);
        let mut motor = self.q(0) - axis.lag.value * speed(1);
        let mut slide = motor;
        let half = 0.5 * axis.lost_motion.value;
        let (mut turned, mut side) = (None::<(f64, f64)>, 0.0);
        let mut turn = 0.0;
        while turn <= turns {
            let is_last = turn + 1.0 > turns;
            for (k, place) in actual.iter_mut().enumerate().skip(1) {
                let (v, step_s) = (speed(k), self.times_s[k] - self.times_s[k - 1]);
                let now_s = turn * whole_s + self.times_s[k];
                // It turns at the node before.
                if v.abs() > REST {
                    if v * side < 0.0 {
                        turned = Some((now_s - step_s, v.signum()));
                    }
                    side = v.signum();
                }
                let steady = self.q(k) - axis.lag.value * v;
                let left = motor - (self.q(k - 1) - axis.lag.value * v);
                let kept = if tau > 0.0 { (-step_s / tau).exp() } else { 0.0 };
                motor = steady + left * kept;
                slide = slide.clamp(motor - half, motor + half);
                if is_last {
                    let stuck = turned.map_or(0.0, |(since_s, towards)| {
                        let age = (now_s - since_s) / axis.friction_time_s.max(1e-12);
                        towards * axis.friction.value * (-age).exp()
                    });
                    place[self.i] = slide - stuck;
                }
            }
            motor -= self.closing;
            slide -= self.closing;
            turn += 1.0;
        }
        actual[0][self.i] = actual[last][self.i] - self.closing;
    }
}

/// The rounding of an inverse is no motion, mm/s or rad/s.
const REST: f64 = 1e-9;

/// `[servo.X] lag = "20 ± 1 ms"` or `gain = 50`, `feedforward`, `lost_motion`, `friction`, `friction_time`.
pub(super) fn read_servo(section: &Section<'_>, machine: &Machine) -> Servo {
    let mut servo = Servo::default();
    for (key, place, item) in section.entries() {
        let name = key.chars().next().filter(|_| key.chars().count() == 1).and_then(BodyName::new);
        let index = name.and_then(|name| machine.axis_index(name));
        let Some(index) = index else {
            let message = format!("the machine has no axis `{key}`");
            section.error_at(place, "unknown-axis", message, &machine.chain_text());
            continue;
        };
        let linear = machine.axes()[index].kind == AxisKind::Linear;
        let of = item.section(&section.path(key), |s| read_axis(s, linear));
        servo.0[index] = of.flatten().unwrap_or_default();
    }
    servo
}

fn read_axis(section: &Section<'_>, linear: bool) -> Option<AxisServo> {
    let own = if linear { Dimension::Length } else { Dimension::Angle };
    let known = |key: &str, of: Dimension| -> Option<Known> {
        let Some(item) = section.get(key) else { return Some(Known::default()) };
        let found = item.measured(of)?;
        if found.value < 0.0 {
            item.error("negative", "this must not be negative".to_owned(), "check its sign");
            return None;
        }
        Some(Known { value: found.value, u: found.u.unwrap_or(0.0) })
    };
    // All keys are read before the first fault counts.
    let feedforward = section.get("feedforward").map_or(Some(0.0), |i| share(&i));
    let lag = known("lag", Dimension::Time);
    let [lost_motion, friction] = ["lost_motion", "friction"].map(|key| known(key, own));
    let (gain, time) = (section.get("gain"), section.get("friction_time"));
    let (feedforward, mut lag) = (feedforward?, lag?);
    if let Some(item) = gain {
        let gain = item.number()?;
        if gain <= 0.0 || section.get("lag").is_some() {
            let message = "a gain is a positive number of 1/s, and stands for a lag".to_owned();
            item.error("bad-gain", message, "either lag = \"20 ms\" or gain = 50");
            return None;
        }
        lag.value = (1.0 - feedforward) / gain;
    }
    if lag.value > LONGEST_LAG_S {
        let message = format!("a lag of {} s is that of no machine", lag.value);
        section.error("bad-gain", message, "lag = \"20 ms\", or gain = 50 (Kv, 1/s)");
        return None;
    }
    let (lost_motion, friction) = (lost_motion?, friction?);
    let friction_time_s = match &time {
        Some(item) => item.quantity(Dimension::Time).filter(|t| *t > 0.0),
        None => Some(0.0),
    };
    if let (Some(item), None) = (&time, friction_time_s) {
        item.error("not-positive", "this must be above zero".to_owned(), "\"30 ms\"");
    }
    if friction.value > 0.0 && time.is_none() {
        let message = "how fast does the axis come free after it turned?".to_owned();
        section.error("missing-key", message, "friction_time = \"30 ms\"");
    }
    let friction_time_s = friction_time_s?;
    Some(AxisServo { lag, feedforward, lost_motion, friction, friction_time_s })
}

/// Kv = 1/s, 0.06 m/min for each mm: no drive is slower.
const LONGEST_LAG_S: f64 = 1.0;

fn share(item: &Item<'_>) -> Option<f64> {
    let k = item.number()?;
    if !(0.0..=1.0).contains(&k) {
        let message = "a feedforward is a part of the velocity, 0 to 1".to_owned();
        item.error("bad-gain", message, "feedforward = 0.9");
        return None;
    }
    Some(k)
}
