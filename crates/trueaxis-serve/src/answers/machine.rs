//! The machine that a request names: as it stands on the disk, or as somebody is editing it.

use crate::body::Body;
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

/// `machine` names the file, `text` is its text if it is being edited.
pub(super) fn draft(desk: &Desk, body: &Body<'_>) -> Result<Draft, Refusal> {
    let path = desk.project.path(body.text("machine")?)?;
    let mut problems = Diagnostics::new();
    let text = match body.optional_text("text")? {
        Some(text) => Some(text.to_owned()),
        None => disk().text(&path, "a machine file (TOML)", &mut problems),
    };
    let Some(text) = text else { return Err(Refusal::unusable(&problems)) };
    let (machine, problems) = Machine::check(
        &path.display().to_string(),
        &text,
        &Folder::of(&trueaxis::files::disk(), &path),
    );
    let machine = machine.filter(|_| !problems.has_errors());
    Ok(Draft { machine, path, text, problems })
}
