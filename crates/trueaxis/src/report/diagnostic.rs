//! Problems as JSON, the same in every document.

use serde_json::Value;
use trueaxis_input::{Diagnostic, Diagnostics};

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

/// What was found, as the remarks of a report: the message, then what to do.
pub fn remarks(problems: &Diagnostics) -> Vec<String> {
    let remark = |d: &Diagnostic| match d.hint.is_empty() {
        true => d.message.clone(),
        false => format!("{} ({})", d.message, d.hint),
    };
    problems.iter().map(remark).collect()
}
