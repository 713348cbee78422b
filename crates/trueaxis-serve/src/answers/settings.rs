//! Changes of errors of a request, as the library takes them.

use crate::body::short;
use crate::refusal::Refusal;
use serde::Deserialize;
use std::collections::BTreeMap;
use trueaxis::JsonSchema;
use trueaxis::input::{Dimension, parse_quantity};
use trueaxis::machine::errors::ErrorName;
use trueaxis::predict::ErrorChange;

/// A change of one error: its curve times the factor, then the constant is added.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ErrorChangeEntry {
    /// What its values are multiplied by; 1 if it is left out.
    factor: Option<f64>,
    /// What is added, a length or an angle with its unit, such as `5 urad`; nothing if it is left out.
    add: Option<String>,
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
