//! Any text as a study of a thermal model and as its logs: never a panic; what is taken gives finite
//! scores. The first line that is `---` parts the study from the log.
//!
//! `scripts/fuzz thermal_study 120`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis::input::Diagnostics;
use trueaxis::identify::thermal::{Tables, identify_thermal, parse_logs};

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let (study, log) = text.split_once("\n---\n").unwrap_or((text, ""));
    let load = |_: &str, _: &mut Diagnostics| Some(log.to_owned());
    let tables = Tables { load: &load, show: &|name| name.to_owned() };
    let (logs, problems) = parse_logs("study.toml", study, &tables);
    assert!(logs.is_none() || !problems.has_errors());
    if let Some(logs) = logs {
        let model = identify_thermal(&logs);
        assert!(model.scores.iter().all(|s| s.held_out_mm.is_finite()));
    }
});
