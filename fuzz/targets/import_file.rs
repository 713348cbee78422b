//! Any text as readings in the form of another program; the first byte chooses the standard, the second the form: never a
//! panic; figures or an error.
//!
//! `scripts/fuzz import_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::questions::Evaluate;
use trueaxis::verify::import::Import;

const NAMES: [&str; 3] = ["readings.csv", "readings.rtl", "readings.rta"];

fuzz_target!(|data: &[u8]| {
    let [standard, form, rest @ ..] = data else { return };
    let file = NAMES[usize::from(*form / 4) % NAMES.len()];
    let question = Evaluate {
        import: Some(Import::ALL[usize::from(*form) % Import::ALL.len()]),
        feature: (form & 128 != 0).then(|| "bore".to_owned()),
        ..asking::evaluation(*standard, file)
    };
    asking::ask_with(&question, &[file], rest);
});
