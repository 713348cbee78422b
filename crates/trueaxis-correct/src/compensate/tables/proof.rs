//! What the tables of a control leave: over the volume, of each error alone, of a test piece.

use super::carrier_chain::CarrierChain;
use super::choose::off;
use super::content::Content;
use super::control::Control;
use super::emulation::Emulation;
use super::joints::{Joints, moves_an_axis};
use super::known::split;
use super::lever::{Lever, correction, errors_near, placed, sum};
use super::nominal::Nominals;
use super::{Order, TablesError};
use std::rc::Rc;
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command, MAX_AXES};
use trueaxis_machine::chain::{ChainBody, CommandFault};
use trueaxis_machine::errors::{ErrorKind, ErrorName, ErrorValues};
use trueaxis_machine::volume::commands;
use trueaxis_predict::predict::drawing::{
    CompensatedPart, DeviationSource, Deviations, PartPrediction, PartStudy,
    predict_with_deviations,
};
use trueaxis_predict::predict::{Cutting, Error, Judge, Study};

/// Poses over the travel of all axes beside the corners, each reached rising and falling.
const POSES: u32 = 4096;
/// Poses for each error alone.
const FEW_POSES: u32 = 96;
/// Less than this no error does: 1 nm.
const NOTHING_MM: f64 = 1e-6;
/// An error counts as represented if this share of what it did is left.
const SMALL_SHARE: f64 = 0.02;

/// How far the tool is off over the volume.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Left {
    /// Poses that were evaluated, each in two directions.
    pub poses: usize,
    /// The largest distance of the tips, mm.
    pub max_mm: f64,
    /// Where it is.
    pub at: Command,
    /// Root mean square, mm.
    pub rms_mm: f64,
    /// The largest angle between the tool axes, rad.
    pub axis_rad: f64,
}

/// What one error does alone, and what these tables can leave of it.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorLoss {
    /// Which.
    pub error: ErrorName,
    /// The most that it moves the tip, mm.
    pub before_mm: f64,
    /// The most that is left, mm.
    pub left_mm: f64,
    /// Whether the tables represent it.
    pub represented: bool,
    /// Where the rest could be put.
    pub instead: &'static str,
}

/// The residual error over the volume.
///
/// # Errors
/// No pose at all at which the errors are known.
pub fn left_over(leaves: &Emulation<'_>) -> Result<Left, TablesError> {
    left_from(leaves, Vec3::zeros())
}

/// The same after the part zero was set where the axes stand at a command, with the tables in force: what is off there
/// is taken along everywhere.
///
/// # Errors
/// As of [`left_over`]; that the errors are not known at the command.
pub fn left_after_zero_set(leaves: &Emulation<'_>, command: &Command) -> Result<Left, TablesError> {
    let mut zero = Vec3::zeros();
    for side in [1.0, -1.0] {
        let approach = [side; MAX_AXES];
        let added = leaves.added(command, &approach);
        match off(leaves.machine(), command, &added, &approach) {
            Some([tip, _]) => zero += tip * 0.5,
            None => {
                leaves.machine().errors_at(command, &approach)?;
            }
        }
    }
    left_from(leaves, zero)
}

fn left_from(leaves: &Emulation<'_>, zero: Vec3) -> Result<Left, TablesError> {
    let mut left = Left::default();
    let (mut squares, mut count) = (0.0, 0.0);
    for command in commands(leaves.machine().axes(), POSES) {
        let mut seen = false;
        for side in [1.0, -1.0] {
            let approach = [side; MAX_AXES];
            let added = leaves.added(&command, &approach);
            let Some([tip, axis]) = off(leaves.machine(), &command, &added, &approach) else {
                continue;
            };
            let tip = tip - zero;
            seen = true;
            squares += tip.norm_squared();
            count += 1.0;
            left.axis_rad = left.axis_rad.max(axis.norm());
            if tip.norm() > left.max_mm {
                (left.max_mm, left.at) = (tip.norm(), command);
            }
        }
        left.poses += usize::from(seen);
    }
    if left.poses == 0 {
        leaves.machine().errors_at(&Command::default(), &Approach::default())?;
    }
    left.rms_mm = (squares / f64::max(count, 1.0)).sqrt();
    Ok(left)
}

/// Each error alone: what such content of this control, without rounding and with any number of nodes, would
/// leave. `elsewhere`: the functions, by input and output, that are not for the grid.
pub fn error_losses(
    machine: &Machine,
    reference: &Command,
    (control, content, elsewhere): (&dyn Control, &Content, &[(usize, usize)]),
    order: &Order,
) -> Vec<ErrorLoss> {
    let bound_mm = order.bound_mm;
    let cold = machine.without_heat();
    let all = machine.stated_errors();
    let bare = all.iter().fold(cold.clone(), |m, (index, _)| m.with_error(*index, None));
    let poses = commands(machine.axes(), FEW_POSES);
    let mut losses = Vec::new();
    let nominals = Rc::new(Nominals::default());
    for (index, error) in all {
        let stated = cold.bodies()[index.body].stated(index.kind, index.component).cloned();
        let alone = bare.clone().with_error(index, stated);
        let (chain, rest) = split(&alone, control, order.kinematics);
        let parts = (&chain, &rest);
        let of = (control, content, elsewhere);
        let Ok(best) = Best::of(parts, *reference, of, &nominals) else {
            continue;
        };
        let (mut before_mm, mut left_mm) = (0.0_f64, 0.0_f64);
        for (i, command) in poses.iter().enumerate() {
            let approach = [if i % 2 == 0 { 1.0 } else { -1.0 }; MAX_AXES];
            let Some(without) = off(&alone, command, &Command::default(), &approach) else {
                continue;
            };
            before_mm = before_mm.max(without[0].norm());
            let Ok(added) = best.added(command, &approach) else { continue };
            let Some(with) = off(&alone, command, &added, &approach) else { continue };
            left_mm = left_mm.max(with[0].norm());
        }
        if before_mm > NOTHING_MM {
            let represented =
                left_mm <= f64::max(bound_mm.min(0.5 * before_mm), SMALL_SHARE * before_mm);
            let instead = instead(machine, error, control);
            losses.push(ErrorLoss { error, before_mm, left_mm, represented, instead });
        }
    }
    losses.sort_by(|a, b| b.left_mm.total_cmp(&a.left_mm));
    losses
}

/// The best that a control could do with such tables, such a chain and such a grid.
struct Best<'a> {
    /// With what the control's chain knows.
    chain: &'a Machine,
    /// With what remains for tables and grid.
    rest: &'a Machine,
    control: &'a dyn Control,
    content: &'a Content,
    /// The functions that are not for the grid.
    elsewhere: &'a [(usize, usize)],
    reference: Command,
    lever: Lever<'a>,
    carrier: Option<CarrierChain>,
    nominals: &'a Rc<Nominals>,
}

impl<'a> Best<'a> {
    fn of(
        (chain, rest): (&'a Machine, &'a Machine),
        reference: Command,
        (control, content, elsewhere): (&'a dyn Control, &'a Content, &'a [(usize, usize)]),
        nominals: &'a Rc<Nominals>,
    ) -> Result<Self, CommandFault> {
        let lever = Lever::sharing(rest, reference, nominals.clone())?;
        let carrier = control.carrier_chain(chain, &Joints::actual(chain));
        Ok(Self { chain, rest, control, content, elsewhere, reference, lever, carrier, nominals })
    }

    fn added(&self, command: &Command, approach: &Approach) -> Result<Command, CommandFault> {
        let written = self.content.tables.iter().map(|t| (t.input, t.output));
        let mut total = self.by_functions(written, command, approach)?;
        if let Some(grid) = &self.content.grid {
            let mut at = self.reference;
            for side in &grid.sides {
                at[side.axis] = command[side.axis];
            }
            let still = Approach::default();
            let whole = correction(self.rest, &at, &still)?;
            let elsewhere = self.by_functions(self.elsewhere.iter().copied(), &at, &still)?;
            for (i, side) in grid.sides.iter().enumerate() {
                if grid.values.iter().any(|value| value[i] != 0) {
                    total[side.axis] += whole[side.axis] - elsewhere[side.axis];
                }
            }
        }
        Ok(sum(&total, &self.by_chain(command)?))
    }

    fn by_chain(&self, command: &Command) -> Result<Command, CommandFault> {
        if let Some(carrier) = &self.carrier {
            return Ok(carrier.added(self.chain, command));
        }
        let joints = Joints::actual(self.chain);
        let errors = |at: &Command| match self.control.knows_links() {
            // Such a chain has one value for both directions.
            true => errors_near(self.chain, at, command, &Approach::default()),
            false => {
                let mut errors = ErrorValues::default();
                joints.place(self.chain, &mut errors);
                Ok(errors)
            }
        };
        let nominal = self.nominals.at(self.chain, command);
        placed(self.chain, (&nominal, command), &errors, Command::default())
    }

    fn by_functions(
        &self,
        functions: impl Iterator<Item = (usize, usize)>,
        command: &Command,
        approach: &Approach,
    ) -> Result<Command, CommandFault> {
        let mut total = Command::default();
        for (input, output) in functions {
            let all = self.lever.functions(input, command[input], approach[input])?;
            total[output] += all[output];
        }
        Ok(total)
    }
}

/// Where an error of the workpiece or the tool on the last axis could be put.
const WITH_THE_END: &str = "the work offset, or the tool length and its direction";

/// Whether an error shifts the last rotary axis before workpiece or tool along itself: they go with it whatever
/// it turns.
fn goes_with_the_end(machine: &Machine, error: ErrorName) -> bool {
    let (bodies, side) = (machine.bodies(), machine.workpiece_side());
    let last = [bodies[..side].get(1), bodies[side..].iter().nth_back(1)];
    let along = |axis: usize| machine.axes()[axis].direction.iamax() == error.component as usize;
    let is_it = |body: &ChainBody| body.name == error.body && body.axis.is_some_and(along);
    last.into_iter().flatten().any(is_it)
}

/// Where the rest of an error could be put.
fn instead(machine: &Machine, error: ErrorName, control: &dyn Control) -> &'static str {
    let axis = machine.axes().iter().find(|a| a.name == error.body);
    let cross = control.has_cross_tables() || control.knows_links() || control.grid().is_some();
    match (error.kind, axis.map(|a| a.kind), error.component.is_rotation()) {
        (ErrorKind::Location, None, _) => WITH_THE_END,
        (ErrorKind::Location, Some(AxisKind::Rotary), _) if !moves_an_axis(machine, error) => {
            "the zero of the axis"
        }
        (ErrorKind::Location, Some(AxisKind::Rotary), false)
            if goes_with_the_end(machine, error) =>
        {
            WITH_THE_END
        }
        (ErrorKind::Location, Some(AxisKind::Rotary), _) => {
            "the control's kinematic parameters (rotary centres and tilts), or the NC program"
        }
        (ErrorKind::Location, _, false) => "the zero of the axis",
        (ErrorKind::Motion, _, true) => {
            "the NC program; a volumetric compensation for the position alone"
        }
        _ if !cross => "a control with cross tables, or the NC program",
        _ => "the NC program",
    }
}

/// An index of a test piece before and after.
#[derive(Debug, Clone, PartialEq)]
pub struct IndexLeft {
    /// Its key.
    pub key: String,
    /// Without tables, mm.
    pub before_mm: f64,
    /// With the tables as they were read back, mm.
    pub left_mm: f64,
}

/// The indices of a test piece cut with the tables; the zero is set with them on.
///
/// # Errors
/// As of [`trueaxis_predict::predict::predict`].
pub fn piece_left(
    study: &Study,
    (control, content): (&dyn Control, &Content),
) -> Result<Vec<IndexLeft>, Error> {
    let machine = &study.machine;
    let plain = |errors: &_, _: &_| *errors;
    let cutting = Cutting::new(machine, study.piece(), &study.reference)?;
    let before = Judge { cutting: &cutting, piece: study.piece() }.once(&plain)?;
    let leaves = Emulation::new(machine, control, content);
    let cutting = cutting.compensated(&|command, approach| leaves.added(command, approach));
    let after = Judge { cutting: &cutting, piece: study.piece() }.once(&plain)?;
    let names = study.piece().index_names().iter().map(|n| n.key.to_string());
    let pairs = names.zip(before.into_iter().zip(after));
    Ok(pairs.map(|(key, (before_mm, left_mm))| IndexLeft { key, before_mm, left_mm }).collect())
}

/// A control with its content, whatever the machine.
struct WithTables<'a> {
    control: &'a dyn Control,
    content: &'a Content,
}

impl DeviationSource for WithTables<'_> {
    fn deviations<'m>(&'m self, machine: &'m Machine) -> Deviations<'m> {
        let leaves = Emulation::new(machine, self.control, self.content);
        Box::new(move |command, approach| {
            off(machine, command, &leaves.added(command, approach), approach)
        })
    }
}

/// The part of a study cut with the tables in the control: the zero where it was set without them, and set again with them.
///
/// # Errors
/// As [`predict_with_deviations`].
pub fn part_left(
    study: &PartStudy,
    prediction: &PartPrediction,
    (control, content): (&dyn Control, &Content),
    problems: &mut Diagnostics,
) -> Option<CompensatedPart> {
    predict_with_deviations(study, prediction, &WithTables { control, content }, problems)
}
