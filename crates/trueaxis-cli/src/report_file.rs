//! Files that a command writes: what may be replaced, and how it is reported.

use crate::output::{Outcome, report, tell};
use std::path::Path;
use trueaxis::files;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::report::DrawingError;

/// Writes a report whole or not at all, and says where it is.
pub fn write_report(path: &Path, page: Result<String, DrawingError>) -> Result<(), Outcome> {
    let shown = path.display().to_string();
    let page =
        page.map_err(|e| unusable("no-report", &shown, &e.to_string(), "leave out --report"))?;
    files::write_in_folder(path, page.as_bytes()).map_err(|e| {
        let message = format!("cannot be written: {e}");
        unusable("unwritable-file", &shown, &message, "name another --report, or leave it out")
    })?;
    tell(&format!("report: {shown}"));
    Ok(())
}

/// Shows one error.
pub fn unusable(code: &'static str, place: &str, message: &str, hint: &str) -> Outcome {
    let mut problems = Diagnostics::new();
    problems.error(code, Place::whole(place), message.to_owned(), hint);
    report(problems);
    Outcome::Unusable
}
