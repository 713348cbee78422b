//! Any text as calibrations of one machine, a machine file and two documents of `evaluate`: never a panic; a history or an
//! error.
//!
//! `scripts/fuzz history_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::VerifyHistory;

const FILES: [&str; 3] = ["fuzzed-2024.toml", "fuzzed-2025.json", "fuzzed-2026.json"];

fuzz_target!(|data: &[u8]| {
    let question = VerifyHistory {
        files: FILES.map(Into::into).to_vec(),
        limits: vec!["EC0X=40 urad".to_owned()],
    };
    asking::ask_with(&question, &FILES, data);
});
