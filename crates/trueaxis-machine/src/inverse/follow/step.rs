//! From the states of one point to those of the next.

use super::{FollowSolver, Label, Stage, TIE_RAD};
use crate::axis::Command;
use std::f64::consts::FRAC_PI_2;
use trueaxis_geometry::Vec3;

/// One step from state to state.
#[derive(Clone, Copy)]
pub(super) struct Step {
    /// Of each axis; 0 for linear ones.
    pub turns: Command,
    /// Of the first rotary axis, without its sign.
    first: f64,
    pub cost: f64,
    /// The axis that turns most.
    pub most: usize,
}

impl Step {
    /// The way that ends with this step.
    pub fn after(&self, label: &Label, before: usize) -> Label {
        let (cost, first) = (label.cost + self.cost, label.first + self.first);
        Label { cost, first, rank: label.rank, before }
    }
}

/// The steps from one point to the next.
pub(super) struct Steps<'s> {
    way: &'s FollowSolver<'s>,
    held: [Option<usize>; 2],
    /// The tool axes.
    ends: [Vec3; 2],
    apart: f64,
    /// How far apart the tool axes are, and a tie more.
    allowed: f64,
}

fn apart(a: Vec3, b: Vec3) -> f64 {
    a.cross(&b).norm().atan2(a.dot(&b))
}

impl<'s> Steps<'s> {
    pub fn between(way: &'s FollowSolver<'s>, from: &Stage, to: &Stage) -> Self {
        let apart = apart(from.axis, to.axis);
        let (held, ends) = ([from.held, to.held], [from.axis, to.axis]);
        Self { way, held, ends, apart, allowed: apart + TIE_RAD }
    }

    /// √(Δq1² + Δq2²); where one end is a pole the turn of its idle axis counts twice, so that it
    /// turns while the tool stands, not while it tilts.
    pub fn to(&self, before: &Command, after: &Command) -> Step {
        let (mut turns, mut most) = (Command::default(), 0);
        for &axis in &self.way.rotary {
            turns[axis] = self.way.turn(axis, before, after);
            if turns[axis].abs() > turns[most].abs() {
                most = axis;
            }
        }
        let idle = match self.held {
            [Some(axis), None] | [None, Some(axis)] => turns[axis].abs(),
            _ => 0.0,
        };
        let squares: f64 = turns.iter().map(|turn| turn * turn).sum();
        let others = (squares - idle * idle).max(0.0).sqrt();
        let cost = if idle > 0.0 { others + 2.0 * idle } else { squares.sqrt() };
        let first = self.way.rotary.first().map_or(0.0, |&i| turns[i].abs());
        Step { turns, first, cost, most }
    }

    /// The way to a state from the one of the same number, if it is continuous at a glance and better than all
    /// those from states before that: whatever became of those, it takes their place.
    pub fn sure(&self, point: &Stage, state: usize, after: &Command) -> Option<Label> {
        let label = point.labels.get(state).filter(|label| label.is_reached())?;
        let step = self.to(&point.states[state].command, after);
        if !self.is_continuous_at_a_glance(total(&step)) {
            return None;
        }
        let candidate = step.after(label, state);
        let is_better = |at: usize| {
            let (label, before) = (&point.labels[at], &point.states[at].command);
            !label.is_reached()
                || self.is_dearer(label, before, after, &candidate)
                || candidate.beats(&self.to(before, after).after(label, at))
        };
        (0..state).all(is_better).then_some(candidate)
    }

    /// Whether a way costs more than another for one axis alone: no step costs less than the turn of any axis.
    pub fn is_dearer(
        &self,
        label: &Label,
        before: &Command,
        after: &Command,
        than: &Label,
    ) -> bool {
        let room = than.cost + 2.0 * TIE_RAD - label.cost;
        let limited = self.way.rotary.iter().filter(|&&axis| !self.way.is_endless(axis));
        limited.into_iter().any(|&axis| (after[axis] - before[axis]).abs() * (1.0 - 1e-12) > room)
    }

    /// Sufficient for [`Self::is_continuous`].
    ///
    /// A step that turns by T in all is at its half no farther than T²/8 from the middle of the chord of its
    /// ends (|a″| ≤ T²), so no farther than θ/2 + T²/8 from either end. With T² ≤ 3θ that is 7θ/8 as a chord,
    /// and less than θ as an angle.
    fn is_continuous_at_a_glance(&self, total: f64) -> bool {
        0.5 * total <= self.allowed || (total <= 1.0 && total * total <= 3.0 * self.apart)
    }

    /// Whether the tool axis is clearly too far from its ends at a part of a step: a chord is shorter than its
    /// angle.
    fn swings_away(&self, before: &Command, step: &Step, part: f64) -> bool {
        let Some(placer) = &self.way.solver.placer else { return false };
        let mut between = *before;
        for &axis in &self.way.rotary {
            between[axis] += step.turns[axis] * part;
        }
        let (_, tool) = placer.tip_and_axis(&between);
        let clearly = (self.allowed * (1.0 + 1e-9) + 1e-9).powi(2);
        self.ends.iter().any(|end| (tool - end).norm_squared() > clearly)
    }

    /// Whether the tool axis stays between its ends on a step: on the way it is never farther from
    /// either end than they are from each other. Checked halfway, and at every 90° of turning.
    pub fn is_continuous(&self, before: &Command, step: &Step) -> bool {
        let total = total(step);
        if self.is_continuous_at_a_glance(total) {
            return true;
        }
        let parts = (total / FRAC_PI_2).ceil().max(2.0);
        if self.swings_away(before, step, (0.5 * parts).floor() / parts) {
            return false;
        }
        (1..).map(f64::from).take_while(|part| *part < parts).all(|part| {
            let mut between = *before;
            for (q, turn) in between.iter_mut().zip(&step.turns) {
                *q += turn * part / parts;
            }
            let tool = self.way.solver.serial.tool_axis(&between);
            self.ends.iter().all(|end| apart(tool, *end) <= self.allowed)
        })
    }
}

fn total(step: &Step) -> f64 {
    step.turns.iter().map(|turn| turn.abs()).sum()
}
