//! Why a request is not answered: for the page and for people.

use serde_json::{Value, json};
use trueaxis::input::{Diagnostics, Severity};

/// A request that cannot be answered.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Refusal {
    /// The status of HTTP.
    pub(crate) status: u16,
    code: String,
    message: String,
    hint: String,
    diagnostics: Vec<Value>,
}

impl Refusal {
    pub(crate) fn new(status: u16, code: &str, message: impl Into<String>, hint: &str) -> Self {
        let (code, hint) = (code.to_owned(), hint.to_owned());
        Self { status, code, message: message.into(), hint, diagnostics: Vec::new() }
    }

    /// A request that makes no sense.
    pub(crate) fn bad(message: impl Into<String>, hint: &str) -> Self {
        Self::new(400, "bad-request", message, hint)
    }

    /// Files that cannot be used; the first error speaks for all.
    pub(crate) fn unusable(problems: &Diagnostics) -> Self {
        let first = problems.iter().find(|d| d.severity == Severity::Error);
        let (code, message, hint) = match first {
            Some(d) => (d.code, format!("{}: {}", d.place, d.message), d.hint.clone()),
            None => ("unusable", "this cannot be used".to_owned(), String::new()),
        };
        let mut refusal = Self::new(422, code, message, &hint);
        refusal.diagnostics = diagnostics_json(problems);
        refusal
    }

    pub(crate) fn json(&self) -> Value {
        json!({
            "code": self.code,
            "message": self.message,
            "hint": self.hint,
            "diagnostics": self.diagnostics,
        })
    }
}

/// All diagnostics in the order of their places.
pub(crate) fn diagnostics_json(problems: &Diagnostics) -> Vec<Value> {
    problems.clone().sorted().iter().map(trueaxis::report::diagnostic_json).collect()
}
