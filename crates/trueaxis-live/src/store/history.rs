//! `history.csv`: lines over days in constant space. A full file becomes `history-before.csv`, and so does one with other
//! columns. Written beside the loop, which must not wait for a disk.

use super::lines::Lines;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::Receiver;

const NOW: &str = "history.csv";
const BEFORE: &str = "history-before.csv";
/// Lines of one file: a day of one each ten seconds.
const MOST_LINES: usize = 8640;
/// Lines that wait while the disk is busy; further ones are lost.
const MOST_WAITING: usize = 16;

/// The file of a run.
pub(super) fn history_file(folder: PathBuf, heading: String) -> Lines {
    Lines::by(move |waiting| write_all(&folder, &heading, waiting), MOST_WAITING)
}

fn write_all(folder: &Path, heading: &str, waiting: &Receiver<String>) -> io::Result<()> {
    let (mut file, mut count) = open(folder, heading)?;
    for line in waiting {
        if count >= MOST_LINES {
            (file, count) = renew(folder, heading)?;
        }
        file.write_all(format!("{line}\n").as_bytes())?;
        count += 1;
    }
    Ok(())
}

/// The file with these columns, and how many lines it has.
fn open(folder: &Path, heading: &str) -> io::Result<(File, usize)> {
    let text = fs::read_to_string(folder.join(NOW)).unwrap_or_default();
    if text.lines().next() != Some(heading) {
        return renew(folder, heading);
    }
    let mut file = OpenOptions::new().append(true).open(folder.join(NOW))?;
    if !text.ends_with('\n') {
        // A run that was killed leaves a line that is cut.
        file.write_all(b"\n")?;
    }
    Ok((file, text.lines().count() - 1))
}

fn renew(folder: &Path, heading: &str) -> io::Result<(File, usize)> {
    match fs::rename(folder.join(NOW), folder.join(BEFORE)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let mut file = File::create(folder.join(NOW))?;
    file.write_all(format!("{heading}\n").as_bytes())?;
    Ok((file, 0))
}

/// The lines with these columns, the oldest first.
pub fn history_lines(folder: &Path, heading: &str) -> Vec<String> {
    let texts = [BEFORE, NOW].map(|name| fs::read_to_string(folder.join(name)));
    let mut lines = Vec::new();
    for text in texts.into_iter().flatten() {
        let mut all = text.lines();
        if all.next() == Some(heading) {
            lines.extend(all.map(str::to_owned));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("trueaxis-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder");
        folder
    }

    fn add(folder: &Path, heading: &str, lines: std::ops::Range<usize>) {
        let history = history_file(folder.to_owned(), heading.to_owned());
        for i in lines {
            while !history.add(i.to_string()) {
                std::thread::yield_now();
            }
        }
    }

    #[test]
    fn it_goes_on_after_a_restart_and_stays_small() {
        let folder = folder("history");
        add(&folder, "n", 0..10);
        add(&folder, "n", 10..3 * MOST_LINES);
        let lines = history_lines(&folder, "n");
        assert_eq!(
            lines.last().map(String::as_str),
            Some((3 * MOST_LINES - 1).to_string().as_str())
        );
        assert_eq!(lines.len(), 2 * MOST_LINES);
        let first: usize = lines[0].parse().expect("a number");
        assert!(lines.iter().enumerate().all(|(i, line)| *line == (first + i).to_string()));
        // Other columns: what there was stays, and is not shown.
        add(&folder, "other", 0..3);
        assert_eq!(history_lines(&folder, "other").len(), 3);
        assert_eq!(history_lines(&folder, "n").len(), MOST_LINES);
        fs::remove_dir_all(&folder).expect("removed");
    }

    #[test]
    fn a_line_that_was_cut_is_ended() {
        let folder = folder("history-cut");
        fs::write(folder.join(NOW), "n\n1\n2,3").expect("written");
        add(&folder, "n", 4..5);
        assert_eq!(history_lines(&folder, "n"), ["1", "2,3", "4"]);
        fs::remove_dir_all(&folder).expect("removed");
    }
}
