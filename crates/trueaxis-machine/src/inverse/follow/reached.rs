//! The ways to reach many targets: both branches of 64 at a time in vector instructions; near poles, where branches
//! meet, and on machines without a closed form one after the other.

use super::{Aim, ClosedForm, FollowSolver, State};
use crate::Machine;
use crate::axis::{Command, MAX_AXES};
use crate::batch::{InstructionSet, aim_group, place_group};
use crate::inverse::turns::principal;
use crate::inverse::{SolveError, Solver, Target};

/// Targets that are solved together, a multiple of the lanes of every instruction set.
const TOGETHER: usize = 64;

/// Targets with the ways to reach each of them: what is the same wherever the tool comes from, and so
/// may be found for many targets at once.
#[derive(Debug, Clone, Default)]
pub struct Reached {
    pub(super) targets: Vec<Target>,
    pub(super) held: Vec<Option<usize>>,
    /// Where the branches of a target end.
    branch_ends: Vec<usize>,
    branches: Vec<Command>,
    /// Where the states of a target end; it has none here where an angle is free.
    state_ends: Vec<usize>,
    states: Vec<State>,
    pub(super) fault: Option<SolveError>,
    group: Vec<Target>,
    room: Vec<Command>,
}

impl Reached {
    fn clear(&mut self) {
        self.targets.clear();
        self.held.clear();
        self.branch_ends.clear();
        self.branches.clear();
        self.state_ends.clear();
        self.states.clear();
        self.fault = None;
    }

    fn part<'l, T>(list: &'l [T], ends: &[usize], i: usize) -> &'l [T] {
        &list[i.checked_sub(1).map_or(0, |before| ends[before])..ends[i]]
    }

    pub(super) fn branches(&self, i: usize) -> &[Command] {
        Self::part(&self.branches, &self.branch_ends, i)
    }

    pub(super) fn states(&self, i: usize) -> &[State] {
        Self::part(&self.states, &self.state_ends, i)
    }
}

/// The closed forms of a machine with two rotary axes, which both aim, and three linear axes that place the tip.
pub(super) struct TwoBranches {
    aim: Aim,
    form: ClosedForm,
}

/// Both branches of a group of targets, axis by axis.
struct Branches {
    commands: [[[f64; TOGETHER]; MAX_AXES]; 2],
    undecided: u64,
}

impl TwoBranches {
    pub fn of(machine: &Machine, solver: &Solver<'_>) -> Option<Self> {
        let placing = solver.placer.as_ref()?.placing;
        let aim = Aim::of(&solver.aim).filter(|_| solver.serial.rotary().count() == 2)?;
        Some(Self { aim, form: ClosedForm::of(machine, &solver.serial, placing)? })
    }

    fn at(&self, targets: &[Target], from: &Command) -> Branches {
        let column = |value: &dyn Fn(&Target) -> f64| {
            let mut column = [0.0; TOGETHER];
            column.iter_mut().zip(targets).for_each(|(x, target)| *x = value(target));
            column
        };
        let axes = std::array::from_fn(|k| column(&|target| target.axis.vector()[k]));
        let tips = std::array::from_fn(|k| column(&|target| target.tip.vector()[k]));
        let mut angles = [[0.0; TOGETHER]; 4];
        let set = InstructionSet::best();
        let undecided = aim_group(set, &self.aim, &axes, &mut angles);
        let [a1, b1, a2, b2] = angles.map(|column| column.map(principal));
        let commands = [[a1, b1], [a2, b2]].map(|turned| {
            let mut commands = from.map(|q| [q; TOGETHER]);
            for (axis, column) in self.aim.axes.into_iter().zip(turned) {
                commands[axis] = column;
            }
            place_group(set, &self.form, &tips, &mut commands);
            commands
        });
        Branches { commands, undecided }
    }
}

impl Branches {
    /// The commands of both branches where the closed form decides.
    fn of(&self, target: usize) -> Option<[Command; 2]> {
        let both = self.commands.each_ref().map(|c| c.each_ref().map(|column| column[target]));
        let is_finite = both.iter().flatten().all(|q| q.is_finite());
        (self.undecided >> target & 1 == 0 && is_finite).then_some(both)
    }
}

impl FollowSolver<'_> {
    /// Finds the ways to reach these targets, in place of what `reached` holds, up to the first that
    /// cannot be reached.
    pub fn reach(&self, targets: impl IntoIterator<Item = Target>, reached: &mut Reached) {
        reached.clear();
        let mut targets = targets.into_iter();
        let mut group = std::mem::take(&mut reached.group);
        while reached.fault.is_none() {
            group.clear();
            group.extend(targets.by_ref().take(TOGETHER));
            if group.is_empty() {
                break;
            }
            self.reach_group(&group, reached);
        }
        reached.group = group;
    }

    fn reach_group(&self, group: &[Target], reached: &mut Reached) {
        let both = self.both.as_ref().map(|both| both.at(group, &self.solver.from));
        let mut commands = std::mem::take(&mut reached.room);
        for (i, target) in group.iter().enumerate() {
            let held = match both.as_ref().and_then(|both| both.of(i)) {
                Some(both) => {
                    commands.clear();
                    commands.extend(both);
                    Ok(None)
                }
                None => self.solver.branches_into(target, &mut commands),
            };
            match held {
                Ok(held) => self.add(target, held, &commands, reached),
                Err(fault) => {
                    reached.fault = Some(fault);
                    break;
                }
            }
        }
        reached.room = commands;
    }

    fn add(
        &self,
        target: &Target,
        held: Option<usize>,
        commands: &[Command],
        reached: &mut Reached,
    ) {
        if self.offered(held).is_none() {
            self.push_states(commands, held, &mut reached.states);
        }
        reached.targets.push(*target);
        reached.held.push(held);
        reached.branches.extend_from_slice(commands);
        reached.branch_ends.push(reached.branches.len());
        reached.state_ends.push(reached.states.len());
    }
}
