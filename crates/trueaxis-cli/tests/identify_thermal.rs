//! `trueaxis identify thermal` as a user sees it.

mod command;

use command::{Folder, trueaxis};
use std::fmt::Write;

const STUDY: &str = "examples/05_identify/lathe-thermal.toml";

/// A study of three logs in a folder.
fn study(more: &str) -> String {
    format!(
        "name = 'n'\nfiles = ['a.csv', 'b.csv', 'c.csv']\n{more}\n[displacement]\ncolumn = 'd_um'\n\
         error = 'EZ0t'\n[sensors]\ns = 's_degC'\nr = 'r_degC'\n"
    )
}

/// A log of 20 rows; `row` may change what stands in one of them.
fn log(seed: usize, row: impl Fn(usize, &mut [f64; 4])) -> String {
    let mut text = "time_min,d_um,s_degC,r_degC\n".to_owned();
    for i in 0..20 {
        let slow = (i as f64 * (0.1 + 0.03 * seed as f64)).sin();
        let mut values = [i as f64, 5.0 * slow, 21.0 + 2.0 * slow, 22.0 + 0.05 * i as f64];
        row(i, &mut values);
        let cells = values.map(|v| v.to_string()).join(",");
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{cells}");
    }
    text
}

fn same(_: usize, _: &mut [f64; 4]) {}

#[test]
fn the_document_has_the_agreed_keys() {
    let folder = Folder::new("identify-thermal");
    let report = folder.path("report.html");
    let ran = trueaxis(&["identify", "thermal", STUDY, "--format", "json", "--report", &report]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    assert_eq!(
        (&found["schema"], &found["what"]),
        (&"trueaxis/identify/1".into(), &"thermal".into())
    );
    assert_eq!(found["verdict"], "model");
    for key in ["in_sample_um", "row_wise_um", "held_out_um", "no_model_um", "repeatability_um"] {
        assert!(found[key].is_f64(), "{key}");
    }
    assert_eq!(found["coefficients"][0]["sensor"], "spindle_front");
    assert_eq!(found["cycles"].as_array().map(Vec::len), Some(8));
    assert!(found["machine_file"].as_str().is_some_and(|l| l.starts_with("[heat.EX0t]\n")));
    assert!(std::fs::read_to_string(&report).is_ok_and(|page| page.ends_with("</html>")));
}

#[test]
fn a_refused_model_is_a_no_without_lines() {
    let folder = Folder::new("identify-refused");
    // Displacements that have nothing to do with the sensors.
    let noise =
        |seed: usize| log(seed, move |i, v| v[1] = ((i * i * (seed + 3)) as f64 * 0.7).cos() * 3.0);
    for (i, name) in ["a.csv", "b.csv", "c.csv"].iter().enumerate() {
        folder.file(name, noise(i));
    }
    let file = folder.file("study.toml", study(""));
    let ran = trueaxis(&["identify", "thermal", &file]);
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("no model: ") && !ran.out.contains("[heat."), "{}", ran.out);
}

/// The log `b.csv` is bad.
#[track_caller]
fn refused(more: &str, bad: &str, code: &str, place: &str) {
    let folder = Folder::new(&format!("identify-{code}-{}", bad.len()));
    folder.file("a.csv", log(0, same));
    folder.file("b.csv", bad);
    folder.file("c.csv", log(2, same));
    let file = folder.file("study.toml", study(more));
    let report = folder.path("report.html");
    let ran = trueaxis(&["identify", "thermal", &file, "--report", &report]);
    assert!(ran.err.contains(&format!("error[{code}]")), "{code}: {}", ran.err);
    assert!(ran.err.contains(place), "{place}: {}", ran.err);
    assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{}", ran.err);
    assert!(!folder.names().contains(&"report.html".to_owned()));
}

#[test]
fn logs_that_cannot_be_used_are_refused_with_their_place() {
    let at = |row: usize, column: usize, value: f64| {
        log(1, move |i, v| {
            if i == row {
                v[column] = value;
            }
        })
    };
    let cell = |text: &str| log(1, same).replacen("\n3,", &format!("\n3,{text},"), 1);
    for (more, bad, code, place) in [
        ("", at(6, 2, 300.0), "impossible-temperature", "b.csv:8:1"),
        ("time = 'time_min'", at(6, 0, 2.0), "time-runs-backwards", "b.csv:8:1"),
        ("", at(6, 2, f64::NAN), "not-a-number", "b.csv:8:"),
        ("", cell(""), "not-a-number", "b.csv:5:3"),
        ("", log(1, same)[..100].to_owned(), "ragged-row", "b.csv:"),
        ("", log(0, same), "duplicate-cycle", "b.csv"),
        ("", log(1, |_, v| v[1] = 4.0), "stuck-displacement", "b.csv:2:1"),
        (
            "",
            log(1, same).lines().take(6).collect::<Vec<_>>().join("\n"),
            "short-cycle",
            "b.csv:2:1",
        ),
        ("", String::new(), "empty-table", "b.csv"),
        ("", log(1, same).replace("s_degC", "s_degF"), "missing-column", "b.csv"),
    ] {
        refused(more, &bad, code, place);
    }
}

#[test]
fn doubtful_logs_are_used_and_told() {
    for (bad, code, place) in [
        (log(1, |_, v| v[2] = 1.8 * v[2] + 32.0), "warm-temperature", "b.csv:2:1"),
        (log(1, |_, v| v[3] = 22.0), "stuck-sensor", "b.csv:2:1"),
        (log(1, |i, v| v[3] += if i > 9 { 9.0 } else { 0.0 }), "jumping-sensor", "b.csv:12:1"),
        (
            log(1, |i, v| v[1] += if i > 9 { 90.0 } else { 0.0 }),
            "jumping-displacement",
            "b.csv:12:1",
        ),
        (log(1, |i, v| v[3] += if i % 2 > 0 { 2.0 } else { 0.0 }), "jittering-sensor", "b.csv:2:1"),
    ] {
        let folder = Folder::new(&format!("identify-{code}"));
        folder.file("a.csv", log(0, same));
        folder.file("b.csv", bad);
        folder.file("c.csv", log(2, same));
        let file = folder.file("study.toml", study(""));
        let ran = trueaxis(&["identify", "thermal", &file]);
        assert!(ran.err.contains(&format!("warning[{code}]")), "{code}: {}", ran.err);
        assert!(ran.err.contains(place), "{place}: {}", ran.err);
        assert!(ran.status < 2, "{}", ran.err);
    }
}

#[test]
fn studies_that_cannot_be_used_are_refused_with_their_place() {
    let folder = Folder::new("identify-studies");
    for (i, name) in ["a.csv", "b.csv", "c.csv"].iter().enumerate() {
        folder.file(name, log(i, same));
    }
    let swap = |from: &str, to: &str| study("").replacen(from, to, 1);
    for (text, code, place) in [
        (study("lags = ['10 min']"), "missing-time", "study.toml:3:8"),
        (study("interval = '1 s'\nlags = ['-1 s']"), "not-positive", "study.toml:4:9"),
        (study("zero = 'never'"), "unknown-word", "study.toml:3:8"),
        (study("most_terms = 0"), "too-few-terms", "study.toml"),
        (study("most_tems = 2"), "unknown-key", "study.toml:3:1"),
        (swap("'b.csv'", "'a.csv'"), "duplicate-cycle", "study.toml:2:19"),
        (swap("'b.csv'", "'z.csv'"), "unreadable-file", "z.csv"),
        (swap("['a.csv', 'b.csv', 'c.csv']", "['a.csv']"), "too-few-cycles", "a.csv"),
        (swap("['a.csv', 'b.csv', 'c.csv']", "[]"), "bad-list", "study.toml:2:9"),
        (swap("'EZ0t'", "'EB0Z'"), "wrong-unit", "study.toml:6:9"),
        (swap("'d_um'", "'s_degC'"), "wrong-unit", "a.csv:1:15"),
        (swap("'s_degC'", "'d_um'"), "wrong-unit", "a.csv:1:10"),
        (swap("'d_um'", "'x_um'"), "missing-column", "a.csv"),
        (study("cycle = 'r_degC'"), "short-cycle", "a.csv:2:1"),
        (swap("[sensors]", "[sensor]"), "missing-key", "study.toml"),
    ] {
        let file = folder.file("study.toml", text);
        let ran = trueaxis(&["identify", "thermal", &file]);
        assert!(ran.err.contains(&format!("error[{code}]")), "{code}: {}", ran.err);
        assert!(ran.err.contains(place), "{place}: {}", ran.err);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{}", ran.err);
    }
}

/// A later day with a new pattern: exit status 1, what remains, and the sensor that is outside; by the option as by the study.
#[test]
fn a_later_log_is_scored() {
    let study = "examples/05_identify/lathe-thermal.toml";
    let day = "examples/05_identify/lathe-new-day.csv";
    let ran = trueaxis(&["identify", "thermal", study, "--score", day, "--format", "json"]);
    assert_eq!(ran.status, 1);
    let later = &ran.json()["later"];
    let log = &later["logs"][0];
    assert_eq!(
        (&later["verdict"], &log["pattern"]),
        (&"worse than promised".into(), &"outside".into())
    );
    let um =
        |value: &serde_json::Value| (value.as_f64().expect("a number") * 100.0).round() / 100.0;
    assert_eq!(
        [um(&later["promised_u_um"]), um(&log["left_um"]), um(&log["u_um"])],
        [1.41, 5.31, 8.38]
    );
    let outside = log["sensors_outside"].as_array().expect("sensors");
    assert!(outside.iter().any(|s| s["sensor"] == "coolant"));
    let text = trueaxis(&["identify", "thermal", study, "--score", day]);
    assert!(text.out.contains("WORSE THAN PROMISED"), "{}", text.out);
    assert!(text.err.contains("warning[outside-pattern]"), "{}", text.err);
    // Without later logs the answer says so; a log that the model comes from scores nothing.
    assert!(
        trueaxis(&["identify", "thermal", study, "--format", "json"]).json()["later"].is_null()
    );
    let own = "examples/05_identify/lathe-thermal/cycle-2.csv";
    let ran = trueaxis(&["identify", "thermal", study, "--score", own]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("error[duplicate-cycle]"), "{}", ran.err);
}
