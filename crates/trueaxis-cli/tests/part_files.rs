//! Part files as a user meets them: drafts of QIF files, results as QIF and as a table.

mod command;

use command::{Folder, trueaxis};
use serde_json::Value;
use std::fs;

const HOUSING: &str = "examples/03_predict/housing.toml";
const PLATE: &str = "crates/trueaxis-cli/tests/import/plate.qif";

fn list<'a>(document: &'a Value, key: &str) -> &'a Vec<Value> {
    document[key].as_array().unwrap_or_else(|| panic!("{key}: {document}"))
}

/// A draft without unknown values is a part file with the features and characteristics that it counts.
#[test]
fn a_draft_is_a_part_file() {
    let folder = Folder::new("part-draft");
    let file = folder.path("plate.toml");
    let shown = trueaxis(&["part", PLATE, "--format", "json"]).json();
    let draft = &shown["draft"];
    assert_eq!((&draft["unknown"], list(draft, "left_out").len()), (&Value::from(0), 0));
    let ran = trueaxis(&["part", PLATE, "-o", &file]);
    assert!(ran.status == 0 && ran.out.contains("COMPLETE"), "{}", ran.err);
    assert_eq!(draft["text"], fs::read_to_string(&file).expect("the draft").as_str());
    let part = trueaxis(&["part", &file, "--format", "json"]).json();
    assert_eq!(draft["features"], list(&part, "features").len());
    assert_eq!(draft["characteristics"], list(&part, "characteristics").len());
    assert!(part["draft"].is_null());
}

/// The table and the QIF document have the values of the JSON document; the latter is drafted as the part that it came from.
#[test]
fn results_are_those_of_the_prediction() {
    let folder = Folder::new("part-results");
    let (csv, qif) = (folder.path("r.csv"), folder.path("r.qif"));
    let ask = |results: &str| {
        let words =
            ["predict", HOUSING, "--samples", "0", "--format", "json", "--results", results];
        let ran = trueaxis(&words);
        assert_eq!(ran.status, 1, "{}", ran.err);
        ran.json()
    };
    let document = ask(&csv);
    assert_eq!(ask(&qif), document);
    let asked = list(&document, "characteristics");
    let table = fs::read_to_string(&csv).expect("the table");
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|l| l.split(',').collect()).collect();
    assert_eq!(rows.len(), asked.len());
    let text = fs::read_to_string(&qif).expect("the document");
    for (row, one) in rows.iter().zip(asked) {
        assert_eq!(row[0], one["name"].as_str().expect("a name"));
        for (cell, key) in [(4, "value_mm"), (7, "high_mm"), (8, "used_ratio")] {
            let (cell, due) = (row[cell].parse::<f64>().expect("a number"), one[key].as_f64());
            assert_eq!(Some(cell), due, "{key} of {row:?}");
        }
        // The u of a result is that of the machine and of the points, eq. 323.
        let [u, points] = ["u_mm", "points_mm"].map(|key| one[key].as_f64().expect("a number"));
        let found = row[5].parse::<f64>().expect("a number");
        assert!((found - u.hypot(points / 3f64.sqrt())).abs() < 1e-12, "{row:?}");
        assert_eq!(row[9], one["outcome"].as_str().expect("an outcome"));
    }
    assert_eq!(text.matches("combinedUncertainty=\"").count(), asked.len());
    let draft = trueaxis(&["part", &qif, "--format", "json"]).json();
    assert_eq!(draft["draft"]["characteristics"], asked.len());
}

/// By the compensated program the housing is as good as the increment of the program allows, and what counts from datums is that of the program alone;
/// the verdict and the exit status stay those of the program as it is.
#[test]
fn a_part_by_its_compensated_program() {
    let words = ["predict", HOUSING, "--samples", "0", "--compensated", "--format", "json"];
    let ran = trueaxis(&words);
    assert_eq!(ran.status, 1, "{}", ran.err);
    let document = ran.json();
    assert_eq!(document["compensated_outcome"], "pass");
    assert_eq!(document["compensated_zero_set_outcome"], "pass");
    for one in list(&document, "characteristics") {
        let number = |v: &Value| v.as_f64().expect("a number");
        let after = number(&one["compensated"]["value_mm"]);
        // A residual of 1 µm either way at each end of a zone, and twice that where a zone is a diameter.
        assert!((after - number(&one["nominal_mm"])).abs() < 4e-3, "{one}");
        assert_eq!(one["compensated"]["outcome"], "pass", "{one}");
        // All of it counts from datums: the zero does not matter.
        let again = number(&one["compensated_zero_set"]["value_mm"]);
        assert!((after - again).abs() < 2e-4, "{one}");
    }
    let words = ["predict", "examples/03_predict/torque-arm.toml", "--compensated"];
    let ran = trueaxis(&words);
    assert!(ran.status == 2 && ran.err.contains("contradiction"), "{}", ran.err);
}

#[test]
fn results_that_cannot_be_written_are_refused() {
    let folder = Folder::new("part-refused");
    for (words, code) in [
        (vec!["predict", HOUSING, "--results", "r.xlsx"], "unknown-word"),
        (
            vec!["predict", "examples/03_predict/torque-arm.toml", "--results", "r.csv"],
            "contradiction",
        ),
        (vec!["part", "parts/housing.toml", "-o", "draft.toml"], "contradiction"),
        (vec!["part", "machines/i5-engraver/machine.toml"], "missing-key"),
        (vec!["part", "no-such.qif"], "unreadable-file"),
        (vec!["part", "no-such.step"], "not-a-part-file"),
    ] {
        let ran = trueaxis(&words);
        assert!(ran.status == 2 && ran.err.contains(code), "{words:?}: {}", ran.err);
    }
    let text = fs::read_to_string(command::root().join(PLATE)).expect("the file");
    let broken = folder.file("broken.qif", text.replacen("<FileUnits>", "<Fileunits>", 1));
    let ran = trueaxis(&["part", &broken]);
    assert!(ran.status == 2 && ran.err.contains("bad-xml"), "{}", ran.err);
}
