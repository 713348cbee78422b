//! Deviations of millions of poses: the machine compiled to flat arrays.
//!
//! ```text
//!     Machine ──CompiledMachine::new──> rows of cubics per axis + list of steps of the chain
//!     commands (one column per axis) ──deviations──> 12 columns: nominal tip and axis, deviations
//! ```
//!
//! Same result as [`Machine::deviation`], to 1e-9 mm on nominal tips and 1e-12 mm on deviations:
//! the differences are propagated along with the nominal vectors, and no order of smallness is
//! neglected. What the compiled form does not cover (small-angle model, squareness of the direction
//! only, error motions above [`LARGEST_TURN_RAD`], commands beyond 10⁴ rad or beyond an extended
//! table) is computed pose by pose with the machine itself, so every machine and every command has
//! a result.
//!
//! A pose's numbers depend on nothing but its own command: not on its neighbours, not on the
//! number of threads.

mod chain;
mod columns;
mod compensated;
pub(crate) mod drawn;
mod groups;
mod inverse;
mod kernel;
mod lanes;
mod motion;
mod pieces;
mod portable;
mod steps;
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code, reason = "vector instructions that only some processors have")]
mod x86;

pub use chain::{CompiledChain, Frames, GROUP, Group, Station, sines_and_cosines};
pub use columns::{Commands, DeviationColumns, DeviationTable};
pub use compensated::{
    CommandColumns, CommandTable, CompensationError, CompiledCompensator, Effort,
};
pub use inverse::{CompiledInverse, InverseError, TargetColumns};
pub(crate) use inverse::{aim_group, place_group};
pub use motion::LARGEST_TURN_RAD;

use crate::axis::{Approach, Command, MAX_AXES};
use crate::chain::{CommandFault, Machine};
use crate::errors::{Curve, ErrorValues, Rotation};
use motion::{Motion, Range};
use steps::Steps;
use trueaxis_geometry::Vec3;

/// Poses that one task of a parallel batch computes at least.
const TASK_POSES: usize = 8192;

/// The reason why a batch has no result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BatchError {
    /// Not one column of commands per axis.
    #[error("the batch has {found} columns, but the machine has {expected} axes")]
    Columns {
        /// Axes of the machine.
        expected: usize,
        /// Columns given.
        found: usize,
    },
    /// Columns of different lengths.
    #[error("a column has {found} rows, but the batch has {expected} poses")]
    Lengths {
        /// Entries of the first column of commands.
        expected: usize,
        /// Entries of the column that differs.
        found: usize,
    },
    /// A command, or what follows from it, is not a finite number.
    #[error("pose {index}: the command or its result is not a finite number")]
    NotFinite {
        /// The first such pose, counted from 0.
        index: usize,
    },
    /// The machine has no errors at a command.
    #[error("pose {index}: {source}")]
    Refused {
        /// The first such pose, counted from 0.
        index: usize,
        /// The reason.
        source: CommandFault,
    },
    /// The processor does not support the required instructions.
    #[error("this processor does not support {0:?}")]
    Unavailable(InstructionSet),
}

impl BatchError {
    /// The first pose without a result, if it is the fault of a pose.
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::NotFinite { index } | Self::Refused { index, .. } => Some(*index),
            _ => None,
        }
    }
}

/// The vector instructions that compute the batch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum InstructionSet {
    /// Whatever the compiler makes of plain loops.
    Portable,
    /// Four poses at a time, x86-64 with AVX2 and FMA.
    Avx2,
    /// Eight poses at a time, x86-64 with AVX-512F.
    Avx512,
}

impl InstructionSet {
    /// All of them, slowest first.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// Whether this processor supports it.
    pub fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => x86::has_avx2(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => x86::has_avx512(),
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// The fastest that this processor supports.
    pub fn best() -> Self {
        Self::ALL.into_iter().rev().find(|set| set.is_available()).unwrap_or(Self::Portable)
    }
}

/// A [`Machine`] with one tool tip, compiled for batches of poses.
///
/// # Example
/// ```
/// use trueaxis_machine::batch::{Commands, CompiledMachine, DeviationTable};
/// use trueaxis_machine::{Machine, file::NoTables};
/// let text = r#"
///     [machine]
///     name = "three axes"
///     chain = "w b X Y Z t"
///     [tool]
///     length = "100 mm"
///     [location]
///     EC0Y = "10 urad"
/// "#;
/// let machine = Machine::check("machine.toml", text, &NoTables).0.unwrap();
///
/// // 10 µrad of squareness at Y = 100, 200, 500 mm move the tool by −1, −2, −5 µm in X.
/// let (x, y, z) = ([0.0; 3], [100.0, 200.0, 500.0], [0.0; 3]);
/// let mut table = DeviationTable::zeros(3);
/// CompiledMachine::new(&machine)
///     .deviations(&Commands::new(&[&x, &y, &z]), &mut table.columns())?;
/// assert!((table.at(2).tip_mm.x + 0.005).abs() < 1e-9);
/// # Ok::<(), trueaxis_machine::batch::BatchError>(())
/// ```
#[derive(Debug, Clone)]
pub struct CompiledMachine {
    /// For what the compiled form does not cover.
    machine: Machine,
    /// `None` where it covers nothing of this machine.
    plan: Option<Plan>,
}

/// What the kernels run.
#[derive(Debug, Clone)]
struct Plan {
    /// Where the compiled form of each axis holds; the scalar path computes poses outside.
    ranges: Vec<Range>,
    motions: Vec<Motion>,
    steps: Steps,
}

impl CompiledMachine {
    /// Compiles a machine with its present tip, mounting and error model.
    pub fn new(machine: &Machine) -> Self {
        Self { machine: machine.clone(), plan: Plan::of(machine) }
    }

    /// The machine that was compiled.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Whether there is a fast form at all; without one every pose takes the scalar path.
    pub fn is_fast(&self) -> bool {
        self.plan.is_some()
    }

    /// The deviation of every pose, on the calling thread.
    ///
    /// Allocates nothing. After an error the columns hold the poses before the first bad one; the
    /// rows after it are undefined.
    ///
    /// # Errors
    /// Columns that do not fit; the first pose outside an error table that has no value there, or
    /// with a number that is not finite.
    pub fn deviations(
        &self,
        commands: &Commands<'_>,
        out: &mut DeviationColumns<'_>,
    ) -> Result<(), BatchError> {
        self.deviations_by(InstructionSet::best(), commands, out)
    }

    /// The same with given vector instructions, for tests and benches.
    ///
    /// # Errors
    /// As [`CompiledMachine::deviations`]; instructions that this processor does not support.
    pub fn deviations_by(
        &self,
        set: InstructionSet,
        commands: &Commands<'_>,
        out: &mut DeviationColumns<'_>,
    ) -> Result<(), BatchError> {
        if !set.is_available() {
            return Err(BatchError::Unavailable(set));
        }
        commands.fit(self.machine.axes().len(), out.lengths())?;
        self.run(set, &commands.inputs(), out, 0)
    }

    /// The same on all threads of the present rayon pool; bit for bit the same numbers.
    ///
    /// # Errors
    /// As [`CompiledMachine::deviations`].
    pub fn deviations_parallel(
        &self,
        commands: &Commands<'_>,
        out: &mut DeviationColumns<'_>,
    ) -> Result<(), BatchError> {
        commands.fit(self.machine.axes().len(), out.lengths())?;
        self.halves(InstructionSet::best(), &commands.inputs(), out.reborrow(), 0)
    }

    fn halves(
        &self,
        set: InstructionSet,
        inputs: &Inputs<'_>,
        mut out: DeviationColumns<'_>,
        first: usize,
    ) -> Result<(), BatchError> {
        let length = out.len();
        if length <= TASK_POSES {
            return self.run(set, inputs, &mut out, first);
        }
        // Whole groups of lanes in the left half.
        let middle = (length / 2).next_multiple_of(64);
        let (left, right) = out.split_at(middle);
        let (left, right) = rayon::join(
            || self.halves(set, inputs, left, first),
            || self.halves(set, inputs, right, first + middle),
        );
        // The left error comes first, whichever half ended first.
        left.and(right)
    }

    /// Poses `first ..` of the inputs, as many as `out` holds.
    fn run(
        &self,
        set: InstructionSet,
        inputs: &Inputs<'_>,
        out: &mut DeviationColumns<'_>,
        first: usize,
    ) -> Result<(), BatchError> {
        let done = self.machine_part(set, inputs, out, first);
        if let Some(growth) = self.machine.growth() {
            for i in 0..out.len() {
                let [x, y, z] = &out.nominal_tip_mm;
                let grown = growth.at(Vec3::new(x[i], y[i], z[i]));
                for (column, e) in out.tip_mm.iter_mut().zip(grown.iter()) {
                    column[i] -= e;
                }
            }
        }
        done
    }

    fn machine_part(
        &self,
        set: InstructionSet,
        inputs: &Inputs<'_>,
        out: &mut DeviationColumns<'_>,
        first: usize,
    ) -> Result<(), BatchError> {
        let Some(plan) = &self.plan else {
            return (0..out.len()).try_for_each(|i| self.one(inputs, out, first, i));
        };
        let job = Job { compiled: self, plan, inputs, first };
        match set {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => x86::run_avx512(&job, out),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => x86::run_avx2(&job, out),
            _ => portable::run_portable(&job, out),
        }
    }

    /// One pose by the scalar path: pose `first + i` of the inputs into entry `i` of `out`.
    #[cold]
    fn one(
        &self,
        inputs: &Inputs<'_>,
        out: &mut DeviationColumns<'_>,
        first: usize,
        i: usize,
    ) -> Result<(), BatchError> {
        let index = first + i;
        let (mut command, mut approach) = (Command::default(), Approach::default());
        for axis in 0..self.machine.axes().len() {
            command[axis] = inputs.positions[axis][index];
            approach[axis] = inputs.approaches[axis].get(index).copied().unwrap_or(0.0);
        }
        if !command.iter().chain(&approach).all(|v| v.is_finite()) {
            return Err(BatchError::NotFinite { index });
        }
        let errors = self
            .machine
            .errors_at(&command, &approach)
            .map_err(|source| BatchError::Refused { index, source })?;
        // The growth of the workpiece comes to all poses together.
        let errors = ErrorValues { workpiece_mm: Vec3::zeros(), ..errors };
        let deviation = self.machine.deviation(&command, &errors);
        if !out.set(i, &deviation) {
            return Err(BatchError::NotFinite { index });
        }
        Ok(())
    }
}

/// Columns of commands and of approaches; an empty approach is not known.
struct Inputs<'a> {
    positions: [&'a [f64]; MAX_AXES],
    approaches: [&'a [f64]; MAX_AXES],
}

/// What a kernel is given: poses `first ..` of the inputs.
struct Job<'a> {
    compiled: &'a CompiledMachine,
    plan: &'a Plan,
    inputs: &'a Inputs<'a>,
    first: usize,
}

impl Plan {
    fn of(machine: &Machine) -> Option<Self> {
        if !is_covered(machine) {
            return None;
        }
        let mut ranges = vec![Range::EMPTY; machine.axes().len()];
        let mut motions = Vec::new();
        let mut motion_of_body = vec![None; machine.bodies().len()];
        for (body, number) in machine.bodies().iter().zip(&mut motion_of_body) {
            let Some(index) = body.axis else { continue };
            let axis = &machine.axes()[index];
            ranges[index] = Range::of(body, axis);
            if let Some((motion, range)) = Motion::of(body, axis, index, ranges[index]) {
                ranges[index] = range;
                *number = Some(motions.len());
                motions.push(motion);
            }
        }
        let steps = Steps::of(machine, &motion_of_body)?;
        Some(Self { ranges, motions, steps })
    }
}

/// Whether the kernels know everything that this machine states.
fn is_covered(machine: &Machine) -> bool {
    let are_locations_constant = machine.bodies().iter().all(|body| {
        let mut stated = body.location.iter().flatten();
        stated.all(|e| matches!(e.mean, Curve::Constant(_)) && e.reversal.is_none())
    });
    let move_only_axes = machine
        .bodies()
        .iter()
        .all(|body| body.axis.is_some() || body.motion.iter().all(Option::is_none));
    machine.model().rotation == Rotation::Exact && are_locations_constant && move_only_axes
}
