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
use super::{Branches, SolveError, Solver, Target, with};
use crate::Machine;
use crate::axis::{AxisKind, Command, Travel};
use crate::errors::BodyName;
use std::f64::consts::{FRAC_PI_2, PI};
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
    #[error("{axis} leaves its travel by {}; move or turn the part", amount(*.kind, *.beyond))]
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
        "no continuous motion leads here from the point before: {axis} would have to jump by {:.3} \
         deg; retract the tool in between and begin a new path here", .by_rad.to_degrees()
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

/// One point of the path and every state that it may be reached in.
struct Stage {
    /// The tool axis wanted.
    axis: Vec3,
    states: Vec<Command>,
    /// The axis that has no effect here.
    held: Option<usize>,
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

pub(super) fn follow(
    machine: &Machine,
    path: &[Target],
    from: &Command,
) -> Result<Vec<Command>, FollowError> {
    let at = |index: usize| move |fault: FollowFault| FollowError { index, fault };
    let solver = Solver::new(machine, from).map_err(|e| at(0)(e.into()))?;
    let way = Way { solver: &solver, rotary: machine.rotary_axes().collect() };
    let mut branches = Vec::with_capacity(path.len());
    for (i, target) in path.iter().enumerate() {
        branches.push(solver.branches(target).map_err(|e| at(i)(e.into()))?);
    }
    let stages = way.stages(path, &branches).map_err(|(i, fault)| at(i)(fault))?;
    let Some(first) = stages.first() else {
        return Ok(Vec::new());
    };
    let mut labels = vec![way.start(first)];
    for (i, pair) in stages.windows(2).enumerate() {
        let next = way.advance(&pair[0], &labels[i], &pair[1]).map_err(at(i + 1))?;
        labels.push(next);
    }
    Ok(way.walk_back(&stages, &labels))
}

struct Way<'a> {
    solver: &'a Solver<'a>,
    /// The rotary axes in chain order.
    rotary: Vec<usize>,
}

impl Way<'_> {
    fn travel(&self, axis: usize) -> Travel {
        self.solver.machine.axes[axis].travel
    }

    fn is_endless(&self, axis: usize) -> bool {
        !matches!(self.travel(axis), Travel::Between(..))
    }

    fn stages(
        &self,
        path: &[Target],
        branches: &[Branches],
    ) -> Result<Vec<Stage>, (usize, FollowFault)> {
        let mut stages: Vec<Stage> = Vec::with_capacity(path.len());
        for (target, branches) in path.iter().zip(branches) {
            let states = match self.offered(branches) {
                Some(_) => Vec::new(),
                None => self.states(&branches.commands, branches.held),
            };
            stages.push(Stage { axis: target.axis.vector(), states, held: branches.held });
        }
        self.offer_neighbours(path, branches, &mut stages).map_err(|(i, e)| (i, e.into()))?;
        match stages.iter().position(|stage| stage.states.is_empty()) {
            Some(i) => Err((i, self.leaves_travel(&path[i]))),
            None => Ok(stages),
        }
    }

    /// The axis whose angle is free at this point: one that aims elsewhere on the path.
    fn offered(&self, branches: &Branches) -> Option<usize> {
        let aims = |axis: &usize| self.solver.aim.turning.iter().any(|turn| turn.axis == *axis);
        branches.held.filter(aims)
    }

    /// At the poles: the free angles of the nearest points that are none.
    fn offer_neighbours(
        &self,
        path: &[Target],
        branches: &[Branches],
        stages: &mut [Stage],
    ) -> Result<(), (usize, SolveError)> {
        let regular: Vec<bool> = branches.iter().map(|b| self.offered(b).is_none()).collect();
        let next_regular = |i: usize| (i..path.len()).find(|&k| regular[k]);
        let (mut before, mut after) = (None, next_regular(0));
        for i in 0..path.len() {
            let Some(axis) = self.offered(&branches[i]) else {
                before = Some(i);
                continue;
            };
            if after.is_some_and(|k| k < i) {
                after = next_regular(i);
            }
            let neighbours = [before, after].into_iter().flatten();
            let mut angles: Vec<f64> =
                neighbours.flat_map(|k| stages[k].states.iter().map(|s| s[axis])).collect();
            if angles.is_empty() {
                angles.push(branches[i].commands[0][axis]);
            }
            angles.sort_by(f64::total_cmp);
            angles.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
            let (mut commands, mut missed) = (Vec::new(), None);
            for command in &branches[i].commands {
                for &angle in &angles {
                    let turned = with(command, axis, angle);
                    match self.solver.place_tip(turned, &path[i]) {
                        Ok(command) => commands.push(command),
                        Err(error) => missed = Some(error),
                    }
                }
            }
            if let (true, Some(error)) = (commands.is_empty(), missed) {
                return Err((i, error));
            }
            stages[i].states = self.states(&commands, Some(axis));
        }
        Ok(())
    }

    /// Every turn of every command that lies within the travel, best to begin with first.
    fn states(&self, commands: &[Command], held: Option<usize>) -> Vec<Command> {
        let mut states = Vec::new();
        for command in commands {
            let mut turned = vec![*command];
            for turn in &self.solver.aim.turning {
                let (axis, travel) = (turn.axis, self.travel(turn.axis));
                if held == Some(axis) || self.is_endless(axis) {
                    continue;
                }
                let other = others(travel, command[axis], 0.0);
                let more: Vec<Command> = other
                    .iter()
                    .flat_map(|&q| turned.iter().map(move |c| with(c, axis, q)))
                    .collect();
                turned.extend(more);
            }
            turned.retain(|c| self.solver.machine.within_travel(c));
            states.extend(turned);
        }
        let angle = |c: &Command, n: usize| self.rotary.get(n).map_or(0.0, |&i| c[i]);
        let outside = |c: &Command| {
            self.rotary.iter().filter(|&&i| c[i] <= -PI - TIE_RAD || c[i] > PI + TIE_RAD).count()
        };
        states.sort_by(|a, b| {
            (outside(a), angle(a, 1) < -TIE_RAD)
                .cmp(&(outside(b), angle(b, 1) < -TIE_RAD))
                .then(angle(a, 0).total_cmp(&angle(b, 0)))
                .then(angle(a, 1).total_cmp(&angle(b, 1)))
        });
        states
    }

    /// The turn of an axis from one state to the next; the shorter way round if it is endless.
    fn turn(&self, axis: usize, before: &Command, after: &Command) -> f64 {
        match self.is_endless(axis) {
            true => nearest(after[axis], before[axis]) - before[axis],
            false => after[axis] - before[axis],
        }
    }

    fn start(&self, stage: &Stage) -> Vec<Label> {
        let label = |(rank, state): (usize, &Command)| {
            let from = &self.solver.from;
            let turns = self.rotary.iter().map(|&i| self.turn(i, from, state));
            let cost = turns.map(|turn| turn * turn).sum::<f64>().sqrt();
            let first = self.rotary.first().map_or(0.0, |&i| self.turn(i, from, state).abs());
            Label { cost, first, rank, before: 0 }
        };
        stage.states.iter().enumerate().map(label).collect()
    }

    /// The best way to every state of the next point; a state that none leads to costs infinity.
    fn advance(
        &self,
        stage: &Stage,
        labels: &[Label],
        next: &Stage,
    ) -> Result<Vec<Label>, FollowFault> {
        let unreached = Label { cost: f64::INFINITY, first: 0.0, rank: usize::MAX, before: 0 };
        let mut reached = vec![unreached; next.states.len()];
        let mut jump = (f64::INFINITY, 0, 0.0);
        for (after, best) in next.states.iter().zip(&mut reached) {
            for (before, (state, label)) in stage.states.iter().zip(labels).enumerate() {
                if label.cost == f64::INFINITY {
                    continue;
                }
                let step = Step::between(self, [stage, next], [state, after]);
                if !self.is_continuous([stage, next], state, &step) {
                    if step.cost < jump.0 {
                        jump = (step.cost, step.most, step.turns[step.most].abs());
                    }
                    continue;
                }
                let first = self.rotary.first().map_or(0.0, |&i| step.turns[i].abs());
                let (cost, first) = (label.cost + step.cost, label.first + first);
                let candidate = Label { cost, first, rank: label.rank, before };
                if candidate.beats(best) {
                    *best = candidate;
                }
            }
        }
        if reached.iter().all(|label| label.cost == f64::INFINITY) {
            let axis = self.solver.machine.axes[jump.1].name;
            return Err(FollowFault::Jump { axis, by_rad: jump.2 });
        }
        Ok(reached)
    }

    /// Whether the tool axis stays between its ends on a step: on the way it is never farther from
    /// either end than they are from each other. Looked at halfway, and at every 90° of turning.
    fn is_continuous(&self, ends: [&Stage; 2], before: &Command, step: &Step) -> bool {
        let apart = |a: Vec3, b: Vec3| a.cross(&b).norm().atan2(a.dot(&b));
        let allowed = apart(ends[0].axis, ends[1].axis) + TIE_RAD;
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
            ends.iter().all(|end| apart(tool, end.axis) <= allowed)
        })
    }

    fn walk_back(&self, stages: &[Stage], labels: &[Vec<Label>]) -> Vec<Command> {
        let last = labels.len() - 1;
        let mut best = 0;
        for (i, label) in labels[last].iter().enumerate() {
            if label.beats(&labels[last][best]) {
                best = i;
            }
        }
        let mut commands = Vec::with_capacity(stages.len());
        for (stage, labels) in stages.iter().zip(labels).rev() {
            commands.push(stage.states[best]);
            best = labels[best].before;
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
    fn between(way: &Way<'_>, stages: [&Stage; 2], states: [&Command; 2]) -> Self {
        let (mut turns, mut most) = (Command::default(), 0);
        for &axis in &way.rotary {
            turns[axis] = way.turn(axis, states[0], states[1]);
            if turns[axis].abs() > turns[most].abs() {
                most = axis;
            }
        }
        let idle = match (stages[0].held, stages[1].held) {
            (Some(axis), None) | (None, Some(axis)) => turns[axis].abs(),
            _ => 0.0,
        };
        let squares: f64 = turns.iter().map(|turn| turn * turn).sum();
        let others = (squares - idle * idle).max(0.0).sqrt();
        let cost = if idle > 0.0 { others + 2.0 * idle } else { squares.sqrt() };
        Self { turns, cost, most }
    }
}
