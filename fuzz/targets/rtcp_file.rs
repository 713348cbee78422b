//! Any text as a file of an RTCP calibration and as its tables: never a panic; centres or an error.
//!
//! `scripts/fuzz rtcp_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::IdentifyRtcp;

const FILES: [&str; 3] = [
    "examples/05_identify/rtcp-engraver.toml",
    "examples/05_identify/rtcp-engraver-a.csv",
    "examples/05_identify/rtcp-engraver-c-rtcp.csv",
];

fuzz_target!(|data: &[u8]| {
    asking::ask_with(&IdentifyRtcp { study: FILES[0].into(), output: None }, &FILES, data);
});
