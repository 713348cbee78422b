//! Any text as a part file, and as a table of its points: never a panic; a part or an error, and finite values of the nominal part.
//!
//! `scripts/fuzz part_file 600`

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::{Path, PathBuf};
use trueaxis_input::{Files, SourceText};
use trueaxis_part::part::Part;

/// Parts with more points take too long for many runs.
const MOST_POINTS: usize = 2000;

fuzz_target!(|data: &[u8]| {
    let text = String::from_utf8_lossy(data);
    let (part, points) = text.split_once("===\n").unwrap_or((&text, ""));
    let files = Files::none().with_texts([(PathBuf::from("points.csv"), points.to_owned())]);
    let source = SourceText::from(&files, "part.toml", part);
    let part = source.read(|root| Part::read(root, Path::new("")));
    let problems = source.finish();
    let Some(part) = part else {
        assert!(problems.has_errors());
        return;
    };
    if part.points() <= MOST_POINTS
        && let Ok(values) = part.evaluate(&vec![0.0; part.points()])
    {
        assert!(values.iter().all(|v| v.is_finite()), "{values:?}");
    }
});
