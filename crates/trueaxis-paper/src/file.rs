//! The file of a report that a command was asked for: checked before the work, printed after it.

use crate::{Form, PrintError, Printed, print, read_heading};
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_report::{Heading, Language, Report};

/// The file of a report.
#[derive(Debug)]
pub struct ReportFile {
    path: PathBuf,
    form: Form,
    heading: Option<Heading>,
    language: &'static dyn Language,
}

impl ReportFile {
    /// What was asked for: the file of the report, that of its heading, its language. None without a report, or with errors, which
    /// stand in `problems`.
    ///
    /// ```
    /// use trueaxis_input::{Diagnostics, Files};
    /// use trueaxis_paper::ReportFile;
    /// use trueaxis_report::English;
    /// let mut problems = Diagnostics::new();
    /// let (path, files) = (Some("x.docx".as_ref()), Files::none());
    /// let file = ReportFile::read(path, None, &English, &files, &mut problems);
    /// assert!(file.is_none());
    /// assert_eq!(problems.iter().next().unwrap().code, "unknown-report-form");
    /// ```
    pub fn read(
        path: Option<&Path>,
        heading: Option<&Path>,
        language: &'static dyn Language,
        files: &Files,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let form = path.and_then(|path| form(path, problems));
        let read = heading.map(|heading| read_heading(files, heading, problems));
        if let (None, Some(heading)) = (path, heading) {
            let place = Place::whole(&heading.display().to_string());
            let message = "a heading without a report".to_owned();
            problems.error("no-report", place, message, "add `--report FILE.pdf`");
        }
        let heading = match read {
            Some(None) => return None,
            Some(heading) => heading,
            None => None,
        };
        Some(Self { path: path?.to_owned(), form: form?, heading, language })
    }

    /// Where it goes.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The content of the file. Characters without a glyph become a warning.
    ///
    /// # Errors
    /// What the drawing or typesetting library says.
    pub fn print(
        &self,
        report: Report<'_>,
        problems: &mut Diagnostics,
    ) -> Result<Vec<u8>, PrintError> {
        let report = Report { heading: self.heading.clone(), date: today(), ..report };
        let report = report.in_language(self.language);
        let Printed { bytes, missing } = print(&report, self.form)?;
        if !missing.is_empty() {
            missing_glyphs(&missing, Place::whole(&self.path.display().to_string()), problems);
        }
        Ok(bytes)
    }
}

/// Characters that are named: of a report in another script there may be hundreds.
const MOST_NAMED: usize = 10;

/// Says which characters of a report no font has.
pub fn missing_glyphs(missing: &str, place: Place, problems: &mut Diagnostics) {
    let named: String = missing.chars().take(MOST_NAMED).collect();
    let others = match missing.chars().count().saturating_sub(MOST_NAMED) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    let message = format!("no font has the characters `{named}`{others}: boxes stand for them");
    let hint = "install a font that has them, such as Noto Sans CJK, or write an HTML report";
    problems.warn("missing-glyph", place, message, hint);
}

fn form(path: &Path, problems: &mut Diagnostics) -> Option<Form> {
    let place = Place::whole(&path.display().to_string());
    let Some(form) = Form::of(path) else {
        let message = "a report is HTML or PDF, by the ending of its name".to_owned();
        problems.error("unknown-report-form", place, message, "name it FILE.html or FILE.pdf");
        return None;
    };
    if form.is_there() {
        return Some(form);
    }
    let hint = "name it FILE.html, which every browser prints; or take the Debian package, or build with `--features pdf`";
    problems.error("no-pdf", place, "this build of trueaxis writes no PDF".to_owned(), hint);
    None
}

/// The day, as ISO 8601 writes it; that of `SOURCE_DATE_EPOCH` (seconds) where it is set, so that the same input gives the
/// same file.
pub fn today() -> String {
    let stated = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.parse().ok());
    let stated = stated.and_then(|seconds| jiff::Timestamp::from_second(seconds).ok());
    match stated {
        Some(moment) => moment.strftime("%Y-%m-%d").to_string(),
        None => jiff::ZonedDateTime::now().strftime("%Y-%m-%d").to_string(),
    }
}
