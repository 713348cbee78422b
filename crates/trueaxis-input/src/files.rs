//! Access to files. The readers of this workspace open no file themselves: the caller passes a
//! [`Files`], which may be a disk, an upload or the memory of a test.

use crate::{Content, Diagnostics, Draft, Place};
use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A provider of files: a disk, a folder of a project, the memory of a test.
pub trait Source: Send + Sync {
    /// The content of a file.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// The content of a file that may be longer than others, such as an NC program.
    ///
    /// # Errors
    /// As [`Source::read`].
    fn read_long(&self, path: &Path) -> io::Result<Content> {
        self.read(path).map(Content::from)
    }

    /// Whether the path names a regular file that may be read.
    fn is_file(&self, path: &Path) -> bool;

    /// Where a text of some such length is put together: in the memory, unless the source has another place for long ones.
    fn draft(&self, bytes: usize) -> Box<dyn Draft> {
        Box::new(Vec::with_capacity(bytes))
    }
}

/// The files that a reader may open. A handle, cheap to clone; its default is [`Files::none`].
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

    /// See [`Source::draft`].
    pub fn draft(&self, bytes: usize) -> Box<dyn Draft> {
        self.0.draft(bytes)
    }

    /// These files with some more in memory, which stand before files of the same name.
    ///
    /// ```
    /// use trueaxis_input::Files;
    /// let files = Files::none().with_texts([("part.toml".into(), "name = \"part\"".to_owned())]);
    /// assert!(files.is_file("part.toml".as_ref()) && !files.is_file("other.toml".as_ref()));
    /// ```
    #[must_use]
    pub fn with_texts(self, texts: impl IntoIterator<Item = (PathBuf, String)>) -> Self {
        Self::new(WithTexts { texts: texts.into_iter().collect(), others: self })
    }

    /// No files at all.
    pub fn none() -> Self {
        Self::new(NoFiles)
    }

    /// The content of a UTF-8 file, or `None` and the problem `unreadable-file`. `what` names the
    /// expected kind of file in the hint, such as "a study file (TOML)".
    pub fn text(&self, path: &Path, what: &str, problems: &mut Diagnostics) -> Option<String> {
        self.read_text(path).map_err(|error| unreadable(path, what, &error, problems)).ok()
    }

    /// The bytes of a file in any encoding, or `None` and the problem `unreadable-file`; `what` as for [`Files::text`].
    pub fn bytes(&self, path: &Path, what: &str, problems: &mut Diagnostics) -> Option<Vec<u8>> {
        self.read(path).map_err(|error| unreadable(path, what, &error, problems)).ok()
    }

    /// The same of a file that may be longer than others, such as an NC program.
    pub fn content(&self, path: &Path, what: &str, problems: &mut Diagnostics) -> Option<Content> {
        self.read_long(path).map_err(|error| unreadable(path, what, &error, problems)).ok()
    }

    /// The content of a file that may be longer than others, such as an NC program.
    ///
    /// # Errors
    /// The error of the source.
    pub fn read_long(&self, path: &Path) -> io::Result<Content> {
        self.0.read_long(path)
    }

    /// The bytes of a file in any encoding.
    ///
    /// # Errors
    /// The error of the source.
    pub fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.0.read(path)
    }

    /// The content of a UTF-8 file.
    ///
    /// # Errors
    /// The error of the source, or the first line that is not UTF-8.
    pub fn read_text(&self, path: &Path) -> io::Result<String> {
        String::from_utf8(self.read(path)?).map_err(|error| {
            let sound = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = sound.iter().filter(|b| **b == b'\n').count() + 1;
            let message = format!("line {line} is not UTF-8 text; save the file as UTF-8");
            io::Error::new(io::ErrorKind::InvalidData, message)
        })
    }

    /// Whether the path names a regular file that may be read.
    pub fn is_file(&self, path: &Path) -> bool {
        self.0.is_file(path)
    }
}

fn unreadable(path: &Path, what: &str, error: &io::Error, problems: &mut Diagnostics) {
    let place = Place::whole(&path.display().to_string());
    let message = format!("the file cannot be read: {error}");
    problems.error("unreadable-file", place, message, &format!("expected {what} here"));
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

/// The origin of a file is not part of its content, so that all handles compare equal.
impl PartialEq for Files {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

struct WithTexts {
    texts: BTreeMap<PathBuf, String>,
    others: Files,
}

impl Source for WithTexts {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        match self.texts.get(path) {
            Some(text) => Ok(text.clone().into_bytes()),
            None => self.others.read(path),
        }
    }

    fn read_long(&self, path: &Path) -> io::Result<Content> {
        match self.texts.get(path) {
            Some(text) => Ok(text.clone().into_bytes().into()),
            None => self.others.read_long(path),
        }
    }

    fn is_file(&self, path: &Path) -> bool {
        self.texts.contains_key(path) || self.others.is_file(path)
    }

    fn draft(&self, bytes: usize) -> Box<dyn Draft> {
        self.others.draft(bytes)
    }
}

struct NoFiles;

impl Source for NoFiles {
    fn read(&self, _: &Path) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::NotFound, "this reader has no access to files"))
    }

    fn is_file(&self, _: &Path) -> bool {
        false
    }
}
