//! Changes of errors of a request, as the library takes them.

use crate::body::short;
use crate::refusal::Refusal;
use serde::Deserialize;
use std::collections::BTreeMap;
use trueaxis::JsonSchema;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::machine::errors::ErrorName;
use trueaxis::predict::ErrorChange;
use trueaxis::questions;

/// A change of one error: its curve times the factor, then the constant is added.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ErrorChangeEntry {
    /// What its values are multiplied by; 1 if it is left out.
    factor: Option<f64>,
    /// What is added, a length or an angle with its unit, such as `5 urad`; nothing if it is left out.
    add: Option<String>,
}

/// The length of a tool of a request, mm, judged as that of `--tool-length`.
pub(super) fn tool_length(length_mm: f64, problems: &mut Diagnostics) -> Option<f64> {
    questions::tool_length(&as_typed(length_mm), problems)
}

/// Whether the positions of axes are as small as those of `--at` have to be.
pub(super) fn are_positions(
    at: Option<&BTreeMap<String, f64>>,
    place: &Place,
    problems: &mut Diagnostics,
) -> bool {
    let before = problems.iter().count();
    for (axis, value) in at.into_iter().flatten() {
        if let Err(e) = parse_quantity(&as_typed(*value), Dimension::Ratio) {
            problems.error(e.code(), place.clone(), format!("{}: {e}", short(axis)), &e.hint());
        }
    }
    problems.iter().count() == before
}

/// A number as it is typed: 1e300, not 300 digits.
fn as_typed(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// The changes by ISO 230-1 name.
pub(super) fn errors(
    changes: Option<BTreeMap<String, ErrorChangeEntry>>,
) -> Result<Vec<ErrorChange>, Refusal> {
    changes.into_iter().flatten().map(|(name, change)| change.read(&name)).collect()
}

impl ErrorChangeEntry {
    fn read(self, name: &str) -> Result<ErrorChange, Refusal> {
        let Some(parsed) = ErrorName::parse(name) else {
            let message = format!("`{}` is not an error name of ISO 230-1", short(name));
            return Err(Refusal::bad(message, "such as EC0Y, EXX, EX0t"));
        };
        let rotation = parsed.component.is_rotation();
        let dimension = if rotation { Dimension::Angle } else { Dimension::Length };
        let add = self.add.map(|text| parse_quantity(&text, dimension)).transpose();
        let add =
            add.map_err(|e| Refusal::new(400, e.code(), format!("{name}: {e}"), &e.hint()))?;
        let factor = self.factor.unwrap_or(1.0);
        Ok(ErrorChange { name: parsed, factor, add: add.unwrap_or(0.0) })
    }
}
