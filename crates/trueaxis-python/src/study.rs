//! A study of many machines as Python holds it: any samples of it, and the answer of all of them.

use crate::answer::NativeAnswer;
use crate::machine::{Contents, to_dict, with_contents};
use crate::options::Options;
use crate::problems::{listed, one, refused};
use crate::threads;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::ops::Range;
use std::sync::Arc;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Files};
use trueaxis_study::{AskStudy, Changes, Study, StudyAnswer, input_unit, read_study};

/// A study that was read, with the files that it was made from.
#[pyclass(frozen, name = "Study", module = "trueaxis._native")]
pub struct NativeStudy {
    study: Arc<Study>,
    files: Contents,
    found: Diagnostics,
}

/// The question of the verb `study`.
pub fn question(o: &Options<'_, '_>) -> PyResult<AskStudy> {
    Ok(AskStudy { study: o.file("study")?, changes: changes(o)?, table: o.path("table")? })
}

fn changes(o: &Options<'_, '_>) -> PyResult<Changes> {
    let count = |name: &str| -> PyResult<Option<usize>> {
        match o.count(name)? {
            Some(0) => Err(PyValueError::new_err(format!("{name}: 1 or more"))),
            count => Ok(count.and_then(|n| usize::try_from(n).ok())),
        }
    };
    let sensitivity = o.count("sensitivity")?.and_then(|n| usize::try_from(n).ok());
    if sensitivity.is_some_and(|rows| (1..16).contains(&rows)) {
        return Err(PyValueError::new_err("sensitivity: 0 for none, or 16 and more"));
    }
    let (machines, days, seed) = (count("machines")?, count("days")?, o.count("seed")?);
    Ok(Changes { machines, days, seed, sensitivity })
}

impl NativeStudy {
    fn range(&self, start: usize, stop: usize) -> PyResult<Range<usize>> {
        let samples = self.study.design.samples();
        if start > stop || stop > samples {
            let message = format!("samples {start} to {stop} of a study that has {samples}");
            return Err(PyValueError::new_err(message));
        }
        Ok(start..stop)
    }
}

#[pymethods]
impl NativeStudy {
    /// Reads a study file: `files` stand before those of the disk, or alone.
    #[new]
    fn new(
        py: Python<'_>,
        options: &Bound<'_, PyDict>,
        files: Contents,
        alone: bool,
    ) -> PyResult<Self> {
        let options = Options(options);
        let (path, changes) = (options.file("study")?, changes(&options)?);
        let others = if alone { Files::none() } else { disk() };
        let (files, read) = with_contents(files, others);
        let (study, found) = threads::work(py, None, || read_study(&files, &path, changes))?;
        let Some(study) = study else { return Err(refused(py, &found)) };
        let files = read.lock().map(|read| read.clone()).unwrap_or_default();
        Ok(Self { study: Arc::new(study), files, found })
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.study.name
    }

    /// How many samples it has.
    #[getter]
    fn samples(&self) -> usize {
        self.study.design.samples()
    }

    /// The keys of the outputs.
    #[getter]
    fn outputs(&self) -> Vec<String> {
        self.study.output_keys()
    }

    /// Name and unit of each input.
    #[getter]
    fn inputs(&self) -> Vec<(&str, &'static str)> {
        self.study.inputs.iter().map(|i| (i.name.as_str(), input_unit(&i.varied))).collect()
    }

    /// The outputs of samples from `start` to before `stop`, mm, a row for each.
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        start: usize,
        stop: usize,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let range = self.range(start, stop)?;
        let shape = [range.len(), self.study.output_count()];
        let values = threads::work(py, threads, || self.study.evaluate(range, &|_| {}))?;
        let values = values.map_err(|fault| {
            let hint = "narrower distributions, or another study of the part";
            one(py, "sample-not-made", &self.study.path.display().to_string(), fault.message, hint)
        })?;
        PyArray1::from_vec(py, values).reshape(shape)
    }

    /// The inputs of samples, a row for each, in their units.
    fn inputs_of<'py>(
        &self,
        py: Python<'py>,
        start: usize,
        stop: usize,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let range = self.range(start, stop)?;
        let shape = [range.len(), self.study.inputs.len()];
        let values = py.detach(|| self.study.inputs_of(range));
        PyArray1::from_vec(py, values).reshape(shape)
    }

    /// The answer of all samples: their outputs, row after row.
    fn answer(&self, py: Python<'_>, values: PyReadonlyArray1<'_, f64>) -> PyResult<NativeAnswer> {
        let values = values.as_slice()?;
        let expected = self.study.design.samples() * self.study.output_count();
        if values.len() != expected || values.iter().any(|v| !v.is_finite()) {
            let message = format!("{} values instead of {expected} finite ones", values.len());
            return Err(PyValueError::new_err(message));
        }
        let study = Arc::clone(&self.study);
        let answer = threads::work(py, None, || StudyAnswer::of_values(study, values))?;
        Ok(NativeAnswer::new(Box::new(answer), self.found.clone(), Vec::new()))
    }

    /// The files that the study was made from.
    #[getter]
    fn files<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        to_dict(py, &self.files)
    }

    /// What was found in the files.
    #[getter]
    fn diagnostics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        listed(py, &self.found)
    }
}
