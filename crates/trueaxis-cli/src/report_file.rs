//! Files that a command writes: what may be replaced, and how it is reported.

use crate::output::{Outcome, report, tell};
use trueaxis::files;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::report::Report;
use trueaxis_paper::ReportFile;

/// Writes a report whole or not at all, and says where it is.
pub fn write_report(file: &ReportFile, printed: Report<'_>) -> Result<(), Outcome> {
    let shown = file.path().display().to_string();
    let mut problems = Diagnostics::new();
    let bytes = file.print(printed, &mut problems).map_err(|e| {
        unusable(
            "no-report",
            &shown,
            &e.to_string(),
            "name another logo in --heading, or leave out --report",
        )
    })?;
    files::write_in_folder(file.path(), &bytes).map_err(|e| {
        let message = format!("cannot be written: {e}");
        unusable("unwritable-file", &shown, &message, "name another --report, or leave it out")
    })?;
    report(problems);
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
