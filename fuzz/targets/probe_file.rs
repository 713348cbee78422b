//! Any text as a study of a touch probe, as its hits and as the log of its programs: never a panic; a calibration or an
//! error.
//!
//! `scripts/fuzz probe_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::IdentifyProbe;

const FILES: [&str; 4] = [
    "examples/05_identify/ring-60.toml",
    "examples/05_identify/ring-60.csv",
    "examples/05_identify/ring-60-fresh.csv",
    "examples/05_identify/ring-programs.log",
];

fuzz_target!(|data: &[u8]| {
    asking::ask_with(&IdentifyProbe { study: FILES[0].into(), ..Default::default() }, &FILES, data);
});
