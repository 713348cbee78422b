//! Any text as the section `[plausible]` of a file: never a panic; a range that is taken widens what is possible, and the
//! judgement of every value has an end.
//!
//! `scripts/fuzz plausible_section 600`

#![no_main]

mod asking;

use libfuzzer_sys::fuzz_target;
use trueaxis::input::plausible::{Limits, RANGES, Seen};
use trueaxis::input::{Diagnostics, Place, SourceText};

const VALUES: [f64; 9] = [0.0, -0.0, 1.0, -3.0, 1e9, -1e9, 1e308, -1e308, 5e-324];

fuzz_target!(|data: &[u8]| {
    let text = String::from_utf8_lossy(data);
    let source = SourceText::new("machine.toml", &text);
    let limits = source.read(|root| root.section("plausible", Limits::read));
    let problems = source.finish();
    asking::check(&problems);
    let Some(limits) = limits.filter(|_| !problems.has_errors()) else { return };
    for range in &RANGES {
        for value in VALUES {
            let mut problems = Diagnostics::new();
            let seen = Seen::one("value", value);
            let fits = limits.judge(range.quantity, &seen, &Place::whole("x"), &mut problems);
            assert_eq!(fits, !problems.has_errors());
            asking::check(&problems);
        }
    }
});
