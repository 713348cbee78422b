//! The machine of a study as it runs: what its control compensates is no error of it.

use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Place, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::file::machine_of;

/// The machine that a study names, and its path, its errors that active tables compensate at zero; a note says which.
pub(crate) fn running_machine(root: &Section<'_>, study: &Path) -> Option<(PathBuf, Machine)> {
    let (path, machine) = machine_of(root, study)?;
    let Some(names) = machine.active_names() else { return Some((path, machine)) };
    let message = format!("predicted without {names}: the control compensates them");
    let hint = "the machine file says under [compensation] that their tables are active; take out what is not";
    let mut problems = Diagnostics::new();
    problems.note("already-active", Place::whole(&path.display().to_string()), message, hint);
    root.take_over(problems);
    Some((path, machine.as_running()))
}
