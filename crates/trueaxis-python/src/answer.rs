//! An answer as Python holds it: text, document and page are made when they are asked for.

use crate::problems::{listed, one};
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::sync::{Mutex, MutexGuard, PoisonError};
use trueaxis::input::Diagnostics;
use trueaxis::questions::Answer;
use trueaxis::report::{DrawingError, Report};
use trueaxis_paper::today;
use trueaxis_words::ReportLanguage;

/// An answer of the library, whatever the verb.
pub type Held = Box<dyn Answer + Send>;

/// The answer of a verb.
#[pyclass(frozen, name = "Answer", module = "trueaxis._native")]
pub struct NativeAnswer {
    answer: Mutex<Held>,
    found: Diagnostics,
    /// Whether its text is that of the report, and not what the command prints.
    reads_as_report: bool,
    /// The language of its text, its page and its pictures.
    language: ReportLanguage,
    /// Whether the verdict is "yes", where there is one.
    #[pyo3(get)]
    is_yes: bool,
    /// How the work ended where it went on in spite of errors.
    #[pyo3(get)]
    in_spite_of_errors: Option<&'static str>,
    /// What to do with the files that were written.
    #[pyo3(get)]
    notes: Vec<String>,
    /// The files that were written.
    #[pyo3(get)]
    written: Vec<String>,
}

impl NativeAnswer {
    /// Of an answer whose files were written.
    pub fn new(answer: Held, found: Diagnostics, written: Vec<String>) -> Self {
        let (is_yes, notes) = (answer.is_yes(), answer.notes());
        let in_spite_of_errors = answer.in_spite_of_errors();
        let answer = Mutex::new(answer);
        let (reads_as_report, language) = (false, ReportLanguage::English);
        Self {
            answer,
            found,
            reads_as_report,
            language,
            is_yes,
            in_spite_of_errors,
            notes,
            written,
        }
    }

    /// The same with the report as its text: where what the command prints depends on the form that was asked for.
    pub fn by_report(self) -> Self {
        Self { reads_as_report: true, ..self }
    }

    /// The same in another language.
    pub fn in_language(self, language: ReportLanguage) -> Self {
        Self { language, ..self }
    }

    fn held(&self) -> MutexGuard<'_, Held> {
        self.answer.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn drawn<T: Send>(
        &self,
        py: Python<'_>,
        draw: impl FnOnce(&Held) -> Result<T, DrawingError> + Send,
    ) -> PyResult<T> {
        let drawn = py.detach(|| draw(&self.held()).map_err(|e| e.to_string()));
        drawn.map_err(|e| one(py, "no-report", "report", e, "take the text or the document"))
    }
}

#[pymethods]
impl NativeAnswer {
    /// What the command prints.
    fn text(&self, py: Python<'_>) -> String {
        py.detach(|| {
            let language = self.language.language();
            if self.reads_as_report {
                return self.held().report().in_language(language).text();
            }
            let mut text = Vec::new();
            // A vector takes every byte.
            let _ = self.held().write_text(language, &mut text);
            String::from_utf8_lossy(&text).into_owned()
        })
    }

    /// What the command prints with `--format json`.
    fn json(&self, py: Python<'_>) -> String {
        py.detach(|| {
            let mut text = Vec::new();
            let _ = self.held().write_json(&self.found, &mut text);
            String::from_utf8_lossy(&text).into_owned()
        })
    }

    /// The page that the command writes with `--report`.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let language = self.language.language();
        self.drawn(py, |answer| {
            Report { date: today(), ..answer.report() }.in_language(language).html()
        })
    }

    /// Its pictures, SVG.
    fn pictures(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let language = self.language.language();
        self.drawn(py, |answer| answer.report().in_language(language).pictures())
    }

    /// What was found in the input.
    #[getter]
    fn diagnostics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        listed(py, &self.found)
    }
}
