//! Any bytes as a cutter-location file, and what is read as a program: nothing panics, hangs or goes
//! out of hand.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis_cl::{ClFile, Reading};

fuzz_target!(|bytes: &[u8]| {
    let (file, _) = ClFile::read("fuzz.cls", bytes.to_vec(), &Reading::default());
    let mut end = 0;
    for record in file.records() {
        assert!(record.span.start >= end && record.span.end <= bytes.len());
        end = record.span.end;
    }
    assert!(file.points().all(|(_, p)| p.tip_mm.iter().chain(&p.axis).all(|v| v.is_finite())));
});
