//! From the states of one point to those of the next.

use super::{FollowSolver, Label, Stage, TIE_RAD};
use crate::axis::Command;
use crate::inverse::DirectionSolver;
use std::f64::consts::{FRAC_PI_2, PI};
use trueaxis_geometry::Vec3;

/// The first of two rotary axes that aim, and its direction in the workpiece frame.
pub(super) struct FirstAxis {
    axis: usize,
    direction: Vec3,
}

impl FirstAxis {
    /// `None` unless two axes aim.
    pub fn of_aim(aim: &DirectionSolver) -> Option<Self> {
        let ([first, _], Some(pair)) = (&aim.turning[..], &aim.pair) else { return None };
        Some(Self { axis: first.axis, direction: pair.a })
    }
}

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
    /// The turns of all axes, without their signs.
    total: f64,
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
    /// How far the tool axis is from the first rotary axis to begin with: the sine of the angle.
    radius: f64,
}

fn apart(a: Vec3, b: Vec3) -> f64 {
    a.cross(&b).norm().atan2(a.dot(&b))
}

impl<'s> Steps<'s> {
    pub fn between(way: &'s FollowSolver<'s>, from: &Stage, to: &Stage) -> Self {
        let apart = apart(from.axis, to.axis);
        let (held, ends) = ([from.held, to.held], [from.axis, to.axis]);
        let radius =
            way.first.as_ref().map_or(0.0, |first| first.direction.cross(&from.axis).norm());
        Self { way, held, ends, apart, allowed: apart + TIE_RAD, radius }
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
        let total = turns.iter().map(|turn| turn.abs()).sum();
        Step { turns, first, cost, most, total }
    }

    /// The way to a state from the one of the same number, if it is continuous at a glance and better than all
    /// those from states before that: whatever became of those, it takes their place.
    pub fn sure(&self, point: &Stage, state: usize, after: &Command) -> Option<Label> {
        let label = point.labels.get(state).filter(|label| label.is_reached())?;
        let step = self.to(&point.states[state].command, after);
        if !self.is_continuous_at_a_glance(step.total) {
            return None;
        }
        let candidate = step.after(label, state);
        let is_better = |at: usize| {
            let (label, before) = (&point.labels[at], &point.states[at].command);
            if !label.is_reached() || self.is_dearer(label, before, after, &candidate) {
                return true;
            }
            let step = self.to(before, after);
            candidate.beats(&step.after(label, at)) || !self.is_continuous(before, &step)
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
        let is_dear = |&axis: &usize| (after[axis] - before[axis]).abs() * (1.0 - 1e-12) > room;
        self.way.limited.iter().any(is_dear)
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
        let clearly = self.clearly().powi(2);
        self.ends.iter().any(|end| (tool - end).norm_squared() > clearly)
    }

    fn clearly(&self) -> f64 {
        self.allowed * (1.0 + 1e-9) + 1e-9
    }

    /// Sufficient for [`Self::swings_away`], without a sine.
    ///
    /// A turn of the first axis by δ moves the tool axis, which is ϱ away from that axis, along a chord of 2ϱ sin(δ/2); no
    /// turn of another axis moves it farther than its angle. For 0 ≤ y ≤ π the sine of y is not less than y (π − y)/π.
    fn swings_away_at_a_glance(&self, step: &Step, part: f64) -> bool {
        let Some(first) = &self.way.first else { return false };
        let half = 0.5 * step.turns[first.axis].abs() * part;
        let others = part * (step.total - step.turns[first.axis].abs());
        half <= PI && 2.0 * self.radius * half * (PI - half) / PI - others > self.clearly()
    }

    /// Whether the tool axis stays between its ends on a step: on the way it is never farther from
    /// either end than they are from each other. Checked halfway, and at every 90° of turning.
    pub fn is_continuous(&self, before: &Command, step: &Step) -> bool {
        if self.is_continuous_at_a_glance(step.total) {
            return true;
        }
        let parts = parts(step.total);
        let part = (parts / 2) as f64 / parts as f64;
        !self.swings_away_at_a_glance(step, part)
            && !self.swings_away(before, step, part)
            && self.stays_between(before, step, parts)
    }

    fn stays_between(&self, before: &Command, step: &Step, parts: u64) -> bool {
        (1..parts).all(|part| {
            let mut between = *before;
            for (q, turn) in between.iter_mut().zip(&step.turns) {
                *q += turn * part as f64 / parts as f64;
            }
            let tool = self.way.solver.serial.tool_axis(&between);
            self.ends.iter().all(|end| apart(tool, *end) <= self.allowed)
        })
    }
}

/// ⌈total/90°⌉, at least 2: a turn is examined in so many parts.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "no travel has 2^63 turns"
)]
fn parts(total: f64) -> u64 {
    let quarters = total / FRAC_PI_2;
    let whole = quarters as u64;
    (whole + u64::from(whole as f64 != quarters)).max(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Machine;
    use crate::file::NoTables;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// What is seen at a glance is what the places on the way say; short steps near the pole, whole turns,
        /// and changes of the branch.
        #[test]
        fn law_a_glance_agrees_with_the_places_on_the_way(
            which in 0..3_usize, c in -3.0..3.0_f64, tilt in -1.5..1.5_f64, size in -6.0..0.6_f64,
            ways in proptest::array::uniform2(-1.0..1.0_f64), turns in -1..2_i32, flips in any::<bool>(),
        ) {
            let chain = ["w b X Y Z C A t", "w C' A' b X Y Z t", "w C' b X Y Z B t"][which];
            let text = format!("[machine]\nname = \"m\"\nchain = \"{chain}\"\n");
            let machine = Machine::check("m.toml", &text, &NoTables).0.expect("a machine");
            let way = FollowSolver::of(&machine, &Command::default()).expect("a solver");
            let [first, second] = way.rotary[..] else { panic!("two axes") };
            let at = |q: [f64; 2]| {
                let mut command = Command::default();
                (command[first], command[second]) = (q[0], q[1]);
                command
            };
            let (room, pi) = (10_f64.powf(size), std::f64::consts::PI);
            let to = [c + room * ways[0] + 2.0 * pi * f64::from(turns), tilt + room * ways[1]];
            let to = if flips { [to[0] + pi, -to[1]] } else { to };
            let (before, after) = (at([c, tilt]), at(to));
            let stage = |command: &Command| {
                Stage { axis: way.solver.serial.tool_axis(command), ..Stage::default() }
            };
            let steps = Steps::between(&way, &stage(&before), &stage(&after));
            let mut step = steps.to(&before, &after);
            // Endless axes would take the shorter way round.
            (step.turns[first], step.turns[second]) = (to[0] - c, to[1] - tilt);
            step.total = step.turns.iter().map(|turn| turn.abs()).sum();
            let (total, parts) = (step.total, parts(step.total));
            prop_assert_eq!(parts as f64, (total / FRAC_PI_2).ceil().max(2.0));
            let stays = steps.stays_between(&before, &step, parts);
            if steps.is_continuous_at_a_glance(total) && 0.5 * total > steps.allowed {
                prop_assert!(stays);
            }
            let part = (parts / 2) as f64 / parts as f64;
            let swings = steps.swings_away(&before, &step, part);
            if swings {
                prop_assert!(!stays);
            }
            if steps.swings_away_at_a_glance(&step, part) {
                prop_assert!(swings);
            }
        }
    }
}
