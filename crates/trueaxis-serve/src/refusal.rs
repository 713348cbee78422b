//! Why a request is not answered: a code for the page, words for the reader.

use serde::Serialize;
use trueaxis::JsonSchema;
use trueaxis::input::{Diagnostic, Diagnostics, Severity};
use trueaxis::report::DiagnosticEntry;

/// A request that cannot be answered.
#[derive(Debug, Clone)]
pub(crate) struct Refusal {
    /// The status of HTTP.
    pub(crate) status: u16,
    code: String,
    message: String,
    hint: String,
    diagnostics: Diagnostics,
}

/// Why a request is not answered.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct RefusalEntry<'a> {
    /// The code, such as `bad-request`; `trueaxis explain CODE` has its meaning and its remedy.
    code: &'a str,
    /// The reason in one sentence.
    message: &'a str,
    /// What to do; may be empty.
    hint: &'a str,
    /// The problems of the input, if that is the reason.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// The answer to a request by POST that is refused.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct RefusedAnswer<'a> {
    /// Why.
    pub(crate) error: RefusalEntry<'a>,
}

impl Refusal {
    pub(crate) fn new(status: u16, code: &str, message: impl Into<String>, hint: &str) -> Self {
        let (code, hint) = (code.to_owned(), hint.to_owned());
        Self { status, code, message: message.into(), hint, diagnostics: Diagnostics::new() }
    }

    /// A request that makes no sense.
    pub(crate) fn bad(message: impl Into<String>, hint: &str) -> Self {
        Self::new(400, "bad-request", message, hint)
    }

    /// Files that cannot be used; the message is that of the first error.
    pub(crate) fn unusable(problems: &Diagnostics) -> Self {
        let first = problems.iter().find(|d| d.severity == Severity::Error);
        let (code, message, hint) = match first {
            Some(d) => (d.code, format!("{}: {}", d.place, d.message), d.hint.clone()),
            None => ("unusable", "this cannot be used".to_owned(), String::new()),
        };
        let mut refusal = Self::new(422, code, message, &hint);
        refusal.diagnostics = problems.clone();
        refusal
    }

    pub(crate) fn entry(&self) -> RefusalEntry<'_> {
        RefusalEntry {
            code: &self.code,
            message: &self.message,
            hint: &self.hint,
            diagnostics: entries(&self.diagnostics),
        }
    }
}

/// Diagnostics in the order of their places, as they stand in answers.
pub(crate) fn entries(problems: &Diagnostics) -> Vec<DiagnosticEntry<'_>> {
    let mut sorted: Vec<&Diagnostic> = problems.iter().collect();
    sorted.sort_by(|a, b| a.place.cmp(&b.place));
    sorted.into_iter().map(DiagnosticEntry::from).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    /// The message of a refusal.
    pub(crate) fn message(refusal: &super::Refusal) -> String {
        refusal.message.clone()
    }
}
