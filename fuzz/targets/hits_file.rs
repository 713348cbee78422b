//! Any text as hits on a surface, as its points and as the log: never a panic; deviations or an error.
//!
//! `scripts/fuzz hits_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::IdentifySurface;

const FILES: [&str; 3] = [
    "examples/05_identify/bangle-hits.toml",
    "examples/05_identify/bangle-points.csv",
    "examples/05_identify/bangle-hits.log",
];

fuzz_target!(|data: &[u8]| {
    asking::ask_with(&IdentifySurface { study: FILES[0].into(), output: None }, &FILES, data);
});
