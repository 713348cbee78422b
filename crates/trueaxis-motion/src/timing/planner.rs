//! Runs, look-ahead and time stamps; bounded memory, constant work per node.

use super::element::{Element, Segment};
use super::joint::{Passage, passage};
use super::path::{Piece, Reciprocals};
use super::run::{Chain, Run, duration_s};
use super::scurve::{Bounds, Phases, reach, time_at};
use super::{AxisLimits, LimitKind, Limiting, Node, Phase, Receive, Timed, TimingError};
use std::collections::VecDeque;

/// At least and at most so many runs are looked ahead.
const WINDOW: std::ops::RangeInclusive<usize> = 64..=4096;
/// No more nodes than this wait for their time.
const MAX_WAITING: usize = 1 << 16;
/// The longest section between two stops for which blends and stops are compared as a whole.
const LONGEST_SECTION: usize = 32;
/// Lengths below this part of the whole path drown in its rounding.
const RESOLUTION: f64 = 1e-13;
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
    chain: Chain,
    /// Runs that wait for their place in the queue.
    closed: Vec<Run>,
    /// The segments since the last stop and their ends, unless there are too many or the first of
    /// their runs are handed on already; and how many blends are between them.
    section: Vec<(Segment, f64)>,
    section_begin: f64,
    is_section_whole: bool,
    section_rounds: usize,
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
            chain: Chain::default(),
            closed: Vec::new(),
            section: Vec::new(),
            section_begin: 0.0,
            is_section_whole: true,
            section_rounds: 0,
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
            self.pass_corner(&corner_node, before, &after, out);
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
            self.stop_at(&node, before, None, out);
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
        before: Segment,
        after: &Segment,
        out: &mut impl Receive,
    ) {
        if node.stop || node.dwell_s > 0.0 {
            return self.stop_at(node, before, None, out);
        }
        let feed = before.feed.min(after.feed);
        let least = self.sigma * RESOLUTION;
        match passage(&self.limits, node, [&before, after], least) {
            Passage::Rest(why) => self.stop_at(node, before, Some(why), out),
            Passage::Through => {
                let line = self.add_element(&before, self.sigma, out);
                self.wait(&line, 0.0, feed);
                self.keep(before, false);
            }
            Passage::Round(d, round) => {
                // Between two blends that meet, rounding leaves no straight piece but the blend's.
                if self.sigma - d - self.chain.planned > 1e-9 * before.length {
                    self.add_element(&before, self.sigma - d, out);
                }
                self.add_piece(&round, self.sigma + d, out);
                self.wait(&round, d, feed);
                self.keep(before, true);
            }
        }
    }

    /// Adds the rest of a segment, up to a place; returns the last piece.
    fn add_element(&mut self, segment: &Segment, to: f64, out: &mut impl Receive) -> Piece {
        let (closed, ends) = (&mut self.closed, [self.sigma, to]);
        let piece =
            self.chain.add_segment(&self.limits, segment, ends, &mut |run| closed.push(run));
        self.close(out);
        piece
    }

    fn add_piece(&mut self, piece: &Piece, to: f64, out: &mut impl Receive) {
        let closed = &mut self.closed;
        self.chain.add_piece(piece, to, &mut |run| closed.push(run));
        self.close(out);
    }

    fn stop_at(
        &mut self,
        node: &Node,
        before: Segment,
        why: Option<Limiting>,
        out: &mut impl Receive,
    ) {
        let line = self.add_element(&before, self.sigma, out);
        // A programmed stop misses no feed.
        let feed = if why.is_some() { before.feed } else { 0.0 };
        self.wait(
            &Piece { velocity: why, bounds: Bounds { v: 0.0, ..line.bounds }, ..line },
            0.0,
            feed,
        );
        if let Some(mut run) = self.chain.open.take() {
            run.stop_s = Some(node.dwell_s);
            self.runs.push_back(run);
        }
        self.keep(before, false);
        self.choose_stops(node.dwell_s);
        self.look_ahead(out);
    }

    /// The node at the end of, or in, the piece that was added last.
    fn wait(&mut self, piece: &Piece, blend: f64, feed: f64) {
        let (velocity, why) = (piece.bounds.v, piece.velocity);
        self.waiting.push_back(Waiting { sigma: self.sigma, blend, feed, velocity, why });
        if let Some(run) = &mut self.chain.open {
            run.nodes += 1;
        }
    }

    fn close(&mut self, out: &mut impl Receive) {
        while !self.closed.is_empty() {
            self.runs.push_back(self.closed.remove(0));
            if self.runs.len() >= self.look_at || self.waiting.len() >= MAX_WAITING {
                self.look_ahead(out);
            }
        }
    }

    /// From the last stop to this one: rests at every node if that takes less time than its blends,
    /// docs/model.md eq. 45b.
    fn choose_stops(&mut self, stop_s: f64) {
        let section = std::mem::take(&mut self.section);
        let is_whole = std::mem::replace(&mut self.is_section_whole, true);
        let rounds = std::mem::take(&mut self.section_rounds);
        let begin = std::mem::replace(&mut self.section_begin, self.sigma);
        if !is_whole || rounds == 0 {
            return;
        }
        let kept = self.runs.partition_point(|run| run.from < begin);
        let mut chain = Chain { planned: begin, open: None };
        let mut stops: Vec<Run> = Vec::new();
        for (segment, end) in &section {
            let ends = [*end, *end];
            chain.add_segment(&self.limits, segment, ends, &mut |run| stops.push(run));
            stops.extend(chain.open.take().map(|run| Run { nodes: 1, stop_s: Some(0.0), ..run }));
        }
        if let Some(last) = stops.last_mut() {
            last.stop_s = Some(stop_s);
        }
        let mut rounded: Vec<Run> = self.runs.iter().skip(kept).copied().collect();
        if duration_s(&mut stops) >= duration_s(&mut rounded) {
            return;
        }
        self.runs.truncate(kept);
        self.runs.extend(stops);
        let last = self.waiting.len().saturating_sub(1);
        for waiting in self.waiting.iter_mut().take(last).filter(|w| w.sigma > begin) {
            // Marks stay as they are.
            if waiting.velocity.is_finite() {
                (waiting.blend, waiting.velocity) = (0.0, 0.0);
                let kind = LimitKind::Corner;
                waiting.why = waiting.why.or(Some(Limiting { axis: 0, kind }));
            }
        }
    }

    /// Keeps a segment of the section since the last stop.
    fn keep(&mut self, segment: Segment, is_round: bool) {
        self.section_rounds += usize::from(is_round);
        if self.section.len() >= LONGEST_SECTION {
            self.is_section_whole = false;
            self.section.clear();
        }
        if self.is_section_whole {
            self.section.push((segment, self.sigma));
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
        if run.from >= self.section_begin {
            self.is_section_whole = false;
            self.section.clear();
        }
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
