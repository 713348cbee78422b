//! A finite path with its time: the state of every axis at any instant.

use super::element::{Element, Turn};
use super::joint::rounding;
use super::{AxisLimits, Node, Phase, Planner, Receive, Timed, TimingError};
use trueaxis_machine::axis::{Command, MAX_AXES};

/// Axis positions and their derivatives by time, mm or rad and s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Positions.
    pub q: Command,
    /// Velocities.
    pub dq: Command,
    /// Accelerations.
    pub ddq: Command,
    /// Jerks.
    pub dddq: Command,
    /// Length of the path so far. Unit: that of the path.
    pub sigma: f64,
    /// Velocity along the path. Unit: that of the path per s.
    pub sigma_dot: f64,
}

/// How the axes get to a node.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Shape {
    /// Straight.
    #[default]
    Line,
    /// On an arc.
    Arc(Turn),
}

/// A node of the path and the way to it.
#[derive(Debug, Clone)]
struct Leg {
    to: Command,
    length: f64,
    shape: Shape,
}

/// A path in memory as a whole: for plots, tests and short programs.
#[derive(Debug, Clone, Default)]
pub struct Timeline {
    path: Vec<Leg>,
    /// When each node is passed.
    pub nodes: Vec<Timed>,
    /// The motion along the path, without a gap.
    pub phases: Vec<Phase>,
}

impl Receive for Timeline {
    fn node(&mut self, timed: Timed) {
        self.nodes.push(timed);
    }

    fn phase(&mut self, phase: &Phase) {
        self.phases.push(*phase);
    }
}

impl Timeline {
    /// Plans the whole path, with straight lines from node to node.
    pub fn plan(limits: &AxisLimits, nodes: &[Node]) -> Result<Self, TimingError> {
        let nodes: Vec<_> = nodes.iter().map(|node| (*node, Shape::Line)).collect();
        Self::plan_shapes(limits, &nodes)
    }

    /// Plans the whole path.
    pub fn plan_shapes(limits: &AxisLimits, nodes: &[(Node, Shape)]) -> Result<Self, TimingError> {
        let leg =
            |(n, shape): &(Node, Shape)| Leg { to: n.command, length: n.length, shape: *shape };
        let path = nodes.iter().map(leg).collect();
        let mut timeline = Self { path, ..Self::default() };
        let mut planner = Planner::new(limits)?;
        for (node, shape) in nodes {
            match shape {
                Shape::Line => planner.push(node, &mut timeline)?,
                Shape::Arc(turn) => {
                    let element: Element = turn.element();
                    planner.push_element(node, element, &[], &mut timeline)?;
                }
            }
        }
        planner.finish(&mut timeline);
        Ok(timeline)
    }

    /// When the motion ends, with the last dwell.
    pub fn duration_s(&self) -> f64 {
        self.phases.last().map_or(0.0, |p| p.t_s + p.duration_s)
    }

    /// Where every axis is at a time, and how it moves; before the begin and after the end it
    /// rests. None for a path without nodes or a time that is no number.
    pub fn sample(&self, t_s: f64) -> Option<State> {
        if self.nodes.is_empty() || t_s.is_nan() {
            return None;
        }
        let phase = self.phases.partition_point(|p| p.t_s <= t_s).saturating_sub(1);
        let Some(phase) = self.phases.get(phase) else { return self.state(t_s, 0.0, [0.0; 3]) };
        let tau = t_s - phase.t_s;
        if tau < 0.0 {
            return self.state(t_s, phase.sigma, [0.0; 3]);
        }
        let [sigma, velocity, acceleration] = phase.after(tau.min(phase.duration_s));
        if tau > phase.duration_s {
            return self.state(t_s, sigma, [0.0; 3]);
        }
        self.state(t_s, sigma, [velocity, acceleration, phase.jerk])
    }

    /// The chain rule, docs/model.md eq. 43.
    fn state(&self, t_s: f64, sigma: f64, [v, a, j]: [f64; 3]) -> Option<State> {
        let [q, first, second, third] = self.place(t_s, sigma)?;
        let (mut dq, mut ddq, mut dddq) = (q, q, q);
        for i in 0..MAX_AXES {
            dq[i] = first[i] * v;
            ddq[i] = second[i] * v * v + first[i] * a;
            dddq[i] = third[i] * v * v * v + 3.0 * second[i] * v * a + first[i] * j;
        }
        Some(State { q, dq, ddq, dddq, sigma, sigma_dot: v })
    }

    /// q and its derivatives by σ: those of the element, and what the blend at the node that is
    /// nearest adds.
    fn place(&self, t_s: f64, sigma: f64) -> Option<[Command; 4]> {
        let after = self.nodes.partition_point(|n| n.sigma <= sigma);
        let before = after.saturating_sub(1);
        let is_near_next = self
            .nodes
            .get(after)
            .is_some_and(|n| n.sigma - sigma < sigma - self.nodes[before].sigma);
        let i = if is_near_next { after } else { before };
        let node = self.nodes.get(i)?;
        let mut x = sigma - node.sigma;
        if node.blend == 0.0 {
            // Close to a stop the remaining distance is lost in the rounding of σ; the time is not.
            x = if t_s < node.t_s { x.min(-f64::MIN_POSITIVE) } else { x.max(0.0) };
        }
        let [incoming, outgoing] = [i, i + 1].map(|k| self.path.get(k).filter(|_| k > 0));
        let at = self.path.get(i)?.to;
        let mut result = match (incoming, outgoing) {
            (None, None) => [at, [0.0; MAX_AXES], [0.0; MAX_AXES], [0.0; MAX_AXES]],
            (Some(element), _) if x < 0.0 => element.at(element.length + x, &self.path[i - 1].to),
            (_, Some(element)) => element.at(x, &at),
            (Some(element), None) => element.at(element.length, &self.path[i - 1].to),
        };
        if let (Some(incoming), Some(outgoing), true) = (incoming, outgoing, node.blend > 0.0) {
            let from = &self.path[i - 1].to;
            let (e, f) = (incoming.at(incoming.length, from), outgoing.at(0.0, &at));
            let [corner, turn] = rounding(node.blend, x);
            for (n, row) in result.iter_mut().enumerate() {
                for axis in 0..MAX_AXES {
                    row[axis] +=
                        (f[1][axis] - e[1][axis]) * corner[n] + (f[2][axis] - e[2][axis]) * turn[n];
                }
            }
        }
        Some(result)
    }
}

impl Leg {
    /// q and its derivatives at a distance from the begin.
    fn at(&self, sigma: f64, from: &Command) -> [Command; 4] {
        let mut result = match &self.shape {
            Shape::Arc(turn) => turn.derivatives(sigma),
            Shape::Line => {
                let slope: Command = std::array::from_fn(|i| (self.to[i] - from[i]) / self.length);
                [slope.map(|s| s * sigma), slope, [0.0; MAX_AXES], [0.0; MAX_AXES]]
            }
        };
        for (q, from) in result[0].iter_mut().zip(from) {
            *q += from;
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A right angle rounded by 0.01 mm in each axis: at the node both axes are 0.01 mm off, and
    /// between differences and derivatives there is no gap.
    #[test]
    fn a_rounded_corner() {
        let node = |x: f64, y: f64| Node {
            command: [x, y, 0.0, 0.0, 0.0, 0.0],
            length: 10.0,
            feed: 5.0,
            stop: false,
            tolerance: [0.01; MAX_AXES],
            dwell_s: 0.0,
        };
        let row = |limit: f64| [limit; MAX_AXES];
        let limits = AxisLimits { velocity: row(500.0), acceleration: row(3000.0), jerk: row(5e6) };
        let nodes = [node(0.0, 0.0), node(10.0, 0.0), node(10.0, 10.0)];
        let timeline = Timeline::plan(&limits, &nodes).unwrap();
        let corner = timeline.nodes[1];
        assert!((corner.blend - 0.16 / 3.0).abs() < 1e-12);
        let at = timeline.sample(corner.t_s).unwrap();
        assert!((at.q[0] - 9.99).abs() < 1e-9 && (at.q[1] - 0.01).abs() < 1e-9, "{at:?}");
        for k in -100..100 {
            let t = corner.t_s + f64::from(k) * 2e-4;
            let (one, two) = (timeline.sample(t).unwrap(), timeline.sample(t + 1e-6).unwrap());
            assert!(((two.q[0] - one.q[0]) / 1e-6 - one.dq[0]).abs() < 1e-2, "{k} {one:?}");
            assert!((two.dq[0] - one.dq[0]).abs() / 1e-6 < 1e4, "{k} {one:?}");
            assert!(one.dddq[0].abs() < 5e6 && one.dddq[1].abs() < 5e6, "{k} {one:?}");
        }
    }
}
