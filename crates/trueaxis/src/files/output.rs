//! Files that an answer leaves: what may be replaced.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use trueaxis_input::{Diagnostics, Place};

/// A kind of file that is written.
#[derive(Debug, PartialEq, Eq)]
pub struct Kind {
    /// The argument that names it.
    pub argument: &'static str,
    /// What it is, for messages.
    pub name: &'static str,
    /// How such files begin, in small letters; anything else is not overwritten.
    pub begins: &'static [&'static [u8]],
    /// What such files contain, in any case; empty if they are known by their beginning.
    pub contains: &'static str,
    /// Whether its folder is made where there is none.
    pub makes_folder: bool,
}

impl Kind {
    /// A file in a folder that is there.
    pub const fn file(
        argument: &'static str,
        name: &'static str,
        begins: &'static [&'static [u8]],
    ) -> Self {
        Self { argument, name, begins, contains: "", makes_folder: false }
    }

    /// Tables of virtual readings in a folder that is made where there is none.
    pub const fn readings(begins: &'static [&'static [u8]]) -> Self {
        let file = Self::file("-o", "a table of virtual readings", begins);
        Self { makes_folder: true, ..file }
    }
}

/// The HTML report.
pub const REPORT: Kind = Kind::file("--report", "a report", &[b"<!doctype html"]);

/// Whether a file may be put there: the folder exists, and what stands there is of the same kind.
pub fn may_write(path: &Path, kind: &Kind, problems: &mut Diagnostics) {
    let Kind { argument, name, .. } = kind;
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let will_be = kind.makes_folder && !folder.exists();
    let (message, hint) = if path.file_name().is_none() || path.is_dir() {
        ("is a folder, not a file".to_owned(), format!("name a file in it: {argument} FOLDER/FILE"))
    } else if !folder.is_dir() && !will_be {
        let hint = format!("make the folder first, or name another {argument}");
        ("its folder does not exist".to_owned(), hint)
    } else if !replaceable(path, kind) {
        let hint = format!("it is not overwritten; name another {argument}");
        (format!("is there, and is not {name}"), hint)
    } else {
        return;
    };
    problems.error("unwritable-file", Place::whole(&path.display().to_string()), message, &hint);
}

/// Nothing, an empty file or one of the kind; never a study, a machine or a device.
fn replaceable(path: &Path, kind: &Kind) -> bool {
    /// What marks a file stands within this many bytes.
    const HEAD: u64 = 1 << 14;
    let Ok(found) = fs::metadata(path) else { return true };
    if !found.is_file() {
        return false;
    }
    let mut head = Vec::new();
    // A file that cannot be read is not known to be of the kind.
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    head.make_ascii_lowercase();
    let marked = || String::from_utf8_lossy(&head).contains(&kind.contains.to_ascii_lowercase());
    let is_kind = kind.begins.iter().any(|b| head.starts_with(b));
    read.is_ok() && (head.is_empty() || is_kind || !kind.contains.is_empty() && marked())
}

/// Whether nothing stands there, or the same: what was written once may have been filled in or edited since.
pub fn same_or_nothing(path: &Path, content: &[u8], problems: &mut Diagnostics) {
    let (message, hint) = match fs::metadata(path) {
        Err(_) => return,
        Ok(found) if !found.is_file() => ("is no ordinary file", "name another folder"),
        Ok(_) if fs::read(path).is_ok_and(|there| there == content) => return,
        Ok(_) => (
            "is there with another content",
            "it may have been filled in or edited: it is not overwritten; remove it or name another folder",
        ),
    };
    let place = Place::whole(&path.display().to_string());
    problems.error("unwritable-file", place, message.to_owned(), hint);
}

/// Whether the folder is new or empty, and the one that it stands in is there.
pub fn may_fill(folder: &Path, problems: &mut Diagnostics) {
    let above = folder.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let full = folder.read_dir().is_ok_and(|mut entries| entries.next().is_some());
    let (message, hint) = if folder.file_name().is_none() || folder.is_file() || full {
        ("is no new or empty folder", "nothing is overwritten; name a folder that is new or empty")
    } else if !above.is_dir() {
        ("its folder does not exist", "make that folder first, or name another --output")
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

/// Whether two paths name one file.
pub fn same_file(one: &Path, other: &Path) -> bool {
    match (one.canonicalize(), other.canonicalize()) {
        (Ok(one), Ok(other)) => one == other,
        _ => one == other,
    }
}

/// Whether a machine file may be put there: never over the files that were read, nor over anything that is
/// not a machine file.
pub fn may_write_machine(path: &Path, read: &[&Path], problems: &mut Diagnostics) {
    let is_machine = |text: String| text.is_empty() || text.contains("[machine]");
    let (message, hint) = if read.iter().any(|other| same_file(path, other)) {
        ("is the input, which is not overwritten", "name another file: -o identified.toml")
    } else if path.is_dir() || path.exists() && !fs::read_to_string(path).is_ok_and(is_machine) {
        ("is there, and is not a machine file", "it is not overwritten; name another -o")
    } else {
        return;
    };
    let place = Place::whole(&path.display().to_string());
    problems.error("unwritable-file", place, message.to_owned(), hint);
}
