//! `trueaxis verify --before-after`: a laser before and after compensation, as a user runs it.

mod command;

use command::{Folder, trueaxis};
use serde_json::Value;

const X: &str = "examples/07_verify/laser-before-after-x.toml";

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// What is written is what `evaluate iso230-2` reads: both evaluate the same readings.
#[test]
fn the_tables_that_are_written_are_evaluated_alike() {
    let folder = Folder::new("before-after");
    let out = folder.path("lasers");
    let ran = trueaxis(&["verify", "--before-after", X, "-o", &out, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let document = ran.json();
    assert_eq!(document["schema"], "trueaxis/before-after/1");
    assert_eq!(document["lasers"][0]["material"], Value::Null);
    // 13.2 · 10.5 µm/m
    let share = number(&document["lasers"][1]["material"]["share_um_per_m"]);
    assert!((share - 138.6).abs() < 1e-9, "{share}");
    let curves = document["curves"].as_array().expect("a list");
    assert_eq!(curves.len(), 6);
    assert!(document["diagnostics"].as_array().expect("a list").is_empty());
    for (laser, path) in [("laser", "01-X"), ("laser-workpiece", "02-X-workpiece")] {
        for state in ["none", "machine", "comprehensive"] {
            let file = format!("{out}/{path}-{state}.csv");
            let evaluated = trueaxis(&["evaluate", "iso230-2", &file, "--format", "json"]);
            assert_eq!(evaluated.status, 0, "{file}: {}", evaluated.err);
            let figures = evaluated.json();
            let curve = curves.iter().find(|c| c["laser"] == laser && c["compensation"] == state);
            let curve = curve.expect("that curve");
            assert_eq!(curve["targets"].as_array().expect("a list").len(), 11);
            for key in ["A_um", "R_um", "E_um", "M_um", "B_um", "B_mean_um", "E_up_um"] {
                let (ours, theirs) = (number(&curve[key]), number(&figures[key]));
                assert!((ours - theirs).abs() < 1e-9, "{file} {key}: {ours} {theirs}");
            }
        }
    }
    // The same files again, and a folder with something else in it.
    let again = trueaxis(&["verify", "--before-after", X, "-o", &out]);
    assert_eq!(again.status, 0, "{}", again.err);
    std::fs::write(format!("{out}/01-X-none.csv"), "mine\n").expect("written");
    let refused = trueaxis(&["verify", "--before-after", X, "-o", &out]);
    assert_eq!(refused.status, 2, "{}", refused.out);
    assert!(refused.err.contains("01-X-none.csv"), "{}", refused.err);
}

#[test]
fn the_text_names_what_was_read_and_with_what_uncertainty() {
    let folder = Folder::new("before-after-text");
    let page = folder.path("laser.html");
    let ran = trueaxis(&["verify", "--before-after", X, "--report", &page]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    for word in ["reads the machine alone", "138.6 ± 5.0 µm/m", "U of the file", "11 targets"] {
        assert!(ran.out.contains(word), "{word}: {}", ran.out);
    }
    let page = std::fs::read_to_string(page).expect("the page");
    assert!(page.contains("<svg") && page.contains("laser-workpiece, machine − workpiece"));
    let wrong = trueaxis(&["verify", "--before-after", "examples/04_plan/probe-ball.toml"]);
    assert_eq!(wrong.status, 2);
    assert!(wrong.err.contains("no-positioning"), "{}", wrong.err);
}
