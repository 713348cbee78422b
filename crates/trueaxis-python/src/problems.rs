//! Diagnostics as Python exceptions and warnings.

use pyo3::prelude::*;
use pyo3::types::PyList;
use trueaxis::input::{Diagnostic, Diagnostics, Place};

/// One diagnostic: severity, code, message, hint, file, line, column.
type Entry = (String, &'static str, String, String, String, usize, usize);

fn entry(d: &Diagnostic) -> Entry {
    let Diagnostic { code, severity, place, message, hint } = d.clone();
    (severity.to_string(), code, message, hint, place.file, place.line, place.column)
}

/// Diagnostics as a list of tuples, in the order in which they were found.
pub fn listed<'py>(py: Python<'py>, problems: &Diagnostics) -> PyResult<Bound<'py, PyList>> {
    PyList::new(py, problems.iter().map(entry))
}

/// `trueaxis.TrueAxisError` with these diagnostics, of which one is an error.
pub fn refused(py: Python<'_>, problems: &Diagnostics) -> PyErr {
    let raised = || {
        let class = py.import("trueaxis._problems")?.getattr("TrueAxisError")?;
        class.call_method1("_of", (listed(py, problems)?,))
    };
    match raised() {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

/// The same with one error.
pub fn one(py: Python<'_>, code: &'static str, place: &str, message: String, hint: &str) -> PyErr {
    let mut problems = Diagnostics::new();
    problems.error(code, Place::whole(place), message, hint);
    refused(py, &problems)
}
