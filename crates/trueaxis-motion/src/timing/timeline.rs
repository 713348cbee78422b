//! A finite path with its time: the state of every axis at any instant.

use super::path::derivatives;
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

/// A path in memory as a whole: for plots, tests and short programs.
#[derive(Debug, Clone, Default)]
pub struct Timeline {
    path: Vec<(Command, f64)>,
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
    /// Plans the whole path.
    pub fn plan(limits: &AxisLimits, nodes: &[Node]) -> Result<Self, TimingError> {
        let path = nodes.iter().map(|n| (n.command, n.length)).collect();
        let mut timeline = Self { path, ..Self::default() };
        let mut planner = Planner::new(limits)?;
        for node in nodes {
            planner.push(node, &mut timeline)?;
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

    /// q and its derivatives by σ.
    fn place(&self, t_s: f64, sigma: f64) -> Option<[Command; 4]> {
        // The node that is nearest, so that its blend is the one to look at.
        let after = self.nodes.partition_point(|n| n.sigma <= sigma);
        let before = after.saturating_sub(1);
        let is_near_next = self
            .nodes
            .get(after)
            .is_some_and(|n| n.sigma - sigma < sigma - self.nodes[before].sigma);
        let i = if is_near_next { after } else { before };
        let node = self.nodes.get(i)?;
        let slope = |from: usize| -> Option<Command> {
            let (start, (mut slope, length)) = (&self.path.get(from)?.0, *self.path.get(from + 1)?);
            for (s, q) in slope.iter_mut().zip(start) {
                *s = (*s - q) / length;
            }
            Some(slope)
        };
        let incoming = i.checked_sub(1).and_then(slope);
        let outgoing = slope(i);
        let incoming = incoming.or(outgoing).unwrap_or([0.0; MAX_AXES]);
        let outgoing = outgoing.unwrap_or(incoming);
        let (at, _) = self.path.get(i)?;
        let mut x = sigma - node.sigma;
        if node.blend == 0.0 {
            // Close to a stop the remaining distance is lost in the rounding of σ; the time is not.
            x = if t_s < node.t_s { x.min(-f64::MIN_POSITIVE) } else { x.max(0.0) };
        }
        Some(derivatives(at, [&incoming, &outgoing], node.blend, x))
    }
}
