//! Any bytes as a test piece file: never a panic.
//!
//! `scripts/fuzz test_piece_file 600`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis_input::SourceText;
use trueaxis_part::TestPieceFile;

fuzz_target!(|data: &[u8]| {
    let text = String::from_utf8_lossy(data);
    let source = SourceText::new("piece.toml", &text);
    let piece = source.read(TestPieceFile::read);
    assert!(piece.is_some() || source.finish().has_errors());
});
