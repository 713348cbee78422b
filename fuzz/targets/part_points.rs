//! Any text as the file of a measured test piece and as its points: never a panic; parts or an error.
//!
//! `scripts/fuzz part_points 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::VerifyPart;

const FILES: [&str; 2] =
    ["examples/07_verify/nas979-points.toml", "examples/07_verify/nas979-points.csv"];

fuzz_target!(|data: &[u8]| {
    asking::read_with(&VerifyPart { file: FILES[0].into() }, &FILES, data);
});
