//! `verify --diff` says what speaks against two files being calibrations of one machine in their order.

use std::path::PathBuf;
use trueaxis::input::{Diagnostics, Files};
use trueaxis::questions::{CompareCalibrations, ask};

fn file(name: &str, date: &str, active: &str) -> String {
    format!(
        "[machine]\nname = \"{name}\"\nchain = \"w b X Y Z t\"\n[location]\n\
         measured = {{ date = {date} }}\nEC0Y = \"50 ± 2 urad\"\n[compensation]\nactive = [{active}]\n"
    )
}

/// The codes of what is said.
fn said(old: String, new: String) -> Vec<&'static str> {
    let [older, newer] = ["old.toml", "new.toml"].map(PathBuf::from);
    let files = Files::none().with_texts([(older.clone(), old), (newer.clone(), new)]);
    let question = CompareCalibrations { old: older, new: newer };
    let mut problems = Diagnostics::new();
    let answer = ask(&question, &files, &|_| {}, &mut problems);
    assert!(answer.is_some(), "{problems:?}");
    problems.iter().map(|d| d.code).collect()
}

#[test]
fn another_name_another_order_and_another_state_are_named() {
    let old = || file("A", "2024-03-10", "\"EC0Y\"");
    assert_eq!(said(old(), file("A", "2025-03-10", "\"EC0Y\"")), [""; 0]);
    assert_eq!(said(old(), old()), [""; 0], "a file and itself");
    assert_eq!(said(old(), file("B", "2025-03-10", "\"EC0Y\"")), ["other-machine"]);
    assert_eq!(said(old(), file("A", "2023-03-10", "\"EC0Y\"")), ["date-order"]);
    assert_eq!(said(old(), file("A", "2025-03-10", "")), ["already-active"]);
    assert_eq!(
        said(file("A", "2024-03-10", ""), file("A", "2025-03-10", "\"EC0Y\"")),
        ["already-active"]
    );
}
