//! Subprograms that are not in the main program.

/// Gives the text of subprograms by name; this crate opens no file.
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
}

/// No subprograms but those in the program itself.
#[derive(Debug, Clone, Copy)]
pub struct NoLibrary;

impl Library for NoLibrary {
    fn text(&self, _name: &str) -> Result<Vec<u8>, String> {
        Err("no other programs are at hand here".into())
    }
}
