//! The path of the tip with as many points as a picture needs.

use super::Recording;
use super::columns::RAPID;
use super::detail::from_piece;
use std::collections::BinaryHeap;
use std::ops::RangeInclusive;
use trueaxis_geometry::Vec3;

/// What the colour of a path shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colour {
    /// Length of the deviation of the tip, µm.
    Deviation,
    /// Speed along the path, mm/min.
    Feed,
    /// The largest part of its velocity limit that any axis uses on the path to a node, %:
    /// docs/model.md eq. 158.
    Load,
}

impl Colour {
    /// Its name in text output, and its unit.
    pub fn title(self) -> (&'static str, &'static str) {
        match self {
            Self::Deviation => ("Deviation of the tip", "µm"),
            Self::Feed => ("Speed along the path", "mm/min"),
            Self::Load => ("Largest share of a velocity limit", "%"),
        }
    }
}

/// Points of the path; the columns have one length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PathPoints {
    /// Where the points are counted from, mm, in the workpiece frame.
    pub origin_mm: [f64; 3],
    /// Nominal tip from there.
    pub tip_mm: Vec<[f32; 3]>,
    /// Deviation of the tip.
    pub off_um: Vec<[f32; 3]>,
    /// What the colour shows: the highest value since the point before.
    pub value: Vec<f32>,
    /// It is reached in rapid.
    pub rapid: Vec<bool>,
    /// When it is reached.
    pub time_s: Vec<f64>,
    /// The program of its block.
    pub program: Vec<u32>,
    /// The line of its block.
    pub line: Vec<u32>,
    /// The lowest and the highest value of all nodes of the stretch.
    pub range: [f32; 2],
    /// No node that is left out is farther from the drawn line, mm.
    pub chord_mm: f64,
    /// No node is left out.
    pub is_complete: bool,
}

/// The nodes omitted between two nodes that are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Gap {
    /// The distance of the farthest node from the line, mm, by its bits: they order as it does.
    offset_bits: u64,
    farthest: usize,
    from: usize,
    to: usize,
}

/// First and last point, greatest deviation, lowest and highest value.
const ALWAYS: usize = 5;

impl Recording {
    /// The path between two times, from the node before to the node after it, with at most so many
    /// points (8 at least).
    pub fn path(&self, from_s: f64, to_s: f64, most_points: usize, colour: Colour) -> PathPoints {
        let times = &self.columns.time_s;
        let Some(last) = times.len().checked_sub(1) else { return PathPoints::default() };
        let from = times.partition_point(|t| *t <= from_s).saturating_sub(1);
        let to = times.partition_point(|t| *t < to_s).clamp(from, last);
        let values: Vec<f32> = (from..=to).map(|i| self.colour(colour, i)).collect();
        let low = |a: f32, b: &f32| a.min(*b);
        let high = |a: f32, b: &f32| a.max(*b);
        let range =
            [values.iter().fold(f32::INFINITY, low), values.iter().fold(f32::NEG_INFINITY, high)];
        let (drawn, chord_mm) = self.drawn(from..=to, most_points.max(8), &values);
        let is_complete = drawn.len() == to - from + 1;
        let points = PathPoints { range, chord_mm, is_complete, ..PathPoints::default() };
        self.points(&drawn, &values, points)
    }

    fn colour(&self, colour: Colour, i: usize) -> f32 {
        let columns = &self.columns;
        match colour {
            Colour::Deviation => columns.off(i),
            Colour::Feed => columns.speed[i] * 60.0,
            Colour::Load => {
                let share = |a: usize| columns.axis_speed(a, i).abs() / self.velocities[a];
                (0..columns.axes()).map(share).fold(0.0, f64::max) as f32 * 100.0
            }
        }
    }

    /// The nodes that are drawn, and how far no other is from the line: the extremes, those with the
    /// most detail, and the farthest ones of what these leave out.
    fn drawn(
        &self,
        nodes: RangeInclusive<usize>,
        most: usize,
        values: &[f32],
    ) -> (Vec<usize>, f64) {
        let (from, to) = (*nodes.start(), *nodes.end());
        let count = to - from + 1;
        if count <= most {
            return (nodes.collect(), 0.0);
        }
        let by = |value: &dyn Fn(usize) -> f32| {
            nodes.clone().max_by(|a, b| value(*a).total_cmp(&value(*b))).unwrap_or(from)
        };
        let greatest = by(&|i| self.columns.off(i));
        let [lowest, highest] = [by(&|i| -values[i - from]), by(&|i| values[i - from])];
        let always = [from, to, greatest, lowest, highest];
        let mut sorted = self.detail[from..=to].to_vec();
        let place = (most - ALWAYS) * 3 / 4;
        let (_, threshold, _) = sorted.select_nth_unstable_by(place, |a, b| b.total_cmp(a));
        let threshold = *threshold;
        let drawn = nodes.filter(|i| self.detail[*i] > threshold || always.contains(i));
        self.filled(drawn.collect(), most)
    }

    /// With the farthest nodes that are left out, as long as there is room.
    fn filled(&self, mut drawn: Vec<usize>, most: usize) -> (Vec<usize>, f64) {
        let mut gaps: BinaryHeap<Gap> =
            drawn.windows(2).map(|pair| self.gap(pair[0], pair[1])).collect();
        // However uneven the gaps are, this takes no longer than a few passes over the path.
        let mut work = 4 * drawn.last().map_or(0, |last| last - drawn[0]);
        while let Some(gap) = gaps.peek().copied().filter(|gap| gap.offset_bits > 0) {
            let length = gap.to - gap.from;
            if drawn.len() >= most || work < length {
                break;
            }
            work -= length;
            gaps.pop();
            drawn.push(gap.farthest);
            gaps.extend([self.gap(gap.from, gap.farthest), self.gap(gap.farthest, gap.to)]);
        }
        drawn.sort_unstable();
        (drawn, gaps.peek().map_or(0.0, |gap| f64::from_bits(gap.offset_bits)))
    }

    fn gap(&self, from: usize, to: usize) -> Gap {
        let tip = |i: usize| Vec3::from(self.columns.tip_mm[i]);
        let (a, b) = (tip(from), tip(to));
        let offset = |i: usize| (from_piece(tip(i), a, b).0.to_bits(), i);
        let (offset_bits, farthest) = (from + 1..to).map(offset).max().unwrap_or((0, from));
        Gap { offset_bits, farthest, from, to }
    }

    fn points(&self, drawn: &[usize], values: &[f32], mut points: PathPoints) -> PathPoints {
        let columns = &self.columns;
        let tip = |i: usize| Vec3::from(columns.tip_mm[i]);
        let (first, origin) = (drawn[0], tip(drawn[0]));
        let mut before = first;
        for i in drawn.iter().copied() {
            let since = if i == first { first } else { before + 1 };
            let values = &values[since - first..=i - first];
            points.value.push(values.iter().copied().fold(f32::NEG_INFINITY, f32::max));
            let from_origin = tip(i) - origin;
            points.tip_mm.push([from_origin.x, from_origin.y, from_origin.z].map(|x| x as f32));
            points.off_um.push(columns.off_um[i]);
            points.rapid.push(columns.flags[i] & RAPID != 0);
            points.time_s.push(columns.time_s[i]);
            points.program.push(columns.program[i]);
            points.line.push(columns.line[i]);
            before = i;
        }
        points.origin_mm = origin.into();
        points
    }
}
