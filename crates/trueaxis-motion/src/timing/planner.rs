//! Runs, look-ahead and time stamps; bounded memory, constant work per node.

use super::element::{Element, Segment};
use super::joint::{Passage, passage};
use super::path::{Piece, Reciprocals, curved, straight};
use super::scurve::{Bounds, Phases, ramp_length, ramp_time, reach, time_at};
use super::{AxisLimits, LimitKind, Limiting, Node, Phase, Receive, Timed, TimingError};
use std::collections::VecDeque;

/// At least and at most so many runs are looked ahead.
const WINDOW: std::ops::RangeInclusive<usize> = 64..=4096;
/// No more nodes than this wait for their time.
const MAX_WAITING: usize = 1 << 16;
/// Lengths below this part of the whole path drown in its rounding.
const RESOLUTION: f64 = 1e-13;
/// No more nodes than this lie in one run.
const MAX_NODES_OF_RUN: usize = 1024;
/// Nor in one run of pieces with the same limits.
const MAX_NODES_OF_LINE: usize = 1 << 14;

/// When a run ends: see [`Run::with`]. Found by trial on the programs of the bench.
const PAYS: f64 = 0.5;
const LONG: f64 = 0.5;
const WEAK: f64 = 0.8;
/// A long run of so many nodes ends too, so that its times can be handed on.
const ENOUGH_NODES: usize = 16;

/// A stretch of pieces with common limits; the acceleration is zero where two runs meet.
#[derive(Debug, Clone, Copy)]
struct Run {
    /// Place of its begin and end.
    from: f64,
    to: f64,
    bounds: Bounds,
    /// The largest V of its pieces, and the time that they would take with their own V.
    fastest: f64,
    ideal_s: f64,
    velocity: Option<Limiting>,
    acceleration_axis: usize,
    jerk_axis: usize,
    nodes: usize,
    /// Rest at its end, if it ends with a stop.
    stop_s: Option<f64>,
    /// The look-ahead's largest velocity at its begin.
    allowed: f64,
}

/// A node that waits for its time.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    sigma: f64,
    blend: f64,
    feed: f64,
    /// Velocity limit of its piece and who makes it.
    velocity: f64,
    why: Option<Limiting>,
}

/// Gives every node of a stream its time: jerk-limited, with look-ahead.
///
/// The motion rests at the first and at the last node.
#[derive(Debug)]
pub struct Planner {
    limits: Reciprocals,
    /// The last node, the segment to it, and where its first part, already planned, ends.
    last: Option<(Node, Option<Segment>)>,
    sigma: f64,
    pushed: usize,
    /// End of the last piece.
    planned: f64,
    open: Option<Run>,
    runs: VecDeque<Run>,
    waiting: VecDeque<Waiting>,
    look_at: usize,
    /// Velocity at the begin of the first run of the queue, and the clock there.
    velocity: f64,
    clock_s: f64,
    passed: usize,
    stamp_s: f64,
}

impl Planner {
    /// For these limits, at rest at time zero.
    pub fn new(limits: &AxisLimits) -> Result<Self, TimingError> {
        limits.check()?;
        Ok(Self {
            limits: Reciprocals::of(limits),
            last: None,
            sigma: 0.0,
            pushed: 0,
            planned: 0.0,
            open: None,
            runs: VecDeque::new(),
            waiting: VecDeque::new(),
            look_at: *WINDOW.start(),
            velocity: 0.0,
            clock_s: 0.0,
            passed: 0,
            stamp_s: f64::NEG_INFINITY,
        })
    }

    /// The next node; hands on every node whose time is settled by now.
    ///
    /// The axes go straight there. A refused node changes nothing: the path may go on with another.
    pub fn push(&mut self, node: &Node, out: &mut impl Receive) -> Result<(), TimingError> {
        let from = self.last.as_ref().map_or(node.command, |(last, _)| last.command);
        self.push_along(node, |node| Segment::between(&from, node).element, &[], out)
    }

    /// The next node and the element that leads there; `marks` are places on it, by their distance
    /// from its begin in ascending order, that are timed as nodes are.
    pub fn push_element(
        &mut self,
        node: &Node,
        element: Element,
        marks: &[f64],
        out: &mut impl Receive,
    ) -> Result<(), TimingError> {
        self.push_along(node, |_| element, marks, out)
    }

    fn push_along(
        &mut self,
        node: &Node,
        element: impl FnOnce(&Node) -> Element,
        marks: &[f64],
        out: &mut impl Receive,
    ) -> Result<(), TimingError> {
        node.check(self.pushed)?;
        if node.length < self.sigma * RESOLUTION {
            let (what, value) = ("the length", node.length);
            let expected = "more than 1e-13 of the path before it";
            return Err(TimingError::Node { index: self.pushed, what, value, expected });
        }
        self.pushed += 1;
        let Some((corner_node, before)) = self.last.take() else {
            self.emit_start(node, out);
            self.last = Some((*node, None));
            return Ok(());
        };
        let after = Segment { element: element(node), length: node.length, feed: node.feed };
        if let Some(before) = before {
            self.pass_corner(&corner_node, &before, &after, out);
        }
        let (begin, end) = (self.sigma, self.sigma + node.length);
        // A mark has no limit of its own: its run says what holds the velocity there.
        let mark = |at: &f64| Waiting {
            sigma: (begin + at).min(end),
            blend: 0.0,
            feed: node.feed,
            velocity: f64::INFINITY,
            why: None,
        };
        self.waiting.extend(marks.iter().map(mark));
        self.sigma = end;
        self.last = Some((*node, Some(after)));
        Ok(())
    }

    /// The last node was the end: stops there and hands on all that waits.
    pub fn finish(mut self, out: &mut impl Receive) {
        if let Some((node, Some(before))) = self.last.take() {
            self.stop_at(&node, &before, None, out);
        }
    }

    fn emit_start(&mut self, node: &Node, out: &mut impl Receive) {
        self.stamp_s = 0.0;
        self.passed = 1;
        let start =
            Timed { index: 0, t_s: 0.0, sigma: 0.0, sigma_dot: 0.0, blend: 0.0, limiting: None };
        out.node(start);
        self.rest(0.0, node.dwell_s, out);
    }

    fn rest(&mut self, sigma: f64, dwell_s: f64, out: &mut impl Receive) {
        if dwell_s > 0.0 {
            out.phase(&Phase {
                t_s: self.clock_s,
                duration_s: dwell_s,
                sigma,
                velocity: 0.0,
                acceleration: 0.0,
                jerk: 0.0,
            });
            self.clock_s += dwell_s;
        }
    }

    /// Plans the path up to the end of the blend at a node, or up to the node.
    fn pass_corner(
        &mut self,
        node: &Node,
        before: &Segment,
        after: &Segment,
        out: &mut impl Receive,
    ) {
        if node.stop || node.dwell_s > 0.0 {
            return self.stop_at(node, before, None, out);
        }
        let feed = before.feed.min(after.feed);
        let least = self.sigma * RESOLUTION;
        match passage(&self.limits, node, [before, after], least) {
            Passage::Rest(why) => self.stop_at(node, before, Some(why), out),
            Passage::Through => {
                let line = self.add_element(before, self.sigma, out);
                self.wait(&line, 0.0, feed);
            }
            Passage::Round(d, round) => {
                // Between two blends that meet, rounding leaves no straight piece but the blend's.
                if self.sigma - d - self.planned > 1e-9 * before.length {
                    self.add_element(before, self.sigma - d, out);
                }
                self.add_piece(&round, self.sigma + d, out);
                self.wait(&round, d, feed);
            }
        }
    }

    /// Adds what is left of a segment, up to a place; returns the last piece.
    fn add_element(&mut self, segment: &Segment, to: f64, out: &mut impl Receive) -> Piece {
        if segment.is_straight() {
            let line = straight(&self.limits, segment);
            self.add_piece(&line, to, out);
            return line;
        }
        let parts = &segment.element.parts;
        let mut end = self.sigma - segment.length;
        let mut last = None;
        for (k, part) in parts.iter().enumerate() {
            end += part.length;
            let until = if k + 1 == parts.len() { to } else { end.min(to) };
            if until > self.planned || (last.is_none() && k + 1 == parts.len()) {
                let piece = curved(&self.limits, part, segment.feed);
                self.add_piece(&piece, until, out);
                last = Some(piece);
            }
        }
        last.unwrap_or_else(|| straight(&self.limits, segment))
    }

    fn stop_at(
        &mut self,
        node: &Node,
        before: &Segment,
        why: Option<Limiting>,
        out: &mut impl Receive,
    ) {
        let line = self.add_element(before, self.sigma, out);
        // A programmed stop misses no feed.
        let feed = if why.is_some() { before.feed } else { 0.0 };
        self.wait(
            &Piece { velocity: why, bounds: Bounds { v: 0.0, ..line.bounds }, ..line },
            0.0,
            feed,
        );
        if let Some(mut run) = self.open.take() {
            run.stop_s = Some(node.dwell_s);
            self.runs.push_back(run);
        }
        self.look_ahead(out);
    }

    /// The node at the end of, or in, the piece that was added last.
    fn wait(&mut self, piece: &Piece, blend: f64, feed: f64) {
        let (velocity, why) = (piece.bounds.v, piece.velocity);
        self.waiting.push_back(Waiting { sigma: self.sigma, blend, feed, velocity, why });
        if let Some(run) = &mut self.open {
            run.nodes += 1;
        }
    }

    /// Adds a piece up to a place: to the open run, or as a new one.
    fn add_piece(&mut self, piece: &Piece, to: f64, out: &mut impl Receive) {
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
                self.close(run, out);
                single
            }),
        });
    }

    fn close(&mut self, run: Run, out: &mut impl Receive) {
        self.runs.push_back(run);
        if self.runs.len() >= self.look_at || self.waiting.len() >= MAX_WAITING {
            self.look_ahead(out);
        }
    }

    /// Finds the velocities between the runs backwards, docs/model.md eq. 45, and hands on the runs
    /// that nothing to come can change.
    fn look_ahead(&mut self, out: &mut impl Receive) {
        let Some(last) = self.runs.back() else { return };
        // What follows may ask for a stop, or for nothing: where both give the same, it is settled.
        let stopped = last.stop_s.is_some();
        let (mut least, mut most) = (0.0, if stopped { 0.0 } else { last.bounds.v });
        let mut settled = if stopped { self.runs.len() } else { 0 };
        let mut next_v = f64::INFINITY;
        for i in (0..self.runs.len()).rev() {
            let run = &mut self.runs[i];
            let end = |v: f64| v.min(run.bounds.v).min(next_v);
            let (low, high) = (end(least), end(most));
            let length = run.to - run.from;
            least = reach(low, length, &run.bounds);
            most = if low == high { least } else { reach(high, length, &run.bounds) };
            if settled == 0 && least == most {
                settled = i;
            }
            run.allowed = least;
            next_v = run.bounds.v;
        }
        let full = self.runs.len() >= *WINDOW.end() || self.waiting.len() >= MAX_WAITING;
        if full && settled == 0 {
            // Never too fast, at worst slower than it could be.
            settled = self.runs.len() / 2;
        }
        for _ in 0..settled {
            self.emit_run(out);
        }
        self.look_at = (2 * self.runs.len()).clamp(*WINDOW.start(), *WINDOW.end());
    }

    /// The first run of the queue, from the velocity that it begins with.
    fn emit_run(&mut self, out: &mut impl Receive) {
        let Some(run) = self.runs.pop_front() else { return };
        let length = run.to - run.from;
        let next = self.runs.front().map_or(0.0, |next| next.allowed.min(next.bounds.v));
        let end = match run.stop_s {
            Some(_) => 0.0,
            None => next.min(reach(self.velocity, length, &run.bounds)),
        };
        let start = [self.clock_s, run.from];
        let phases = Phases::of_run(start, [self.velocity, end], length, &run.bounds);
        self.stamp(&run, phases.list(), end, out);
        if let Some(last) = phases.list().last() {
            self.clock_s = last.t_s + last.duration_s;
        }
        self.velocity = end;
        if let Some(dwell_s) = run.stop_s {
            self.rest(run.to, dwell_s, out);
        }
    }

    /// Hands on the nodes and phases of a run in the order of time.
    fn stamp(&mut self, run: &Run, phases: &[Phase], end: f64, out: &mut impl Receive) {
        for (i, phase) in phases.iter().enumerate() {
            let last = i + 1 == phases.len();
            let stop = if last { run.to } else { phases[i + 1].sigma.min(run.to) };
            out.phase(phase);
            while let Some(waiting) = self.waiting.front().filter(|w| w.sigma <= stop) {
                let (tau, velocity) = if waiting.sigma >= run.to {
                    (phase.duration_s, end)
                } else {
                    let tau = time_at(phase, waiting.sigma);
                    (tau, phase.after(tau)[1])
                };
                let waiting = *waiting;
                self.waiting.pop_front();
                self.emit(run, &waiting, phase.t_s + tau, velocity, out);
            }
        }
    }

    fn emit(&mut self, run: &Run, at: &Waiting, t_s: f64, velocity: f64, out: &mut impl Receive) {
        // Two nodes closer than the last bit of the clock are still in order.
        self.stamp_s = if t_s > self.stamp_s { t_s } else { self.stamp_s.next_up() };
        let reached = |v: f64| velocity >= v * (1.0 - 1e-9);
        let limiting = match () {
            () if reached(at.feed) => None,
            () if reached(at.velocity) => at.why,
            () if reached(run.bounds.v) => run.velocity.or_else(|| Some(run.ramp_limit())),
            () => Some(run.ramp_limit()),
        };
        out.node(Timed {
            index: self.passed,
            t_s: self.stamp_s,
            sigma: at.sigma,
            sigma_dot: velocity.max(0.0),
            blend: at.blend,
            limiting,
        });
        self.passed += 1;
    }
}

impl Run {
    /// This run and the next piece as one, unless that costs more time than it saves.
    ///
    /// A run of its own pays if its pieces lose more time by a common velocity than a change of
    /// velocity takes; and a long run is not slowed down by the weak acceleration of a short piece.
    fn with(&self, next: &Self) -> Option<Self> {
        let (a, b) = (&self.bounds, &next.bounds);
        let bounds = Bounds { v: a.v.min(b.v), a: a.a.min(b.a), j: a.j.min(b.j) };
        let length = next.to - self.from;
        let ideal_s = self.ideal_s + next.ideal_s;
        let fastest = self.fastest.max(next.fastest);
        let lost_s = length / bounds.v - ideal_s;
        let change_s = ramp_time(fastest - bounds.v, bounds.a, bounds.j);
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

    /// What makes its changes of velocity slow: large ones its acceleration, small ones its jerk.
    fn ramp_limit(&self) -> Limiting {
        let Bounds { v, a, j } = self.bounds;
        if v * j >= a * a {
            Limiting { axis: self.acceleration_axis, kind: LimitKind::Acceleration }
        } else {
            Limiting { axis: self.jerk_axis, kind: LimitKind::Jerk }
        }
    }
}
