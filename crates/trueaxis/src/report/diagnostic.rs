//! Problems as JSON, the same in every document.

use serde::Serialize;
use serde_json::Value;
use trueaxis_input::{Diagnostic, Diagnostics};
use trueaxis_report::JsonSchema;
use trueaxis_report::document;

/// A problem found in the input.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DiagnosticEntry<'a> {
    /// The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
    pub code: &'a str,
    /// `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
    pub severity: String,
    /// The file as the user named it, or an argument such as `--at`.
    pub file: &'a str,
    /// The line, from 1; 0 for the file as a whole.
    pub line: usize,
    /// The column in characters, from 1; 0 for the file as a whole.
    pub column: usize,
    /// The problem in one sentence.
    pub message: &'a str,
    /// What to do; empty if it follows from the message.
    pub hint: &'a str,
}

impl<'a> From<&'a Diagnostic> for DiagnosticEntry<'a> {
    fn from(d: &'a Diagnostic) -> Self {
        Self {
            code: d.code,
            severity: d.severity.to_string(),
            file: &d.place.file,
            line: d.place.line,
            column: d.place.column,
            message: &d.message,
            hint: &d.hint,
        }
    }
}

/// A diagnostic as JSON.
pub fn diagnostic_json(diagnostic: &Diagnostic) -> Value {
    document(&DiagnosticEntry::from(diagnostic))
}

/// The answer of a command that cannot use its input; the exit status is 2.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RefusedDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/refused/1"))]
    pub schema: &'static str,
    /// The version of TrueAxis.
    pub version: &'static str,
    /// What is wrong, at least one error, in the order of the files.
    pub diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// The document `trueaxis/refused/1`.
pub fn refused_json(problems: &Diagnostics) -> Value {
    let (schema, version) = ("trueaxis/refused/1", env!("CARGO_PKG_VERSION"));
    let diagnostics = problems.iter().map(DiagnosticEntry::from).collect();
    document(&RefusedDocument { schema, version, diagnostics })
}

/// What was found, as the remarks of a report: the message, then what to do.
pub fn remarks(problems: &Diagnostics) -> Vec<String> {
    let remark = |d: &Diagnostic| match d.hint.is_empty() {
        true => d.message.clone(),
        false => format!("{} ({})", d.message, d.hint),
    };
    problems.iter().map(remark).collect()
}
