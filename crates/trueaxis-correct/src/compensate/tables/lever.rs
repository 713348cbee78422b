//! What every axis should add to its command, and what of it is a function of one axis.
//!
//! ```text
//!     c_r = −ω_r(q_r) − ω_0r                   own error motion and zero of each rotary axis, about itself
//!     c_l: tip(q + c, E(q + c)) = nominal tip(q)            all linear axes together
//!     f_io(q_i) = c_o(q_i; others at the reference) − its mean,      f_oo: + the mean of c_o
//! ```
//!
//! docs/model.md eq. 170, 171. The means are over one set of poses in the volume: so functions of one axis
//! each are recovered exactly, and where tables are missing the constant is the one that leaves least. Squareness of a rotary axis, say, is left to the linear axes: turning an axis
//! against an error of another body is right in one pose and wrong in the next.

use super::super::values::body_of;
use super::nominal::{Nominal, Nominals};
use super::spread::{Spread, together};
use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Axis, AxisKind, Command};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorValues};
use trueaxis_machine::volume::commands;

/// The correction shrinks by its own size relative to the machine in each step: far below a count after these.
const STEPS: usize = 3;

/// Poses of the means, beside the corners.
pub const POSES: u32 = 96;

/// A machine that is to be compensated, the other axes standing at a reference.
pub struct Lever<'a> {
    machine: &'a Machine,
    reference: Command,
    /// The mean correction of every axis over the volume.
    mean: Command,
    /// The mean of every output over the same poses where only this input moves.
    mean_of: Vec<Command>,
    nominals: Rc<Nominals>,
    /// What was asked before: an input gives every output at once, and they ask one after the other.
    asked: RefCell<HashMap<(usize, u64, u64), Command>>,
    uncertain: RefCell<HashMap<(usize, u64), Command>>,
    spread: OnceCell<Spread<'a>>,
}

impl<'a> Lever<'a> {
    /// # Errors
    /// A reference that an error table does not cover.
    pub fn new(machine: &'a Machine, reference: Command) -> Result<Self, CommandFault> {
        Self::sharing(machine, reference, Rc::default())
    }

    /// The same beside others of one nominal chain.
    ///
    /// # Errors
    /// As [`Lever::new`].
    pub fn sharing(
        machine: &'a Machine,
        reference: Command,
        nominals: Rc<Nominals>,
    ) -> Result<Self, CommandFault> {
        let axes = machine.axes().len();
        let mut lever = Self {
            machine,
            reference,
            mean: Command::default(),
            mean_of: vec![Command::default(); axes],
            nominals,
            asked: RefCell::default(),
            uncertain: RefCell::default(),
            spread: OnceCell::new(),
        };
        lever.whole(0, reference[0], 0.0)?;
        let mut count = 0.0;
        for pose in commands(machine.axes(), POSES) {
            let nominal = lever.nominals.at(machine, &pose);
            let all = correction_from(machine, &nominal, &pose, &Approach::default());
            let each = (0..axes).map(|input| lever.whole(input, pose[input], 0.0));
            let (Ok(all), Ok(each)) = (all, each.collect::<Result<Vec<_>, _>>()) else { continue };
            count += 1.0;
            lever.mean = sum(&lever.mean, &all);
            for (mean, one) in lever.mean_of.iter_mut().zip(&each) {
                *mean = sum(mean, one);
            }
        }
        let means = lever.mean_of.iter_mut().chain([&mut lever.mean]);
        means.flatten().for_each(|v| *v /= f64::max(count, 1.0));
        Ok(lever)
    }

    /// The machine.
    pub fn machine(&self) -> &Machine {
        self.machine
    }

    /// What an input axis at a position makes every axis add, mm or rad: the functions f_io of all
    /// outputs o.
    ///
    /// # Errors
    /// A position that an error table does not cover.
    pub fn functions(&self, input: usize, q: f64, side: f64) -> Result<Command, CommandFault> {
        let mut c = self.whole(input, q, side)?;
        for (output, axis) in self.machine.axes().iter().enumerate() {
            if axis.kind == AxisKind::Linear {
                c[output] -= self.mean_of[input][output];
                if output == input {
                    c[output] += self.mean[output];
                }
            }
        }
        Ok(c)
    }

    /// One standard uncertainty of those functions.
    ///
    /// # Errors
    /// As [`Lever::functions`].
    pub fn u(&self, input: usize, q: f64) -> Result<Command, CommandFault> {
        let key = (input, q.to_bits());
        if let Some(known) = self.uncertain.borrow().get(&key) {
            return Ok(*known);
        }
        let u = together(&self.spread().functions(input, q)?);
        self.uncertain.borrow_mut().insert(key, u);
        Ok(u)
    }

    /// One standard uncertainty of what remains at a command beside these functions, by input and output.
    ///
    /// # Errors
    /// As [`Lever::functions`].
    pub fn u_of_rest(
        &self,
        command: &Command,
        functions: &[(usize, usize)],
    ) -> Result<Command, CommandFault> {
        let mut rest = self.spread().whole(command)?;
        for (input, output) in functions {
            let each = self.spread().functions(*input, command[*input])?;
            rest.iter_mut().zip(&each).for_each(|(rest, one)| rest[*output] -= one[*output]);
        }
        Ok(together(&rest))
    }

    fn spread(&self) -> &Spread<'a> {
        self.spread.get_or_init(|| Spread::of(self.machine, self.reference))
    }

    fn whole(&self, input: usize, q: f64, side: f64) -> Result<Command, CommandFault> {
        let mut command = self.reference;
        command[input] = q;
        let mut approach = Approach::default();
        approach[input] = side;
        let key = (input, q.to_bits(), side.to_bits());
        if let Some(known) = self.asked.borrow().get(&key) {
            return Ok(*known);
        }
        let nominal = self.nominals.at(self.machine, &command);
        let added = correction_from(self.machine, &nominal, &command, &approach)?;
        self.asked.borrow_mut().insert(key, added);
        Ok(added)
    }
}

/// What every axis should add to its command at a pose, mm or rad.
///
/// # Errors
/// A command that an error table does not cover.
pub fn correction(
    machine: &Machine,
    command: &Command,
    approach: &Approach,
) -> Result<Command, CommandFault> {
    correction_from(machine, &Nominal::of(machine, command), command, approach)
}

fn correction_from(
    machine: &Machine,
    nominal: &Nominal,
    command: &Command,
    approach: &Approach,
) -> Result<Command, CommandFault> {
    let added = rotary(machine, nominal, command, &machine.errors_at(command, approach)?);
    let errors = |at: &Command| errors_near(machine, at, command, approach);
    placed(machine, (nominal, command), &errors, added)
}

/// What is added already, and what the linear axes have to add to bring the tip to its place, mm or rad; with the
/// errors at a command.
///
/// # Errors
/// Those of `errors`.
pub fn placed<F>(
    machine: &Machine,
    (nominal, command): (&Nominal, &Command),
    errors: &dyn Fn(&Command) -> Result<ErrorValues, F>,
    mut added: Command,
) -> Result<Command, F> {
    for _ in 0..STEPS {
        let at = sum(command, &added);
        let there = machine.deviation(&at, &errors(&at)?);
        let off = there.nominal_tip.vector() + there.tip_mm - nominal.tip;
        for (axis, step) in nominal.steps(&off) {
            added[axis] -= step;
        }
    }
    Ok(added)
}

/// Where the tip is when the control has added something: the errors are those of where the axes are.
///
/// # Errors
/// A command that an error table does not cover. Where only the sum lies outside a table, at the end of
/// the travel, the errors of the programmed command stand in.
pub fn errors_near(
    machine: &Machine,
    at: &Command,
    programmed: &Command,
    approach: &Approach,
) -> Result<ErrorValues, CommandFault> {
    machine.errors_at(at, approach).or_else(|_| machine.errors_at(programmed, approach))
}

/// Sum of a command and what is added to it.
pub fn sum(command: &Command, added: &Command) -> Command {
    let mut sum = *command;
    for (q, c) in sum.iter_mut().zip(added) {
        *q += c;
    }
    sum
}

/// The rotary part: each axis against its own error motion and its own zero.
pub fn rotary(
    machine: &Machine,
    nominal: &Nominal,
    command: &Command,
    errors: &ErrorValues,
) -> Command {
    let mut added = Command::default();
    for (i, sense) in nominal.senses(machine) {
        let mut own = ErrorValues::default();
        let body = body_of(machine, *i);
        for component in Component::ALL {
            let motion = ErrorIndex { body, kind: ErrorKind::Motion, component };
            own.set(motion, errors.get(motion));
        }
        let zero = own_component(&machine.axes()[*i]);
        let zero = ErrorIndex { body, kind: ErrorKind::Location, component: zero };
        own.set(zero, errors.get(zero));
        added[*i] = -sense.felt(machine, command, &own) + 0.0;
    }
    added
}

/// The direction in which an axis moves or about which it turns.
pub fn own_component(axis: &Axis) -> Component {
    let along = axis.direction.iamax();
    match axis.kind {
        AxisKind::Linear => [Component::X, Component::Y, Component::Z][along],
        AxisKind::Rotary => [Component::A, Component::B, Component::C][along],
    }
}
