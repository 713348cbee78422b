//! A report on paper: what stands above it when it is filed and signed, as HTML or PDF.
//!
//! - [`read_heading`]: number, date, customer, machine, operator, instruments, logo and lines for signatures, from
//!   `[report]` of a TOML file;
//! - [`Form`]: what a file of a report contains, by the ending of its name;
//! - [`print()`]: the bytes of that file; [`ReportFile`]: all of it, as a command is asked for it.
//!
//! ```
//! use trueaxis_paper::{Form, print};
//! use trueaxis_report::{Report, Section};
//! let report = Report::new("Axis X").section(Section::new("Result").paragraph("2.5 µm"));
//! let form = Form::of("x.html".as_ref()).unwrap();
//! let page = print(&report, form).unwrap().bytes;
//! assert!(String::from_utf8(page).unwrap().contains("<p>2.5 µm</p>"));
//! assert!(Form::of("x.docx".as_ref()).is_none());
//! ```
//!
//! PDF needs the feature `pdf`, which packages have: typesetting takes minutes to build.

mod file;
mod heading;
#[cfg(feature = "pdf")]
mod pdf;

pub use file::ReportFile;
pub use heading::read_heading;

use std::fmt;
use std::path::Path;
use trueaxis_report::Report;

/// What a file of a report contains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A page for a browser.
    Html,
    /// Pages of paper.
    Pdf,
}

impl Form {
    /// The form by the ending of the name; none for another ending than `.html`, `.htm` and `.pdf`.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "html" | "htm" => Some(Self::Html),
            "pdf" => Some(Self::Pdf),
            _ => None,
        }
    }

    /// Whether this build can print it.
    pub fn is_there(self) -> bool {
        self == Self::Html || cfg!(feature = "pdf")
    }
}

/// A report in its form.
#[derive(Debug)]
pub struct Printed {
    /// The content of the file.
    pub bytes: Vec<u8>,
    /// Characters of the text that no font at hand has: an empty box stands for each of them. Always empty for HTML.
    pub missing: String,
}

/// A report that could not be printed.
#[derive(Debug)]
pub struct PrintError(String);

impl fmt::Display for PrintError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for PrintError {}

/// Prints a report.
///
/// # Errors
/// What the drawing or typesetting library says; PDF in a build without it.
pub fn print(report: &Report<'_>, form: Form) -> Result<Printed, PrintError> {
    match form {
        Form::Html => {
            let page = report.html().map_err(|e| PrintError(e.to_string()))?;
            Ok(Printed { bytes: page.into_bytes(), missing: String::new() })
        }
        #[cfg(feature = "pdf")]
        Form::Pdf => pdf::pdf(report),
        #[cfg(not(feature = "pdf"))]
        Form::Pdf => Err(PrintError("this build writes no PDF".to_owned())),
    }
}
