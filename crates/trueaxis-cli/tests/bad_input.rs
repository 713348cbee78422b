//! Mistakes as users make them: each has a named diagnostic with its place and a hint, exit
//! status 2, nothing on standard output and nothing on the disk.

mod command;

use command::{Folder, Ran, trueaxis};

const XKAS: &str = "machines/xkas2525/machine.toml";
const I5: &str = "machines/i5-engraver/machine.toml";
const MILL: &str = "machines/three-axis-mill/machine.toml";
const STUDY: &str = "examples/03_predict/nas979-on-xkas2525.toml";
const BAD: &str = "crates/trueaxis-cli/tests/bad/";

/// A code and its place; of a file in `tests/bad` only the name is written here.
type Expected = (&'static str, &'static str);

/// The diagnostics of a run, in the order of the terminal.
fn errors(ran: &Ran) -> Vec<(String, String)> {
    let blocks = ran.err.split("\n\n").filter_map(|b| b.strip_prefix("error["));
    let read = |block: &str| {
        let (code, rest) = block.split_once(']').expect("a code");
        let place = rest.lines().find_map(|l| l.strip_prefix("  --> ")).expect("a place");
        assert!(rest.lines().any(|l| l.starts_with("  hint: ") && l.len() > 10), "{block}");
        (code.to_owned(), place.trim_start_matches(BAD).to_owned())
    };
    blocks.map(read).collect()
}

#[track_caller]
fn refused(arguments: &[&str], expected: &[Expected]) {
    let ran = trueaxis(arguments);
    assert!(ran.status == 2 && ran.has_no_answer(), "{arguments:?} {}\n{}", ran.out, ran.err);
    let found = errors(&ran);
    let found: Vec<_> = found.iter().map(|(code, place)| (code.as_str(), place.as_str())).collect();
    assert_eq!(found, expected, "{arguments:?}\n{}", ran.err);
    let last = match expected.len() {
        1 => "\n1 error found; nothing was written\n".to_owned(),
        n => format!("\n{n} errors found; nothing was written\n"),
    };
    assert!(ran.err.ends_with(&last), "{}", ran.err);
}

#[test]
fn machine_files() {
    let cases: &[(&str, &[Expected])] = &[
        (
            "machine-unknown-error.toml",
            &[("unknown-error-name", "machine-unknown-error.toml:11:1")],
        ),
        (
            "machine-two-axes-of-one-name.toml",
            &[("bad-chain", "machine-two-axes-of-one-name.toml:3:9")],
        ),
        ("machine-table-not-increasing.toml", &[("bad-table", "not-increasing.csv:4:1")]),
        ("machine-table-too-short.toml", &[("table-too-short", "too-short.csv:5:1")]),
        ("machine-table-nan.toml", &[("not-a-number", "nan.csv:4:5")]),
        ("machine-nan.toml", &[("not-finite", "machine-nan.toml:10:8")]),
        (
            "machine-degrees-for-mm.toml",
            &[
                ("wrong-unit", "machine-degrees-for-mm.toml:10:11"),
                ("wrong-unit", "machine-degrees-for-mm.toml:10:20"),
            ],
        ),
        ("machine-missing-csv.toml", &[("missing-table", "machine-missing-csv.toml:10:9")]),
        ("machine-csv-is-folder.toml", &[("missing-table", "machine-csv-is-folder.toml:10:9")]),
        ("no-such-machine.toml", &[("unreadable-file", "no-such-machine.toml")]),
        ("binary.toml", &[("unreadable-file", "binary.toml")]),
        ("empty.toml", &[("missing-key", "empty.toml:1:1")]),
    ];
    for (file, expected) in cases {
        let path = format!("{BAD}{file}");
        refused(&["check", &path], expected);
        refused(&["pose", &path, "--at", "X=0"], expected);
        refused(&["solve", &path, "--tip", "0 0 0", "--axis", "0 0 1"], expected);
        // A program that asks for JSON gets the diagnostics in the document.
        let ran = trueaxis(&["check", &path, "--format", "json"]);
        let document = ran.json();
        assert_eq!((ran.status, &document["usable"]), (2, &false.into()));
        let listed = document["diagnostics"].as_array().expect("a list");
        let codes: Vec<_> = listed.iter().map(|d| d["code"].as_str().expect("a code")).collect();
        assert_eq!(codes, expected.iter().map(|(code, _)| *code).collect::<Vec<_>>());
        assert!(listed.iter().all(|d| d["hint"].as_str().is_some_and(|h| !h.is_empty())));
    }
    refused(&["check", "machines"], &[("unreadable-file", "machines")]);
    let long = "m".repeat(5000);
    assert_eq!(trueaxis(&["check", &long]).status, 2);
}

/// Studies that cannot be read.
const STUDIES: &[(&str, &[Expected])] = &[
    ("study-misspelt-key.toml", &[("unknown-key", "study-misspelt-key.toml:6:1")]),
    ("study-negative-samples.toml", &[("bad-count", "study-negative-samples.toml:6:11")]),
    ("study-guarded-without-u.toml", &[("no-uncertainty", "study-guarded-without-u.toml:1:1")]),
    ("study-one-sample.toml", &[("too-few-samples", "study-one-sample.toml:5:1")]),
    ("study-too-many-samples.toml", &[("too-many-samples", "study-too-many-samples.toml:6:11")]),
    ("study-missing-machine.toml", &[("unreadable-file", "no-such-machine.toml")]),
    ("study-machine-is-folder.toml", &[("unreadable-file", "../../../../machines/xkas2525")]),
    (
        "study-tolerance-without-unit.toml",
        &[
            ("wrong-unit", "piece-tolerance-without-unit.toml:24:27"),
            ("wrong-unit", "piece-tolerance-without-unit.toml:25:28"),
            ("missing-unit", "piece-tolerance-without-unit.toml:26:29"),
        ],
    ),
    ("study-unknown-tool.toml", &[("unknown-tool", "study-unknown-tool.toml:6:8")]),
    ("study-two-tools.toml", &[("one-tool", "study-two-tools.toml:5:1")]),
    (
        "study-unknown-error.toml",
        &[
            ("unknown-error-name", "study-unknown-error.toml:6:1"),
            ("unknown-body", "study-unknown-error.toml:7:1"),
            ("wrong-unit", "study-unknown-error.toml:8:8"),
        ],
    ),
    ("study-error-twice.toml", &[("duplicate-error", "study-error-twice.toml:7:1")]),
    (
        "study-setting-unknown-axis.toml",
        &[
            ("unknown-axis", "study-setting-unknown-axis.toml:6:1"),
            ("unknown-axis", "study-setting-unknown-axis.toml:7:1"),
            ("wrong-unit", "study-setting-unknown-axis.toml:8:5"),
        ],
    ),
    ("study-setting-contradicts.toml", &[("contradiction", "study-setting-contradicts.toml:7:1")]),
    ("study-setting-with-hole.toml", &[("unknown-axis", "study-setting-with-hole.toml:7:1")]),
    ("study-unknown-index.toml", &[("unknown-index", "study-unknown-index.toml:7:1")]),
    ("study-unknown-rule.toml", &[("unknown-word", "study-unknown-rule.toml:6:8")]),
    (
        "study-coverage-of-simple-rule.toml",
        &[("contradiction", "study-coverage-of-simple-rule.toml:7:12")],
    ),
    // Only what is wrong is reported: not that [setting] and [compare] were unknown.
    (
        "study-fixture-without-unit.toml",
        &[("missing-unit", "study-fixture-without-unit.toml:6:11")],
    ),
    (
        "study-everything-wrong.toml",
        &[
            ("unreadable-file", "no-such-machine.toml"),
            ("unreadable-file", "no-such-piece.toml"),
            ("unknown-word", "study-everything-wrong.toml:6:8"),
            ("bad-count", "study-everything-wrong.toml:9:11"),
        ],
    ),
    (
        "study-bad-parts.toml",
        &[
            ("missing-table", "machine-missing-csv.toml:10:9"),
            ("missing-key", "piece-misspelt.toml:4:1"),
            ("unknown-key", "piece-misspelt.toml:5:1"),
        ],
    ),
];

/// Studies that the machine cannot do.
const IMPOSSIBLE: &[(&str, &[Expected])] = &[
    ("study-far-fixture.toml", &[("path-leaves-travel", "study-far-fixture.toml")]),
    (
        "study-setting-out-of-travel.toml",
        &[("path-leaves-travel", "study-setting-out-of-travel.toml")],
    ),
    ("study-little-tilt.toml", &[("path-leaves-travel", "study-little-tilt.toml")]),
    ("study-steep-cone.toml", &[("path-leaves-travel", "study-steep-cone.toml")]),
    ("study-three-axis.toml", &[("unreachable-direction", "study-three-axis.toml")]),
];

#[test]
fn studies() {
    let folder = Folder::new("studies");
    let page = folder.path("report.html");
    for (file, expected) in STUDIES.iter().chain(IMPOSSIBLE) {
        let path = format!("{BAD}{file}");
        refused(&["predict", &path, "--report", &page], expected);
        refused(&["predict", &path, "--report", &page, "--format", "json"], expected);
    }
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn positions() {
    let cases: &[(&str, &[Expected])] = &[
        ("X=nan", &[("not-finite", "--at")]),
        ("X=inf", &[("not-finite", "--at")]),
        ("X=1e400", &[("not-finite", "--at")]),
        ("X=1e308", &[("too-large", "--at")]),
        ("X=", &[("not-a-number", "--at")]),
        ("X=１０", &[("not-a-number", "--at")]),
        ("X=10deg", &[("wrong-unit", "--at")]),
        ("X=10 furlongs", &[("bad-position", "--at")]),
        ("X=1 X=1", &[("duplicate-axis", "--at")]),
        ("x=1", &[("unknown-axis", "--at")]),
        ("Q=1 W=2 Ä=3", &[("unknown-axis", "--at"); 3]),
        ("X=1,5 Y=2", &[("unknown-axis", "--at")]),
        (
            "nonsense \u{1b}[31m =",
            &[("bad-position", "--at"), ("bad-position", "--at"), ("unknown-axis", "--at")],
        ),
        // Outside of what was measured; the travel is only a warning.
        ("X=6201", &[("outside-table", "--at")]),
    ];
    for (at, expected) in cases {
        refused(&["pose", XKAS, "--at", at], expected);
        refused(&["pose", XKAS, "--at", at, "--format", "json"], expected);
    }
    let ran = trueaxis(&["pose", XKAS, "--at", "\u{1b}[31m"]);
    assert!(!ran.err.contains('\u{1b}'), "{:?}", ran.err);
    let approaches: &[(&str, &[Expected])] = &[
        ("X=up", &[("bad-approach", "--approach")]),
        ("X=+ X=-", &[("duplicate-axis", "--approach")]),
        ("Q=+", &[("unknown-axis", "--approach")]),
        ("+", &[("bad-position", "--approach")]),
    ];
    for (approach, expected) in approaches {
        refused(&["pose", XKAS, "--at", "X=0", "--approach", approach], expected);
    }
}

#[test]
fn tables_of_positions() {
    let cases: &[(&str, &[Expected])] = &[
        (
            "positions-nan.csv",
            &[
                ("not-a-number", "positions-nan.csv:3:3"),
                ("ragged-row", "positions-nan.csv:4:1"),
                ("not-a-number", "positions-nan.csv:5:3"),
            ],
        ),
        ("positions-none.csv", &[("empty-table", "positions-none.csv")]),
        ("positions-off-table.csv", &[("outside-table", "positions-off-table.csv:3:1")]),
        ("positions-semicolons.csv", &[("bad-separator", "positions-semicolons.csv:1:1")]),
        ("positions-twice.csv", &[("duplicate-column", "positions-twice.csv:1:3")]),
        ("unknown-axis.csv", &[("unknown-axis", "unknown-axis.csv:1:1")]),
        ("empty.toml", &[("empty-table", "empty.toml")]),
        ("binary.toml", &[("unreadable-file", "binary.toml")]),
        ("no-such.csv", &[("unreadable-file", "no-such.csv")]),
    ];
    for (file, expected) in cases {
        refused(&["pose", XKAS, "--at-file", &format!("{BAD}{file}")], expected);
    }
    let folder = Folder::new("tables");
    let rows = "nan,0\n".repeat(1000);
    let many = folder.file("many.csv", format!("X,Y\n{rows}"));
    let ran = trueaxis(&["pose", XKAS, "--at-file", &many]);
    assert_eq!((ran.status, errors(&ran).len()), (2, 100));
    assert!(ran.err.ends_with("… and 1 more\n\n101 errors found; nothing was written\n"));
}

#[test]
fn tool_poses() {
    let upright = ["--axis", "0 0 1"];
    for (tip, code) in [
        ("nan 0 0", "not-finite"),
        ("1e400 0 0", "not-finite"),
        ("1e300 0 0", "too-large"),
        ("1 2", "bad-vector"),
        ("1 2 3 4", "bad-vector"),
        ("", "bad-vector"),
        ("1,5 2", "bad-vector"),
        ("1deg 2 3", "wrong-unit"),
        ("-a 2 3", "not-a-number"),
    ] {
        refused(&[&["solve", I5, "--tip", tip], &upright[..]].concat(), &[(code, "--tip")]);
    }
    let from = |text| [&["solve", I5, "--tip", "0 0 0", "--from", text], &upright[..]].concat();
    refused(&from("C=nonsense"), &[("not-a-number", "--from")]);
    refused(&from("B=1"), &[("unknown-axis", "--from")]);
    refused(&from("---"), &[("bad-position", "--from")]);
    // Every argument is read before the command gives up.
    let all = ["solve", I5, "--tip", "a 0 0", "--axis", "0 0 0", "--from", "Q=1"];
    let expected = [("zero-axis", "--axis"), ("unknown-axis", "--from"), ("not-a-number", "--tip")];
    refused(&all, &expected);
    let target = |axis| ["solve", MILL, "--tip", "0 0 0", "--axis", axis];
    refused(&target("0 0.1 1"), &[("unreachable-direction", "--axis")]);
    refused(&target("nan 0 1"), &[("not-finite", "--axis")]);
    assert_eq!(trueaxis(&target("0 0 1e-3")).status, 0);
}

#[test]
fn paths() {
    let cases: &[(&str, &str, &[Expected])] = &[
        (
            I5,
            "path-bad-axis.csv",
            &[("zero-axis", "path-bad-axis.csv:3:1"), ("not-a-number", "path-bad-axis.csv:4:7")],
        ),
        (I5, "path-lacks-column.csv", &[("missing-column", "path-lacks-column.csv")]),
        (I5, "path-leaves-travel.csv", &[("path-leaves-travel", "path-leaves-travel.csv:3:1")]),
        (MILL, "path-unreachable.csv", &[("unreachable-direction", "path-unreachable.csv:3:1")]),
        (I5, "no-such.csv", &[("unreadable-file", "no-such.csv")]),
    ];
    for (machine, file, expected) in cases {
        refused(&["solve", machine, "--path", &format!("{BAD}{file}")], expected);
    }
}

#[test]
fn tools() {
    let at = |more: [&'static str; 2]| ["pose", XKAS, "--at", "X=0", more[0], more[1]];
    refused(&at(["--tool", "endmill-30"]), &[("unknown-tool", "--tool")]);
    refused(&at(["--tool-length", "nan"]), &[("not-finite", "--tool-length")]);
    refused(&at(["--tool-length", "1e308"]), &[("too-large", "--tool-length")]);
    refused(&at(["--tool-length", "10 deg"]), &[("wrong-unit", "--tool-length")]);
    refused(&at(["--tool-length", ""]), &[("not-a-number", "--tool-length")]);
    refused(&["pose", I5, "--at", "X=0", "--tool", "x"], &[("unknown-tool", "--tool")]);
}

#[test]
fn places_for_a_report() {
    let folder = Folder::new("report");
    let notes = folder.file("notes.html", "my own notes");
    let old = folder.file("old.html", "<!doctype html><p>of last week");
    std::fs::create_dir(folder.path("taken.html")).expect("a folder");
    let cases = [
        folder.path("no-such-folder/report.html"),
        folder.path("taken.html"),
        folder.path("notes.html/report.html"),
        notes.clone(),
        folder.path(&format!("{}.html", "r".repeat(300))),
    ];
    let no_form = [STUDY.to_owned(), folder.path("taken"), folder.path("..")];
    let all = cases.iter().map(|place| (place, "unwritable-file"));
    for (place, code) in all.chain(no_form.iter().map(|place| (place, "unknown-report-form"))) {
        let ran = trueaxis(&["predict", STUDY, "--samples", "0", "--report", place]);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{place}\n{}", ran.err);
        assert_eq!(errors(&ran), [(code.to_owned(), place.clone())]);
    }
    #[cfg(target_os = "linux")] // no file can be made there, not even by root
    refused(
        &["predict", STUDY, "--samples", "0", "--report", "/proc/report.html"],
        &[("unwritable-file", "/proc/report.html")],
    );
    assert_eq!(folder.names(), ["notes.html", "old.html", "taken.html"]);
    assert_eq!(std::fs::read_to_string(notes).expect("still there"), "my own notes");
    // An unusable study leaves the report of last week alone.
    let study = format!("{BAD}study-far-fixture.toml");
    refused(
        &["predict", &study, "--report", &old, "--force"],
        &[("path-leaves-travel", "study-far-fixture.toml")],
    );
    assert!(std::fs::read_to_string(old).expect("still there").ends_with("last week"));
}

#[test]
fn numbers_of_samples() {
    for samples in ["1", "-5", "1.5", "many", "99999999999999999999", "1000000001", ""] {
        let arguments = ["predict", STUDY, "--no-report", "--samples", samples];
        refused(&arguments, &[("bad-sampling", "--samples")]);
    }
}

#[test]
fn arguments() {
    for arguments in [
        &["pose", XKAS][..],
        &["solve", I5, "--tip", "0 0 0"],
        &["solve", I5, "--path", "p.csv", "--tip", "0 0 0"],
        &["pose", XKAS, "--at", "X=0", "--at-file", "p.csv"],
        &["pose", XKAS, "--at", "X=0", "--tool", "endmill-20", "--tool-length", "5"],
        &["pose", XKAS, "--at", "X=0", "--format", "xml"],
        &["predict", STUDY, "--no-report", "--report", "r.html"],
        &["predict", STUDY, "--seed", "-1"],
        &["predict"],
        &["predikt", STUDY],
    ] {
        let ran = trueaxis(arguments);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{arguments:?}");
        assert!(ran.err.starts_with("error: ") && ran.err.contains("--help"), "{}", ran.err);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn endless_files_and_a_full_disk() {
    refused(&["check", "/dev/zero"], &[("unreadable-file", "/dev/zero")]);
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a device");
    let ended = std::process::Command::new(env!("CARGO_BIN_EXE_trueaxis"))
        .args(["check", MILL])
        .current_dir(command::root())
        .stdout(full)
        .output()
        .expect("an end");
    assert_eq!(ended.status.code(), Some(2));
    let reported = String::from_utf8(ended.stderr).expect("UTF-8");
    assert!(reported.starts_with("error[unwritable-output]: standard output"), "{reported}");
}

/// Not even where the option that it belongs to conflicts with the question that is there.
#[test]
fn an_option_of_another_question_is_refused() {
    let campaign = "examples/04_plan/probe-ball.toml";
    for arguments in [
        &["verify", campaign, "--limit", "EC0Y=30 urad"][..],
        &["measure", campaign, "--draw"],
        &["measure", campaign, "--point-u", "1 um"],
    ] {
        let ran = trueaxis(arguments);
        assert!(ran.status == 2 && ran.has_no_answer(), "{arguments:?} {}\n{}", ran.out, ran.err);
        assert!(ran.err.contains("cannot be used with"), "{}", ran.err);
    }
    // The default of an option is no option.
    assert_eq!(trueaxis(&["measure", campaign]).status, 0);
}
