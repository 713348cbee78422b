//! What goes to standard output and standard error.

use clap::ValueEnum;
use serde_json::Value;
use std::io::{ErrorKind, Write};
use trueaxis::geometry::input::{Diagnostic, Diagnostics, Severity};

/// How a command ended.
pub enum Outcome {
    /// Done; where there is a verdict, it is "yes".
    Done,
    /// The verdict is "no": not in tolerance, problems found.
    No,
    /// Unusable input; diagnostics were shown.
    Unusable,
}

/// For people or for programs.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Tables for people
    Text,
    /// One JSON document, see docs/conventions.md
    Json,
}

/// Writes the result to standard output.
pub fn show(text: &str) {
    let mut stdout = std::io::stdout().lock();
    let written = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush());
    if let Err(error) = written {
        // `trueaxis … | head` closes the pipe early; that is no fault of ours.
        if error.kind() != ErrorKind::BrokenPipe {
            tell(&format!("error: standard output: {error}"));
        }
    }
}

/// Writes one JSON document to standard output.
pub fn show_json(document: &Value) {
    show(&format!("{document:#}\n"));
}

/// Writes a line to standard error.
pub fn tell(line: &str) {
    // Nobody is left to tell if standard error is gone.
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Shows all diagnostics on standard error; `true` if there was an error among them.
pub fn report(problems: Diagnostics) -> bool {
    let errors = problems.has_errors();
    let sorted = problems.sorted();
    for diagnostic in &sorted {
        tell(&format!("{diagnostic}\n"));
    }
    if errors {
        let count = sorted.iter().filter(|d| d.severity == Severity::Error).count();
        tell(&format!(
            "{count} error{} found; nothing was written",
            if count == 1 { "" } else { "s" }
        ));
    }
    errors
}

/// A diagnostic as JSON.
pub fn diagnostic_json(diagnostic: &Diagnostic) -> Value {
    serde_json::json!({
        "code": diagnostic.code,
        "severity": diagnostic.severity.to_string(),
        "file": diagnostic.place.file,
        "line": diagnostic.place.line,
        "column": diagnostic.place.column,
        "message": diagnostic.message,
        "hint": diagnostic.hint,
    })
}
