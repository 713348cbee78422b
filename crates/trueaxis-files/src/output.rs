//! Files that an answer leaves: what may be replaced.
//!
//! One rule for all commands: a file that the command reads is never replaced; another one only if this program
//! wrote it and it has not changed since, or if the same would be written, or by force.

use super::{FilesRead, written};
use std::fs;
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Place};

/// A file that will be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// The argument that names it.
    pub argument: &'static str,
    /// Where it goes.
    pub path: PathBuf,
    /// Whether its folder is made where there is none.
    pub makes_folder: bool,
}

impl Output {
    /// A file in a folder that is there.
    pub fn file(argument: &'static str, path: impl Into<PathBuf>) -> Self {
        Self { argument, path: path.into(), makes_folder: false }
    }

    /// A file in a folder that is made where there is none.
    pub fn in_new_folder(argument: &'static str, path: impl Into<PathBuf>) -> Self {
        Self { makes_folder: true, ..Self::file(argument, path) }
    }
}

/// Keeps files of a person from being replaced.
#[derive(Debug, Default)]
pub struct Guard {
    /// What the command has read.
    pub read: FilesRead,
    /// Whether files that this program did not write may be replaced, too.
    pub force: bool,
}

impl Guard {
    /// Whether a file may be put there, before its content is known.
    pub fn may_write(&self, output: &Output, problems: &mut Diagnostics) {
        let Output { argument, path, makes_folder } = output;
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let will_be = *makes_folder && !folder.exists();
        let (message, hint) = if path.file_name().is_none() || path.is_dir() {
            ("is a folder, not a file", format!("name a file in it: {argument} FOLDER/FILE"))
        } else if !folder.is_dir() && !will_be {
            let hint = format!("make the folder first, or name another {argument}");
            ("its folder does not exist", hint)
        } else if let Some(reason) = self.keeps(path, None) {
            (reason, self.hint(path, argument))
        } else {
            return;
        };
        let place = Place::whole(&path.display().to_string());
        problems.error("unwritable-file", place, message.to_owned(), &hint);
    }

    /// Whether this content may be put there.
    pub fn may_put(&self, path: &Path, content: Option<&[u8]>, problems: &mut Diagnostics) {
        if let Some(reason) = self.keeps(path, content) {
            let place = Place::whole(&path.display().to_string());
            let hint = self.hint(path, "file or folder");
            problems.error("unwritable-file", place, reason.to_owned(), &hint);
        }
    }

    /// Why what stands there stays, if it does.
    fn keeps(&self, path: &Path, content: Option<&[u8]>) -> Option<&'static str> {
        fs::symlink_metadata(path).ok()?;
        let Ok(found) = fs::metadata(path) else {
            return Some("is a link that leads nowhere");
        };
        let same = || content.is_some_and(|new| fs::read(path).is_ok_and(|there| there == new));
        if !found.is_file() {
            Some("is no ordinary file")
        } else if self.read.contains(path) {
            Some("is read by this command, and would be replaced")
        } else if self.force || found.len() == 0 || written::is_ours(path) || same() {
            None
        } else {
            Some("is there, and was not written by this program or was edited since")
        }
    }

    fn hint(&self, path: &Path, argument: &str) -> String {
        match self.read.contains(path) {
            true => format!("an input is never replaced; name another {argument}"),
            false => format!("name another {argument}, or replace it with --force"),
        }
    }
}

/// Whether the folder is new or empty, and the one that it stands in is there.
pub fn may_fill(folder: &Path, problems: &mut Diagnostics) {
    let above = folder.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let full = folder.read_dir().is_ok_and(|mut entries| entries.next().is_some());
    let (message, hint) = if folder.file_name().is_none() || folder.is_file() || full {
        ("is no new or empty folder", "nothing is overwritten; name a folder that is new or empty")
    } else if !above.is_dir() {
        ("its folder does not exist", "make that folder first, or name another one")
    } else {
        return;
    };
    let place = Place::whole(&folder.display().to_string());
    problems.error("unwritable-folder", place, message.to_owned(), hint);
}

/// Refuses one file for two outputs.
pub fn no_file_twice(paths: &[&Path], problems: &mut Diagnostics) {
    for (i, path) in paths.iter().enumerate() {
        if paths[..i].iter().any(|other| same_place(path, other)) {
            let place = Place::whole(&path.display().to_string());
            let message = "is named for two outputs".to_owned();
            problems.error("one-file-twice", place, message, "name a file for each");
        }
    }
}

/// Whether two names stand for one place, where a file may be or not.
fn same_place(one: &Path, other: &Path) -> bool {
    let place = |path: &Path| {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some((folder.canonicalize().ok()?, path.file_name()?.to_owned()))
    };
    one == other || place(one).is_some_and(|p| Some(p) == place(other))
}

/// Whether two paths name one file, through links of both kinds.
pub fn same_file(one: &Path, other: &Path) -> bool {
    let real = || Some(one.canonicalize().ok()? == other.canonicalize().ok()?);
    one == other || real().unwrap_or(false) || one_node(one, other)
}

/// Whether two names lead to one place on the disk, as hard links do.
#[cfg(unix)]
fn one_node(one: &Path, other: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let node = |path: &Path| fs::metadata(path).map(|found| (found.dev(), found.ino())).ok();
    node(one).is_some_and(|found| Some(found) == node(other))
}

/// Other systems do not say it.
#[cfg(not(unix))]
fn one_node(_: &Path, _: &Path) -> bool {
    false
}
