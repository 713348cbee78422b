//! Problems with code, place, message and hint.

use crate::limits::cut;
use std::borrow::Cow;
use std::fmt;

/// Whether the input can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Information; nothing to do.
    Note,
    /// The result can be used, but the input should be checked.
    Warning,
    /// The input cannot be used.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        })
    }
}

/// A place in a file; line and column count from 1, line 0 is the file as a whole.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Place {
    /// The file as the user named it, or `--at`, `--tip` … for an argument.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl Place {
    /// A file or argument as a whole.
    pub fn whole(file: &str) -> Self {
        Self { file: file.to_owned(), line: 0, column: 0 }
    }

    /// The place of a byte offset in a text.
    ///
    /// ```
    /// use trueaxis_input::Place;
    /// let place = Place::of("m.toml", "a = 1\nµ = 2", 9);
    /// assert_eq!((place.line, place.column), (2, 3));
    /// ```
    pub fn of(file: &str, text: &str, offset: usize) -> Self {
        let mut offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        let before = &text[..offset];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        Self {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => f.write_str(&self.file),
            _ => write!(f, "{}:{}:{}", self.file, self.line, self.column),
        }
    }
}

/// One problem at one place, with the action to take.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The code, stable for programs, such as `unknown-error-name`; `docs/diagnostics/` explains each.
    pub code: &'static str,
    /// Whether the input can be used.
    pub severity: Severity,
    /// The place in the input.
    pub place: Place,
    /// The problem in one sentence: what was found, and what was expected.
    pub message: String,
    /// The action to take; empty if it follows from the message.
    pub hint: String,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}]: {}\n  --> {}", self.severity, self.code, self.message, self.place)?;
        if !self.hint.is_empty() {
            write!(f, "\n  hint: {}", self.hint)?;
        }
        Ok(())
    }
}

/// Diagnostics within which one that is found again is the same.
const SOON: usize = 32;

/// A collection of problems, so that all of them are reported in one run.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics(Vec<Diagnostic>);

impl Diagnostics {
    /// An empty collection.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an error.
    pub fn error(&mut self, code: &'static str, place: Place, message: String, hint: &str) {
        self.push(Severity::Error, code, place, message, hint);
    }

    /// Adds a warning.
    pub fn warn(&mut self, code: &'static str, place: Place, message: String, hint: &str) {
        self.push(Severity::Warning, code, place, message, hint);
    }

    /// Adds a note.
    pub fn note(&mut self, code: &'static str, place: Place, message: String, hint: &str) {
        self.push(Severity::Note, code, place, message, hint);
    }

    fn push(
        &mut self,
        severity: Severity,
        code: &'static str,
        place: Place,
        message: String,
        hint: &str,
    ) {
        self.add(Diagnostic { code, severity, place, message, hint: hint.to_owned() });
    }

    /// Appends the problems of another stage.
    pub fn append(&mut self, mut other: Self) {
        self.0.append(&mut other.0);
    }

    /// What another stage found; its problems are appended.
    pub fn keep<T>(&mut self, (found, problems): (T, Self)) -> T {
        self.append(problems);
        found
    }

    /// Adds a diagnostic; of a message, a hint or the name of a file longer than
    /// [`LONGEST_MESSAGE`](crate::limits::LONGEST_MESSAGE) the beginning and the end.
    pub fn add(&mut self, mut diagnostic: Diagnostic) {
        let Diagnostic { message, hint, place, .. } = &mut diagnostic;
        for text in [message, hint, &mut place.file] {
            if let Cow::Owned(shorter) = cut(text) {
                *text = shorter;
            }
        }
        // An entry that two readers need is wrong once.
        if !self.0.iter().rev().take(SOON).any(|before| *before == diagnostic) {
            self.0.push(diagnostic);
        }
    }

    /// Whether one of them is an error, so that the input cannot be used.
    pub fn has_errors(&self) -> bool {
        self.0.iter().any(|d| d.severity == Severity::Error)
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.0.len()
    }

    /// Whether one of those from a number on is an error.
    pub(crate) fn has_errors_from(&self, first: usize) -> bool {
        self.0.iter().skip(first).any(|d| d.severity == Severity::Error)
    }

    /// The diagnostics in the order of file, line and column.
    pub fn sorted(mut self) -> Vec<Diagnostic> {
        self.0.sort_by(|a, b| a.place.cmp(&b.place));
        self.0
    }

    /// The diagnostics in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.0.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::{Diagnostics, Place};

    #[test]
    fn what_is_found_twice_is_said_once() {
        let at = |line| Place { file: "f".to_owned(), line, column: 1 };
        let mut found = Diagnostics::new();
        for line in [1, 2, 1, 1] {
            found.error("wrong-unit", at(line), "a length is expected".to_owned(), "mm");
        }
        found.warn("wrong-unit", at(1), "a length is expected".to_owned(), "mm");
        assert_eq!(found.iter().map(|d| d.place.line).collect::<Vec<_>>(), [1, 2, 1]);
    }
}
