//! What the nominal machine says of a pose, kept: every error alone and every table ask for the same poses.

use super::super::values::Sense;
use nalgebra::{DMatrix, DVector};
use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};
use trueaxis_machine::errors::ErrorValues;

/// The nominal tip, and how the axes move it.
pub struct Nominal {
    command: Command,
    /// Where the tip is in the workpiece frame.
    pub tip: Vec3,
    linear: LinearInverse,
    senses: OnceCell<Vec<(usize, Sense)>>,
}

impl Nominal {
    /// At a command, whatever the errors of the machine are.
    pub fn of(machine: &Machine, command: &Command) -> Self {
        Self {
            command: *command,
            tip: nominal_tip(machine, command),
            linear: LinearInverse::of(machine, command),
            senses: OnceCell::new(),
        }
    }

    /// The steps of the linear axes that move the tip so far.
    pub fn steps(&self, off: &Vec3) -> Vec<(usize, f64)> {
        self.linear.steps(off)
    }

    /// Each rotary axis, and how the tool turns with it.
    pub fn senses(&self, machine: &Machine) -> &[(usize, Sense)] {
        self.senses.get_or_init(|| {
            let rotary =
                machine.axes().iter().enumerate().filter(|(_, a)| a.kind == AxisKind::Rotary);
            rotary.map(|(i, _)| (i, Sense::of(machine, i, &self.command))).collect()
        })
    }
}

/// Those of one chain, by their commands.
#[derive(Default)]
pub struct Nominals(RefCell<HashMap<[u64; MAX_AXES], Rc<Nominal>>>);

impl Nominals {
    /// That of a command; every machine that asks here has the same nominal chain.
    pub fn at(&self, machine: &Machine, command: &Command) -> Rc<Nominal> {
        let key = command.map(f64::to_bits);
        let mut known = self.0.borrow_mut();
        known.entry(key).or_insert_with(|| Rc::new(Nominal::of(machine, command))).clone()
    }
}

/// From an error of the tip to the steps of the linear axes that make it, the least ones if there is a choice.
pub struct LinearInverse {
    axes: Vec<usize>,
    inverse: DMatrix<f64>,
}

impl LinearInverse {
    /// At a command.
    pub fn of(machine: &Machine, command: &Command) -> Self {
        let linear = machine.axes().iter().enumerate().filter(|(_, a)| a.kind == AxisKind::Linear);
        let axes: Vec<usize> = linear.map(|(i, _)| i).collect();
        let columns: Vec<Vec3> = axes
            .iter()
            .map(|i| {
                let (mut more, mut less) = (*command, *command);
                more[*i] += 0.5;
                less[*i] -= 0.5;
                nominal_tip(machine, &more) - nominal_tip(machine, &less)
            })
            .collect();
        let matrix = DMatrix::from_fn(3, axes.len(), |row, column| columns[column][row]);
        let inverse = matrix.pseudo_inverse(1e-9).unwrap_or_else(|_| DMatrix::zeros(axes.len(), 3));
        Self { axes, inverse }
    }

    /// The steps of the linear axes that move the tip so far.
    pub fn steps(&self, off: &Vec3) -> Vec<(usize, f64)> {
        let steps = &self.inverse * DVector::from_column_slice(off.as_slice());
        self.axes.iter().copied().zip(steps.iter().copied()).collect()
    }
}

/// Where the tip is without any error.
pub fn nominal_tip(machine: &Machine, command: &Command) -> Vec3 {
    machine.deviation(command, &ErrorValues::default()).nominal_tip.vector()
}
