//! A control that has read the files: what it adds to every command.

use super::carrier_chain::CarrierChain;
use super::content::Content;
use super::control::Control;
use super::lever::placed;
use super::link::errors_of;
use super::nominal::Nominal;
use super::table::{count_of, counts};
use super::temperature;
use std::convert::Infallible;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};

/// A control with its content, on a machine.
pub struct Emulation<'a> {
    machine: &'a Machine,
    control: &'a dyn Control,
    content: &'a Content,
    carrier: Option<CarrierChain>,
}

impl<'a> Emulation<'a> {
    /// The control after it has read this content.
    pub fn new(machine: &'a Machine, control: &'a dyn Control, content: &'a Content) -> Self {
        let carrier = content.joints.as_ref().and_then(|j| control.carrier_chain(machine, j));
        Self { machine, control, content, carrier }
    }

    /// The actual machine.
    pub fn machine(&self) -> &Machine {
        self.machine
    }

    /// What the control adds to a command, mm and rad: tables and chain by the programmed command, the grid
    /// by the position of the linear axes.
    pub fn added(&self, command: &Command, approach: &Approach) -> Command {
        let mut added = self.by_chain(command, approach);
        for table in &self.content.tables {
            let position = counts(self.machine, table.input, command[table.input]);
            let value = self.control.value(table, position, approach[table.input]);
            added[table.output] += value * count_of(self.machine, table.output);
        }
        temperature::add(self.machine, self.content, command, &mut added);
        if let Some(grid) = &self.content.grid {
            let place = grid.sides.map(|s| counts(self.machine, s.axis, command[s.axis]));
            for (side, value) in grid.sides.iter().zip(grid.at(place)) {
                added[side.axis] += value * count_of(self.machine, side.axis);
            }
        }
        added
    }

    fn by_chain(&self, command: &Command, approach: &Approach) -> Command {
        if self.content.known.is_empty() && self.content.joints.is_none() {
            return Command::default();
        }
        if let Some(carrier) = &self.carrier {
            return carrier.added(self.machine, command);
        }
        let known = |at: &Command| {
            let content = (self.control, self.content);
            Ok::<_, Infallible>(errors_of(self.machine, content, at, approach))
        };
        let nominal = Nominal::of(self.machine, command);
        let Ok(added) = placed(self.machine, (&nominal, command), &known, Command::default());
        added
    }
}
