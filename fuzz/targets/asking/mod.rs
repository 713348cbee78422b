//! A question whose files are parts of the input: an answer or an error, nothing that is no number, no endless message.

// Each target uses a part of this file.
#![allow(dead_code)]

use std::path::{Path, PathBuf};
use trueaxis::files::{disk, within};
use trueaxis::input::{Diagnostics, Files};
use trueaxis::questions::{Answer, Evaluate, Question, ReadingsFile, ask};
use trueaxis::verify::Standard;

/// The parts of an input are parted by such a line.
pub const PARTS: &str = "\n===\n";
/// A message that is longer is of no use.
const LONGEST_MESSAGE: usize = 4000;

/// The parts of the input in place of these files, others as the project has them.
pub fn files(data: &[u8], names: &[&str]) -> Files {
    let text = String::from_utf8_lossy(data).into_owned();
    let parts = names.iter().zip(text.split(PARTS));
    disk().with_texts(parts.map(|(name, part)| (PathBuf::from(name), part.to_owned())))
}

/// Reads and computes.
pub fn ask_with<Q: Question>(question: &Q, names: &[&str], data: &[u8]) {
    let files = files(data, names);
    let mut problems = Diagnostics::new();
    let answer = in_project(|| ask(question, &files, &|_| {}, &mut problems));
    check(&problems);
    let Some(answer) = answer else {
        assert!(problems.has_errors(), "neither an answer nor an error");
        return;
    };
    let text = answer.text();
    assert!(!text.contains("NaN"), "{text}");
}

/// Reads only, where the answer takes seconds.
pub fn read_with<Q: Question>(question: &Q, names: &[&str], data: &[u8]) {
    let files = files(data, names);
    let mut problems = Diagnostics::new();
    let input = in_project(|| question.read(&files, &mut problems));
    check(&problems);
    assert!(input.is_some() || problems.has_errors(), "neither an input nor an error");
}

/// Nothing outside the project is read: devices and pipes never end.
pub fn in_project<T>(work: impl FnOnce() -> T) -> T {
    within(Path::new("."), work)
}

/// Every message has an end.
pub fn check(problems: &Diagnostics) {
    for found in problems.iter() {
        let length = found.to_string().len();
        assert!(length < LONGEST_MESSAGE, "{} has {length} bytes", found.code);
    }
}

/// These readings by that standard, and nothing else asked for.
pub fn evaluation(standard: u8, data: &str) -> Evaluate {
    Evaluate {
        standard: Standard::ALL[usize::from(standard) % Standard::ALL.len()],
        data: ReadingsFile::Path(data.into()),
        import: None,
        feature: None,
        map: None,
        conditions: None,
        radius: None,
        window: None,
        write_back: None,
        machine: None,
        output: None,
        tolerances: Vec::new(),
        tolerance_file: None,
        is_simple: false,
    }
}
