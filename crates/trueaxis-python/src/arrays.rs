//! Arrays from Python: their type, shape and strides, and where in them something is wrong.

use crate::problems::one;
use numpy::ndarray::ArrayView2;
use numpy::{PyArrayMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use trueaxis::input::Place;

/// What an argument holds.
pub struct Wanted<'a> {
    /// Its name.
    pub name: &'a str,
    /// What its columns are, each in its unit.
    pub columns: &'a [String],
}

impl Wanted<'_> {
    fn shape(&self) -> String {
        format!("(n, {}), its columns {}", self.columns.len(), self.columns.join(", "))
    }

    /// The place of one number, as numpy writes it.
    pub fn place(&self, row: usize, column: usize) -> Place {
        Place::whole(&format!("{}[{row}, {column}]", self.name))
    }

    /// The place of a row.
    pub fn row(&self, row: usize) -> Place {
        Place::whole(&format!("{}[{row}]", self.name))
    }

    /// An array of float64 as it is, whatever its strides; of another number type a converted copy. Anything else is
    /// refused: a text may hold a unit, a truth value is no position, and a mask would be lost.
    pub fn array<'py>(&self, given: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArray2<'py, f64>> {
        let array = self.numbers(given)?;
        let (py, shape) = (given.py(), array.shape());
        if shape.len() != 2 || shape[1] != self.columns.len() {
            let found: Vec<String> = shape.iter().map(ToString::to_string).collect();
            let message = format!(
                "`{}` has the shape ({}), not {}",
                self.name,
                found.join(", "),
                self.shape()
            );
            let hint = "one row for each pose; a single pose is [[…]]";
            return Err(one(py, "array-shape", self.name, message, hint));
        }
        Ok(array.cast::<numpy::PyArray2<f64>>()?.try_readonly()?)
    }

    fn numbers<'py>(&self, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyUntypedArray>> {
        let py = given.py();
        let numpy = py.import("numpy")?;
        let refuse = |place: &str, message: String| {
            let hint =
                format!("write plain numbers: an array of float64 of the shape {}", self.shape());
            one(py, "array-type", place, message, &hint)
        };
        if given.is_instance(&numpy.getattr("ma")?.getattr("MaskedArray")?)? {
            let message = format!("`{}` is a masked array, whose mask would be lost", self.name);
            return Err(refuse(self.name, message));
        }
        let array = numpy.call_method1("asarray", (given,)).map_err(|error| {
            refuse(self.name, format!("`{}` is no array of numbers: {error}", self.name))
        })?;
        let dtype = array.getattr("dtype")?;
        let kind: String = dtype.getattr("kind")?.extract()?;
        if !["i", "u", "f"].contains(&kind.as_str()) {
            let (place, found) = self.first_no_number(&array)?;
            let message = format!("`{}` has the type {dtype}{found}", self.name);
            return Err(refuse(&place, message));
        }
        // As it is where it is float64 in the byte order of this computer and aligned; else converted.
        let needs = ("A",);
        let array = numpy.call_method1("require", (array, "float64", needs))?;
        Ok(array.cast_into()?)
    }

    /// The place and the text of the first entry that is no number.
    fn first_no_number(&self, array: &Bound<'_, PyAny>) -> PyResult<(String, String)> {
        let ndim: usize = array.getattr("ndim")?.extract()?;
        if ndim == 2 {
            for (row, entries) in array.try_iter()?.enumerate() {
                for (column, entry) in entries?.try_iter()?.enumerate() {
                    let entry = entry?;
                    let entry = entry.call_method0("item").unwrap_or(entry);
                    let is_number = entry.extract::<f64>().is_ok()
                        && !entry.is_instance_of::<pyo3::types::PyBool>();
                    if !is_number {
                        let place = self.place(row, column).file;
                        let shown = entry.repr()?.to_string();
                        let shown: String = shown.chars().take(40).collect();
                        return Ok((place, format!(": {shown} in row {row}, column {column}")));
                    }
                }
            }
        }
        Ok((self.name.to_owned(), String::new()))
    }
}

/// The first number of a row that is not finite.
pub fn not_finite(array: &ArrayView2<'_, f64>, row: usize) -> Option<usize> {
    array.row(row).iter().position(|x| !x.is_finite())
}
