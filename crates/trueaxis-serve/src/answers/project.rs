//! Files of the project: which there are, their text, and saving it.

use crate::body::Body;
use crate::desk::{Desk, Job, Reply};
use crate::project::version;
use crate::refusal::Refusal;
use serde_json::{Value, json};
use std::path::Path;
use trueaxis::files;

/// Which files and examples there are.
pub(super) fn project(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    Body::of(body, &[])?;
    Ok(Reply::Json(desk.project.json()))
}

/// The text of a file and its version.
pub(super) fn open(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["path"])?;
    let name = body.text("path")?;
    let content = read(&desk.project.path(name)?)?;
    // Programs of old controls are no UTF-8; what is none shows as a replacement character.
    let text = String::from_utf8_lossy(&content);
    Ok(Reply::Json(json!({ "path": name, "text": text, "version": version(&content) })))
}

/// Replaces the text of a file, if it is still the one that was opened.
pub(super) fn save(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["path", "text", "version", "window"])?;
    let (name, text) = (body.text("path")?, body.text("text")?);
    let path = desk.project.writable_path(name)?;
    let known = body.optional_text("version")?;
    let _one = desk.saving.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let there = path.exists().then(|| read(&path)).transpose()?;
    if there.as_deref().map(version).as_deref() != known {
        let message = format!("{name} was changed by somebody else since it was opened");
        let hint = "open it again, or save under another name";
        return Err(Refusal::new(409, "conflict", message, hint));
    }
    files::write(&path, text.as_bytes()).map_err(|e| {
        Refusal::new(422, "unwritable-file", format!("{name} cannot be written: {e}"), "")
    })?;
    let version = version(text.as_bytes());
    let window = body.optional_text("window")?;
    let news = json!({ "changed": { "path": name, "version": version, "window": window } });
    // Nobody else may be looking.
    let _ = desk.changed.send(news);
    Ok(Reply::Json(json!({ "path": name, "version": version })))
}

fn read(path: &Path) -> Result<Vec<u8>, Refusal> {
    files::read_bytes(path).map_err(|error| {
        let status = if error.kind() == std::io::ErrorKind::NotFound { 404 } else { 422 };
        let message = format!("{}: cannot be read: {error}", path.display());
        Refusal::new(status, "unreadable-file", message, "choose a file from the list")
    })
}
