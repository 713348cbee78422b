//! The best branch for a whole path.
//!
//! ```text
//!     cost(i, s) = min over s' at i−1 of  cost(i−1, s') + step(s', s)         Bellman 1957
//! ```
//!
//! A state is one branch with one turn of each rotary axis within its travel. An endless axis (also
//! one without a stated travel) is kept in (−π, π] and its steps are taken the shorter way round;
//! its turns are put together at the end.
//!
//! ```text
//!     targets ──FollowSolver──> branches, states     each point by itself, on any thread
//!             ──Follower──> labels                   point after point
//!             ──Undecided──> the best way            where all ways come together, and at the end
//! ```

mod followed;
mod follower;
mod reached;
mod step;
mod undecided;

pub use followed::FollowedPath;
pub use follower::Follower;
pub use reached::Reached;

use super::turns::{TIE_RAD, nearest, others};
use super::{Aim, ClosedForm, Placer, SolveError, Solver, Target, with};
use crate::Machine;
use crate::axis::{AxisKind, Command, Travel};
use crate::errors::BodyName;
use follower::Pole;
use reached::TwoBranches;
use std::f64::consts::{PI, TAU};
use step::{FirstAxis, Steps};
use trueaxis_geometry::Vec3;

/// The branches of so many targets are found at a time.
const BLOCK: usize = 1024;

/// Why a path cannot be followed, and at which of its points.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("point {index} of the path (counted from 0): {fault}")]
pub struct FollowError {
    /// The first point that fails, counted from 0.
    pub index: usize,
    /// Why.
    pub fault: FollowFault,
}

/// Why a point of a path cannot be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FollowFault {
    /// No axis positions reach the point.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// Every way to reach it leaves the travel; this is the one that leaves it least.
    #[error("{axis} exceeds its travel by {}; move or turn the part", amount(*.kind, *.beyond))]
    LeavesTravel {
        /// The axis that leaves its travel farthest: move the part or choose a longer axis.
        axis: BodyName,
        /// Linear or rotary.
        kind: AxisKind,
        /// How far beyond the end, mm or rad.
        beyond: f64,
    },
    /// From no way to the point before does the tool get here without swinging away.
    #[error(
        "no continuous motion from the previous point: {axis} would jump by {:.3} deg; retract \
         the tool and begin a new path at this point", .by_rad.to_degrees()
    )]
    Jump {
        /// The axis that would turn most.
        axis: BodyName,
        /// How far.
        by_rad: f64,
    },
}

fn amount(kind: AxisKind, beyond: f64) -> String {
    match kind {
        AxisKind::Linear => format!("{beyond:.6} mm"),
        AxisKind::Rotary => format!("{:.6} deg", beyond.to_degrees()),
    }
}

/// One way to stand at a point: a branch with turns of its aiming axes.
#[derive(Debug, Clone, Copy)]
struct State {
    command: Command,
    branch: u32,
    /// Whole turns of the aiming axes from the angles of the branch.
    turns: [i32; 2],
    /// What counts before its angles; see [`FollowSolver::order`].
    order: usize,
}

/// A point with every state that it may be reached in.
#[derive(Debug, Clone, Default)]
struct Stage {
    /// The tool axis wanted.
    axis: Vec3,
    /// The axis that has no effect at the point.
    held: Option<usize>,
    /// Angles of the aiming axes of its branches.
    branches: Vec<[f64; 2]>,
    states: Vec<State>,
    labels: Vec<Label>,
}

/// The best way to a state so far.
#[derive(Debug, Clone, Copy)]
struct Label {
    cost: f64,
    /// Travel of the first rotary axis.
    first: f64,
    /// Rank of the state at the first point.
    rank: usize,
    before: usize,
}

impl Label {
    const UNREACHED: Self = Self { cost: f64::INFINITY, first: 0.0, rank: usize::MAX, before: 0 };

    fn is_reached(&self) -> bool {
        self.cost < f64::INFINITY
    }

    fn beats(&self, other: &Self) -> bool {
        let differ = |a: f64, b: f64| (a - b).abs() > TIE_RAD;
        if differ(self.cost, other.cost) {
            return self.cost < other.cost;
        }
        if differ(self.first, other.first) {
            return self.first < other.first;
        }
        self.rank < other.rank
    }
}

/// The commands as far as a continuous motion leads, and the jump that it ends at.
pub(super) fn follow(
    machine: &Machine,
    path: &[Target],
    from: &Command,
) -> Result<(Vec<Command>, Option<FollowError>), FollowError> {
    let solver = FollowSolver::of(machine, from)?;
    let (mut follower, mut reached) = (Follower::on(&solver), Reached::default());
    let mut followed = FollowedPath::default();
    let mut jump = None;
    for block in path.chunks(BLOCK) {
        solver.reach(block.iter().copied(), &mut reached);
        jump = follower.take(&mut reached, &mut followed)?;
        if jump.is_some() {
            break;
        }
    }
    let jump = follower.finish(&mut followed)?.or(jump);
    let points = path.iter().take(followed.len()).enumerate();
    Ok((points.map(|(i, target)| solver.command(&followed, i, target)).collect(), jump))
}

/// Finds the ways to reach each target of a path that begins at one command.
pub struct FollowSolver<'m> {
    solver: Solver<'m>,
    /// The rotary axes in chain order.
    rotary: Vec<usize>,
    /// Those with a travel.
    limited: Vec<usize>,
    /// Where the machine has closed forms.
    both: Option<TwoBranches>,
    /// Where two axes aim.
    first: Option<FirstAxis>,
}

impl<'m> FollowSolver<'m> {
    pub(super) fn of(machine: &'m Machine, from: &Command) -> Result<Self, FollowError> {
        let at_first = |e: SolveError| FollowError { index: 0, fault: e.into() };
        let mut solver = Solver::new(machine, from).map_err(at_first)?;
        solver.placer = Placer::of(machine, &solver.serial);
        let both = TwoBranches::of(machine, &solver);
        let first = FirstAxis::of_aim(&solver.aim);
        let is_limited = |&axis: &usize| matches!(machine.axes[axis].travel, Travel::Between(..));
        let limited = machine.rotary_axes().filter(is_limited).collect();
        Ok(Self { solver, rotary: machine.rotary_axes().collect(), limited, both, first })
    }

    /// The axis positions at a point that is decided, whose target this is.
    pub fn command(&self, followed: &FollowedPath, point: usize, target: &Target) -> Command {
        let [placed, turned] = followed.angles(point);
        let command = self.with_angles(&self.solver.from, placed);
        // The same place was found before.
        let placed = self.solver.place_tip(command, target).unwrap_or(command);
        self.with_angles(&placed, turned)
    }

    /// The rotary axes of the same; the linear ones stand where the path was begun.
    pub fn turned(&self, followed: &FollowedPath, point: usize) -> Command {
        self.with_angles(&self.solver.from, followed.angles(point)[1])
    }

    fn with_angles(&self, command: &Command, angles: [f64; 2]) -> Command {
        let mut command = *command;
        for (turn, q) in self.solver.aim.turning.iter().zip(angles) {
            command[turn.axis] = q;
        }
        for &axis in self.rotary.iter().filter(|&&axis| self.is_endless(axis)) {
            command[axis] += 0.0; // −0 is 0
        }
        command
    }

    fn travel(&self, axis: usize) -> Travel {
        self.solver.machine.axes[axis].travel
    }

    fn is_endless(&self, axis: usize) -> bool {
        !matches!(self.travel(axis), Travel::Between(..))
    }

    /// The axis whose angle is free at this point: one that aims elsewhere on the path.
    fn offered(&self, held: Option<usize>) -> Option<usize> {
        held.filter(|axis| self.solver.aim.turning.iter().any(|turn| turn.axis == *axis))
    }

    fn angles(&self, command: &Command) -> [f64; 2] {
        let mut angles = [0.0; 2];
        for (angle, turn) in angles.iter_mut().zip(&self.solver.aim.turning) {
            *angle = command[turn.axis];
        }
        angles
    }

    /// At a pole: the free angles of the nearest points that are none.
    fn at_pole(&self, pole: &Pole, neighbours: [&[State]; 2]) -> Result<Vec<Command>, SolveError> {
        let Some(axis) = self.offered(pole.held) else { return Ok(pole.branches.clone()) };
        let states = neighbours.into_iter().flatten();
        let mut angles: Vec<f64> = states.map(|s| s.command[axis]).collect();
        if angles.is_empty() {
            angles.extend(pole.branches.first().map(|command| command[axis]));
        }
        angles.sort_by(f64::total_cmp);
        angles.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
        let (mut commands, mut missed) = (Vec::new(), None);
        for command in &pole.branches {
            for &angle in &angles {
                match self.solver.place_tip(with(command, axis, angle), &pole.target) {
                    Ok(command) => commands.push(command),
                    Err(error) => missed = Some(error),
                }
            }
        }
        match missed {
            Some(error) if commands.is_empty() => Err(error),
            _ => Ok(commands),
        }
    }

    /// Every turn of every command that lies within the travel, best to begin with first.
    #[expect(clippy::cast_possible_truncation, reason = "no travel has 2^31 turns")]
    fn push_states(&self, commands: &[Command], held: Option<usize>, states: &mut Vec<State>) {
        let begin = states.len();
        for (branch, command) in (0..).zip(commands) {
            let own = states.len();
            states.push(State { command: *command, branch, turns: [0; 2], order: 0 });
            for (place, turn) in self.solver.aim.turning.iter().enumerate().take(2) {
                let (axis, travel) = (turn.axis, self.travel(turn.axis));
                if held == Some(axis) || self.is_endless(axis) {
                    continue;
                }
                let end = states.len();
                for q in others(travel, command[axis], 0.0) {
                    let turns = ((q - command[axis]) / TAU).round() as i32;
                    for k in own..end {
                        let mut state = states[k];
                        (state.command[axis], state.turns[place]) = (q, turns);
                        states.push(state);
                    }
                }
            }
            self.keep_inside(own, states);
        }
        for state in &mut states[begin..] {
            state.order = self.order(&state.command);
        }
        let angle = |s: &State, n: usize| self.rotary.get(n).map_or(0.0, |&i| s.command[i]);
        states[begin..].sort_by(|a, b| {
            (a.order.cmp(&b.order))
                .then_with(|| angle(a, 0).total_cmp(&angle(b, 0)))
                .then_with(|| angle(a, 1).total_cmp(&angle(b, 1)))
        });
    }

    /// Keeps the turns of one command that lie within the travel; all other axes stand alike.
    fn keep_inside(&self, own: usize, states: &mut Vec<State>) {
        let inside = |axis: usize, q: f64| self.travel(axis).contains(q);
        let aims = |axis: usize| self.solver.aim.turning.iter().any(|turn| turn.axis == axis);
        let command = states[own].command;
        let axes = 0..self.solver.machine.axes.len();
        if !axes.into_iter().all(|axis| aims(axis) || inside(axis, command[axis])) {
            states.truncate(own);
            return;
        }
        let mut kept = own;
        for k in own..states.len() {
            let turning = &self.solver.aim.turning;
            if turning.iter().all(|turn| inside(turn.axis, states[k].command[turn.axis])) {
                states.swap(kept, k);
                kept += 1;
            }
        }
        states.truncate(kept);
    }

    /// Within half a turn of zero first, then a second angle that is not negative.
    fn order(&self, command: &Command) -> usize {
        let outside = |&&axis: &&usize| {
            let q = command[axis];
            q <= -PI - TIE_RAD || q > PI + TIE_RAD
        };
        let second = self.rotary.get(1).map_or(0.0, |&axis| command[axis]);
        2 * self.rotary.iter().filter(outside).count() + usize::from(second < -TIE_RAD)
    }

    /// The turn of an axis from one state to the next; the shorter way round if it is endless.
    fn turn(&self, axis: usize, before: &Command, after: &Command) -> f64 {
        match self.is_endless(axis) {
            true => nearest(after[axis], before[axis]) - before[axis],
            false => after[axis] - before[axis],
        }
    }

    fn start(&self, rank: usize, state: &Command) -> Label {
        let from = &self.solver.from;
        let turns = self.rotary.iter().map(|&i| self.turn(i, from, state));
        let cost = turns.map(|turn| turn * turn).sum::<f64>().sqrt();
        let first = self.rotary.first().map_or(0.0, |&i| self.turn(i, from, state).abs());
        Label { cost, first, rank, before: 0 }
    }

    /// The best way to every state of the next point; a state that none leads to costs infinity.
    fn advance(&self, point: &Stage, next: &mut Stage) -> Result<(), FollowFault> {
        let (mut jump, mut is_reached) = ((f64::INFINITY, 0, 0.0), false);
        let steps = Steps::between(self, point, next);
        next.labels.clear();
        for (number, state) in next.states.iter().enumerate() {
            let sure = steps.sure(point, number, &state.command);
            let begin = sure.map_or(0, |_| number + 1);
            let mut best = sure.unwrap_or(Label::UNREACHED);
            is_reached |= best.is_reached();
            for (before, from) in point.states.iter().enumerate().skip(begin) {
                let label = &point.labels[before];
                if !label.is_reached()
                    || is_reached && steps.is_dearer(label, &from.command, &state.command, &best)
                {
                    continue;
                }
                let step = steps.to(&from.command, &state.command);
                let candidate = step.after(label, before);
                // Whether a step is continuous is checked only where it matters.
                if !candidate.beats(&best) {
                    continue;
                }
                if steps.is_continuous(&from.command, &step) {
                    (best, is_reached) = (candidate, true);
                } else if step.cost < jump.0 {
                    jump = (step.cost, step.most, step.turns[step.most].abs());
                }
            }
            next.labels.push(best);
        }
        if is_reached {
            return Ok(());
        }
        let axis = self.solver.machine.axes[jump.1].name;
        Err(FollowFault::Jump { axis, by_rad: jump.2 })
    }

    /// Which axis leaves its travel, and how far, in the entry that leaves it least.
    fn leaves_travel(&self, target: &Target) -> FollowFault {
        let machine = self.solver.machine;
        let farthest = |command: &Command| {
            let beyond = machine.axes.iter().zip(command).enumerate().map(|(i, (axis, &q))| {
                let (beyond, range) = match axis.travel {
                    Travel::Between(low, high) => ((low - q).max(q - high).max(0.0), high - low),
                    Travel::Unlimited | Travel::Unknown => (0.0, 1.0),
                };
                (beyond / range, beyond, i)
            });
            beyond.fold((0.0, 0.0, 0), |a, b| if b.0 > a.0 { b } else { a })
        };
        let commands = self.solver.branches(target).map(|b| self.solver.with_turns(&b));
        let least = commands
            .iter()
            .flatten()
            .map(farthest)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, 0.0, 0));
        let axis = &machine.axes[least.2];
        FollowFault::LeavesTravel { axis: axis.name, kind: axis.kind, beyond: least.1 }
    }
}
