//! Long texts that are put together on the disk: a program that is written needs no memory for what is done of it.

use super::mapped::{Mapped, without_name};
use std::fs::File;
use std::io;
use std::ops::Range;
use std::os::unix::fs::FileExt;
use trueaxis_input::{Content, Draft};

/// So many bytes are written at a time.
const PIECE: usize = 1 << 20;

/// A text in a file without a name; in the memory as soon as the disk takes no more.
pub(crate) struct LongDraft {
    file: Option<File>,
    /// So many bytes are in the file; the last ones are not yet.
    written: usize,
    last: Vec<u8>,
    /// The file cannot be read again.
    fault: Option<io::Error>,
}

impl LongDraft {
    /// In `/var/tmp`, or else where temporary files are.
    ///
    /// # Errors
    /// What the disk says.
    pub fn new() -> io::Result<Self> {
        Ok(Self::of(without_name()?))
    }

    fn of(file: File) -> Self {
        Self { file: Some(file), written: 0, last: Vec::new(), fault: None }
    }

    fn write_last(&mut self) {
        let Some(file) = &self.file else { return };
        match file.write_all_at(&self.last, self.written as u64) {
            Ok(()) => {
                self.written += self.last.len();
                self.last.clear();
            }
            Err(_) => self.hold(),
        }
    }

    /// From here on in the memory.
    fn hold(&mut self) {
        match self.bytes_of_file(0..self.written) {
            Ok(mut all) => {
                all.append(&mut self.last);
                (self.last, self.written, self.file) = (all, 0, None);
            }
            Err(fault) => self.fault = Some(fault),
        }
    }

    fn bytes_of_file(&self, range: Range<usize>) -> io::Result<Vec<u8>> {
        let mut bytes = vec![0; range.len()];
        if let Some(file) = &self.file {
            file.read_exact_at(&mut bytes, range.start as u64)?;
        }
        Ok(bytes)
    }
}

impl Draft for LongDraft {
    fn length(&self) -> usize {
        self.written + self.last.len()
    }

    fn put(&mut self, bytes: &[u8]) {
        self.last.extend_from_slice(bytes);
        if self.file.is_some() && self.fault.is_none() && self.last.len() >= PIECE {
            self.write_last();
        }
    }

    fn read(&self, range: Range<usize>) -> Vec<u8> {
        let (from, to) = (range.start.min(self.length()), range.end.min(self.length()));
        let on_disk = from.min(self.written)..to.min(self.written);
        let mut bytes = self.bytes_of_file(on_disk).unwrap_or_default();
        let last = from.saturating_sub(self.written)..to.saturating_sub(self.written);
        bytes.extend_from_slice(self.last.get(last).unwrap_or_default());
        bytes
    }

    fn finish(mut self: Box<Self>) -> io::Result<Content> {
        self.write_last();
        if let Some(Ok(map)) = self.file.as_ref().map(Mapped::of) {
            return Ok(Content::kept(map));
        }
        self.hold();
        match self.fault {
            None => Ok(self.last.into()),
            Some(fault) => Err(fault),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::OpenOptions;

    fn pieces() -> impl Iterator<Item = Vec<u8>> {
        (0..40_u32).map(|i| i.to_le_bytes().repeat(10_000 * (1 + i as usize % 3)))
    }

    fn filled(mut draft: LongDraft) -> Box<LongDraft> {
        let mut all = Vec::new();
        for piece in pieces() {
            draft.put(&piece);
            all.extend_from_slice(&piece);
            assert_eq!(draft.length(), all.len());
            for range in [0..10, all.len() - 7..all.len(), all.len() / 2..all.len() / 2 + 9] {
                assert!(draft.read(range.clone()) == all[range]);
            }
        }
        // Across the border between the file and what is not written yet.
        assert!(draft.read(0..all.len()) == all && draft.read(5..usize::MAX) == all[5..]);
        Box::new(draft)
    }

    #[test]
    fn what_is_put_is_read_again_and_is_the_text_at_the_end() {
        let draft = filled(LongDraft::new().expect("a file"));
        assert!(draft.written > PIECE);
        let text = draft.finish().expect("a text");
        assert!(*text == *pieces().flatten().collect::<Vec<_>>());
        text.pass(0..text.len());
        assert!(text.ends_with(&39_u32.to_le_bytes()));
        let none = Box::new(LongDraft::new().expect("a file")).finish().expect("a text");
        assert!(none.is_empty());
    }

    /// A device that is always full: everything is held.
    #[test]
    fn on_a_full_disk_the_text_is_held_in_the_memory() {
        let full = OpenOptions::new().read(true).write(true).open("/dev/full");
        let Ok(full) = full else { return };
        let draft = filled(LongDraft::of(full));
        assert!(draft.file.is_none());
        assert!(*draft.finish().expect("a text") == *pieces().flatten().collect::<Vec<_>>());
    }

    /// A file that takes bytes and gives none back.
    #[test]
    fn a_disk_that_loses_the_text_is_an_error() {
        let null = OpenOptions::new().write(true).open("/dev/null").expect("a device");
        let mut draft = LongDraft::of(null);
        pieces().for_each(|piece| draft.put(&piece));
        assert!(draft.read(0..10).is_empty());
        assert!(Box::new(draft).finish().is_err());
    }
}
