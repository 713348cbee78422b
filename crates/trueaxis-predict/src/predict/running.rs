//! The machine of a study as it runs: what its control compensates is no error of it.

use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Place, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::file::machine_of;

/// The machine that a study names, and its path, its errors that active tables compensate at zero; a note says which.
pub(crate) fn running_machine(root: &Section<'_>, study: &Path) -> Option<(PathBuf, Machine)> {
    let (path, machine) = machine_of(root, study)?;
    let (place, mut problems) = (Place::whole(&path.display().to_string()), Diagnostics::new());
    let machine = machine.running("predicted", place, &mut problems);
    root.take_over(problems);
    Some((path, machine))
}
