//! Axis positions for many poses of the tool, one after the other along a path.
//!
//! ```text
//!     targets (columns) ──both branches, W at a time──> angles ──one after the other──> the branch and turn nearest to the pose before
//!                       ──linear axes, W at a time───> commands (columns)
//! ```
//!
//! Poles, and directions where two branches meet, are left to the scalar form, so every target has the result that
//! [`TipControl::aim_nearest`] and [`TipControl::place`] give, to 1e-12 rad and 1e-9 mm.

use super::groups::{self, aim_by, place_by};
use super::{BatchError, CommandColumns, InstructionSet};
use crate::axis::{Command, MAX_AXES};
use crate::inverse::{Aim, ClosedForm, SolveError};
use crate::lanes::Plain;
use crate::tcp::TipControl;
use crate::{FollowError, FollowFault, Machine};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::Direction;

/// Poses that are computed together, a multiple of the lanes of every instruction set.
const TOGETHER: usize = 64;

/// Where the tool shall be: columns of its tip (mm) and of its axis (unit vector from the tip to the spindle) in the
/// workpiece frame.
#[derive(Debug, Clone, Copy)]
pub struct TargetColumns<'a> {
    /// X, Y and Z of the tip, mm.
    pub tip_mm: [&'a [f64]; 3],
    /// The tool axis. Unit: 1.
    pub axis: [&'a [f64]; 3],
}

impl TargetColumns<'_> {
    /// How many targets.
    pub fn len(&self) -> usize {
        self.tip_mm[0].len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Why a batch of targets has no commands.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InverseError {
    /// Columns that do not fit.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// The first target that cannot be reached.
    #[error(transparent)]
    Target(#[from] FollowError),
}

/// The inverse of a nominal machine for whole columns of targets.
///
/// # Example
/// ```
/// use trueaxis_machine::batch::{CommandTable, CompiledInverse, TargetColumns};
/// use trueaxis_machine::{Machine, file::NoTables};
/// let text = "[machine]\nname = \"gantry\"\nchain = \"w b X Y Z C A t\"\n\
///             [tool]\nlength = \"100 mm\"";
/// let machine = Machine::check("gantry.toml", text, &NoTables).0.expect("a machine");
///
/// // The tip at the origin, the tool leaning by 30° towards −y: A = 30°, and the pivot stands 100 mm up the tool,
/// // so Y = −50 mm and Z = 86.6 mm.
/// let (zero, axis) = ([0.0], [[0.0], [-0.5], [0.75_f64.sqrt()]]);
/// let targets = TargetColumns { tip_mm: [&zero; 3], axis: axis.each_ref().map(|c| &c[..]) };
/// let mut commands = CommandTable::zeros(5, 1);
/// let inverse = CompiledInverse::of(&machine).expect("three linear axes");
/// inverse.commands(&targets, &[0.0; 6], &mut commands.columns())?;
/// let [_, y, z, _, a, _] = commands.at(0);
/// assert!((y + 50.0).abs() < 1e-9 && (z - 86.602540378).abs() < 1e-9);
/// assert!((a.to_degrees() - 30.0).abs() < 1e-9);
/// # Ok::<(), trueaxis_machine::batch::InverseError>(())
/// ```
#[derive(Debug, Clone)]
pub struct CompiledInverse {
    control: TipControl,
}

impl CompiledInverse {
    /// `None` if the machine has fewer than three linear axes.
    pub fn of(machine: &Machine) -> Option<Self> {
        Some(Self { control: TipControl::of(machine)? })
    }

    /// One command for each target: the tool axis by the branch and the turn nearest to the command before (the first
    /// to `from`), as a control does it in every cycle; the linear axes bring the tip to its place.
    ///
    /// # Errors
    /// Columns that do not fit; the first target that cannot be reached. The rows from there on are undefined.
    pub fn commands(
        &self,
        targets: &TargetColumns<'_>,
        from: &Command,
        out: &mut CommandColumns<'_>,
    ) -> Result<(), InverseError> {
        self.commands_by(InstructionSet::best(), targets, from, out)
    }

    /// The same with given vector instructions, for tests and benches.
    ///
    /// # Errors
    /// As [`CompiledInverse::commands`]; instructions that this processor does not support.
    pub fn commands_by(
        &self,
        set: InstructionSet,
        targets: &TargetColumns<'_>,
        from: &Command,
        out: &mut CommandColumns<'_>,
    ) -> Result<(), InverseError> {
        if !set.is_available() {
            return Err(BatchError::Unavailable(set).into());
        }
        self.fit(targets, out)?;
        let mut last = *from;
        for at in (0..targets.len()).step_by(TOGETHER) {
            let count = TOGETHER.min(targets.len() - at);
            let part = |columns: &[&[f64]; 3]| columns.map(|c| padded(&c[at..at + count]));
            let (tips, axes) = (part(&targets.tip_mm), part(&targets.axis));
            let mut commands = [[0.0; TOGETHER]; MAX_AXES];
            self.control
                .group(set, (&tips, &axes), count, &mut last, &mut commands)
                .map_err(|(i, e)| FollowError { index: at + i, fault: FollowFault::Solve(e) })?;
            for (column, q) in out.each().iter_mut().zip(&commands) {
                column[at..at + count].copy_from_slice(&q[..count]);
            }
        }
        Ok(())
    }

    fn fit(&self, targets: &TargetColumns<'_>, out: &CommandColumns<'_>) -> Result<(), BatchError> {
        let (expected, axes) = (targets.len(), self.control.machine().axes().len());
        if out.axes() != axes {
            return Err(BatchError::Columns { expected: axes, found: out.axes() });
        }
        let inputs = targets.tip_mm.iter().chain(&targets.axis).map(|c| c.len());
        match inputs.chain(out.lengths()).find(|found| *found != expected) {
            Some(found) => Err(BatchError::Lengths { expected, found }),
            None => Ok(()),
        }
    }
}

fn padded(column: &[f64]) -> [f64; TOGETHER] {
    let mut all = [0.0; TOGETHER];
    all[..column.len()].copy_from_slice(column);
    all
}

impl TipControl {
    /// The commands of a group of targets, each nearest to the one before.
    fn group<const N: usize>(
        &self,
        set: InstructionSet,
        (tips, axes): (&[[f64; N]; 3], &[[f64; N]; 3]),
        count: usize,
        last: &mut Command,
        commands: &mut [[f64; N]; MAX_AXES],
    ) -> Result<(), (usize, SolveError)> {
        let mut angles = [[0.0; N]; 4];
        let aim = self.two_axes();
        let undecided = aim.map_or(u64::MAX, |aim| aim_group(set, aim, axes, &mut angles));
        for i in 0..count {
            let axis = Vec3::new(axes[0][i], axes[1][i], axes[2][i]);
            let [a1, b1, a2, b2] = &angles;
            let known = (undecided >> i & 1 == 0).then(|| [a1[i], b1[i], a2[i], b2[i]]);
            self.aim_with(axis, known, last).map_err(|e| (i, e))?;
            for (column, q) in commands.iter_mut().zip(last.iter()) {
                column[i] = *q;
            }
        }
        let Some(form) = self.closed_form().filter(|form| form.holds(commands)) else {
            return self.place_each(tips, count, commands);
        };
        place_group(set, form, tips, commands);
        let finite = |i: &usize| form.placing.iter().all(|axis| commands[*axis][*i].is_finite());
        match (0..count).find(|i| !finite(i)) {
            Some(i) => Err((i, SolveError::NotFinite)),
            None => Ok(()),
        }
    }

    /// The linear axes one by one, where there is no closed form.
    fn place_each<const N: usize>(
        &self,
        tips: &[[f64; N]; 3],
        count: usize,
        commands: &mut [[f64; N]; MAX_AXES],
    ) -> Result<(), (usize, SolveError)> {
        for i in 0..count {
            let mut command = commands.each_ref().map(|column| column[i]);
            let tip = Vec3::new(tips[0][i], tips[1][i], tips[2][i]);
            if !self.place(tip, &mut command) {
                return Err((i, self.flat()));
            }
            for (column, q) in commands.iter_mut().zip(&command) {
                column[i] = *q;
            }
        }
        Ok(())
    }

    /// Places the tips of four poses, as [`TipControl::place`] does one after the other; `false` if one of them is not
    /// reached.
    pub fn place_four(&self, tips_mm: &[Vec3; 4], commands: &mut [Command; 4]) -> bool {
        let form = self.closed_form();
        let Some(form) = form.filter(|form| commands.iter().all(|c| form.holds_for(c))) else {
            return tips_mm.iter().zip(commands).all(|(tip, command)| self.place(*tip, command));
        };
        let tips = std::array::from_fn(|k| std::array::from_fn(|i| tips_mm[i][k]));
        let mut columns = std::array::from_fn(|axis| std::array::from_fn(|i| commands[i][axis]));
        place_group::<4>(four(), form, &tips, &mut columns);
        for axis in form.placing {
            for (command, q) in commands.iter_mut().zip(columns[axis]) {
                command[axis] = q;
            }
        }
        form.placing.iter().all(|axis| columns[*axis].iter().all(|q| q.is_finite()))
    }

    /// Places the tips of any number of poses, as [`TipControl::place`] does one after the other; `false`, and nothing
    /// placed for certain, if one of them is not reached.
    ///
    /// # Panics
    /// If there are not as many tips as commands.
    pub fn place_all(&self, tips_mm: &[Vec3], commands: &mut [Command]) -> bool {
        assert_eq!(tips_mm.len(), commands.len(), "one tip for each command");
        let groups = tips_mm.chunks(TOGETHER).zip(commands.chunks_mut(TOGETHER));
        groups.into_iter().all(|(tips, commands)| self.place_together(tips, commands))
    }

    fn place_together(&self, tips_mm: &[Vec3], commands: &mut [Command]) -> bool {
        let form = self.closed_form();
        let Some(form) = form.filter(|form| commands.iter().all(|c| form.holds_for(c))) else {
            return tips_mm.iter().zip(commands).all(|(tip, command)| self.place(*tip, command));
        };
        let mut tips = [[0.0; TOGETHER]; 3];
        let mut columns = [[0.0; TOGETHER]; MAX_AXES];
        for (i, (tip, command)) in tips_mm.iter().zip(&*commands).enumerate() {
            tips.iter_mut().zip(tip.iter()).for_each(|(column, x)| column[i] = *x);
            columns.iter_mut().zip(command).for_each(|(column, q)| column[i] = *q);
        }
        place_group(InstructionSet::best(), form, &tips, &mut columns);
        let mut is_finite = true;
        for (i, command) in commands.iter_mut().enumerate() {
            for axis in form.placing {
                command[axis] = columns[axis][i];
                is_finite &= command[axis].is_finite();
            }
        }
        is_finite
    }

    /// Tip (mm) and tool axis (unit vector) at any number of commands, as [`TipControl::tip_and_axis`] gives them one after the
    /// other, appended to `out`.
    pub fn tips_and_axes(&self, commands: &[Command], out: &mut Vec<(Vec3, Vec3)>) {
        for group in commands.chunks(TOGETHER) {
            let form = self.closed_form();
            let form = form.filter(|form| group.iter().all(|c| form.holds_for(c)));
            let Some(form) = form else {
                out.extend(group.iter().map(|command| self.tip_and_axis(command)));
                continue;
            };
            let (mut columns, mut found) = ([[0.0; TOGETHER]; MAX_AXES], [[0.0; TOGETHER]; 6]);
            for (i, command) in group.iter().enumerate() {
                columns.iter_mut().zip(command).for_each(|(column, q)| column[i] = *q);
            }
            tool_group(InstructionSet::best(), form, &columns, &mut found);
            let vector = |first: usize, i: usize| {
                Vec3::new(found[first][i], found[first + 1][i], found[first + 2][i])
            };
            out.extend((0..group.len()).map(|i| (vector(0, i), vector(3, i))));
        }
    }

    /// The nearest positions of the rotary axes for four directions, one after the other: the first is nearest to
    /// `from`, each to the one before. The linear axes stay.
    ///
    /// # Errors
    /// As [`TipControl::aim_nearest`].
    pub fn aim_four(
        &self,
        axes: &[Direction<trueaxis_geometry::frame::Workpiece>; 4],
        from: &Command,
    ) -> Result<[Command; 4], SolveError> {
        let vectors = axes.map(Direction::vector);
        let columns = std::array::from_fn(|k| std::array::from_fn(|i| vectors[i][k]));
        let mut angles = [[0.0; 4]; 4];
        let aim = self.two_axes();
        let undecided = aim.map_or(u64::MAX, |aim| aim_group(four(), aim, &columns, &mut angles));
        let (mut last, mut commands) = (*from, [*from; 4]);
        for (i, command) in commands.iter_mut().enumerate() {
            let known = (undecided >> i & 1 == 0).then(|| angles.map(|column| column[i]));
            self.aim_with(vectors[i], known, &mut last)?;
            *command = last;
        }
        Ok(commands)
    }
}

/// The instructions for four poses.
fn four() -> InstructionSet {
    match InstructionSet::Avx2.is_available() {
        true => InstructionSet::Avx2,
        false => InstructionSet::Portable,
    }
}

/// First and second angle of one branch and of the other, and the poses that only the scalar form can decide.
pub(crate) fn aim_group<const N: usize>(
    set: InstructionSet,
    aim: &Aim,
    axes: &[[f64; N]; 3],
    out: &mut [[f64; N]; 4],
) -> u64 {
    match set {
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => super::x86::aim_avx512(aim, axes, out),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => super::x86::aim_avx2(aim, axes, out),
        _ => aim_by::<4, N, Plain<4>>(aim, axes, out),
    }
}

/// The linear axes of the commands.
pub(crate) fn place_group<const N: usize>(
    set: InstructionSet,
    form: &ClosedForm,
    tips: &[[f64; N]; 3],
    commands: &mut [[f64; N]; MAX_AXES],
) {
    match set {
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => super::x86::place_avx512(form, tips, commands),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => super::x86::place_avx2(form, tips, commands),
        _ => place_by::<4, N, Plain<4>>(form, tips, commands),
    }
}

/// Tip and tool axis at commands.
fn tool_group<const N: usize>(
    set: InstructionSet,
    form: &ClosedForm,
    commands: &[[f64; N]; MAX_AXES],
    out: &mut [[f64; N]; 6],
) {
    match set {
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => super::x86::tool_avx512(form, commands, out),
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => super::x86::tool_avx2(form, commands, out),
        _ => groups::tool_by::<4, N, Plain<4>>(form, commands, out),
    }
}
