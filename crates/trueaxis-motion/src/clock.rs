//! When each node is passed: by the planner of the control, or by the phases of Jiang et al..

use super::axis_path::{Node, SHORTEST};
use super::timing;
use super::timing::three_phase::{Block, Shape, ThreePhases};
use super::timing::{AxisLimits, Element, LimitKind, Limiting, Planner, Timed, TimingError};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Limits, MAX_AXES};

/// When and how fast a node is passed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stamp {
    /// From the start of the program, s.
    pub time_s: f64,
    /// Along the path. Unit: mm/s or deg/s.
    pub speed: f64,
    /// The limit that keeps the speed below the programmed one.
    pub held_by: Option<Limiting>,
}

/// How time runs along the path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Timing {
    /// Jerk-limited with look-ahead, within the limits of every axis.
    #[default]
    LookAhead,
    /// Jiang et al.: each block in three phases, with exact stop; the axes are not asked.
    ThreePhase {
        /// Mean acceleration, mm/s² (deg/s² where only rotary axes move).
        acceleration: f64,
        /// Whether the velocity changes smoothly instead of evenly.
        smooth: bool,
    },
    /// Not at all: where places count and no time. The axes only wait.
    Untimed,
}

/// Where the machine file states no limit: 30 m/min, 3 m/s², 50 m/s³; 6 rad/s (57 rpm),
/// 20 rad/s², 350 rad/s³.
const USUAL: [[f64; 3]; 2] = [[500.0, 3000.0, 50_000.0], [6.0, 20.0, 350.0]];

/// A corner may turn a rotary axis off its path by so much, rad (0.02°).
const ROUNDING_RAD: f64 = 3.5e-4;

/// The limits of the axes, with usual ones where the machine file states none.
pub fn limits(machine: &Machine) -> AxisLimits {
    let limits = machine.axes().iter().map(|axis| {
        let [velocity, acceleration, jerk] = USUAL[usize::from(axis.kind == AxisKind::Rotary)];
        Limits {
            velocity: axis.limits.velocity.or(Some(velocity)),
            acceleration: axis.limits.acceleration.or(Some(acceleration)),
            jerk: axis.limits.jerk.or(Some(jerk)),
        }
    });
    AxisLimits::from_stated(&limits.collect::<Vec<_>>())
}

/// Gives every node its stamp, in their order.
pub(super) struct Clock {
    limits: AxisLimits,
    linear: [bool; MAX_AXES],
    timing: Timing,
    planner: Option<Planner>,
    /// How the axes go on the present move and how long it is, and the nodes on it so far, by their
    /// distance from its begin.
    element: Option<(Element, f64)>,
    marks: Vec<f64>,
    /// The nodes of the present move, for the three phases.
    block: Vec<Node>,
    /// Where the axes were last.
    at: Command,
    /// When the planner began.
    begun_s: f64,
    /// The last stamp.
    now_s: f64,
}

impl Clock {
    pub fn new(machine: &Machine, start: Command, timing: Timing) -> Self {
        let mut linear = [true; MAX_AXES];
        for (is_linear, axis) in linear.iter_mut().zip(machine.axes()) {
            *is_linear = axis.kind == AxisKind::Linear;
        }
        Self {
            limits: limits(machine),
            linear,
            timing,
            planner: None,
            element: None,
            marks: Vec::new(),
            block: Vec::new(),
            at: start,
            begun_s: 0.0,
            now_s: 0.0,
        }
    }

    /// The next nodes, up to the last one of a move, lie on this element.
    pub fn begin(&mut self, element: Element, length: f64) {
        if self.timing == Timing::LookAhead {
            self.element = Some((element, length));
        }
    }

    /// Whether the next node lies on an element.
    pub fn on_element(&self) -> bool {
        self.element.is_some()
    }

    /// The move is not completed: how many of its nodes will get no stamp.
    pub fn drop_element(&mut self) -> usize {
        self.element = None;
        std::mem::take(&mut self.marks).len()
    }

    /// The next node; passes on every stamp that is final by now.
    ///
    /// A node where the axes are already at rest is a dwell; the caller leaves others out.
    ///
    /// # Errors
    /// Numbers that no path can have; the node then gets no stamp.
    pub fn push(&mut self, node: &Node, out: &mut dyn FnMut(Stamp)) -> Result<(), TimingError> {
        if node.dwell_s > 0.0 {
            self.finish(out);
            self.now_s += node.dwell_s;
            out(Stamp { time_s: self.now_s, speed: 0.0, held_by: None });
            return Ok(());
        }
        match self.timing {
            Timing::LookAhead if self.element.is_some() && !node.last => {
                let before = self.marks.last().copied().unwrap_or(0.0);
                self.marks.push(before + node.length);
            }
            Timing::LookAhead => self.plan(node, out)?,
            Timing::Untimed => {
                out(Stamp { time_s: self.now_s, speed: 0.0, held_by: None });
            }
            Timing::ThreePhase { acceleration, smooth } => {
                self.block.push(*node);
                if node.last {
                    self.stamp_block(acceleration, smooth, out);
                }
            }
        }
        self.at = node.command;
        Ok(())
    }

    fn plan(&mut self, node: &Node, out: &mut dyn FnMut(Stamp)) -> Result<(), TimingError> {
        if self.planner.is_none() {
            let mut planner = Planner::new(&self.limits)?;
            planner.push(&self.timed_node(node, self.at), &mut |_: Timed| {})?;
            (self.begun_s, self.planner) = (self.now_s, Some(planner));
        }
        let mut timed_node = self.timed_node(node, node.command);
        let (begun_s, now_s) = (self.begun_s, &mut self.now_s);
        let Some(planner) = &mut self.planner else { return Ok(()) };
        let mut out = |timed: Timed| {
            *now_s = begun_s + timed.t_s;
            out(Stamp { time_s: *now_s, speed: timed.sigma_dot, held_by: timed.limiting });
        };
        let Some((element, length)) = self.element.take() else {
            return planner.push(&timed_node, &mut out);
        };
        timed_node.length = length.max(SHORTEST);
        planner.push_element(&timed_node, element, &self.marks, &mut out)?;
        self.marks.clear();
        Ok(())
    }

    fn timed_node(&self, node: &Node, command: Command) -> timing::Node {
        let tolerance = self.linear.map(|linear| match linear {
            _ if node.rounding_mm.is_infinite() => f64::INFINITY,
            true => node.rounding_mm,
            false => ROUNDING_RAD,
        });
        let length = node.length.max(SHORTEST);
        timing::Node { command, length, feed: node.speed, stop: node.stop, tolerance, dwell_s: 0.0 }
    }

    /// The axes come to rest: every waiting node gets its stamp.
    pub fn finish(&mut self, out: &mut dyn FnMut(Stamp)) {
        if let Timing::ThreePhase { acceleration, smooth } = self.timing {
            self.stamp_block(acceleration, smooth, out);
        }
        let Some(planner) = self.planner.take() else { return };
        let (begun_s, now_s) = (self.begun_s, &mut self.now_s);
        planner.finish(&mut |timed: Timed| {
            *now_s = begun_s + timed.t_s;
            out(Stamp { time_s: *now_s, speed: timed.sigma_dot, held_by: timed.limiting });
        });
    }

    fn stamp_block(&mut self, acceleration: f64, smooth: bool, out: &mut dyn FnMut(Stamp)) {
        let nodes = std::mem::take(&mut self.block);
        let length: f64 = nodes.iter().map(|n| n.length).sum();
        let Some(first) = nodes.first() else { return };
        let shape = if smooth { Shape::Smooth } else { Shape::Constant };
        // Rapid is as fast as a linear axis usually is; the paper has no rapid moves.
        let feed = if first.is_rapid() { USUAL[0][0] } else { first.speed };
        let block = Block { length, feed, acceleration, start: 0.0, end: 0.0, shape };
        let phases = block.phases();
        let mut done = 0.0;
        for (i, node) in nodes.iter().enumerate() {
            done += node.length;
            let time = |p: &ThreePhases| match i + 1 == nodes.len() {
                // The inverse of s(t) is flat at the end.
                true => p.duration_s(),
                false => p.time_at_s(done),
            };
            let time = phases.as_ref().map_or(0.0, time);
            let speed = phases.as_ref().map_or(0.0, |p| p.top);
            out(Stamp { time_s: self.now_s + time, speed, held_by: None });
        }
        self.now_s += phases.map_or(0.0, |p| p.duration_s());
        self.block = nodes;
        self.block.clear();
    }
}

/// A limit in one word.
pub fn limit_name(kind: LimitKind) -> &'static str {
    match kind {
        LimitKind::Velocity => "velocity",
        LimitKind::Acceleration => "acceleration",
        LimitKind::Jerk => "jerk",
        LimitKind::Corner => "acceleration or jerk in a corner",
    }
}
