//! The verbs by their names in Python, each with the question that it puts.

mod choices;
mod machine;
mod measurement;
mod writing;

use crate::answer::NativeAnswer;
use crate::door::Door;
use crate::options::Options;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Puts the question of a verb.
pub fn ask(verb: &str, options: &Options<'_, '_>, door: &Door<'_>) -> PyResult<NativeAnswer> {
    let rooms = [machine::ask, measurement::ask, writing::ask];
    for room in rooms {
        if let Some(answer) = room(verb, options, door)? {
            return Ok(answer);
        }
    }
    Err(PyValueError::new_err(format!("there is no verb `{verb}`")))
}
