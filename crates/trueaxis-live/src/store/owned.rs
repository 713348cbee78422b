//! `owned`: what this program has written into the control, kept before it is written.
//!
//! Two lines of fixed length are written in turn, each with a number and a checksum: a run that is killed while it writes one
//! leaves the other. Each is on the disk before its offset is sent: a power cut leaves what the control may hold.

use super::Owner;
use crate::governor::{Earlier, Owned};
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

pub(super) const OWNED: &str = "owned";
/// Of one line.
const LINE: usize = 2048;

/// One line.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    number: u64,
    owner: Owner,
    owned: Owned,
}

/// The file of a run.
#[derive(Debug)]
pub(super) struct OwnedFile {
    file: File,
    number: u64,
    /// It has bytes, and no line of it is whole.
    is_damaged: bool,
}

impl OwnedFile {
    /// Of an open file; with what an earlier run has left, and whose it is.
    pub fn open(mut file: File) -> io::Result<(Self, Option<(Owner, Owned)>)> {
        let (last, is_damaged) = last(&mut file)?;
        let number = last.as_ref().map_or(0, |line| line.number);
        let left = last.map(|line| (line.owner, line.owned));
        Ok((Self { file, number, is_damaged }, left))
    }

    /// What it said cannot be read any more.
    pub fn is_damaged(&self) -> bool {
        self.is_damaged
    }

    /// What will be in the control after the next write.
    pub fn add(&mut self, owner: &Owner, owned: &Owned) -> Result<(), String> {
        self.number += 1;
        let line = Line { number: self.number, owner: owner.clone(), owned: owned.clone() };
        let text = serde_json::to_string(&line).map_err(|e| e.to_string())?;
        let mut bytes = format!("{:08x} {text}", checksum(text.as_bytes())).into_bytes();
        if bytes.len() >= LINE {
            return Err("too many axes for the journal".to_owned());
        }
        bytes.resize(LINE - 1, b' ');
        bytes.push(b'\n');
        let place = (self.number % 2) * LINE as u64;
        let placed = self.file.seek(SeekFrom::Start(place));
        let written = placed.and_then(|_| self.file.write_all(&bytes));
        written.and_then(|()| self.file.sync_data()).map_err(|e| e.to_string())
    }
}

/// The last line that is whole, and whether there are bytes without any.
fn last(file: &mut File) -> io::Result<(Option<Line>, bool)> {
    let mut text = Vec::new();
    file.seek(SeekFrom::Start(0))?;
    file.take(2 * LINE as u64).read_to_end(&mut text)?;
    let whole = |bytes: &[u8]| -> Option<Line> {
        let text = std::str::from_utf8(bytes).ok()?;
        let (sum, rest) = text.trim_end().split_once(' ')?;
        let sound = u32::from_str_radix(sum, 16).is_ok_and(|sum| sum == checksum(rest.as_bytes()));
        serde_json::from_str(rest).ok().filter(|_| sound)
    };
    let last = text.chunks(LINE).filter_map(whole).max_by_key(|line| line.number);
    let is_damaged = last.is_none() && !text.is_empty();
    Ok((last, is_damaged))
}

/// What runs of another plan have left in the same control: of the last one that has left something. Its offset is taken
/// over where its axes are the same; else no one knows which part is whose.
pub(super) fn left_elsewhere(root: &Path, own: &Path, owner: &Owner) -> Earlier {
    let Ok(folders) = fs::read_dir(root) else { return Earlier::Nothing };
    let of = |folder: fs::DirEntry| {
        let folder = folder.path();
        let is_own = fs::canonicalize(&folder).ok() == fs::canonicalize(own).ok();
        let mut file = File::open(folder.join(OWNED)).ok().filter(|_| !is_own)?;
        let when = file.metadata().and_then(|known| known.modified()).ok()?;
        let line = last(&mut file).ok()?.0?;
        let is_same = line.owner.machine == owner.machine && line.owner.control == owner.control;
        (is_same && !line.owned.is_nothing()).then_some((when, line))
    };
    match folders.filter_map(|folder| of(folder.ok()?)).max_by_key(|(when, _)| *when) {
        None => Earlier::Nothing,
        Some((_, line)) if line.owner.axes == owner.axes => Earlier::Owned(line.owned),
        Some(_) => Earlier::Lost,
    }
}

/// FNV-1a with 32 bits.
pub(super) fn checksum(bytes: &[u8]) -> u32 {
    bytes
        .iter()
        .fold(0x811c_9dc5u32, |sum, byte| (sum ^ u32::from(*byte)).wrapping_mul(0x0100_0193))
}
