//! Standard output and standard error.

use clap::ValueEnum;
use serde_json::Value;
use std::io::{ErrorKind, Write};
use trueaxis::input::{Diagnostics, Severity};

/// More diagnostics than this are of no use to a reader; a table of a million rows can have a
/// million of them.
const MOST_SHOWN: usize = 100;

/// The result of a command.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Done; where there is a verdict, it is "yes".
    Done,
    /// The verdict is "no": not in tolerance.
    No,
    /// Unusable input; diagnostics were shown.
    Unusable,
}

/// The form of the output.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Text with tables
    Text,
    /// One JSON document on standard output, nothing else there
    Json,
}

/// The answer of a command.
pub enum Answer {
    /// Text, or a CSV table.
    Text(String),
    /// One document.
    Json(Value),
}

/// Shows the diagnostics, then the answer if there was no error.
pub fn finish(problems: Diagnostics, answer: Option<Answer>) -> Outcome {
    let errors = report(problems);
    match answer {
        Some(answer) if !errors => show(&answer),
        _ => Outcome::Unusable,
    }
}

/// Writes the answer to standard output.
pub fn show(answer: &Answer) -> Outcome {
    show_by(|out| match answer {
        Answer::Text(text) => out.write_all(text.as_bytes()),
        Answer::Json(document) => writeln!(out, "{document:#}"),
    })
}

/// The same of what is written piece by piece.
pub fn show_by(write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Outcome {
    let mut stdout = std::io::BufWriter::new(std::io::stdout().lock());
    match write(&mut stdout).and_then(|()| stdout.flush()) {
        // `trueaxis … | head` closes the pipe early; that is no fault of ours.
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            tell(&format!("error[unwritable-output]: standard output: {error}"));
            Outcome::Unusable
        }
        _ => Outcome::Done,
    }
}

/// Writes a line to standard error.
pub fn tell(line: &str) {
    // Nothing can be reported if standard error is gone.
    let _ = writeln!(std::io::stderr(), "{}", visible(line));
}

/// Text from files and arguments must not control the terminal.
fn visible(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' => shown.push(c),
            c if c.is_control() => shown.extend(c.escape_default()),
            c => shown.push(c),
        }
    }
    shown
}

/// Shows all diagnostics on standard error; `true` if there was an error among them.
pub fn report(problems: Diagnostics) -> bool {
    report_and(problems, "nothing was written")
}

/// The same with the outcome of the work in spite of errors.
pub fn report_and(problems: Diagnostics, outcome: &str) -> bool {
    let mut sorted = problems.sorted();
    let errors = sorted.iter().filter(|d| d.severity == Severity::Error).count();
    let hidden = sorted.len().saturating_sub(MOST_SHOWN);
    if hidden > 0 {
        // Errors stay before warnings do.
        sorted.sort_by(|a, b| b.severity.cmp(&a.severity).then_with(|| a.place.cmp(&b.place)));
        sorted.truncate(MOST_SHOWN);
    }
    for diagnostic in &sorted {
        tell(&format!("{diagnostic}\n"));
    }
    if hidden > 0 {
        tell(&format!("… and {hidden} more\n"));
    }
    match errors {
        0 => {}
        1 => tell(&format!("1 error found; {outcome}")),
        _ => tell(&format!("{errors} errors found; {outcome}")),
    }
    errors > 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escape_sequences_are_shown_not_obeyed() {
        assert_eq!(visible("a\u{1b}[31m\r\nb µ"), "a\\u{1b}[31m\\r\nb µ");
    }
}
