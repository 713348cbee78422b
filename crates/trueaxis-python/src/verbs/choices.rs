//! Choices by the words that the command knows.

use crate::problems::one;
use pyo3::prelude::*;

/// The choice of an option by its word; without one the first.
pub fn choice<T: Copy>(
    py: Python<'_>,
    option: &str,
    word: Option<String>,
    choices: &[(&str, T)],
) -> PyResult<Option<T>> {
    let Some(word) = word else { return Ok(choices.first().map(|(_, value)| *value)) };
    let found = choices.iter().find(|(name, _)| *name == word);
    let Some((_, value)) = found else {
        let known: Vec<_> = choices.iter().map(|(name, _)| *name).collect();
        let message = format!("`{word}` is not a choice of `{option}`");
        return Err(one(
            py,
            "unknown-choice",
            option,
            message,
            &format!("one of {}", known.join(", ")),
        ));
    };
    Ok(Some(*value))
}
