//! Where files come from: the readers of this workspace open none themselves.

use crate::{Diagnostics, Place};
use std::fmt;
use std::io;
use std::path::Path;
use std::sync::Arc;

/// A place that files are read from: a disk, a folder of a project, a test's memory.
pub trait Source: Send + Sync {
    /// The content of a file.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// Whether an ordinary file stands there that may be read.
    fn is_file(&self, path: &Path) -> bool;
}

/// The files that a reader may open; a handle that is cheap to clone. [`Files::none`] is its default.
///
/// ```
/// use trueaxis_input::{Diagnostics, Files};
/// let mut problems = Diagnostics::new();
/// let text = Files::none().text("part.toml".as_ref(), "a study file (TOML)", &mut problems);
/// assert_eq!((text, problems.iter().next().unwrap().code), (None, "unreadable-file"));
/// ```
#[derive(Clone)]
pub struct Files(Arc<dyn Source>);

impl Files {
    /// The files of a source.
    pub fn new(source: impl Source + 'static) -> Self {
        Self(Arc::new(source))
    }

    /// No files at all.
    pub fn none() -> Self {
        Self::new(Nothing)
    }

    /// A text file; if it cannot be read, says why.
    pub fn text(&self, path: &Path, what: &str, problems: &mut Diagnostics) -> Option<String> {
        self.read_text(path).map_err(|error| unreadable(path, what, &error, problems)).ok()
    }

    /// A file that need not be UTF-8, such as an NC program; if it cannot be read, says why.
    pub fn bytes(&self, path: &Path, what: &str, problems: &mut Diagnostics) -> Option<Vec<u8>> {
        self.read(path).map_err(|error| unreadable(path, what, &error, problems)).ok()
    }

    /// A file that need not be UTF-8.
    ///
    /// # Errors
    /// What the source says.
    pub fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.0.read(path)
    }

    /// A text file.
    ///
    /// # Errors
    /// What the source says; the first line that is not UTF-8.
    pub fn read_text(&self, path: &Path) -> io::Result<String> {
        String::from_utf8(self.read(path)?).map_err(|error| {
            let sound = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = sound.iter().filter(|b| **b == b'\n').count() + 1;
            let message = format!("line {line} is not UTF-8 text; save the file as UTF-8");
            io::Error::new(io::ErrorKind::InvalidData, message)
        })
    }

    /// Whether an ordinary file stands there that may be read.
    pub fn is_file(&self, path: &Path) -> bool {
        self.0.is_file(path)
    }
}

fn unreadable(path: &Path, what: &str, error: &io::Error, problems: &mut Diagnostics) {
    let place = Place::whole(&path.display().to_string());
    let message = format!("cannot be read: {error}");
    problems.error("unreadable-file", place, message, &format!("{what} is due here"));
}

impl Default for Files {
    fn default() -> Self {
        Self::none()
    }
}

impl fmt::Debug for Files {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Files")
    }
}

/// Where files come from is no part of what was read: all are equal.
impl PartialEq for Files {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

struct Nothing;

impl Source for Nothing {
    fn read(&self, _: &Path) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::NotFound, "no files are at hand here"))
    }

    fn is_file(&self, _: &Path) -> bool {
        false
    }
}
