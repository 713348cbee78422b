//! Files in, files out: the only place of the loop that touches the disk.

#[cfg(unix)]
mod draft;
#[cfg(unix)]
mod mapped;
pub mod output;
mod scope;
mod written;

pub use scope::{noted_within, within};

use scope::{readable, writable};
use std::fs;
use std::io::{self, BufWriter, Read, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use trueaxis_input::{Content, Diagnostics, Draft, Files, Source};
use trueaxis_machine::Machine;

/// No file that people write or export is longer, but for programs; a larger one is refused before it fills the memory.
const MAX_BYTES: u64 = 256 << 20;

/// No program is longer: 10⁷ blocks of five axes.
const MAX_PROGRAM_BYTES: u64 = 1 << 30;

/// Longer programs are not held in the memory.
#[cfg(unix)]
const MAX_HELD_BYTES: u64 = 32 << 20;

/// The disk, within the scope that holds ([`within`]).
#[derive(Debug, Clone, Copy)]
struct Disk;

impl Source for Disk {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        read_bytes(path)
    }

    fn read_long(&self, path: &Path) -> io::Result<Content> {
        read_long(path)
    }

    fn is_file(&self, path: &Path) -> bool {
        is_file(path)
    }

    fn draft(&self, bytes: usize) -> Box<dyn Draft> {
        #[cfg(unix)]
        if bytes as u64 > MAX_HELD_BYTES
            && let Ok(draft) = draft::LongDraft::new()
        {
            return Box::new(draft);
        }
        Box::new(Vec::with_capacity(bytes))
    }
}

/// The files of this computer.
pub fn disk() -> Files {
    Files::new(Disk)
}

/// The files of this computer, and a list of those that are read.
pub fn noted_disk() -> (Files, FilesRead) {
    let read = FilesRead::default();
    (Files::new(NotedDisk(read.clone())), read)
}

/// The files that a command has read.
#[derive(Debug, Clone, Default)]
pub struct FilesRead(Arc<Mutex<Vec<PathBuf>>>);

impl FilesRead {
    /// Counts a file as read, as one that is in memory since.
    pub fn note(&self, path: &Path) {
        if let Ok(mut read) = self.0.lock() {
            read.push(path.to_owned());
        }
    }

    /// Whether this file is one of them, under any name.
    pub fn contains(&self, path: &Path) -> bool {
        self.0.lock().is_ok_and(|read| read.iter().any(|other| output::same_file(path, other)))
    }
}

/// The disk, with a list of what is read.
struct NotedDisk(FilesRead);

impl Source for NotedDisk {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.0.note(path);
        Disk.read(path)
    }

    fn read_long(&self, path: &Path) -> io::Result<Content> {
        self.0.note(path);
        Disk.read_long(path)
    }

    fn is_file(&self, path: &Path) -> bool {
        Disk.is_file(path)
    }

    fn draft(&self, bytes: usize) -> Box<dyn Draft> {
        Disk.draft(bytes)
    }
}

/// Reads and checks a machine file with the tables that it names.
///
/// ```no_run
/// let (machine, problems) = trueaxis_files::machine("machines/xkas2525/machine.toml".as_ref());
/// assert_eq!(machine.unwrap().chain_text(), "w b X Y Z C A t");
/// ```
pub fn machine(path: &Path) -> (Option<Machine>, Diagnostics) {
    Machine::read(&disk(), path)
}

/// Reads a file that need not be UTF-8.
///
/// # Errors
/// What the disk says; a file that is too long.
pub fn read_bytes(path: &Path) -> io::Result<Vec<u8>> {
    held(&fs::File::open(readable(path)?)?, MAX_BYTES)
}

/// The bytes of a file up to a limit.
fn held(file: &fs::File, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // One byte more than allowed: a device or a pipe does not say its length.
    file.take(most + 1).read_to_end(&mut bytes)?;
    within_limit(bytes.len() as u64, most).map(|()| bytes)
}

fn within_limit(length: u64, most: u64) -> io::Result<()> {
    if length <= most {
        return Ok(());
    }
    let message = format!("files of more than {most} bytes are not read");
    Err(io::Error::new(io::ErrorKind::InvalidData, message))
}

/// Reads an NC program: an ordinary file that is long stays on the disk.
fn read_long(path: &Path) -> io::Result<Content> {
    let file = fs::File::open(readable(path)?)?;
    let found = file.metadata()?;
    if !found.is_file() {
        return held(&file, MAX_BYTES).map(Content::from);
    }
    within_limit(found.len(), MAX_PROGRAM_BYTES)?;
    #[cfg(unix)]
    if found.len() > MAX_HELD_BYTES {
        // One byte more: a file that grows meanwhile is not cut.
        if let Ok(copy) = mapped::Mapped::copy_of(&file, MAX_PROGRAM_BYTES + 1) {
            let copy = Content::kept(copy);
            return within_limit(copy.len() as u64, MAX_PROGRAM_BYTES).map(|()| copy);
        }
        // Where there is no room for a copy the text is held.
        io::Seek::rewind(&mut &file)?;
    }
    held(&file, MAX_PROGRAM_BYTES).map(Content::from)
}

/// Whether an ordinary file stands there that may be read.
pub fn is_file(path: &Path) -> bool {
    readable(path).is_ok_and(|path| path.is_file())
}

/// The files with these endings in a folder, by name; anything else as it is named.
pub fn in_folder(path: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let Ok(entries) = readable(path).and_then(fs::read_dir) else {
        return vec![path.to_owned()];
    };
    let is_one = |p: &PathBuf| p.extension().is_some_and(|e| endings.iter().any(|x| e == *x));
    let mut found: Vec<PathBuf> = entries.flatten().map(|e| e.path()).filter(is_one).collect();
    found.sort();
    found
}

/// A file as a text in this folder names it: the way from there where both have a folder in common, else the whole path.
pub fn file_from(folder: &Path, file: &Path) -> String {
    let plain = |path: &Path| {
        let mut plain: Vec<Component<'_>> = Vec::new();
        let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        for part in whole.components() {
            match part {
                Component::ParentDir => drop(plain.pop()),
                Component::CurDir => {}
                part => plain.push(part),
            }
        }
        plain.iter().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect::<Vec<_>>()
    };
    let (from, to) = (plain(folder), plain(file));
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    // The root alone is nothing in common: a link on the way up could lead elsewhere.
    if common < 2 {
        return std::path::absolute(file).unwrap_or_else(|_| file.to_owned()).display().to_string();
    }
    let up = from[common..].iter().map(|_| "..".to_owned());
    up.chain(to[common..].iter().cloned()).collect::<Vec<_>>().join("/")
}

/// Writes a file whole or not at all: into a temporary file in the same folder, then renamed.
///
/// # Errors
/// Whatever the disk says; an older file of that name is then still there. What is no ordinary
/// file (a folder, a device) is not replaced.
pub fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    let part = Part::beside(path)?;
    let mut file = part.file();
    file.write_all(content)?;
    part.put_in_place()
}

/// The same for a file whose folder may be missing: it is made.
///
/// # Errors
/// Whatever the disk says.
pub fn write_with_folder(path: &Path, content: &[u8]) -> io::Result<()> {
    scope::make_folder_of(path)?;
    write(path, content)
}

/// Writes files into a folder that is new or empty: all of them or none. A folder of another name next to
/// it is filled, then renamed.
///
/// # Errors
/// Whatever the disk says; what stands in a folder that is not empty stays as it is.
pub fn write_folder(place: &Path, files: &[(String, String)]) -> io::Result<()> {
    let place = &*writable(place)?;
    let Some(name) = place.file_name() else {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the path does not name a folder"));
    };
    let hidden = format!("{PART_BEGINS}{}-{}{PART_ENDS}", std::process::id(), name.display());
    let part = place.with_file_name(hidden);
    remove_dead_parts(place);
    fs::create_dir(&part)?;
    // Held while the folder is filled, where folders can be locked; a folder without it is of a run that was killed.
    let lock = fs::File::open(&part).and_then(|folder| folder.lock().map(|()| folder)).ok();
    let fill = || {
        for (name, text) in files {
            let mut file = fs::File::create_new(part.join(name))?;
            file.write_all(text.as_bytes())?;
            file.sync_all()?;
        }
        // Nothing but an empty folder is replaced.
        fs::rename(&part, place)
    };
    fill().inspect_err(|_| {
        let _ = fs::remove_dir_all(&part);
    })?;
    drop(lock);
    files.iter().for_each(|(name, _)| written::note(&place.join(name)));
    Ok(())
}

/// Writes a file as [`write()`] does, and notes that this program wrote it; its folder is made where there is
/// none.
///
/// # Errors
/// What the disk says.
pub fn write_in_folder(path: &Path, content: &[u8]) -> io::Result<()> {
    written::write_and_note(path, content, || write_with_folder(path, content))
}

/// How the names of files and folders begin and end that are being written.
const PART_BEGINS: &str = ".trueaxis-";
const PART_ENDS: &str = ".part";

/// Removes what runs left that were killed while they wrote beside this place: parts that no run holds.
fn remove_dead_parts(place: &Path) {
    let folder = place.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let (name, path) = (entry.file_name(), entry.path());
        let name = name.to_string_lossy();
        let is_part = name.starts_with(PART_BEGINS) && name.ends_with(PART_ENDS);
        // A pipe or a link is not ours, and is not opened.
        let Ok(kind) = entry.file_type() else { continue };
        if !is_part || !(kind.is_file() || kind.is_dir()) {
            continue;
        }
        let held = fs::File::open(&path).and_then(|part| Ok(part.try_lock()?).map(|()| part));
        let _ = match held {
            Ok(_) if kind.is_dir() => fs::remove_dir_all(&path),
            Ok(_) => fs::remove_file(&path),
            Err(error) => Err(error),
        };
    }
}

/// Writes into a [`Part`], many bytes at a time.
pub type PartWriter<'f> = BufWriter<&'f fs::File>;

/// A file that is being written beside its place; unless it is put there, it vanishes.
#[derive(Debug)]
pub struct Part {
    place: PathBuf,
    part: PathBuf,
    file: fs::File,
}

impl Part {
    /// Opens a temporary file beside a place.
    ///
    /// # Errors
    /// As [`write()`].
    pub fn beside(place: &Path) -> io::Result<Self> {
        let refuse = |message| Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        let place = &*writable(place)?;
        let Some(name) = place.file_name() else {
            return refuse("the path does not name a file");
        };
        if fs::metadata(place).is_ok_and(|found| !found.is_file()) {
            return refuse("what stands there is not an ordinary file");
        }
        // Two threads may write the same file: each has a part of its own, the last one in place stays.
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let (process, count) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let hidden = format!("{PART_BEGINS}{process}-{count}-{}{PART_ENDS}", name.display());
        let part = place.with_file_name(hidden);
        remove_dead_parts(place);
        let file = loop {
            // A file that another process left under that name, a link perhaps, is not followed.
            let _ = fs::remove_file(&part);
            let file = fs::File::create_new(&part)?;
            // Held while it is written; not all disks have locks.
            let _ = file.lock();
            // A run that removes dead parts may have come between the two lines above.
            if part.exists() {
                break file;
            }
        };
        if let Ok(mut parts) = PARTS.lock() {
            parts.push(part.clone());
        }
        Ok(Self { place: place.to_owned(), part, file })
    }

    /// Where to write.
    pub fn file(&self) -> &fs::File {
        &self.file
    }

    /// The same for many small pieces.
    pub fn writer(&self) -> PartWriter<'_> {
        BufWriter::with_capacity(1 << 16, &self.file)
    }

    /// Puts the file in its place; an older one there is gone.
    ///
    /// # Errors
    /// Whatever the disk says.
    pub fn put_in_place(self) -> io::Result<()> {
        self.file.sync_all()?;
        fs::rename(&self.part, &self.place)
    }

    /// The same, and notes that this program wrote it.
    ///
    /// # Errors
    /// Whatever the disk says.
    pub fn put_and_note(self) -> io::Result<()> {
        let place = self.place.clone();
        self.put_in_place()?;
        written::note(&place);
        Ok(())
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        // In its place it has another name; otherwise nothing half-written shall stay.
        let _ = fs::remove_file(&self.part);
        if let Ok(mut parts) = PARTS.lock() {
            parts.retain(|part| *part != self.part);
        }
    }
}

/// The parts that are being written.
static PARTS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Removes files that are half written; for a program that is interrupted.
pub fn remove_parts() {
    if let Ok(parts) = PARTS.lock() {
        for part in parts.iter() {
            let _ = fs::remove_file(part);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(files: [(&str, &str); 2]) -> [(String, String); 2] {
        files.map(|(name, text)| (name.to_owned(), text.to_owned()))
    }

    #[test]
    fn a_file_is_named_from_a_folder() {
        let named = |folder: &str, file: &str| file_from(folder.as_ref(), file.as_ref());
        assert_eq!(named("a/b", "a/machine.toml"), "../machine.toml");
        assert_eq!(named("a/./b/", "a/c/../d/e.csv"), "../d/e.csv");
        assert_eq!(named("/shop/plans/1", "/shop/machines/m.toml"), "../../machines/m.toml");
        assert_eq!(named("/tmp/plans", "/shop/m.toml"), "/shop/m.toml");
    }

    #[test]
    fn a_folder_is_written_whole_and_over_nothing() {
        let folder = std::env::temp_dir().join(format!("trueaxis-folder-{}", std::process::id()));
        fs::create_dir_all(folder.join("empty")).unwrap();
        for name in ["new", "empty"] {
            write_folder(&folder.join(name), &written([("a", "1"), ("b", "2")])).unwrap();
            assert_eq!(fs::read(folder.join(name).join("b")).unwrap(), b"2");
        }
        assert!(write_folder(&folder.join("new"), &written([("c", "3"), ("d", "4")])).is_err());
        assert!(write_folder(&folder.join("half"), &written([("a", "1"), ("no/b", "2")])).is_err());
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
        fs::remove_dir_all(folder).unwrap();
    }

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
