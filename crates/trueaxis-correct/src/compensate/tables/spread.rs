//! How uncertain what the axes should add is: the same functions as in `lever`, of one standard uncertainty of each
//! quantity, to first order.
//!
//! ```text
//!     u²(f_io(q)) = Σ_k f_io,k(q)²        f_io,k: of the change of all errors by one u of quantity k, its means too
//! ```

use super::lever::{POSES, rotary, sum};
use super::nominal::{Nominal, nominal_tip};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::volume::commands;

/// By quantity.
type ByEach = Vec<Command>;

/// The functions of one standard uncertainty of each quantity.
pub struct Spread<'a> {
    machine: &'a Machine,
    reference: Command,
    quantities: Vec<String>,
    mean: ByEach,
    mean_of: Vec<ByEach>,
}

impl<'a> Spread<'a> {
    /// Over the same poses as [`super::lever::Lever`].
    pub fn of(machine: &'a Machine, reference: Command) -> Self {
        let quantities = machine.uncertain_quantities();
        let none = vec![Command::default(); quantities.len()];
        let mean_of = vec![none.clone(); machine.axes().len()];
        let mut spread = Self { machine, reference, quantities, mean: none, mean_of };
        if spread.quantities.is_empty() {
            return spread;
        }
        let (mut count, mut mean, mut mean_of) = (0.0, spread.mean.clone(), spread.mean_of.clone());
        for pose in commands(machine.axes(), POSES) {
            let each = (0..mean_of.len()).map(|input| spread.moved(input, pose[input]));
            let each = each.collect::<Result<Vec<_>, _>>();
            let (Ok(all), Ok(each)) = (spread.whole(&pose), each) else { continue };
            count += 1.0;
            add(&mut mean, &all);
            mean_of.iter_mut().zip(&each).for_each(|(mean, one)| add(mean, one));
        }
        for value in mean_of.iter_mut().chain([&mut mean]).flatten().flatten() {
            *value /= f64::max(count, 1.0);
        }
        (spread.mean, spread.mean_of) = (mean, mean_of);
        spread
    }

    /// The functions f_io of all outputs o, by quantity.
    pub fn functions(&self, input: usize, q: f64) -> Result<ByEach, CommandFault> {
        let mut each = self.moved(input, q)?;
        for (k, c) in each.iter_mut().enumerate() {
            for (output, axis) in self.machine.axes().iter().enumerate() {
                if axis.kind == AxisKind::Linear {
                    let mean = if output == input { self.mean[k][output] } else { 0.0 };
                    c[output] += mean - self.mean_of[input][k][output];
                }
            }
        }
        Ok(each)
    }

    fn moved(&self, input: usize, q: f64) -> Result<ByEach, CommandFault> {
        let mut command = self.reference;
        command[input] = q;
        self.whole(&command)
    }

    /// What every axis should add at a command, by quantity.
    pub fn whole(&self, command: &Command) -> Result<ByEach, CommandFault> {
        let errors = self.machine.errors_at(command, &Approach::default())?;
        let known = self.machine.uncertainties_at(command, &self.quantities);
        let nominal = Nominal::of(self.machine, command);
        let one = |errors: &ErrorValues| {
            let mut added = rotary(self.machine, &nominal, command, errors);
            let moved = nominal_tip(self.machine, &sum(command, &added)) - nominal.tip;
            let off = self.machine.deviation(command, errors).tip_mm + moved;
            for (axis, step) in nominal.steps(&off) {
                added[axis] -= step;
            }
            added
        };
        let without = one(&errors);
        let each = (0..self.quantities.len()).map(|quantity| {
            let mut with = one(&known.displaced_by(&errors, quantity, 1.0));
            with.iter_mut().zip(&without).for_each(|(a, b)| *a -= b);
            with
        });
        Ok(each.collect())
    }
}

fn add(total: &mut ByEach, each: &ByEach) {
    total.iter_mut().zip(each).for_each(|(total, one)| *total = sum(total, one));
}

/// All quantities together, which are independent of each other.
pub fn together(each: &[Command]) -> Command {
    let mut variance = Command::default();
    for one in each {
        variance.iter_mut().zip(one).for_each(|(v, c)| *v += c * c);
    }
    variance.map(f64::sqrt)
}
