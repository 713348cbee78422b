//! Any text as the conditions of a test and as its readings; the first byte chooses the standard: never a panic; figures
//! or an error.
//!
//! `scripts/fuzz conditions_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::Evaluate;

const FILES: [&str; 2] = ["conditions.toml", "readings.csv"];

fuzz_target!(|data: &[u8]| {
    let (first, rest) = data.split_first().unwrap_or((&0, &[]));
    let question =
        Evaluate { conditions: Some(FILES[0].into()), ..asking::evaluation(*first, FILES[1]) };
    asking::ask_with(&question, &FILES, rest);
});
