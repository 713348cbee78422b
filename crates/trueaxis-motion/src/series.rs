//! Curves over time and the path of the tip for pictures, in bounded memory.
//!
//! Each stretch of time keeps the lowest and the highest value, so that a short peak stays visible
//! however long the program is. Between two nodes positions and deviations go straight, and axes
//! keep their mean speed.

use super::{Batch, Observer};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};

/// Stretches of time; when they are full, two become one.
const STRETCHES: usize = 2048;

/// Points of the tip that are kept for the picture of the path.
const POINTS: usize = 100_000;

/// Positions, then speeds of the axes, then speed of the path and five deviations.
const COLUMNS: usize = 2 * MAX_AXES + 6;

/// The quantity of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Position of an axis (its index), mm or deg.
    Position(usize),
    /// Speed of an axis (its index), mm/s or deg/s.
    AxisSpeed(usize),
    /// Speed along the path, mm/min; deg/min where only rotary axes move.
    PathSpeed,
    /// Length of the deviation of the tip, µm.
    Tip,
    /// Deviation of the tip along the feed, µm.
    Feed,
    /// Deviation of the tip along the normal, µm.
    Normal,
    /// Deviation of the tip along the binormal, µm.
    Binormal,
    /// Deviation of the tool axis, µrad.
    ToolAxis,
}

impl Quantity {
    fn column(self) -> usize {
        match self {
            Self::Position(axis) => axis,
            Self::AxisSpeed(axis) => MAX_AXES + axis,
            Self::PathSpeed => 2 * MAX_AXES,
            Self::Tip => 2 * MAX_AXES + 1,
            Self::Feed => 2 * MAX_AXES + 2,
            Self::Normal => 2 * MAX_AXES + 3,
            Self::Binormal => 2 * MAX_AXES + 4,
            Self::ToolAxis => 2 * MAX_AXES + 5,
        }
    }
}

/// A place of the tip for the picture of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Nominal tip in the workpiece frame, mm.
    pub tip_mm: Vec3,
    /// Greatest length of its deviation since the point before, mm.
    pub off_mm: f64,
    /// It is reached in rapid.
    pub rapid: bool,
}

type Row = [f64; COLUMNS];

/// Lowest and highest value of every quantity in a stretch of time.
#[derive(Debug, Clone, Copy)]
struct Extent {
    low: Row,
    high: Row,
}

impl Extent {
    const NONE: Self = Self { low: [f64::INFINITY; COLUMNS], high: [f64::NEG_INFINITY; COLUMNS] };

    fn see(&mut self, row: &Row) {
        let extents = self.low.iter_mut().zip(&mut self.high);
        for ((low, high), value) in extents.zip(row) {
            // Comparisons, not min and max: these lines become vector instructions.
            *low = if *value < *low { *value } else { *low };
            *high = if *value > *high { *value } else { *high };
        }
    }

    fn join(mut self, other: &Self) -> Self {
        for i in 0..COLUMNS {
            self.low[i] = self.low[i].min(other.low[i]);
            self.high[i] = self.high[i].max(other.high[i]);
        }
        self
    }
}

/// Curves over time and points along the path.
#[derive(Debug, Clone)]
pub struct Series {
    /// From mm and rad to what is shown.
    scale: Command,
    axes: usize,
    stretch_s: f64,
    stretches: Vec<Extent>,
    time_s: f64,
    before: Option<Row>,
    path: TipPath,
}

impl Series {
    /// Empty curves for a machine.
    pub fn of(machine: &Machine) -> Self {
        let mut scale = [1.0; MAX_AXES];
        for (scale, axis) in scale.iter_mut().zip(machine.axes()) {
            if axis.kind == AxisKind::Rotary {
                *scale = 180.0 / std::f64::consts::PI;
            }
        }
        Self {
            scale,
            axes: machine.axes().len(),
            stretch_s: 1e-3,
            stretches: Vec::new(),
            time_s: 0.0,
            before: None,
            path: TipPath::default(),
        }
    }

    /// The curve of a quantity: middle of the stretch of time (s), lowest and highest value.
    /// A stretch without values is left out.
    pub fn curve(&self, of: Quantity) -> impl Iterator<Item = (f64, f64, f64)> {
        let column = of.column();
        self.stretches.iter().enumerate().filter_map(move |(i, extent)| {
            let (low, high) = (extent.low[column], extent.high[column]);
            (low <= high).then_some(((i as f64 + 0.5) * self.stretch_s, low, high))
        })
    }

    /// Length of a stretch of time, s.
    pub fn stretch_s(&self) -> f64 {
        self.stretch_s
    }

    /// The path of the tip, thinned where it is straight and its deviation even.
    pub fn points(&self) -> &[PathPoint] {
        &self.path.points
    }

    /// The stretch of a time, made if it is not there yet.
    fn stretch(&mut self, time_s: f64) -> usize {
        // Also for a time that is no number: the cast gives 0.
        let mut index = (time_s / self.stretch_s) as usize;
        while index >= STRETCHES {
            self.halve();
            index = (time_s / self.stretch_s) as usize;
        }
        if self.stretches.len() <= index {
            self.stretches.resize(index + 1, Extent::NONE);
        }
        index
    }

    fn halve(&mut self) {
        self.stretch_s *= 2.0;
        let joined = |pair: &[Extent]| pair[1..].iter().fold(pair[0], |whole, e| whole.join(e));
        self.stretches = self.stretches.chunks(2).map(joined).collect();
    }

    /// From the row before straight to this one; the speeds of the axes are constant in between.
    fn advance(&mut self, time_s: f64, row: &Row) {
        let to = self.stretch(time_s);
        let Some(before) = self.before.replace(*row) else {
            self.time_s = time_s;
            return self.stretches[to].see(row);
        };
        let (from_s, from) = (self.time_s, self.stretch(self.time_s));
        self.time_s = time_s;
        for index in from..to {
            let edge_s = (index + 1) as f64 * self.stretch_s;
            let part = ((edge_s - from_s) / (time_s - from_s)).clamp(0.0, 1.0);
            let mut at: Row = std::array::from_fn(|i| before[i] + part * (row[i] - before[i]));
            at[MAX_AXES..2 * MAX_AXES].copy_from_slice(&row[MAX_AXES..2 * MAX_AXES]);
            self.stretches[index].see(&at);
            self.stretches[index + 1].see(&at);
        }
        self.stretches[to].see(row);
    }

    /// The row of a node that is reached at a time; axes at rest have no speed.
    fn row(&self, batch: &Batch<'_>, i: usize, reached_s: f64) -> (Row, PathPoint) {
        let (node, deviation) = (&batch.nodes[i], batch.deviation(i));
        let mut row = [0.0; COLUMNS];
        let positions = node.command.iter().zip(&self.scale).take(self.axes);
        for (value, (q, scale)) in row.iter_mut().zip(positions) {
            *value = q * scale;
        }
        if let Some(before) = &self.before
            && reached_s > self.time_s
        {
            for axis in 0..self.axes {
                row[MAX_AXES + axis] = (row[axis] - before[axis]) / (reached_s - self.time_s);
            }
        }
        let (off_mm, along) = (deviation.tip_mm.norm(), &batch.along_path_mm[i]);
        row[2 * MAX_AXES] = batch.stamps[i].speed * 60.0;
        for (value, mm) in
            row[2 * MAX_AXES + 1..].iter_mut().zip([off_mm, along.x, along.y, along.z])
        {
            *value = mm * 1e3;
        }
        row[COLUMNS - 1] = deviation.axis.norm() * 1e6;
        let tip_mm = deviation.nominal_tip.vector();
        (row, PathPoint { tip_mm, off_mm, rapid: node.is_rapid() })
    }
}

impl Observer for Series {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            let reached_s = stamp.time_s - node.dwell_s;
            let (mut row, point) = self.row(batch, i, reached_s);
            if node.dwell_s > 0.0 {
                row[2 * MAX_AXES] = 0.0;
            }
            self.advance(reached_s, &row);
            if node.dwell_s > 0.0 {
                row[MAX_AXES..2 * MAX_AXES].fill(0.0);
                self.advance(stamp.time_s, &row);
            }
            self.path.add(point);
        }
    }
}

/// The path of the tip; when it has too many points, coarser differences are left out.
#[derive(Debug, Clone)]
struct TipPath {
    points: Vec<PathPoint>,
    /// How far a left-out point may lie from the path, mm.
    tolerance_mm: f64,
    /// How much the deviation may differ from that at the point before, as a part of the range.
    even: f64,
    /// The least and the greatest deviation with feed.
    range_mm: [f64; 2],
    extent_mm: Option<[Vec3; 2]>,
    /// Where nothing can be left out any more only every so many pairs of points are kept.
    stride: u64,
    pushed: u64,
    /// The last point is not needed if the next one lies in this direction from the one before it.
    direction: Option<Vec3>,
}

impl Default for TipPath {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            tolerance_mm: 1e-3,
            even: 0.04,
            range_mm: [f64::INFINITY, 0.0],
            extent_mm: None,
            stride: 1,
            pushed: 0,
            direction: None,
        }
    }
}

impl TipPath {
    fn add(&mut self, point: PathPoint) {
        if !point.rapid {
            let [least, greatest] = self.range_mm;
            self.range_mm = [least.min(point.off_mm), greatest.max(point.off_mm)];
        }
        let [low, high] = self.extent_mm.get_or_insert([point.tip_mm; 2]);
        (*low, *high) = (low.inf(&point.tip_mm), high.sup(&point.tip_mm));
        let coarsest_mm = (*high - *low).norm() / 200.0;
        self.place(point);
        while self.points.len() >= POINTS && self.tolerance_mm < coarsest_mm {
            self.coarsen();
        }
        if self.points.len() >= POINTS {
            // Tens of thousands of holes: nothing but turns between feed and rapid, in pairs.
            self.stride *= 2;
            let mut i = 0;
            self.points.retain(|_| {
                i += 1;
                i % 4 < 2
            });
        }
    }

    fn coarsen(&mut self) {
        self.tolerance_mm *= 2.0;
        self.even = (self.even * 1.25).min(0.08);
        self.direction = None;
        let all = std::mem::take(&mut self.points);
        self.points.reserve(POINTS);
        // These have been chosen before.
        let stride = std::mem::replace(&mut self.stride, 1);
        all.into_iter().for_each(|point| self.place(point));
        self.stride = stride;
    }

    /// Appends a point, or moves the last one on to it where the path goes straight on.
    fn place(&mut self, point: PathPoint) {
        let [.., anchor, last] = &mut self.points[..] else {
            let first = self.points.last().map(|first| point.tip_mm - first.tip_mm);
            self.direction = first.and_then(|on| on.try_normalize(self.tolerance_mm));
            return self.points.push(point);
        };
        let (chord, on) = (point.tip_mm - anchor.tip_mm, point.tip_mm - last.tip_mm);
        let even =
            (point.off_mm - last.off_mm).abs() <= self.even * (self.range_mm[1] - self.range_mm[0]);
        let straight = match &self.direction {
            // Too near the anchor to have a direction yet.
            None => chord.norm() <= self.tolerance_mm,
            Some(along) => {
                let offset = (chord - along * chord.dot(along)).norm();
                offset <= self.tolerance_mm && on.dot(along) >= -self.tolerance_mm
            }
        };
        if straight && even && point.rapid == last.rapid {
            last.tip_mm = point.tip_mm;
            last.off_mm = last.off_mm.max(point.off_mm);
            return;
        }
        self.pushed += 1;
        if !(self.pushed / 2).is_multiple_of(self.stride) {
            return;
        }
        // The ray of the new piece begins at what was the last point.
        self.direction = on.try_normalize(self.tolerance_mm);
        self.points.push(point);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(axes: usize) -> Series {
        Series {
            scale: [1.0; MAX_AXES],
            axes,
            stretch_s: 1e-3,
            stretches: Vec::new(),
            time_s: 0.0,
            before: None,
            path: TipPath::default(),
        }
    }

    fn point(x: f64, y: f64, off_mm: f64) -> PathPoint {
        PathPoint { tip_mm: Vec3::new(x, y, 0.0), off_mm, rapid: false }
    }

    #[test]
    fn a_peak_of_a_millisecond_survives_an_hour() {
        let mut series = series(1);
        for k in 0..3_600_000_u32 {
            let mut row = [0.0; COLUMNS];
            row[0] = if k == 1_234_567 { 7.0 } else { 1.0 };
            series.advance(f64::from(k) * 1e-3, &row);
        }
        assert!(series.stretches.len() <= STRETCHES);
        let curve: Vec<_> = series.curve(Quantity::Position(0)).collect();
        let peaks: Vec<_> = curve.iter().filter(|(.., high)| *high == 7.0).collect();
        assert!(peaks.iter().any(|(t, ..)| (t - 1234.567).abs() < series.stretch_s()));
        assert!(peaks.len() <= 2 && curve.iter().all(|(_, low, _)| *low == 1.0));
    }

    #[test]
    fn between_two_nodes_the_curve_is_a_line_and_the_speed_holds() {
        let mut series = series(1);
        series.advance(0.0, &[0.0; COLUMNS]);
        let mut row = [0.0; COLUMNS];
        (row[0], row[MAX_AXES]) = (8.0, 8.0);
        series.advance(1.0, &row);
        for (t, low, high) in series.curve(Quantity::Position(0)) {
            assert!((0.5 * (low + high) - 8.0 * t).abs() < 8.0 * series.stretch_s());
        }
        // In the first stretch the axis is also at rest.
        assert!(series.curve(Quantity::AxisSpeed(0)).skip(1).all(|(_, l, h)| (l, h) == (8.0, 8.0)));
        assert_eq!(series.curve(Quantity::Position(0)).count(), series.stretches.len());
        // Also where stretches were joined that had nothing yet.
        (row[0], row[MAX_AXES]) = (80.0, 8.0);
        series.advance(10.0, &row);
        for (t, low, high) in series.curve(Quantity::Position(0)) {
            assert!((0.5 * (low + high) - 8.0 * t).abs() < 8.0 * series.stretch_s());
        }
    }

    #[test]
    fn straight_ways_are_thinned_corners_and_uneven_deviations_stay() {
        let mut chord = TipPath::default();
        for k in 0..=1000 {
            chord.add(point(f64::from(k), 0.0, 0.01));
        }
        (1..=1000).for_each(|k| chord.add(point(1000.0, f64::from(k), 0.01)));
        chord.add(point(1000.0, 1001.0, 0.05));
        let kept: Vec<_> = chord.points.iter().map(|p| (p.tip_mm.x, p.tip_mm.y)).collect();
        assert_eq!(kept, [(0.0, 0.0), (1000.0, 0.0), (1000.0, 1000.0), (1000.0, 1001.0)]);
    }

    #[test]
    fn a_wild_way_stays_bounded() {
        let mut chord = TipPath::default();
        for k in 0..1_000_000_u32 {
            let wild = f64::from(k.wrapping_mul(2_654_435_769) >> 8);
            let rapid = k % 2 == 0;
            chord.add(PathPoint { rapid, ..point(wild, f64::from(k), wild) });
        }
        assert!(chord.points.len() < POINTS && chord.points.len() > POINTS / 8);
    }
}
