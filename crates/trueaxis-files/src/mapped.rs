//! Long files in pages that the system reads when they are asked for: of a private copy, so that no other program changes or cuts it.

#![allow(
    unsafe_code,
    reason = "the bytes of a mapped file are those of the file as long as no one changes it"
)]

use memmap2::{Mmap, UncheckedAdvice};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read};
use std::ops::Range;
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use trueaxis_input::Kept;

/// A file in pages.
pub(crate) struct Mapped(Mmap);

impl Mapped {
    /// A private copy of at most so many bytes.
    ///
    /// # Errors
    /// What the disk says.
    pub fn copy_of(file: &File, most: u64) -> io::Result<Self> {
        let mut copy = without_name()?;
        io::copy(&mut file.take(most), &mut copy)?;
        Self::of(&copy)
    }

    /// A file of [`without_name`] that is not written to any more.
    ///
    /// # Errors
    /// What the system says.
    pub fn of(file: &File) -> io::Result<Self> {
        // SAFETY: the file has no name and only this process has opened it; nothing writes to it after this line.
        unsafe { Mmap::map(file) }.map(Self)
    }
}

impl Kept for Mapped {
    fn bytes(&self) -> &[u8] {
        &self.0
    }

    fn pass(&self, range: Range<usize>) {
        let (from, to) = (range.start.min(self.0.len()), range.end.min(self.0.len()));
        if from < to {
            // SAFETY: pages of a file that nothing has written to: read again they are the same.
            // Where the system does not take the advice the pages stay.
            let _ = unsafe {
                self.0.unchecked_advise_range(UncheckedAdvice::DontNeed, from, to - from)
            };
        }
    }
}

/// A file in `/var/tmp`, which is on a disk, or else where temporary files are: it vanishes with the last who has opened it.
pub(crate) fn without_name() -> io::Result<File> {
    let on_disk = without_name_in(Path::new("/var/tmp"));
    on_disk.or_else(|_| without_name_in(&std::env::temp_dir()))
}

fn without_name_in(folder: &Path) -> io::Result<File> {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let mut last = io::Error::from(io::ErrorKind::AlreadyExists);
    // A name that is taken, by a link perhaps, is not opened.
    for _ in 0..100 {
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!(".trueaxis-{}-{count}.copy", std::process::id()));
        let made =
            OpenOptions::new().read(true).write(true).create_new(true).mode(0o600).open(&path);
        match made {
            Ok(file) => return fs::remove_file(&path).map(|()| file),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => last = error,
            Err(error) => return Err(error),
        }
    }
    Err(last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn a_copy_stays_when_its_file_is_cut_and_its_pages_were_passed() {
        let path = std::env::temp_dir().join(format!("trueaxis-mapped-{}", std::process::id()));
        let text: Vec<u8> = (0..1_000_000_u32).flat_map(u32::to_le_bytes).collect();
        File::create(&path).and_then(|mut file| file.write_all(&text)).expect("a file");
        let copy = Mapped::copy_of(&File::open(&path).expect("the file"), u64::MAX);
        let copy = copy.expect("a copy");
        File::create(&path).expect("an empty file");
        fs::remove_file(&path).expect("a file to remove");
        for range in [0..text.len(), 5..9, 4095..8193, 7..usize::MAX, text.len()..text.len() + 1] {
            copy.pass(range);
            assert!(copy.bytes() == text);
        }
        assert!(without_name_in(Path::new("/var/no/such/folder")).is_err());
    }
}
