//! Files in, files out: the only place of the loop that touches the disk.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use trueaxis_geometry::input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::file::Tables;

/// No text file that people write is longer; a larger one is refused before it fills the memory.
const MAX_BYTES: u64 = 256 << 20;

/// The tables beside a machine file.
struct Folder {
    path: PathBuf,
}

impl Tables for Folder {
    fn text(&self, name: &str) -> Result<String, String> {
        read_text(&self.path.join(name)).map_err(|e| e.to_string())
    }

    fn display(&self, name: &str) -> String {
        self.path.join(name).display().to_string()
    }
}

/// Reads and checks a machine file with the tables that it names.
///
/// ```no_run
/// let (machine, problems) = trueaxis::files::machine("machines/xkas2525/machine.toml".as_ref());
/// assert_eq!(machine.unwrap().chain_text(), "w b X Y Z C A t");
/// ```
pub fn machine(path: &Path) -> (Option<Machine>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = text(path, "a machine file (TOML)", &mut problems) else {
        return (None, problems);
    };
    let folder = Folder { path: path.parent().unwrap_or(Path::new("")).to_owned() };
    Machine::check(&path.display().to_string(), &text, &folder)
}

/// Reads a text file; if it cannot be read, says why.
pub fn text(path: &Path, what: &str, problems: &mut Diagnostics) -> Option<String> {
    match read_text(path) {
        Ok(text) => Some(text),
        Err(error) => {
            let place = Place::whole(&path.display().to_string());
            let message = format!("cannot be read: {error}");
            problems.error("unreadable-file", place, message, &format!("{what} is due here"));
            None
        }
    }
}

fn read_text(path: &Path) -> io::Result<String> {
    let length = fs::metadata(path)?.len();
    if length > MAX_BYTES {
        let message = format!("{length} bytes; texts of more than {MAX_BYTES} bytes are not read");
        return Err(io::Error::new(io::ErrorKind::InvalidData, message));
    }
    fs::read_to_string(path)
}

/// Writes a file whole or not at all: into a temporary file beside it, then renamed.
///
/// # Errors
/// Whatever the disk says; an older file of that name is then still there.
pub fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    let name = path
        .file_name()
        .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"))?;
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(hidden);
    let written = fs::File::create(&part).and_then(|mut file| {
        file.write_all(content)?;
        file.sync_all()
    });
    let renamed = written.and_then(|()| fs::rename(&part, path));
    if renamed.is_err() {
        // The first error is the one to tell; a left-over part file may already be gone.
        let _ = fs::remove_file(&part);
    }
    renamed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_behind_when_writing_fails() {
        let folder = std::env::temp_dir().join(format!("trueaxis-files-{}", std::process::id()));
        fs::create_dir_all(folder.join("taken")).unwrap();
        assert!(write(&folder.join("taken"), b"x").is_err()); // a folder stands there
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        write(&folder.join("report.html"), b"<p>").unwrap();
        assert_eq!(fs::read(folder.join("report.html")).unwrap(), b"<p>");
        fs::remove_dir_all(folder).unwrap();
    }
}
