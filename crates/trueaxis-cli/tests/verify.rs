//! `trueaxis verify --diff` as its users call it.

mod command;

use command::{Folder, trueaxis};

const OLD: &str = "machines/xkas2525/machine.toml";
const NEW: &str = "examples/07_verify/xkas2525-after-a-year.toml";

/// oracles/after_a_year.py moved these four, and all others by their uncertainty alone.
#[test]
fn what_really_moved_is_named_and_nothing_else() {
    let folder = Folder::new("verify-diff");
    let page = folder.path("diff.html");
    let ran = trueaxis(&["verify", "--diff", OLD, NEW, "--report", &page, "--format", "json"]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/diff/1");
    assert_eq!(found["moved"], serde_json::json!(["EYX", "EC0Y", "EA0A", "EX0t"]));
    let errors = found["errors"].as_array().expect("errors");
    let sag = errors.iter().find(|e| e["error"] == "EYX").expect("EYX");
    // The sag is greatest in the middle: 9 µm, less 0.21 µm of noise.
    assert_eq!(sag["at"]["position"], 3100.0);
    assert!((sag["change"].as_f64().expect("µm") - 8.79).abs() < 0.01, "{sag}");
    // 13.18 µrad over the 2500 mm of Y are 33 µm; the tip lies off the axis, too.
    let share = &found["tip"]["shares"][0];
    assert_eq!(share["error"], "EC0Y");
    assert!((32.0..40.0).contains(&share["largest_um"].as_f64().expect("µm")), "{share}");
    let page = std::fs::read_to_string(page).expect("the page");
    assert!(page.contains("4 errors have changed") && page.contains("<svg"));
}

#[test]
fn a_machine_has_not_moved_against_itself() {
    let ran = trueaxis(&["verify", "--diff", OLD, OLD]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.out.contains("no error has changed"), "{}", ran.out);
}

#[test]
fn two_machines_are_not_two_calibrations() {
    let other = "machines/three-axis-mill/machine.toml";
    let ran = trueaxis(&["verify", "--diff", OLD, other]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("two machines") && ran.err.contains(other), "{}", ran.err);
    let ran = trueaxis(&["verify", "--diff", OLD]);
    assert_eq!(ran.status, 2);
    let ran = trueaxis(&["verify", "--diff", OLD, "examples/07_verify/nothing.toml"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("nothing.toml"), "{}", ran.err);
    assert_eq!(trueaxis(&["verify"]).status, 2);
}
