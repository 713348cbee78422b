//! The compensation of the errors, pose by pose.

use trueaxis_correct::compensate::tables::Compiled;
use trueaxis_correct::compensate::tables::content::Content;
use trueaxis_correct::compensate::tables::control::Control;
use trueaxis_correct::compensate::tables::emulation::Emulation;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_machine::compensate::{Compensator, Fault};
use trueaxis_machine::errors::ErrorValues;

/// A compensation as the machine executes it.
pub enum AppliedCompensation {
    /// A program whose every pose was solved with the identified errors.
    Program(Box<Compensator>),
    /// Tables in the control.
    Tables {
        /// The compiled tables with their files.
        compiled: Box<Compiled>,
        /// How the control interpolates.
        control: Box<dyn Control + Send + Sync>,
        /// What it holds.
        content: Box<Content>,
    },
}

impl AppliedCompensation {
    /// Tables that were compiled.
    pub fn tables(compiled: Compiled) -> Self {
        let (content, control) = (Box::new(compiled.content()), compiled.order.target.control());
        Self::Tables { compiled: Box::new(compiled), control, content }
    }

    /// The axis positions when this command is programmed, and the identified errors there.
    ///
    /// # Errors
    /// A pose that cannot be compensated, or at which the errors are not known.
    pub fn go(
        &self,
        machine: &Machine,
        command: &Command,
        approach: &Approach,
    ) -> Result<(Command, ErrorValues), Fault> {
        match self {
            Self::Program(compensator) => {
                let at = compensator.at(command, approach)?.command;
                Ok((at, machine.errors_at(&at, approach).map_err(Fault::Corrected)?))
            }
            Self::Tables { control, content, .. } => {
                let mut at = *command;
                let emulation = Emulation::new(machine, control.as_ref(), content);
                let more = emulation.added(command, approach);
                at.iter_mut().zip(more).for_each(|(q, c)| *q += c);
                // At the end of a travel only the sum may lie outside an error table.
                let there = machine.errors_at(&at, approach);
                let errors = there.or_else(|_| machine.errors_at(command, approach))?;
                Ok((at, errors))
            }
        }
    }
}
