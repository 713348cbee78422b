//! Access of a program to other programs and to the kinematics of the machine.

use crate::moves::{Branch, Position};
use trueaxis_input::Content;

/// Provides the texts of subprograms by name and the rotary angles of the machine: this crate opens no
/// file and has no model of the machine.
pub trait Library {
    /// The text of a program.
    ///
    /// # Errors
    /// A sentence that states why it cannot be read.
    fn text(&self, name: &str) -> Result<Vec<u8>, String>;

    /// The same where it may be long and kept elsewhere than in the memory.
    ///
    /// # Errors
    /// As [`Library::text`].
    fn content(&self, name: &str) -> Result<Content, String> {
        self.text(name).map(Content::from)
    }

    /// The name of the program in diagnostics.
    fn display(&self, name: &str) -> String {
        name.to_owned()
    }

    /// The angles A, B and C in degrees at which the tool axis is along a direction of the basic
    /// frame; 0 for axes that the machine does not have. `None` without a machine, or if the machine
    /// does not reach the direction.
    fn rotary_angles(
        &self,
        _direction: [f64; 3],
        _branch: Branch,
        _now: &Position,
    ) -> Option<[f64; 3]> {
        None
    }

    /// How the tool is turned at the angles A, B and C in degrees, seen in the basic frame: the columns are
    /// what X, Y and Z of the spindle become. `None` without a machine.
    fn tool_turn(&self, _angles_deg: [f64; 3]) -> Option<[[f64; 3]; 3]> {
        None
    }
}

/// A library without programs: only subprograms in the program itself are found.
#[derive(Debug, Clone, Copy)]
pub struct NoLibrary;

impl Library for NoLibrary {
    fn text(&self, _name: &str) -> Result<Vec<u8>, String> {
        Err("no other programs are available".into())
    }
}
