//! Any bytes as a mapping of columns and as its table; the first byte chooses the standard: never a panic; figures or an
//! error.
//!
//! `scripts/fuzz mapping_file 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::input::foreign::{LookAs, Mapping, decode, look};
use trueaxis::questions::Evaluate;

const FILES: [&str; 2] = ["readings.map.toml", "readings.csv"];

fuzz_target!(|data: &[u8]| {
    let (first, rest) = data.split_first().unwrap_or((&0, &[]));
    // Tables of other programs are not always UTF-8.
    let text = decode(rest).text;
    let _ = look(&text, &LookAs::default());
    if let (Some(mapping), _) = Mapping::parse(FILES[0], &String::from_utf8_lossy(rest)) {
        let _ = mapping.decode(rest);
        let _ = look(&text, &LookAs { mapping: Some(&mapping), ..LookAs::default() });
    }
    let question = Evaluate {
        map: Some(FILES[0].into()),
        radius: Some("300 mm".to_owned()),
        ..asking::evaluation(*first, FILES[1])
    };
    asking::ask_with(&question, &FILES, rest);
});
