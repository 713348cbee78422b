//! The mark of this program on the files that it writes: their checksums, in one list in their folder.
//!
//! A mark within a file would change what a control or another program reads, and not every form has comments.
//! The list has the form of `sha256sum`: `sha256sum -c .trueaxis-written` shows what was edited since.

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// The name of the list.
const LIST: &str = ".trueaxis-written";

/// A longer list is not ours.
const MAX_BYTES: u64 = 1 << 24;

/// A checksum of more bytes is computed while they are written.
const LARGE_BYTES: usize = 1 << 20;

/// Whether this program wrote what stands there, and it has not changed since.
pub(crate) fn is_ours(path: &Path) -> bool {
    let Some((list, name)) = place(path).filter(|(list, _)| is_usable(list)) else { return false };
    let Ok(file) = File::open(list) else { return false };
    let Ok(sums) = read(&file) else { return false };
    sums.get(&name).is_some_and(|sum| checksum(path).is_ok_and(|there| there == *sum))
}

/// Notes that this program wrote what stands there. Where that is not possible (the list belongs to another
/// user of the folder, a name does not fit into a line) the file counts as that of a person, and stays.
pub(crate) fn note(path: &Path) {
    let _ = checksum(path).and_then(|sum| note_sum(path, sum));
}

/// Writes a content with `write`, and notes it as [`note()`] does: its checksum is computed meanwhile.
pub(crate) fn write_and_note(
    path: &Path,
    content: &[u8],
    write: impl FnOnce() -> io::Result<()>,
) -> io::Result<()> {
    let (written, sum) = std::thread::scope(|scope| {
        let large = (content.len() > LARGE_BYTES)
            .then(|| std::thread::Builder::new().spawn_scoped(scope, || checksum_of(content)));
        let written = write();
        let sum = large.and_then(Result::ok).and_then(|thread| thread.join().ok());
        (written, sum)
    });
    written?;
    let _ = note_sum(path, sum.unwrap_or_else(|| checksum_of(content)));
    Ok(())
}

fn note_sum(path: &Path, sum: String) -> io::Result<()> {
    let Some((list, name)) = place(path).filter(|(list, _)| is_usable(list)) else { return Ok(()) };
    let mut file =
        OpenOptions::new().read(true).write(true).create(true).truncate(false).open(list)?;
    // Several runs may write into one folder. Where the disk has no locks, the last one wins: files without a
    // line are then taken for those of a person, and stay.
    let _ = file.lock();
    let mut sums = read(&file)?;
    if sums.get(&name) == Some(&sum) {
        return Ok(());
    }
    sums.insert(name, sum);
    let lines: String = sums.iter().map(|(name, sum)| format!("{sum}  {name}\n")).collect();
    file.rewind()?;
    file.set_len(0)?;
    file.write_all(lines.as_bytes())
}

/// The list and the name in it.
fn place(path: &Path) -> Option<(PathBuf, String)> {
    let name = path.file_name()?.to_str()?;
    let fits = !name.contains(['\n', '\r', '\\']) && name != LIST;
    fits.then(|| (path.with_file_name(LIST), name.to_owned()))
}

/// An ordinary file or nothing: a link or a pipe under that name is not ours, and is not opened.
fn is_usable(list: &Path) -> bool {
    list.symlink_metadata().map_or(true, |found| found.is_file())
}

/// Checksums by name; lines of another form are left out.
fn read(file: &File) -> io::Result<BTreeMap<String, String>> {
    let mut text = String::new();
    file.take(MAX_BYTES).read_to_string(&mut text)?;
    let entry = |line: &str| line.split_once("  ").map(|(sum, name)| (name.into(), sum.into()));
    Ok(text.lines().filter_map(entry).collect())
}

fn checksum(path: &Path) -> io::Result<String> {
    let mut file = File::open(path)?;
    let mut sum = Sha256::new();
    let mut piece = vec![0; 1 << 16];
    loop {
        match file.read(&mut piece)? {
            0 => break,
            n => sum.update(&piece[..n]),
        }
    }
    Ok(hexadecimal(sum))
}

fn checksum_of(content: &[u8]) -> String {
    let mut sum = Sha256::new();
    sum.update(content);
    hexadecimal(sum)
}

fn hexadecimal(sum: Sha256) -> String {
    sum.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("trueaxis-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    /// FIPS 180-4, example of one block: SHA-256("abc").
    #[test]
    fn the_list_has_the_checksums_of_the_standard() {
        let folder = folder("sums");
        fs::write(folder.join("a b.txt"), "abc").unwrap();
        note(&folder.join("a b.txt"));
        let sum = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        let list = fs::read_to_string(folder.join(LIST)).unwrap();
        assert_eq!(list, format!("{sum}  a b.txt\n"));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_checksum_taken_while_writing_is_that_of_the_file() {
        let folder = folder("meanwhile");
        for bytes in [0, 10, LARGE_BYTES, LARGE_BYTES + 1, 3 * LARGE_BYTES] {
            let (file, content) = (folder.join(format!("{bytes}")), vec![b'x'; bytes]);
            write_and_note(&file, &content, || fs::write(&file, &content)).unwrap();
            assert!(is_ours(&file), "{bytes}");
        }
        let refused = folder.join("refused");
        let full = || Err(io::Error::from(io::ErrorKind::StorageFull));
        assert!(write_and_note(&refused, &vec![0; 2 * LARGE_BYTES], full).is_err());
        assert!(!fs::read_to_string(folder.join(LIST)).unwrap().contains("refused"));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn an_edit_makes_a_file_that_of_a_person_and_undoing_it_does_not() {
        let folder = folder("edits");
        let file = folder.join("r.csv");
        fs::write(&file, "x\n").unwrap();
        assert!(!is_ours(&file), "without a list");
        note(&file);
        assert!(is_ours(&file));
        fs::write(&file, "x\r\n").unwrap();
        assert!(!is_ours(&file), "another end of line is an edit");
        fs::write(&file, "x\n").unwrap();
        assert!(is_ours(&file));
        fs::rename(&file, folder.join("other.csv")).unwrap();
        assert!(!is_ours(&folder.join("other.csv")), "another name is an act of a person");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn no_line_is_lost_when_many_write_at_once() {
        let folder = folder("many");
        std::thread::scope(|scope| {
            for i in 0..8 {
                let folder = &folder;
                scope.spawn(move || {
                    for k in 0..20 {
                        let file = folder.join(format!("{i}-{k}"));
                        fs::write(&file, format!("{i} {k}")).unwrap();
                        note(&file);
                    }
                });
            }
        });
        assert_eq!(fs::read_to_string(folder.join(LIST)).unwrap().lines().count(), 160);
        assert!((0..8).all(|i| (0..20).all(|k| is_ours(&folder.join(format!("{i}-{k}"))))));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_list_that_is_no_text_makes_nothing_ours() {
        let folder = folder("list");
        let file = folder.join("r.csv");
        fs::write(&file, "x").unwrap();
        fs::write(folder.join(LIST), b"\xff\xfe").unwrap();
        assert!(!is_ours(&file));
        note(&file);
        assert_eq!(fs::read(folder.join(LIST)).unwrap(), b"\xff\xfe");
        fs::remove_dir_all(folder).unwrap();
    }
}
