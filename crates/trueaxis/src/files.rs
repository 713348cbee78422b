//! Files in, files out: the only place of the loop that touches the disk.

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use trueaxis_geometry::input::{Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::file::Tables;

/// No file that people write or export is longer; a larger one is refused before it fills the memory.
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

/// Reads a binary file; if it cannot be read, says why.
pub fn bytes(path: &Path, what: &str, problems: &mut Diagnostics) -> Option<Vec<u8>> {
    let read = read_bytes(path).map_err(|error| {
        let place = Place::whole(&path.display().to_string());
        let message = format!("cannot be read: {error}");
        problems.error("unreadable-file", place, message, &format!("{what} is due here"));
    });
    read.ok()
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

fn read_bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // One byte more than allowed: a device or a pipe does not say its length.
    fs::File::open(path)?.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES {
        let message = format!("files of more than {MAX_BYTES} bytes are not read");
        return Err(io::Error::new(io::ErrorKind::InvalidData, message));
    }
    Ok(bytes)
}

fn read_text(path: &Path) -> io::Result<String> {
    let refuse = |message| Err(io::Error::new(io::ErrorKind::InvalidData, message));
    let bytes = read_bytes(path)?;
    String::from_utf8(bytes).or_else(|error| {
        let sound = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = sound.iter().filter(|b| **b == b'\n').count() + 1;
        refuse(format!("line {line} is not UTF-8 text; save the file as UTF-8"))
    })
}

/// Writes a file whole or not at all: into a temporary file beside it, then renamed.
///
/// # Errors
/// Whatever the disk says; an older file of that name is then still there. What is no ordinary
/// file (a folder, a device) is not replaced.
pub fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    let refuse = |message| Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    if path.file_name().is_none() {
        return refuse("the path names no file");
    }
    if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
        return refuse("what stands there is no ordinary file");
    }
    let part = path.with_file_name(format!(".trueaxis-{}.part", std::process::id()));
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
