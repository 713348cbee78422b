//! Any text as tolerances of the figures of ISO 230-2: never a panic; each is judged or an error says why not.
//!
//! `scripts/fuzz tolerance_file 600`

#![no_main]

mod asking;

use asking::PARTS;
use libfuzzer_sys::fuzz_target;
use trueaxis::questions::Evaluate;

const FILE: &str = "examples/07_verify/tolerances.toml";

fuzz_target!(|data: &[u8]| {
    let text = String::from_utf8_lossy(data);
    // What is typed stands after the file.
    let typed = text.split(PARTS).skip(1).map(str::to_owned).collect();
    let question = Evaluate {
        tolerances: typed,
        tolerance_file: Some(FILE.into()),
        is_simple: data.len() % 2 == 0,
        ..asking::evaluation(0, "examples/07_verify/x-axis-laser.csv")
    };
    asking::ask_with(&question, &[FILE], data);
});
