//! What a program asks from outside: other programs, and what only the machine knows.

use crate::moves::{Branch, Position};

/// Gives the text of subprograms by name, and angles of the machine; this crate opens no file and
/// knows no machine.
pub trait Library {
    /// The text of a program.
    ///
    /// # Errors
    /// A sentence that says why it cannot be had.
    fn text(&self, name: &str) -> Result<Vec<u8>, String>;

    /// How to show the program to the user.
    fn display(&self, name: &str) -> String {
        name.to_owned()
    }

    /// A, B and C in degrees at which the tool stands along a direction of the basic frame; the
    /// axes that the machine lacks are 0. `None` where no machine is known or none reaches it.
    fn rotary_angles(
        &self,
        _direction: [f64; 3],
        _branch: Branch,
        _now: &Position,
    ) -> Option<[f64; 3]> {
        None
    }
}

/// No subprograms but those in the program itself.
#[derive(Debug, Clone, Copy)]
pub struct NoLibrary;

impl Library for NoLibrary {
    fn text(&self, _name: &str) -> Result<Vec<u8>, String> {
        Err("no other programs are available".into())
    }
}
