//! Any text as a study of a cone, of holes, or as a file of laser runs, with the shipped machines and
//! tables within reach: never a panic; something is read or an error says why.
//!
//! `scripts/fuzz study_file 120`

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::identify::expansion::{identify_expansion, parse_runs};
use trueaxis::predict::holes::{parse_hole_study, predict_holes};
use trueaxis::predict::parse_study;

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    // Devices and pipes never end or never begin; files of the project do both.
    if ["/dev", "/proc", "/sys", "/run", "std"].iter().any(|word| text.contains(word)) {
        return;
    }
    let (study, problems) = parse_study(&disk(), Path::new("examples/03_predict/study.toml"), text);
    assert!(study.is_some() != problems.has_errors());
    let (runs, problems) = parse_runs(&disk(), Path::new("examples/05_identify/runs.toml"), text);
    assert!(runs.is_some() != problems.has_errors());
    if let Some(runs) = runs {
        let found = identify_expansion(&runs);
        assert!(found.per_k.is_finite() && found.u_per_k.is_finite());
    }
    let (holes, problems) = parse_hole_study(&disk(), Path::new("examples/03_predict/holes.toml"), text);
    assert!(holes.is_some() != problems.has_errors());
    if let Some(holes) = holes.filter(|h| h.holes_mm.len() < 100) {
        // Either a prediction or the holes that cannot be reached.
        if let Ok(prediction) = predict_holes(&holes) {
            assert!(prediction.sets.iter().all(|s| s.worst_mm.is_finite()));
        }
    }
});
