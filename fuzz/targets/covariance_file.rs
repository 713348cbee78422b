//! Any text as a machine file with all errors of an identification and as their covariance: never a panic; a machine or an
//! error, and every U of a pose is a number.
//!
//! `scripts/fuzz covariance_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::{AskPose, MachineChoice, Positions};

const FILES: [&str; 2] = ["predicted.toml", "predicted-covariance.toml"];

fuzz_target!(|data: &[u8]| {
    let machine = MachineChoice { file: FILES[0].into(), ..Default::default() };
    let at = Positions::One("X=300 Y=250 Z=-150 C=45".to_owned());
    asking::ask_with(&AskPose { machine, at, approach: None, bodies: false }, &FILES, data);
});
