//! Pieces of the path with common limits.

use super::element::Segment;
use super::path::{Piece, Reciprocals, curved, straight};
use super::scurve::{Bounds, ramp_length, ramp_time, reach, top_velocity};
use super::{LimitKind, Limiting};

/// No more nodes than this lie in one run.
const MAX_NODES_OF_RUN: usize = 1024;
/// Nor in one run of pieces with the same limits.
const MAX_NODES_OF_LINE: usize = 1 << 14;

/// When a run ends: see [`Run::with`]. Found by trial on the programs of the bench.
const PAYS: f64 = 0.5;
const LONG: f64 = 0.5;
const WEAK: f64 = 0.8;
const ALONE: f64 = 0.1;
/// A long run of so many nodes ends too, so that its times can be handed on.
const ENOUGH_NODES: usize = 16;

/// A stretch of pieces with common limits; the acceleration is zero where two runs meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    /// Place of its begin and end.
    pub from: f64,
    pub to: f64,
    pub bounds: Bounds,
    /// The largest V of its pieces, and the time that they would take with their own V.
    pub fastest: f64,
    pub ideal_s: f64,
    pub velocity: Option<Limiting>,
    pub acceleration_axis: usize,
    pub jerk_axis: usize,
    pub nodes: usize,
    /// Rest at its end, if it ends with a stop.
    pub stop_s: Option<f64>,
    /// The look-ahead's largest velocity at its begin.
    pub allowed: f64,
}

/// Runs in the making.
#[derive(Debug, Default)]
pub(super) struct Chain {
    /// End of the last piece.
    pub planned: f64,
    pub open: Option<Run>,
}

impl Chain {
    /// Adds a piece up to a place: to the open run, or as a new one; hands on a run that ends.
    pub fn add_piece(&mut self, piece: &Piece, to: f64, closed: &mut impl FnMut(Run)) {
        let length = to - self.planned;
        if length <= 0.0 {
            return;
        }
        let single = Run {
            from: self.planned,
            to,
            bounds: piece.bounds,
            fastest: piece.bounds.v,
            ideal_s: length / piece.bounds.v,
            velocity: piece.velocity,
            acceleration_axis: piece.acceleration_axis,
            jerk_axis: piece.jerk_axis,
            nodes: 0,
            stop_s: None,
            allowed: 0.0,
        };
        self.planned = to;
        self.open = Some(match self.open.take() {
            None => single,
            Some(run) => run.with(&single).unwrap_or_else(|| {
                closed(run);
                single
            }),
        });
    }

    /// Adds the rest of a segment that ends at a place, up to another; returns the last piece.
    pub fn add_segment(
        &mut self,
        limits: &Reciprocals,
        segment: &Segment,
        [end, to]: [f64; 2],
        closed: &mut impl FnMut(Run),
    ) -> Piece {
        if segment.is_straight() {
            let line = straight(limits, segment);
            self.add_piece(&line, to, closed);
            return line;
        }
        let parts = &segment.element.parts;
        let mut at = end - segment.length;
        let mut last = None;
        for (k, part) in parts.iter().enumerate() {
            at += part.length;
            let is_last = k + 1 == parts.len();
            let until = if is_last { to } else { at.min(to) };
            if until > self.planned || (last.is_none() && is_last) {
                let piece = curved(limits, part, segment.feed);
                self.add_piece(&piece, until, closed);
                last = Some(piece);
            }
        }
        last.unwrap_or_else(|| straight(limits, segment))
    }
}

/// How long runs take from rest to rest, with a stop where they have one; the limits of [`Run::allowed`]
/// are found on the way.
pub(super) fn duration_s(runs: &mut [Run]) -> f64 {
    let (mut allowed, mut next_v) = (0.0_f64, f64::INFINITY);
    for run in runs.iter_mut().rev() {
        let end = if run.stop_s.is_some() { 0.0 } else { allowed.min(run.bounds.v).min(next_v) };
        allowed = reach(end, run.to - run.from, &run.bounds);
        run.allowed = allowed;
        next_v = run.bounds.v;
    }
    let (mut time_s, mut v) = (0.0, 0.0);
    for k in 0..runs.len() {
        let Run { bounds, stop_s, .. } = runs[k];
        let length = runs[k].to - runs[k].from;
        let next = runs.get(k + 1).map_or(0.0, |next| next.allowed.min(next.bounds.v));
        let end = if stop_s.is_some() { 0.0 } else { next.min(reach(v, length, &bounds)) };
        let top = top_velocity(v, end, length, &bounds);
        let ramps = [(v, top), (top, end)];
        let ramp_s: f64 =
            ramps.iter().map(|(a, b)| ramp_time((b - a).abs(), bounds.a, bounds.j)).sum();
        let rest: f64 =
            length - ramps.iter().map(|(a, b)| ramp_length(*a, *b, &bounds)).sum::<f64>();
        time_s += ramp_s + rest.max(0.0) / top + stop_s.unwrap_or(0.0);
        v = end;
    }
    time_s
}

impl Run {
    /// This run and the next piece as one, unless that costs more time than it saves.
    ///
    /// A run of its own pays if its pieces lose more time by a common velocity than a change of
    /// velocity takes; and a long run is not slowed down by the weak acceleration of a short piece.
    pub fn with(&self, next: &Self) -> Option<Self> {
        let (a, b) = (&self.bounds, &next.bounds);
        let bounds = Bounds { v: a.v.min(b.v), a: a.a.min(b.a), j: a.j.min(b.j) };
        let length = next.to - self.from;
        let ideal_s = self.ideal_s + next.ideal_s;
        let fastest = self.fastest.max(next.fastest);
        let lost_s = length / bounds.v - ideal_s;
        let change_s = ramp_time(self.reachable(next, bounds.v) - bounds.v, bounds.a, bounds.j);
        let long = length > LONG * ramp_length(0.0, bounds.v, &bounds);
        let weaker = bounds.a < WEAK * a.a.max(b.a) || bounds.j < WEAK * a.j.max(b.j);
        // One line in many blocks is still one line.
        let same = [(a.v, b.v), (a.a, b.a), (a.j, b.j)];
        let same = same.iter().all(|(a, b)| (a - b).abs() <= 1e-6 * a);
        let [enough, most] = match same {
            true => [MAX_NODES_OF_LINE; 2],
            false => [ENOUGH_NODES, MAX_NODES_OF_RUN],
        };
        if lost_s > PAYS * change_s + 1e-12 * ideal_s
            || self.is_held_back(next)
            || (long && (weaker || self.nodes >= enough))
            || self.nodes >= most
        {
            return None;
        }
        let weakest = |mine: bool, one: usize, other: usize| if mine { one } else { other };
        Some(Self {
            from: self.from,
            to: next.to,
            bounds,
            fastest,
            ideal_s,
            velocity: if a.v <= b.v { self.velocity } else { next.velocity },
            acceleration_axis: weakest(a.a <= b.a, self.acceleration_axis, next.acceleration_axis),
            jerk_axis: weakest(a.j <= b.j, self.jerk_axis, next.jerk_axis),
            ..*self
        })
    }

    /// The velocity that the faster of the two reaches from v: a short one does not get to its limit.
    fn reachable(&self, next: &Self, v: f64) -> f64 {
        let fast = if self.fastest >= next.fastest { self } else { next };
        if v >= 0.5 * fast.fastest {
            return fast.fastest;
        }
        reach(v, fast.to - fast.from, &Bounds { v: fast.fastest, ..fast.bounds })
    }

    /// The weak acceleration or jerk of one would cost the other much: it is long enough for a
    /// change of velocity of its own.
    fn is_held_back(&self, other: &Self) -> bool {
        let (a, b) = (&self.bounds, &other.bounds);
        let (strong, weak) = if a.j >= b.j { (self, other) } else { (other, self) };
        let v = a.v.min(b.v);
        (weak.bounds.j < WEAK * strong.bounds.j || weak.bounds.a < WEAK * strong.bounds.a)
            && strong.to - strong.from > ALONE * ramp_length(0.0, v, &strong.bounds)
    }

    /// What makes its changes of velocity slow: large ones its acceleration, small ones its jerk.
    pub fn ramp_limit(&self) -> Limiting {
        let Bounds { v, a, j } = self.bounds;
        if v * j >= a * a {
            Limiting { axis: self.acceleration_axis, kind: LimitKind::Acceleration }
        } else {
            Limiting { axis: self.jerk_axis, kind: LimitKind::Jerk }
        }
    }
}
