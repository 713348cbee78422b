//! The keyword arguments of a verb, by the names of the command's options.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use trueaxis::questions::MachineChoice;

/// Values by name; a value that is `None` in Python was not given.
pub struct Options<'a, 'py>(pub &'a Bound<'py, PyDict>);

impl<'py> Options<'_, 'py> {
    fn get<T: for<'a> FromPyObject<'a, 'py>>(&self, name: &str) -> PyResult<Option<T>> {
        match self.0.get_item(name)? {
            Some(value) if !value.is_none() => match value.extract() {
                Ok(value) => Ok(Some(value)),
                Err(error) => Err(error.into()),
            },
            _ => Ok(None),
        }
    }

    /// A text, if it was given.
    pub fn text(&self, name: &str) -> PyResult<Option<String>> {
        self.get(name)
    }

    /// A text, or the default of the command.
    pub fn text_or(&self, name: &str, default: &str) -> PyResult<String> {
        Ok(self.text(name)?.unwrap_or_else(|| default.to_owned()))
    }

    /// A path, if it was given.
    pub fn path(&self, name: &str) -> PyResult<Option<PathBuf>> {
        self.get(name)
    }

    /// The path of an argument that the command requires.
    pub fn file(&self, name: &str) -> PyResult<PathBuf> {
        Ok(self.path(name)?.unwrap_or_default())
    }

    /// Paths, none if they were not given.
    pub fn paths(&self, name: &str) -> PyResult<Vec<PathBuf>> {
        Ok(self.get(name)?.unwrap_or_default())
    }

    /// Texts, none if they were not given.
    pub fn texts(&self, name: &str) -> PyResult<Vec<String>> {
        Ok(self.get(name)?.unwrap_or_default())
    }

    /// Whether a switch is on.
    pub fn is(&self, name: &str) -> PyResult<bool> {
        Ok(self.get(name)?.unwrap_or(false))
    }

    /// A whole number, if it was given.
    pub fn count(&self, name: &str) -> PyResult<Option<u64>> {
        self.get(name)
    }

    /// The machine with the tool in it and its temperatures.
    pub fn machine(&self) -> PyResult<MachineChoice> {
        Ok(MachineChoice {
            file: self.file("machine")?,
            tool_length: self.text("tool_length")?,
            tool: self.text("tool")?,
            temperature: self.text("temperature")?,
            temperature_log: self.path("temperature_log")?,
            log_time: self.text("log_time")?,
            log_start: self.text("log_start")?,
        })
    }
}
