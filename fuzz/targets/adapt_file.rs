//! Any text as a study of an adaptation, as its path and as the measured blank: never a panic; a study or an error.
//!
//! `scripts/fuzz adapt_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::Adapt;

const FILES: [&str; 3] = [
    "examples/06_compensate/bangle-adapt.toml",
    "examples/06_compensate/bangle-adapt.cls",
    "examples/06_compensate/bangle-measured.csv",
];

fuzz_target!(|data: &[u8]| {
    let question = Adapt {
        study: FILES[0].into(),
        output: None,
        tcp: true,
        tolerance: "0.001".to_owned(),
        cl: None,
    };
    asking::read_with(&question, &FILES, data);
});
