//! Files of the project: which there are, their text, and saving it.

use crate::change::ChangeEntry;
use crate::desk::{Desk, Job};
use crate::project::{ExampleEntry, FileEntry, version};
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request};
use serde::{Deserialize, Serialize};
use std::path::Path;
use trueaxis::JsonSchema;
use trueaxis::files;
use trueaxis::report::DiagnosticEntry;

/// Which files and examples there are.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ProjectRequest {}

/// The project folder.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ProjectAnswer<'a> {
    /// The name of the folder.
    folder: String,
    /// The version of TrueAxis.
    version: &'static str,
    /// The examples of the folder.
    examples: Vec<ExampleEntry>,
    /// Its files in the order of their paths.
    files: Vec<FileEntry>,
    /// Whether there are more files than are listed.
    more_files: bool,
    /// Problems of the list of examples.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl Request for ProjectRequest {
    type Answer<'a> = ProjectAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let (files, more_files) = desk.project.files();
        let (examples, problems) = desk.project.examples();
        Ok(Reply::json(&ProjectAnswer {
            folder: desk.project.name(),
            version: env!("CARGO_PKG_VERSION"),
            examples,
            files,
            more_files,
            diagnostics: entries(&problems),
        }))
    }
}

/// The text of a file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct OpenRequest {
    /// Its path below the project folder.
    path: String,
}

/// A file as it is on the disk.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct OpenAnswer<'a> {
    /// Its path below the project folder.
    path: &'a str,
    /// Its text; what is not UTF-8 is shown as replacement characters.
    text: &'a str,
    /// The version of the text, for `save`.
    version: String,
}

impl Request for OpenRequest {
    type Answer<'a> = OpenAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let content = read(&desk.project.path(&self.path)?)?;
        // Programs of old controls are not UTF-8.
        let text = String::from_utf8_lossy(&content);
        Ok(Reply::json(&OpenAnswer { path: &self.path, text: &text, version: version(&content) }))
    }
}

/// Replaces the text of a file, if it is still the one that was opened.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SaveRequest {
    /// Its path below the project folder: TOML or CSV.
    path: String,
    /// The new text.
    text: String,
    /// The version that was opened; null for a new file.
    version: Option<String>,
    /// Whether its folder is made where it is missing.
    make_folder: Option<bool>,
    /// The window that saves it, so that it recognises its own changes.
    window: Option<String>,
}

/// A file that was saved.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SaveAnswer<'a> {
    /// Its path.
    path: &'a str,
    /// The version of its new text.
    version: &'a str,
}

impl Request for SaveRequest {
    type Answer<'a> = SaveAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let (name, text) = (&self.path, self.text.as_bytes());
        let path = desk.project.writable_path(name)?;
        let _one = desk.saving.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let current = path.exists().then(|| read(&path)).transpose()?;
        if current.as_deref().map(version) != self.version {
            let (message, hint) = match self.version {
                Some(_) => (
                    format!("{name} was changed elsewhere since it was opened"),
                    "open it again, or save under another name",
                ),
                None => (
                    format!("{name} is there already"),
                    "save under another name: nothing is replaced",
                ),
            };
            return Err(Refusal::new(409, "conflict", message, hint));
        }
        let written = match self.make_folder.unwrap_or_default() {
            true => files::write_with_folder(&path, text),
            false => files::write(&path, text),
        };
        written.map_err(|e| {
            Refusal::new(422, "unwritable-file", format!("{name} cannot be written: {e}"), "")
        })?;
        let version = version(text);
        tell(desk, name, &version, self.window.clone());
        Ok(Reply::json(&SaveAnswer { path: name, version: &version }))
    }
}

/// Tells the windows of a file that was saved.
fn tell(desk: &Desk, name: &str, version: &str, window: Option<String>) {
    desk.written
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
        .insert(name.to_owned(), version.to_owned());
    let (path, version) = (Some(name.to_owned()), Some(version.to_owned()));
    // It fails if no other window is open.
    let _ = desk.changed.send(ChangeEntry { path, version, window });
}

/// Saves a file that an answer made, under its name or another one with the same ending. A file that is there is replaced
/// only if TrueAxis wrote it and it was not edited since.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SaveMadeRequest {
    /// The number of the files of the answer.
    made: u64,
    /// Which of them, from 0.
    file: usize,
    /// Its path below the project folder.
    path: String,
    /// The window that saves it.
    window: Option<String>,
}

impl Request for SaveMadeRequest {
    type Answer<'a> = SaveAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let name = &self.path;
        let _one = desk.saving.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let version =
            desk.made_file(self.made, self.file, |made, file| made.save(desk, file, name))??;
        tell(desk, name, &version, self.window.clone());
        Ok(Reply::json(&SaveAnswer { path: name, version: &version }))
    }
}

fn read(path: &Path) -> Result<Vec<u8>, Refusal> {
    files::read_bytes(path).map_err(|error| {
        let status = if error.kind() == std::io::ErrorKind::NotFound { 404 } else { 422 };
        let message = format!("{}: cannot be read: {error}", path.display());
        Refusal::new(status, "unreadable-file", message, "choose a file from the list")
    })
}
