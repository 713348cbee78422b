//! The results of a run: time, path, extents and the worst deviations.

use super::{Batch, Node, Observer, STILL};
use std::collections::BTreeMap;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_nc::moves::{Event, Origin, Step};

/// The largest value, and where it occurs.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Worst {
    /// The value. Unit: mm, rad, mm/s or rad/s, by its use.
    pub value: f64,
    /// The block.
    pub origin: Origin,
    /// When, s.
    pub time_s: f64,
}

impl Worst {
    pub(super) fn see(&mut self, value: f64, origin: Origin, time_s: f64) {
        if value.abs() > self.value.abs() {
            *self = Self { value, origin, time_s };
        }
    }
}

/// The motion of one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisUse {
    /// The lowest position. Unit: mm or rad.
    pub lowest: f64,
    /// The highest position. Unit: mm or rad.
    pub highest: f64,
    /// The distance that it travels. Unit: mm or rad.
    pub travelled: f64,
    /// How often it changes its direction.
    pub reversals: u64,
    /// The mean speed of its fastest piece of path, mm/s or rad/s.
    pub fastest: Worst,
}

/// How much a tool was used: with feed, neither in rapid nor waiting.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToolUse {
    /// Time, s.
    pub feed_s: f64,
    /// Path of the tip in the workpiece, mm.
    pub feed_mm: f64,
}

/// Where an axis changes its direction: there backlash and friction show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reversal {
    /// Its index.
    pub axis: usize,
    /// Its position. Unit: mm or rad.
    pub at: f64,
    /// The block that turns back.
    pub origin: Origin,
    /// When, s.
    pub time_s: f64,
}

/// Reversals that are kept, the first ones.
const MOST_REVERSALS: usize = 1000;

/// The results of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// The whole time, s.
    pub time_s: f64,
    /// Of it in rapid, s.
    pub rapid_s: f64,
    /// Of it waiting, s.
    pub dwell_s: f64,
    /// The path of the tip in the workpiece with feed, mm.
    pub feed_mm: f64,
    /// The same in rapid, mm.
    pub rapid_mm: f64,
    /// Nodes of the path.
    pub nodes: u64,
    /// Moves of the program.
    pub moves: u64,
    /// Axis by axis, in the order of the machine.
    pub axes: Vec<AxisUse>,
    /// Length of the deviation of the tip, mm.
    pub tip: Worst,
    /// Length of the deviation of the tool axis, rad.
    pub axis: Worst,
    /// Deviation of the tip along feed, normal and binormal, mm.
    pub along_path: [Worst; 3],
    /// The same two while the tool feeds, not in rapid.
    pub feed_tip: Worst,
    /// The tool axis while the tool feeds.
    pub feed_axis: Worst,
    /// √ of the mean square of the deviation of the tip over the nodes with feed, mm.
    pub feed_tip_rms_mm: f64,
    /// Smallest and largest coordinates of the nominal tip while the tool feeds, mm, in the
    /// workpiece frame; `None` if it never does.
    pub cut_box_mm: Option<[Vec3; 2]>,
    /// How many moves each tool makes.
    pub tools: BTreeMap<u32, u64>,
    /// How long and how far each tool moves with feed.
    pub tool_use: BTreeMap<u32, ToolUse>,
    /// The first reversals of all axes, in order.
    pub reversals: Vec<Reversal>,
    /// Messages of the program to the operator.
    pub messages: Vec<String>,
    /// Stops in the program, optional ones not counted.
    pub stops: u64,
    sum_squares: f64,
    feed_nodes: u64,
    before: Option<Before>,
    rotary: Vec<bool>,
    turning: Vec<Turning>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Before {
    command: Command,
    tip: Vec3,
    time_s: f64,
}

/// A wiggle below this is rounding of the program, not a reversal: 1 µm, 0.001°.
fn band(rotary: bool) -> f64 {
    if rotary { 1e-3_f64.to_radians() } else { 1e-3 }
}

/// Follows an axis to find where it actually reverses.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Turning {
    /// +1 rising, −1 falling, 0 not moved yet.
    direction: f64,
    /// The farthest place in that direction, and when and where it was.
    farthest: f64,
    origin: Origin,
    time_s: f64,
}

impl Turning {
    fn begin(at: f64) -> Self {
        Self { farthest: at, ..Self::default() }
    }

    /// Goes on to `q`; calls back if the axis has turned by more than `band`.
    fn go(
        &mut self,
        q: f64,
        band: f64,
        found: impl FnOnce(f64, Origin, f64),
        origin: Origin,
        time_s: f64,
    ) {
        let ahead = (q - self.farthest) * self.direction;
        // At rest the place is rounded otherwise at every node: the axis turns where it came to rest.
        if self.direction != 0.0 && (-band..=STILL).contains(&ahead) {
            return;
        }
        if self.direction == 0.0 {
            if (q - self.farthest).abs() <= band {
                return;
            }
            self.direction = (q - self.farthest).signum();
        } else if ahead < 0.0 {
            found(self.farthest, self.origin, self.time_s);
            self.direction = -self.direction;
        }
        (self.farthest, self.origin, self.time_s) = (q, origin, time_s);
    }
}

/// Messages that are kept.
const MOST_MESSAGES: usize = 100;

impl Summary {
    /// Empty, for a machine.
    pub fn of(machine: &Machine) -> Self {
        let unused = AxisUse {
            lowest: f64::INFINITY,
            highest: f64::NEG_INFINITY,
            travelled: 0.0,
            reversals: 0,
            fastest: Worst::default(),
        };
        Self {
            time_s: 0.0,
            rapid_s: 0.0,
            dwell_s: 0.0,
            feed_mm: 0.0,
            rapid_mm: 0.0,
            nodes: 0,
            moves: 0,
            axes: vec![unused; machine.axes().len()],
            tip: Worst::default(),
            axis: Worst::default(),
            along_path: Default::default(),
            feed_tip: Worst::default(),
            feed_axis: Worst::default(),
            feed_tip_rms_mm: 0.0,
            cut_box_mm: None,
            tools: BTreeMap::new(),
            tool_use: BTreeMap::new(),
            reversals: Vec::new(),
            messages: Vec::new(),
            stops: 0,
            sum_squares: 0.0,
            feed_nodes: 0,
            before: None,
            rotary: machine.axes().iter().map(|a| a.kind == AxisKind::Rotary).collect(),
            turning: vec![Turning::default(); machine.axes().len()],
        }
    }

    fn see_axes(&mut self, node: &Node, time_s: f64) {
        for (i, axis) in self.axes.iter_mut().enumerate() {
            let q = node.command[i];
            (axis.lowest, axis.highest) = (axis.lowest.min(q), axis.highest.max(q));
            let Some(before) = &self.before else {
                self.turning[i] = Turning::begin(q);
                continue;
            };
            let by = q - before.command[i];
            axis.travelled += by.abs();
            self.turning[i].go(
                q,
                band(self.rotary[i]),
                |at, origin, time_s| {
                    axis.reversals += 1;
                    if self.reversals.len() < MOST_REVERSALS {
                        self.reversals.push(Reversal { axis: i, at, origin, time_s });
                    }
                },
                node.origin,
                time_s,
            );
            if time_s > before.time_s {
                axis.fastest.see(by / (time_s - before.time_s), node.origin, time_s);
            }
        }
    }

    fn see_way(&mut self, node: &Node, tip: Vec3, time_s: f64, tool: u32) {
        let (moved, took_s) = match &self.before {
            Some(before) => ((tip - before.tip).norm(), time_s - before.time_s),
            None => (0.0, time_s),
        };
        self.dwell_s += node.dwell_s;
        if node.is_rapid() {
            self.rapid_mm += moved;
            self.rapid_s += took_s - node.dwell_s;
        } else {
            self.feed_mm += moved;
            let used = self.tool_use.entry(tool).or_default();
            used.feed_mm += moved;
            used.feed_s += (took_s - node.dwell_s).max(0.0);
        }
        self.time_s = time_s;
    }
}

impl Observer for Summary {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            let deviation = batch.deviation(i);
            let tip = deviation.nominal_tip.vector();
            let (origin, time_s) = (node.origin, stamp.time_s);
            self.see_axes(node, time_s);
            self.see_way(node, tip, time_s, batch.tool);
            let before = self.before.map_or(tip, |b| b.tip);
            self.before = Some(Before { command: node.command, tip, time_s });
            let (off_mm, off_rad) = (deviation.tip_mm.norm(), deviation.axis.norm());
            self.tip.see(off_mm, origin, time_s);
            self.axis.see(off_rad, origin, time_s);
            self.nodes += 1;
            if node.last {
                self.moves += 1;
                *self.tools.entry(batch.tool).or_default() += 1;
            }
            if node.is_rapid() {
                continue;
            }
            for (worst, value) in self.along_path.iter_mut().zip(batch.along_path_mm[i].iter()) {
                worst.see(*value, origin, time_s);
            }
            self.feed_tip.see(off_mm, origin, time_s);
            self.feed_axis.see(off_rad, origin, time_s);
            self.feed_nodes += 1;
            self.sum_squares += off_mm * off_mm;
            let [low, high] = self.cut_box_mm.get_or_insert([tip, tip]);
            (*low, *high) = (low.inf(&tip).inf(&before), high.sup(&tip).sup(&before));
        }
        if self.feed_nodes > 0 {
            self.feed_tip_rms_mm = (self.sum_squares / self.feed_nodes as f64).sqrt();
        }
    }

    fn step(&mut self, step: &Step) {
        match step {
            Step::Event(Event::Message(text), _) if self.messages.len() < MOST_MESSAGES => {
                self.messages.push(text.clone());
            }
            Step::Event(Event::Stop { optional: false }, _) => self.stops += 1,
            _ => {}
        }
    }
}

/// A position or speed of an axis in the units of text output: mm or degrees.
pub fn shown(machine: &Machine, axis: usize, value: f64) -> f64 {
    let shown = match machine.axes()[axis].kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => value.to_degrees(),
    };
    shown + 0.0 // no minus before a zero
}

/// The unit of an axis in text output.
pub fn unit(machine: &Machine, axis: usize) -> &'static str {
    match machine.axes()[axis].kind {
        AxisKind::Linear => "mm",
        AxisKind::Rotary => "deg",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where and when an axis turns on its way through places, a second apart.
    fn turns(places: &[f64]) -> Vec<(f64, f64)> {
        let mut turning = Turning::begin(places[0]);
        let mut all = Vec::new();
        for (k, q) in places.iter().enumerate() {
            let found = |at: f64, _, time_s: f64| all.push((at, time_s));
            turning.go(*q, 1e-3, found, Origin::default(), k as f64);
        }
        all
    }

    /// An axis comes to rest at 5, and its place is rounded upwards or downwards while it stands: it turns where it came to rest.
    #[test]
    fn law_rounding_at_rest_does_not_move_a_turn() {
        for noise in [0.0, 1e-14, -1e-14, 1e-9] {
            let places = [0.0, 2.0, 5.0, 5.0 + noise, 5.0 + 2.0 * noise, 3.0, 4.0];
            assert_eq!(turns(&places), [(5.0, 2.0), (3.0, 5.0)], "{noise}");
        }
    }

    /// An axis that creeps on below what counts as a motion is followed all the same.
    #[test]
    fn a_creeping_axis_is_followed() {
        let mut places: Vec<f64> = (0..1000).map(|k| 1.0 + 4e-8 * f64::from(k)).collect();
        places.insert(0, 0.0);
        places.push(0.5);
        let [(at, time_s)] = turns(&places)[..] else { panic!("one turn") };
        assert!((at - places[1000]).abs() <= 1e-7 && time_s > 995.0, "{at} {time_s}");
    }
}
