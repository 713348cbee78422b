//! Compensated commands of millions of poses.
//!
//! ```text
//!     commands (one column per axis) ──CompiledCompensator──> compensated commands
//! ```
//!
//! The same poses as [`Compensator::at`], to the same 1e-10 mm and 1e-13 rad, by steps with the
//! Jacobian of the *nominal* machine at the programmed command: each step reduces the residual error
//! to about 10⁻⁴ of itself (the size of the angles and slopes of the errors). The residual error is
//! determined with the chain and its errors, or from the factor of the previous steps
//! (docs/model.md eq. 163). Poses near a pole, at the ends of travel, with large errors or outside
//! the compiled form are passed to [`Compensator::at`], so that every pose has a result.

mod columns;
mod jacobian;
pub(super) mod newton;

pub use columns::{CommandColumns, CommandTable};

use super::steps::location_errors;
#[cfg(target_arch = "x86_64")]
use super::x86;
use super::{BatchError, Commands, Inputs, InstructionSet, Plan, TASK_POSES, portable};
use crate::axis::{Approach, Command, MAX_AXES, Travel};
use crate::chain::Machine;
use crate::compensate::{Compensator, Fault, Scope};
use std::ops::Add;
use trueaxis_geometry::Vec3;

/// Why a batch is not compensated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CompensationError {
    /// The columns do not fit, or the processor.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// A pose has no compensation.
    #[error("pose {index}: {fault}")]
    Pose {
        /// The first such pose, counted from 0.
        index: usize,
        /// Why.
        fault: Fault,
    },
}

/// What a batch cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Effort {
    /// How often the chain was evaluated, all poses together.
    pub evaluations: u64,
    /// How many poses went to [`Compensator::at`].
    pub by_scalar: u64,
}

impl Add for Effort {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            evaluations: self.evaluations + other.evaluations,
            by_scalar: self.by_scalar + other.by_scalar,
        }
    }
}

/// A [`Compensator`] compiled for batches of poses.
///
/// # Example
/// ```
/// use trueaxis_machine::batch::{CommandTable, Commands, CompiledCompensator};
/// use trueaxis_machine::compensate::{Compensator, Scope};
/// use trueaxis_machine::{Machine, file::NoTables};
/// let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n\
///             [location]\nEC0Y = \"10 urad\"";
/// let machine = Machine::check("mill.toml", text, &NoTables).0.expect("a machine");
///
/// // 10 µrad of squareness: X goes to +1, +2, +5 µm at Y = 100, 200, 500 mm.
/// let (x, y, z) = ([0.0; 3], [100.0, 200.0, 500.0], [0.0; 3]);
/// let mut table = CommandTable::zeros(3, 3);
/// let compiled = CompiledCompensator::new(Compensator::of(&machine, Scope::Pose)?);
/// compiled.commands(&Commands::new(&[&x, &y, &z]), &mut table.columns())?;
/// assert!((table.at(2)[0] - 0.005).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct CompiledCompensator {
    compensator: Compensator,
    /// `None` where every pose takes the scalar path.
    fast: Option<FastForm>,
}

/// What the kernel runs.
#[derive(Debug, Clone)]
struct FastForm {
    plan: Plan,
    /// The linear axes that place the tip.
    placing: [usize; 3],
    /// The rotary axes that turn the tool; `None` if they stay.
    turning: Option<[usize; 2]>,
    /// Below this square the weaker direction of the nominal tool axis is left to the scalar path,
    /// which asks the actual one.
    weakest_square: f64,
    /// From where to where each axis goes.
    travel: [(f64, f64); MAX_AXES],
    /// How the workpiece grows: by so much of the way from its fixed point, mm.
    growth: Option<(f64, Vec3)>,
}

impl FastForm {
    fn of(compensator: &Compensator) -> Option<Self> {
        let machine = compensator.machine();
        let turning = match (compensator.scope(), compensator.rotary()) {
            (Scope::Position, _) | (Scope::Pose, [] | [_]) => None,
            (Scope::Pose, &[first, second]) => Some([first, second]),
            (Scope::Pose, _) => return None,
        };
        let growth = match machine.growth() {
            None => None,
            Some(growth) => {
                let per_mm = growth.per_mm()?;
                Some((per_mm, growth.fixed_mm))
            }
        };
        let mut travel = [(f64::NEG_INFINITY, f64::INFINITY); MAX_AXES];
        for (ends, axis) in travel.iter_mut().zip(machine.axes()) {
            if let Travel::Between(from, to) = axis.travel {
                *ends = (from, to);
            }
        }
        let plan = Plan::of(machine)?;
        let weakest = 1.0 / compensator.most_swing() + largest_turn(machine, &plan, &travel);
        Some(Self {
            plan,
            placing: compensator.placing(),
            turning,
            weakest_square: weakest * weakest,
            travel,
            growth,
        })
    }
}

/// A bound of the angle between the actual and the nominal tool as seen from any body, rad.
fn largest_turn(machine: &Machine, plan: &Plan, travel: &[(f64, f64); MAX_AXES]) -> f64 {
    let turns = |values: [f64; 6]| values[3..].iter().map(|v| v.abs()).sum::<f64>();
    let location = machine.bodies().iter().map(|body| turns(location_errors(body).0));
    let motions = plan.motions.iter().map(|motion| {
        let (from, to) = travel[motion.axis];
        3.0 * motion.largest_turn(plan.ranges[motion.axis].within(from, to))
    });
    location.chain(motions).sum()
}

/// What a kernel is given: poses `first ..` of the inputs.
pub(super) struct CompensationJob<'a> {
    compensator: &'a Compensator,
    fast: &'a FastForm,
    inputs: &'a Inputs<'a>,
    first: usize,
}

impl CompiledCompensator {
    /// Compiles a compensator.
    pub fn new(compensator: Compensator) -> Self {
        let fast = FastForm::of(&compensator);
        Self { compensator, fast }
    }

    /// The compensator that was compiled.
    pub fn compensator(&self) -> &Compensator {
        &self.compensator
    }

    fn machine(&self) -> &Machine {
        self.compensator.machine()
    }

    /// Whether there is a fast form at all; without one every pose takes the scalar path.
    pub fn is_fast(&self) -> bool {
        self.fast.is_some()
    }

    /// The compensated command of every pose, on the calling thread; allocates nothing.
    ///
    /// # Errors
    /// Columns that do not fit; the first pose without a compensation, see [`Fault`]. Then the
    /// columns hold the poses before it, and the rows after it are undefined.
    pub fn commands(
        &self,
        commands: &Commands<'_>,
        out: &mut CommandColumns<'_>,
    ) -> Result<Effort, CompensationError> {
        self.commands_by(InstructionSet::best(), commands, out)
    }

    /// The same with given vector instructions, for tests and benches.
    ///
    /// # Errors
    /// As [`CompiledCompensator::commands`]; instructions that this processor lacks.
    pub fn commands_by(
        &self,
        set: InstructionSet,
        commands: &Commands<'_>,
        out: &mut CommandColumns<'_>,
    ) -> Result<Effort, CompensationError> {
        if !set.is_available() {
            return Err(BatchError::Unavailable(set).into());
        }
        self.fit(commands, out)?;
        self.run(set, &commands.inputs(), out, 0)
    }

    /// The same on all threads of the present rayon pool; bit for bit the same numbers.
    ///
    /// # Errors
    /// As [`CompiledCompensator::commands`].
    pub fn commands_parallel(
        &self,
        commands: &Commands<'_>,
        out: &mut CommandColumns<'_>,
    ) -> Result<Effort, CompensationError> {
        self.fit(commands, out)?;
        self.halves(&commands.inputs(), out.reborrow(), 0)
    }

    fn fit(&self, commands: &Commands<'_>, out: &CommandColumns<'_>) -> Result<(), BatchError> {
        let (expected, found) = (self.machine().axes().len(), out.axes());
        if found != expected {
            return Err(BatchError::Columns { expected, found });
        }
        commands.fit(expected, out.lengths())
    }

    fn halves(
        &self,
        inputs: &Inputs<'_>,
        mut out: CommandColumns<'_>,
        first: usize,
    ) -> Result<Effort, CompensationError> {
        let length = out.len();
        if length <= TASK_POSES {
            return self.run(InstructionSet::best(), inputs, &mut out, first);
        }
        let middle = (length / 2).next_multiple_of(64);
        let (left, right) = out.split_at(middle);
        let (left, right) = rayon::join(
            || self.halves(inputs, left, first),
            || self.halves(inputs, right, first + middle),
        );
        // The left error comes first, whichever half ended first.
        Ok(left? + right?)
    }

    /// Poses `first ..` of the inputs, as many as `out` holds.
    fn run(
        &self,
        set: InstructionSet,
        inputs: &Inputs<'_>,
        out: &mut CommandColumns<'_>,
        first: usize,
    ) -> Result<Effort, CompensationError> {
        let compensator = &self.compensator;
        let Some(fast) = &self.fast else {
            return (0..out.len()).try_fold(Effort::default(), |effort, i| {
                Ok(effort + one(compensator, inputs, out, [first, i])?)
            });
        };
        let job = CompensationJob { compensator, fast, inputs, first };
        match set {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => x86::compensate_avx512(&job, out),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => x86::compensate_avx2(&job, out),
            _ => portable::compensate_portable(&job, out),
        }
    }
}

/// One pose by the scalar path: pose `first + i` of the inputs into entry `i` of `out`.
#[cold]
#[inline(never)]
fn one(
    compensator: &Compensator,
    inputs: &Inputs<'_>,
    out: &mut CommandColumns<'_>,
    [first, i]: [usize; 2],
) -> Result<Effort, CompensationError> {
    let index = first + i;
    let (mut command, mut approach) = (Command::default(), Approach::default());
    for axis in 0..compensator.machine().axes().len() {
        command[axis] = inputs.positions[axis][index];
        approach[axis] = inputs.approaches[axis].get(index).copied().unwrap_or(0.0);
    }
    let done = compensator
        .at(&command, &approach)
        .map_err(|fault| CompensationError::Pose { index, fault })?;
    out.set(i, &done.command);
    Ok(Effort { evaluations: u64::from(done.evaluations), by_scalar: 1 })
}
