//! `parts/NAME.csv`: the record of each part; and the file `part` by which a person says which one is being made.

use super::lines::Lines;
use crate::file::Plan;
use crate::part::{headings_of, part_heading};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::Receiver;

const PARTS: &str = "parts";
/// Its text is the name of the part that is made.
const NOW: &str = "part";
/// Lines that wait while the disk is busy.
const MOST_WAITING: usize = 4096;
/// Rows of one record: those of a day of short blocks.
const MOST_LINES: usize = 1_000_000;

/// Why the record of a part cannot be begun.
#[derive(Debug, thiserror::Error)]
pub enum PartFault {
    /// The name.
    #[error(
        "`{0}` is no name of a file: letters, digits, `-`, `_` and `.`, 80 at most, no point first"
    )]
    Name(String),
    /// It has a record.
    #[error("{0} has a record already, and a record is not written over")]
    Known(String),
    /// The disk.
    #[error("it cannot be written: {0}")]
    Disk(#[from] io::Error),
}

fn is_name(name: &str) -> bool {
    let sound = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    (1..=80).contains(&name.len()) && name.chars().all(sound) && !name.starts_with('.')
}

/// Where the record of a part is.
pub fn part_path(folder: &Path, name: &str) -> PathBuf {
    folder.join(PARTS).join(format!("{name}.csv"))
}

/// Begins the record of a part: a run of this folder fills it from now on, until another part is begun or this one ends.
///
/// # Errors
/// [`PartFault`].
pub fn begin_part(folder: &Path, plan: &Plan, name: &str) -> Result<(), PartFault> {
    if !is_name(name) {
        return Err(PartFault::Name(name.to_owned()));
    }
    fs::create_dir_all(folder.join(PARTS))?;
    let new = File::create_new(part_path(folder, name));
    let mut file = new.map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => PartFault::Known(name.to_owned()),
        _ => PartFault::Disk(error),
    })?;
    file.write_all(format!("{}\n", part_heading(plan, name)).as_bytes())?;
    trueaxis::files::write(&folder.join(NOW), name.as_bytes())?;
    Ok(())
}

/// Ends the record of the part that is made; its name, if there was one.
///
/// # Errors
/// What the disk says.
pub fn end_part(folder: &Path) -> io::Result<Option<String>> {
    let name = part_now(folder);
    match fs::remove_file(folder.join(NOW)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(name),
    }
}

/// The part that is made now.
pub fn part_now(folder: &Path) -> Option<String> {
    let name = fs::read_to_string(folder.join(NOW)).ok()?;
    Some(name.trim().to_owned()).filter(|name| is_name(name))
}

/// The parts with a record, by their names.
pub fn parts(folder: &Path) -> Vec<String> {
    let Ok(found) = fs::read_dir(folder.join(PARTS)) else { return Vec::new() };
    let name = |entry: io::Result<fs::DirEntry>| {
        let name = entry.ok()?.file_name().into_string().ok()?;
        Some(name.strip_suffix(".csv")?.to_owned())
    };
    let mut names: Vec<String> = found.filter_map(name).collect();
    names.sort();
    names
}

/// The record that a run fills: it goes on with one that was begun for these columns.
///
/// # Errors
/// Why it cannot be filled.
pub(super) fn part_file(folder: &Path, name: &str, heading: &str) -> Result<Lines, String> {
    let path = part_path(folder, name);
    let text = fs::read_to_string(&path).map_err(|error| error.to_string())?;
    if headings_of(&text) != headings_of(heading) {
        return Err("it was begun for other axes or sensors".to_owned());
    }
    let opened = OpenOptions::new().append(true).open(&path);
    let mut file = opened.map_err(|error| error.to_string())?;
    if !text.ends_with('\n') {
        // A run that was killed leaves a line that is cut.
        file.write_all(b"\n").map_err(|error| error.to_string())?;
    }
    let room = MOST_LINES.saturating_sub(text.lines().count());
    Ok(Lines::by(move |waiting| write_all(file, room, waiting), MOST_WAITING))
}

fn write_all(mut file: File, room: usize, waiting: &Receiver<String>) -> io::Result<()> {
    for line in waiting.iter().take(room) {
        file.write_all(format!("{line}\n").as_bytes())?;
    }
    Ok(())
}
