//! The native half of the Python package `trueaxis`: machines over numpy arrays, and the questions of the facade.
//!
//! What a user calls stands in `python/trueaxis`: names, documentation, classes of answers. Here stands what
//! needs the library: arrays in and out without a copy, the interpreter lock released, threads.

mod answer;
mod arrays;
mod door;
mod machine;
mod options;
mod poses;
mod problems;
mod solve;
mod study;
mod threads;
mod verbs;

use pyo3::prelude::*;

/// `trueaxis._native`.
#[pymodule]
mod _native {
    use super::*;

    #[pymodule_export]
    use super::answer::NativeAnswer;
    #[pymodule_export]
    use super::door::ask;
    #[pymodule_export]
    use super::machine::NativeMachine;
    #[pymodule_export]
    use super::poses::{deviations, errors_at};
    #[pymodule_export]
    use super::solve::{follow, solve};
    #[pymodule_export]
    use super::study::NativeStudy;

    /// The version of TrueAxis.
    #[pymodule_export]
    const VERSION: &str = trueaxis::VERSION;

    /// What a code of a diagnostic means, as `trueaxis explain` prints it: the page, the text; none if it is not known.
    #[pyfunction]
    fn explain(code: &str) -> Option<(&'static str, &'static str)> {
        let all = trueaxis::explain::explanations();
        all.iter().find(|e| e.code == code).map(|e| (e.page, e.text))
    }
}
