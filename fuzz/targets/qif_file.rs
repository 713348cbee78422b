//! Any text as a QIF file of a product: never a panic; a draft whose text is a part file wherever nothing is unknown, or an error.
//!
//! `scripts/fuzz qif_file 600`

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;
use trueaxis_input::{Diagnostics, Files, SourceText};
use trueaxis_part::part::Part;
use trueaxis_part::qif::draft;

fuzz_target!(|data: &[u8]| {
    let text = String::from_utf8_lossy(data);
    let mut problems = Diagnostics::new();
    let Some(draft) = draft("m.qif", &text, &mut problems) else {
        assert!(problems.has_errors());
        return;
    };
    if draft.unknown() > 0 || draft.characteristics() == 0 {
        return;
    }
    let text = draft.text();
    let source = SourceText::from(&Files::none(), "part.toml", &text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    let found = source.finish();
    assert!(part.is_some() && !found.has_errors(), "{text}");
});
