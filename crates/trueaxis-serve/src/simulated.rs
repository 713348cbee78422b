//! A simulation that is kept, so that the page can go back and forth in it.

use std::sync::Arc;
use trueaxis::machine::Machine;
use trueaxis::simulate::{Job, Recording};

/// One simulation.
pub(crate) struct Simulated {
    pub(crate) machine: Machine,
    pub(crate) recording: Recording,
    pub(crate) programs: Vec<Source>,
    /// What was simulated, where the stock was cut: to cut it up to a time.
    pub(crate) cut: Option<Arc<Job>>,
}

/// A program as it was simulated.
pub(crate) struct Source {
    pub(crate) name: String,
    /// Its name in the project, if it is a file there.
    pub(crate) path: Option<String>,
    pub(crate) text: String,
}
