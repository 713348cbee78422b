//! The best branch for a whole path.
//!
//! ```text
//!     cost(i, s) = min over s' at i−1 of  cost(i−1, s') + step(s', s)         Bellman 1957
//! ```
//!
//! A state is one branch with one turn of each rotary axis within its travel. An endless axis (also
//! one without a stated travel) is kept in (−π, π] and its steps are taken the shorter way round;
//! its turns are put together at the end.

use super::turns::{TIE_RAD, nearest, others};
use super::{Branches, Placer, SolveError, Solver, Target, with};
use crate::Machine;
use crate::axis::{AxisKind, Command, Travel};
use crate::errors::BodyName;
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::Range;
use trueaxis_geometry::Vec3;

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

/// The points of the path so far and every state that each may be reached in, one after the other
/// in common lists.
#[derive(Default)]
struct Stages {
    /// The tool axes wanted.
    axes: Vec<Vec3>,
    /// The axis that has no effect at a point.
    held: Vec<Option<usize>>,
    /// Where the states of a point end.
    ends: Vec<usize>,
    states: Vec<Command>,
    labels: Vec<Label>,
}

impl Stages {
    fn with_capacity(points: usize) -> Self {
        Self {
            axes: Vec::with_capacity(points),
            held: Vec::with_capacity(points),
            ends: Vec::with_capacity(points),
            states: Vec::with_capacity(2 * points),
            labels: Vec::with_capacity(2 * points),
        }
    }

    fn len(&self) -> usize {
        self.axes.len()
    }

    fn range(&self, point: usize) -> Range<usize> {
        point.checked_sub(1).map_or(0, |before| self.ends[before])..self.ends[point]
    }

    fn states(&self, point: usize) -> &[Command] {
        &self.states[self.range(point)]
    }
}

/// The best way to a state so far.
#[derive(Clone, Copy)]
struct Label {
    cost: f64,
    /// Travel of the first rotary axis.
    first: f64,
    /// Rank of the state at the first point.
    rank: usize,
    before: usize,
}

impl Label {
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
    let at = |index: usize| move |fault: FollowFault| FollowError { index, fault };
    let mut solver = Solver::new(machine, from).map_err(|e| at(0)(e.into()))?;
    solver.placer = Placer::of(machine, &solver.serial);
    let way = PathSolver { solver: &solver, rotary: machine.rotary_axes().collect() };
    let mut stages = Stages::with_capacity(path.len());
    let mut jump = None;
    while stages.len() < path.len() && jump.is_none() {
        let next = stages.len();
        way.add_stages(path, &mut stages).map_err(|(i, fault)| at(i)(fault))?;
        jump = (next..stages.len()).find_map(|i| way.label(&mut stages, i).err().map(at(i)));
    }
    let reached = jump.as_ref().map_or(path.len(), |jump| jump.index);
    Ok((way.walk_back(&stages, reached), jump))
}

struct PathSolver<'a> {
    solver: &'a Solver<'a>,
    /// The rotary axes in chain order.
    rotary: Vec<usize>,
}

impl PathSolver<'_> {
    fn travel(&self, axis: usize) -> Travel {
        self.solver.machine.axes[axis].travel
    }

    fn is_endless(&self, axis: usize) -> bool {
        !matches!(self.travel(axis), Travel::Between(..))
    }

    /// Adds the next point; where its angles are free, all points up to the next one that tells.
    fn add_stages(&self, path: &[Target], stages: &mut Stages) -> Result<(), (usize, FollowFault)> {
        let first = stages.len();
        let mut poles: Vec<Branches> = Vec::new();
        let mut commands = Vec::with_capacity(2);
        let mut held = None;
        for (i, target) in path.iter().enumerate().skip(first) {
            held = self.solver.branches_into(target, &mut commands).map_err(|e| (i, e.into()))?;
            if self.offered(held).is_none() {
                break;
            }
            poles.push(Branches { commands: std::mem::take(&mut commands), held });
        }
        let tells = first + poles.len();
        // The solutions for the point after the poles; none at the end of the path.
        let mut after = Vec::new();
        if !poles.is_empty() && tells < path.len() {
            self.push_states(&commands, held, &mut after);
        }
        for (i, branches) in (first..).zip(&poles) {
            let before = first.checked_sub(1).map_or(&[][..], |before| stages.states(before));
            let offered = self.at_pole(&path[i], branches, [before, &after]);
            let offered = offered.map_err(|e| (i, e.into()))?;
            self.add_stage(path, stages, &offered, branches.held)?;
        }
        if tells < path.len() {
            self.add_stage(path, stages, &commands, held)?;
        }
        Ok(())
    }

    fn add_stage(
        &self,
        path: &[Target],
        stages: &mut Stages,
        commands: &[Command],
        held: Option<usize>,
    ) -> Result<(), (usize, FollowFault)> {
        let (i, before) = (stages.len(), stages.states.len());
        self.push_states(commands, held, &mut stages.states);
        if stages.states.len() == before {
            return Err((i, self.leaves_travel(&path[i])));
        }
        stages.axes.push(path[i].axis.vector());
        stages.held.push(held);
        stages.ends.push(stages.states.len());
        Ok(())
    }

    /// The axis whose angle is free at this point: one that aims elsewhere on the path.
    fn offered(&self, held: Option<usize>) -> Option<usize> {
        held.filter(|axis| self.solver.aim.turning.iter().any(|turn| turn.axis == *axis))
    }

    /// At a pole: the free angles of the nearest points that are none.
    fn at_pole(
        &self,
        target: &Target,
        branches: &Branches,
        neighbours: [&[Command]; 2],
    ) -> Result<Vec<Command>, SolveError> {
        let Some(axis) = self.offered(branches.held) else {
            return Ok(branches.commands.clone());
        };
        let mut angles: Vec<f64> = neighbours.into_iter().flatten().map(|s| s[axis]).collect();
        if angles.is_empty() {
            angles.push(branches.commands[0][axis]);
        }
        angles.sort_by(f64::total_cmp);
        angles.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
        let (mut commands, mut missed) = (Vec::new(), None);
        for command in &branches.commands {
            for &angle in &angles {
                match self.solver.place_tip(with(command, axis, angle), target) {
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
    fn push_states(&self, commands: &[Command], held: Option<usize>, states: &mut Vec<Command>) {
        let begin = states.len();
        for command in commands {
            let own = states.len();
            states.push(*command);
            for turn in &self.solver.aim.turning {
                let (axis, travel) = (turn.axis, self.travel(turn.axis));
                if held == Some(axis) || self.is_endless(axis) {
                    continue;
                }
                let end = states.len();
                for q in others(travel, command[axis], 0.0) {
                    (own..end).for_each(|k| states.push(with(&states[k], axis, q)));
                }
            }
        }
        let mut kept = begin;
        for k in begin..states.len() {
            if self.solver.machine.within_travel(&states[k]) {
                states.swap(kept, k);
                kept += 1;
            }
        }
        states.truncate(kept);
        let angle = |c: &Command, n: usize| self.rotary.get(n).map_or(0.0, |&i| c[i]);
        let outside = |c: &Command| {
            self.rotary.iter().filter(|&&i| c[i] <= -PI - TIE_RAD || c[i] > PI + TIE_RAD).count()
        };
        states[begin..].sort_by(|a, b| {
            (outside(a), angle(a, 1) < -TIE_RAD)
                .cmp(&(outside(b), angle(b, 1) < -TIE_RAD))
                .then(angle(a, 0).total_cmp(&angle(b, 0)))
                .then(angle(a, 1).total_cmp(&angle(b, 1)))
        });
    }

    /// The turn of an axis from one state to the next; the shorter way round if it is endless.
    fn turn(&self, axis: usize, before: &Command, after: &Command) -> f64 {
        match self.is_endless(axis) {
            true => nearest(after[axis], before[axis]) - before[axis],
            false => after[axis] - before[axis],
        }
    }

    /// The best way to every state of a point whose points before it have theirs.
    fn label(&self, stages: &mut Stages, point: usize) -> Result<(), FollowFault> {
        match point.checked_sub(1) {
            None => {
                let first = stages.states(0).iter().enumerate();
                let labels: Vec<Label> = first.map(|(rank, s)| self.start(rank, s)).collect();
                stages.labels.extend(labels);
                Ok(())
            }
            Some(before) => self.advance(stages, before),
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
    fn advance(&self, stages: &mut Stages, point: usize) -> Result<(), FollowFault> {
        let unreached = Label { cost: f64::INFINITY, first: 0.0, rank: usize::MAX, before: 0 };
        let (mut jump, mut is_reached) = ((f64::INFINITY, 0, 0.0), false);
        for next in stages.range(point + 1) {
            let mut best = unreached;
            for (before, state) in stages.range(point).enumerate() {
                let label = stages.labels[state];
                if label.cost == f64::INFINITY {
                    continue;
                }
                let ends = [&stages.states[state], &stages.states[next]];
                let step = Step::between(self, [stages.held[point], stages.held[point + 1]], ends);
                let first = self.rotary.first().map_or(0.0, |&i| step.turns[i].abs());
                let (cost, first) = (label.cost + step.cost, label.first + first);
                let candidate = Label { cost, first, rank: label.rank, before };
                // Whether a step is continuous is checked only where it matters.
                if !candidate.beats(&best) {
                    continue;
                }
                if self.is_continuous([stages.axes[point], stages.axes[point + 1]], ends[0], &step)
                {
                    (best, is_reached) = (candidate, true);
                } else if step.cost < jump.0 {
                    jump = (step.cost, step.most, step.turns[step.most].abs());
                }
            }
            stages.labels.push(best);
        }
        if is_reached {
            return Ok(());
        }
        let axis = self.solver.machine.axes[jump.1].name;
        Err(FollowFault::Jump { axis, by_rad: jump.2 })
    }

    /// Whether the tool axis stays between its ends on a step: on the way it is never farther from
    /// either end than they are from each other. Checked halfway, and at every 90° of turning.
    fn is_continuous(&self, ends: [Vec3; 2], before: &Command, step: &Step) -> bool {
        let apart = |a: Vec3, b: Vec3| a.cross(&b).norm().atan2(a.dot(&b));
        let allowed = apart(ends[0], ends[1]) + TIE_RAD;
        let total: f64 = step.turns.iter().map(|turn| turn.abs()).sum();
        if 0.5 * total <= allowed {
            return true;
        }
        let parts = (total / FRAC_PI_2).ceil().max(2.0);
        (1..).map(f64::from).take_while(|part| *part < parts).all(|part| {
            let mut between = *before;
            for (q, turn) in between.iter_mut().zip(&step.turns) {
                *q += turn * part / parts;
            }
            let tool = self.solver.serial.tool_axis(&between);
            ends.iter().all(|end| apart(tool, *end) <= allowed)
        })
    }

    /// The commands of the first points, along the best way to the last of them.
    fn walk_back(&self, stages: &Stages, points: usize) -> Vec<Command> {
        let mut best: Option<usize> = None;
        let mut commands = Vec::with_capacity(points);
        for point in (0..points).rev() {
            let range = stages.range(point);
            let labels = &stages.labels[range.clone()];
            let at = best.unwrap_or_else(|| {
                (0..labels.len()).fold(0, |best, i| match labels[i].beats(&labels[best]) {
                    true => i,
                    false => best,
                })
            });
            commands.push(stages.states[range.start + at]);
            best = Some(labels[at].before);
        }
        commands.reverse();
        let mut before = self.solver.from;
        for command in &mut commands {
            for &axis in self.rotary.iter().filter(|&&i| self.is_endless(i)) {
                command[axis] = nearest(command[axis], before[axis]);
            }
            before = *command;
        }
        commands
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

/// One step from state to state.
struct Step {
    /// Of each axis; 0 for linear ones.
    turns: Command,
    cost: f64,
    /// The axis that turns most.
    most: usize,
}

impl Step {
    /// √(Δq1² + Δq2²); where one end is a pole the turn of its idle axis counts twice, so that it
    /// turns while the tool stands, not while it tilts.
    fn between(way: &PathSolver<'_>, held: [Option<usize>; 2], states: [&Command; 2]) -> Self {
        let (mut turns, mut most) = (Command::default(), 0);
        for &axis in &way.rotary {
            turns[axis] = way.turn(axis, states[0], states[1]);
            if turns[axis].abs() > turns[most].abs() {
                most = axis;
            }
        }
        let idle = match (held[0], held[1]) {
            (Some(axis), None) | (None, Some(axis)) => turns[axis].abs(),
            _ => 0.0,
        };
        let squares: f64 = turns.iter().map(|turn| turn * turn).sum();
        let others = (squares - idle * idle).max(0.0).sqrt();
        let cost = if idle > 0.0 { others + 2.0 * idle } else { squares.sqrt() };
        Self { turns, cost, most }
    }
}
