//! The user's dictionary: M and G codes and programs of the machine builder.

use super::Core;
use crate::moves::Event;

/// What a code or program of the machine builder does, by the user's dictionary.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OwnCode {
    /// Nothing that moves the tool; the words that belong to it have no effect either.
    Ignore,
    /// The program stops until the operator goes on.
    Stop,
    /// A program is called after the move of the block.
    Call(String),
}

impl Core<'_> {
    /// Looks a code up and does what the dictionary says; `false` if it is not there.
    pub fn own_code(&mut self, name: &str, at: usize) -> bool {
        let codes = &self.settings.codes;
        let Some(own) = (if codes.is_empty() { None } else { codes.get(name) }) else {
            return false;
        };
        match own {
            OwnCode::Ignore => self.emit(Event::Note("a code that the set-up file ignores")),
            OwnCode::Stop => self.emit(Event::Stop { optional: false }),
            OwnCode::Call(program) => self.own_call = Some((program.clone(), at)),
        }
        true
    }

    /// The same for a letter with a number.
    pub fn own_number(&mut self, letter: char, number: f64, at: usize) -> bool {
        !self.settings.codes.is_empty() && self.own_code(&format!("{letter}{number}"), at)
    }
}
