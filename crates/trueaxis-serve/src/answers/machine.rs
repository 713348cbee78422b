//! The machine that a request names: as it is on the disk, or as it is being edited.

use crate::desk::Desk;
use crate::refusal::Refusal;
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::file::Folder;

/// A machine file that may not be saved yet.
pub(super) struct Draft {
    /// None if it cannot be used; then the problems say why.
    pub(super) machine: Option<Machine>,
    pub(super) path: PathBuf,
    pub(super) text: String,
    pub(super) problems: Diagnostics,
}

impl Draft {
    /// The file of this name, with this text if it is being edited.
    pub(super) fn read(desk: &Desk, name: &str, text: Option<String>) -> Result<Self, Refusal> {
        let path = desk.project.path(name)?;
        let mut problems = Diagnostics::new();
        let text = text.or_else(|| disk().text(&path, "a machine file (TOML)", &mut problems));
        let Some(text) = text else { return Err(Refusal::unusable(&problems)) };
        let folder = Folder::of(&disk(), &path);
        let (machine, problems) = Machine::check(&path.display().to_string(), &text, &folder);
        let machine = machine.filter(|_| !problems.has_errors());
        Ok(Self { machine, path, text, problems })
    }
}
