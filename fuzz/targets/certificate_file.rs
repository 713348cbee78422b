//! Any text as a study of a certificate and as its readings: never a panic; a study or an error.
//!
//! `scripts/fuzz certificate_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::Certify;

const FILES: [&str; 3] = [
    "examples/07_verify/certificate.toml",
    "examples/07_verify/certificate-before.csv",
    "examples/07_verify/certificate-after.csv",
];

fuzz_target!(|data: &[u8]| {
    asking::read_with(&Certify { study: FILES[0].into() }, &FILES, data);
});
