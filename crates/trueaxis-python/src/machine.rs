//! A machine as Python holds it: compiled for batches, with the files that it was made from.

use crate::options::Options;
use crate::problems::{listed, refused};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use trueaxis::describe::to_shown;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Files, Source};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, AxisKind, Travel};
use trueaxis::machine::batch::CompiledMachine;
use trueaxis::machine::errors::{ErrorIndex, ErrorName};

/// Files by the names under which they were read.
pub type Contents = BTreeMap<PathBuf, Vec<u8>>;

/// A source that remembers what was read: of a machine that goes to another process, all its files go with it.
struct Kept {
    memory: Contents,
    /// What is not in memory; none where everything must be.
    others: Files,
    read: Arc<Mutex<Contents>>,
}

impl Source for Kept {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let content = match self.memory.get(path) {
            Some(content) => content.clone(),
            None => self.others.read(path)?,
        };
        if let Ok(mut read) = self.read.lock() {
            read.insert(path.to_owned(), content.clone());
        }
        Ok(content)
    }

    fn is_file(&self, path: &Path) -> bool {
        self.memory.contains_key(path) || self.others.is_file(path)
    }
}

/// These files, then those of another source.
pub fn with_contents(memory: Contents, others: Files) -> (Files, Arc<Mutex<Contents>>) {
    let read = Arc::new(Mutex::new(Contents::new()));
    (Files::new(Kept { memory, others, read: Arc::clone(&read) }), read)
}

/// Files as Python has them.
pub fn to_dict<'py>(py: Python<'py>, files: &Contents) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (path, content) in files {
        dict.set_item(path, PyBytes::new(py, content))?;
    }
    Ok(dict)
}

/// A checked machine, with its tool, at its temperatures.
#[pyclass(frozen, name = "Machine", module = "trueaxis._native")]
pub struct NativeMachine {
    pub(crate) compiled: CompiledMachine,
    files: Contents,
    found: Diagnostics,
}

impl NativeMachine {
    pub(crate) fn machine(&self) -> &Machine {
        self.compiled.machine()
    }

    /// The columns of commands, such as `C deg`.
    pub(crate) fn columns(&self) -> Vec<String> {
        let axes = self.machine().axes().iter();
        axes.map(|axis| format!("{} {}", axis.name, unit(axis.kind))).collect()
    }

    /// The errors that the machine has, in chain order: stated, or made by temperatures.
    pub(crate) fn errors(&self) -> Vec<(ErrorIndex, ErrorName)> {
        let mut all = self.machine().stated_errors();
        for (body, b) in self.machine().bodies().iter().enumerate() {
            for term in &b.thermal {
                let index = ErrorIndex { body, kind: term.kind, component: term.component };
                let name = ErrorName { body: b.name, kind: term.kind, component: term.component };
                if all.iter().all(|(known, _)| *known != index) {
                    all.push((index, name));
                }
            }
        }
        all
    }
}

fn unit(kind: AxisKind) -> &'static str {
    match kind {
        AxisKind::Linear => "mm",
        AxisKind::Rotary => "deg",
    }
}

/// The sides from which axes come, one for each axis: 1 rising, -1 falling, 0 not known.
pub fn approach(sides: &[f64]) -> Approach {
    let mut approach = Approach::default();
    approach.iter_mut().zip(sides).for_each(|(a, side)| *a = *side);
    approach
}

#[pymethods]
impl NativeMachine {
    /// Reads a machine file: `options` as those of a verb, `files` stand before those of the disk, or alone.
    #[new]
    #[pyo3(signature = (options, files, alone))]
    fn new(
        py: Python<'_>,
        options: &Bound<'_, PyDict>,
        files: BTreeMap<PathBuf, Vec<u8>>,
        alone: bool,
    ) -> PyResult<Self> {
        let choice = Options(options).machine()?;
        let others = if alone { Files::none() } else { disk() };
        let (files, read) = with_contents(files, others);
        let mut found = Diagnostics::new();
        let machine = py.detach(|| choice.read(&files, &mut found));
        let Some(machine) = machine.filter(|_| !found.has_errors()) else {
            return Err(refused(py, &found));
        };
        let files = read.lock().map(|read| read.clone()).unwrap_or_default();
        Ok(Self { compiled: CompiledMachine::new(&machine), files, found })
    }

    /// The name in the machine file.
    #[getter]
    fn name(&self) -> &str {
        self.machine().name()
    }

    /// The chain, such as `w b X Y Z C A t`.
    #[getter]
    fn chain(&self) -> String {
        self.machine().chain_text()
    }

    /// Name, unit and travel of each axis in chain order; an end without a stated travel is infinite.
    #[getter]
    fn axes(&self) -> Vec<(String, &'static str, f64, f64)> {
        let machine = self.machine();
        let axes = machine.axes().iter().enumerate();
        axes.map(|(i, axis)| {
            let [from, to] = match axis.travel {
                Travel::Between(from, to) => [from, to].map(|end| to_shown(machine, i, end)),
                Travel::Unlimited | Travel::Unknown => [f64::NEG_INFINITY, f64::INFINITY],
            };
            (axis.name.to_string(), unit(axis.kind), from, to)
        })
        .collect()
    }

    /// Name and unit of each error, in chain order.
    #[getter]
    fn error_names(&self) -> Vec<(String, &'static str)> {
        let unit = |index: &ErrorIndex| if index.component.is_rotation() { "urad" } else { "um" };
        self.errors().iter().map(|(index, name)| (name.to_string(), unit(index))).collect()
    }

    /// The files that the machine was made from.
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
