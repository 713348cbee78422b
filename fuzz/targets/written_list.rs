//! Any bytes as the list of the files that this program wrote: never a panic; a file of a person stays unless the list has
//! its checksum, and what was written beside the list is known again or stays too.
//!
//! `scripts/fuzz written_list 600`

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::fs;
use trueaxis::files::output::Guard;
use trueaxis::files::{FilesRead, write_in_folder};
use trueaxis::input::Diagnostics;

/// SHA-256 of "of a person".
const SUM: &str = "4fdfb76e9c80743d9206ca17c283fa5e4e333f2aa81df548b08618663a8f06d6";

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("trueaxis-fuzz-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let (list, person, ours) =
        (folder.join(".trueaxis-written"), folder.join("r.csv"), folder.join("new.csv"));
    fs::write(&list, data).expect("written");
    fs::write(&person, "of a person").expect("written");
    let guard = Guard { read: FilesRead::default(), force: false };
    let may = |path: &std::path::Path| {
        let mut problems = Diagnostics::new();
        guard.may_put(path, Some(b"other"), &mut problems);
        !problems.has_errors()
    };
    assert!(!may(&person) || String::from_utf8_lossy(data).contains(SUM));
    let _ = fs::remove_file(&ours);
    write_in_folder(&ours, b"ours").expect("written");
    let is_text = std::str::from_utf8(data).is_ok();
    assert_eq!(may(&ours), is_text, "a list that is no text makes nothing ours");
    fs::write(&ours, "edited").expect("written");
    assert!(!may(&ours), "an edit of a person stays");
    assert!(is_text || fs::read(&list).expect("the list") == data);
});
