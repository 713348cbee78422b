//! Curves over time for pictures, in bounded memory: lowest and highest value per stretch of time.

use super::{Batch, Observer};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};

/// Stretches of time; when they are full, two become one.
const BUCKETS: usize = 2048;

/// Points of the tip that are kept for the picture of the path.
const POINTS: usize = 8192;

/// One curve: lowest and highest value in each stretch.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What it is.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Lowest and highest value of each stretch; an empty stretch is (∞, −∞).
    pub buckets: Vec<(f64, f64)>,
}

/// A place of the tip for the picture of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Nominal tip in the workpiece frame, mm.
    pub tip_mm: Vec3,
    /// Length of its deviation, mm.
    pub off_mm: f64,
    /// It is reached in rapid.
    pub rapid: bool,
}

/// Curves over time and points along the path.
#[derive(Debug, Clone)]
pub struct Series {
    axes: Vec<AxisKind>,
    /// Length of a stretch, s.
    pub stretch_s: f64,
    /// The axes, then speed, then the deviations.
    pub curves: Vec<Curve>,
    /// Evenly thinned.
    pub points: Vec<PathPoint>,
    keep_every: u64,
    seen: u64,
    before: Option<(f64, Command)>,
}

impl Series {
    /// Empty curves for a machine: positions, speeds of the axes, speed of the path, deviations.
    pub fn of(machine: &Machine) -> Self {
        let mut curves = Vec::new();
        let mut add = |name: String, unit| {
            curves.push(Curve { name, unit, buckets: Vec::new() });
        };
        for axis in machine.axes() {
            let rotary = axis.kind == AxisKind::Rotary;
            add(axis.name.to_string(), if rotary { "deg" } else { "mm" });
        }
        for axis in machine.axes() {
            let rotary = axis.kind == AxisKind::Rotary;
            add(axis.name.to_string(), if rotary { "deg/s" } else { "mm/s" });
        }
        add("speed along the path".into(), "mm/min");
        add("tip".into(), "µm");
        add("feed".into(), "µm");
        add("normal".into(), "µm");
        add("binormal".into(), "µm");
        add("tool axis".into(), "µrad");
        Self {
            axes: machine.axes().iter().map(|a| a.kind).collect(),
            stretch_s: 1e-3,
            curves,
            points: Vec::new(),
            keep_every: 1,
            seen: 0,
            before: None,
        }
    }

    fn put(&mut self, curve: usize, time_s: f64, value: f64) {
        let mut index = (time_s / self.stretch_s) as usize;
        while index >= BUCKETS {
            self.halve();
            index = (time_s / self.stretch_s) as usize;
        }
        let buckets = &mut self.curves[curve].buckets;
        if buckets.len() <= index {
            buckets.resize(index + 1, (f64::INFINITY, f64::NEG_INFINITY));
        }
        let (low, high) = &mut buckets[index];
        (*low, *high) = (low.min(value), high.max(value));
    }

    fn halve(&mut self) {
        self.stretch_s *= 2.0;
        for curve in &mut self.curves {
            let joined = |pair: &[(f64, f64)]| {
                pair.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), (low, high)| {
                    (l.min(*low), h.max(*high))
                })
            };
            curve.buckets = curve.buckets.chunks(2).map(joined).collect();
        }
    }

    fn point(&mut self, point: PathPoint) {
        if self.seen.is_multiple_of(self.keep_every) {
            self.points.push(point);
        }
        self.seen += 1;
        if self.points.len() >= POINTS {
            let mut keep = false;
            self.points.retain(|_| {
                keep = !keep;
                keep
            });
            self.keep_every *= 2;
        }
    }
}

impl Observer for Series {
    fn path(&mut self, batch: &Batch<'_>) {
        let axes = self.axes.len();
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            let time_s = stamp.time_s;
            for axis in 0..axes {
                let shown = |value: f64| match self.axes[axis] {
                    AxisKind::Linear => value,
                    AxisKind::Rotary => value.to_degrees(),
                };
                let position = shown(node.command[axis]);
                let speed = self
                    .before
                    .filter(|(t, _)| time_s > *t)
                    .map(|(t, before)| shown(node.command[axis] - before[axis]) / (time_s - t));
                self.put(axis, time_s, position);
                if let Some(speed) = speed {
                    self.put(axes + axis, time_s, speed);
                }
            }
            self.before = Some((time_s, node.command));
            let deviation = batch.deviation(i);
            let (off_mm, along) = (deviation.tip_mm.norm(), batch.along_path_mm[i]);
            self.put(2 * axes, time_s, stamp.speed * 60.0);
            let values = [off_mm, along.x, along.y, along.z].map(|v| v * 1e3);
            for (k, value) in values.into_iter().enumerate() {
                self.put(2 * axes + 1 + k, time_s, value);
            }
            self.put(2 * axes + 5, time_s, deviation.axis.norm() * 1e6);
            let tip_mm = deviation.nominal_tip.vector();
            self.point(PathPoint { tip_mm, off_mm, rapid: node.is_rapid() });
        }
    }
}
