//! `trueaxis verify --certificate` as its users call it.

mod command;

use command::{Folder, Ran, root, trueaxis};
use serde_json::Value;
use std::path::Path;

const TABLES: &str = "examples/07_verify/certificate.toml";
const PROGRAM: &str = "examples/07_verify/certificate-program.toml";

fn certify(study: &str) -> Ran {
    trueaxis(&["verify", "--certificate", study, "--format", "json"])
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
fn the_shipped_certificates_pass_with_all_that_is_due() {
    let folder = Folder::new("certificate");
    let page = folder.path("certificate.html");
    let ran = trueaxis(&["verify", "--certificate", TABLES, "--report", &page]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    let page = std::fs::read_to_string(page).expect("the page");
    let topics = [
        "1. Kinematic representation",
        "2. Errors",
        "3. Determination",
        "4. Compensation",
        "5. Application",
        "6. Validation",
        "7. Documentation",
    ];
    for text in [&ran.out, &page] {
        let places: Vec<_> =
            topics.iter().map(|t| text.find(t).unwrap_or_else(|| panic!("no {t}"))).collect();
        assert!(places.is_sorted(), "{places:?}");
        for due in ["w b X Y Z C A t", "20.3 ± 0.2 °C", "ISO 14253-1", "AX_EEC.INI", "PASS"] {
            assert!(text.contains(due), "no {due}");
        }
    }
    assert!(page.matches("<svg").count() == 2 && !page.contains("<script"));

    let found = certify(PROGRAM).json();
    assert_eq!(found["schema"], "trueaxis/certificate/1");
    assert_eq!(found["verdict"], "pass");
    assert_eq!(found["errors"].as_array().map(Vec::len), Some(72));
    let validation = &found["validation"];
    assert_eq!(validation["poses"].as_array().map(Vec::len), Some(32));
    // 62 µm before; 5 µm after, of which the readings themselves are √3 · 1.5 µm.
    assert!(
        number(&validation["rms_um"]["before"]) > 10.0 * number(&validation["rms_um"]["after"])
    );
    for state in ["before", "after"] {
        assert_eq!(validation["agreement"][state]["holds"], true, "{validation}");
    }
    for pose in validation["poses"].as_array().expect("poses") {
        let exact = pose["predicted_after_um"].as_array().expect("x y z");
        assert!(exact.iter().all(|v| number(v).abs() < 1e-6), "{pose}");
    }
}

/// The study's own hash, and those of all it names, as `sha256sum` finds them.
#[test]
fn every_input_is_named_by_its_hash() {
    let found = certify(TABLES).json();
    let inputs = found["inputs"].as_array().expect("inputs");
    assert_eq!(inputs.len(), 11, "study, machine and its 5 tables, 2 loaded tables, 2 readings");
    for input in inputs {
        let name = input["name"].as_str().expect("a name");
        let path = root().join("examples/07_verify").join(name);
        let ran = std::process::Command::new("sha256sum").arg(&path).output();
        let Ok(ran) = ran else { continue }; // no coreutils here
        let expected = String::from_utf8_lossy(&ran.stdout);
        let hash = input["sha256"].as_str().expect("a hash");
        assert_eq!(expected.get(..64), Some(hash), "{name}");
    }
}

/// The predictions and their uncertainties, by a chain, splines, tables and a solution that are not ours.
#[test]
fn oracle_python_certificate() {
    let text = include_str!("data/certificate.json");
    let expected: Value = serde_json::from_str(text).expect("JSON");
    for (study, key) in [(TABLES, "tables"), (PROGRAM, "program")] {
        let found = certify(study).json();
        let poses = found["validation"]["poses"].as_array().expect("poses");
        let expected = expected[key].as_array().expect("poses");
        assert_eq!(expected.len(), 6);
        for (pose, expected) in poses.iter().zip(expected) {
            for i in 0..3 {
                let off = number(&pose["predicted_after_um"][i]) - number(&expected["after_um"][i]);
                assert!(off.abs() < 1e-5, "{study}: {off} µm\n{pose}\n{expected}");
                let u = number(&pose["expanded_predicted_um"][i]) / 2.0;
                let off = u - number(&expected["u_um"][i]);
                assert!(off.abs() < 1e-5, "{study}: {off} µm\n{pose}\n{expected}");
            }
        }
    }
}

/// A copy of the example and its machine elsewhere, to be spoiled.
struct Copy(Folder);

impl Copy {
    fn new(name: &str) -> Self {
        let folder = Folder::new(name);
        let copy = |from: &str, to: &str| {
            let (from, to) = (root().join(from), Path::new(&folder.path(to)).to_owned());
            std::fs::create_dir_all(&to).expect("a folder");
            for file in std::fs::read_dir(from).expect("a folder").flatten() {
                if file.path().is_file() {
                    std::fs::copy(file.path(), to.join(file.file_name())).expect("a copy");
                }
            }
        };
        copy("examples/07_verify", "examples/07_verify");
        copy("examples/07_verify/xkas2525-tables", "examples/07_verify/xkas2525-tables");
        copy("machines/xkas2525", "machines/xkas2525");
        Self(folder)
    }

    fn path(&self, name: &str) -> String {
        self.0.path(&format!("examples/07_verify/{name}"))
    }

    /// Replaces a part of a file.
    fn change(&self, name: &str, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.path(name)).expect("a file");
        assert!(text.contains(from), "{name} has no {from}");
        std::fs::write(self.path(name), text.replacen(from, to, 1)).expect("a written file");
    }

    fn certify(&self, study: &str) -> Ran {
        certify(&self.path(study))
    }
}

#[test]
fn law_the_same_inputs_give_the_same_bytes_anywhere() {
    let copy = Copy::new("certificate-again");
    let (here, there) = (copy.0.path("here.html"), copy.0.path("there.html"));
    let study = copy.path("certificate.toml");
    let run = |study: &str, page: &str| {
        trueaxis(&["verify", "--certificate", study, "--report", page, "--format", "json"]).out
    };
    assert_eq!(run(TABLES, &here), run(&study, &there));
    let read = |path| std::fs::read(path).expect("the page");
    assert_eq!(read(&here), read(&there));
}

/// A study, one of its files, what is replaced in it by what, and what must be reported.
type Spoiled<'a> = (&'a str, &'a str, &'a str, &'a [&'a str]);

/// What is unusable, with its name and its place; nothing is written.
fn is_named(study: &str, cases: &[Spoiled<'_>]) {
    for (i, (file, from, to, reported)) in cases.iter().enumerate() {
        let copy = Copy::new(&format!("{study}-bad-{i}"));
        copy.change(file, from, to);
        let page = copy.0.path("page.html");
        let study = copy.path(study);
        let ran = trueaxis(&["verify", "--certificate", &study, "--report", &page]);
        assert_eq!(ran.status, 2, "{to}: {}", ran.out);
        for word in *reported {
            assert!(ran.err.contains(word), "{to}: no {word} in\n{}", ran.err);
        }
        assert!(!Path::new(&page).exists() && ran.out.is_empty(), "{to}");
    }
}

#[test]
fn what_is_unusable_of_a_study_is_named() {
    const STUDY: &str = "certificate-program.toml";
    let cases: [Spoiled<'_>; 11] = [
        (STUDY, "certificate-program-after.csv", "no.csv", &["unreadable-file", "no.csv"]),
        (STUDY, "limit = ", "limmit = 3\nlimit = ", &["unknown-key", "limmit", "program.toml:"]),
        (STUDY, "u = \"1.5 um\"", "", &["missing-key", "`u`"]),
        (STUDY, "20.3 ± 0.2 degC", "2030 degC", &["temperature-range"]),
        (STUDY, "\"ISO 14253-1\"", "\"by feeling\"", &["unknown-rule", "by feeling"]),
        (STUDY, "limit = \"15 um\"", "limit = \"0 um\"", &["not-positive"]),
        (STUDY, "kind = \"program\"", "kind = \"hope\"", &["unknown-kind"]),
        (STUDY, "zero = \"X=3100", "zero = \"Q=3100", &["unknown-axis", "`Q`"]),
        (STUDY, "samples = 10000", "samples = 10", &["bad-count"]),
        (
            STUDY,
            "[compensation]",
            "[zone]\nX = [\"0 mm\", \"7 m\"]\n[compensation]",
            &["bad-range", "within the travel"],
        ),
        (
            STUDY,
            "[compensation]",
            "[zone]\nA = [\"20 deg\", \"90 deg\"]\n[compensation]",
            &["outside-zone", "certificate-program-after.csv:3"],
        ),
    ];
    is_named(STUDY, &cases);
}

#[test]
fn what_is_unusable_of_the_readings_is_named() {
    const AFTER: &str = "certificate-program-after.csv";
    let first = "2435.1,780.9,-752.5,-134.9,-14,";
    let cases: [Spoiled<'_>; 4] = [
        (AFTER, first, "2435.1,780.9,nan,-134.9,-14,", &["not-a-number", "after.csv:3:14"]),
        (
            AFTER,
            first,
            "2435.2,780.9,-752.5,-134.9,-14,",
            &["unpaired-pose", "after.csv:3", "before.csv:3"],
        ),
        (AFTER, "x_um,", "x_kg,", &["unknown-unit", "after.csv:2:11", "`kg`"]),
        (AFTER, "x_um,", "q_um,", &["missing-column", "after.csv"]),
    ];
    is_named("certificate-program.toml", &cases);
    // A pose of the identification: X.csv has 310 mm in its second row.
    let copy = Copy::new("certificate-used");
    for file in [AFTER, "certificate-program-before.csv"] {
        copy.change(file, first, "310,1250,-500.5,0,0.05,");
    }
    let ran = copy.certify("certificate-program.toml");
    assert_eq!(ran.status, 2);
    for word in ["used-pose", "certificate-program-after.csv:3", "X.csv:3"] {
        assert!(ran.err.contains(word), "no {word} in\n{}", ran.err);
    }
}

#[test]
fn what_is_unusable_of_tables_is_named() {
    const STUDY: &str = "certificate.toml";
    let cases: [Spoiled<'_>; 3] = [
        (STUDY, "target = \"sinumerik\"", "target = \"abacus\"", &["unknown-target", "abacus"]),
        (STUDY, "xkas2525-tables\" #", "nowhere\" #", &["unreadable-file", "nowhere/AX_EEC.INI"]),
        // Another content than what the machine file compiles to.
        (
            "xkas2525-tables/AX_EEC.INI",
            "0.080700",
            "0.080400",
            &["other-table", "AX_EEC.INI", "SHA-256", "certificate.toml:"],
        ),
    ];
    is_named(STUDY, &cases);
}

#[test]
fn readings_without_a_pose_are_none() {
    let copy = Copy::new("certificate-empty");
    let headings = "X,Y,Z,C,A,x_um,y_um,z_um\n";
    std::fs::write(copy.path("certificate-program-after.csv"), headings).expect("written");
    let ran = copy.certify("certificate-program.toml");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("empty-table"), "{}", ran.err);
    let ran = certify("examples/07_verify/no-such-study.toml");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("no-such-study.toml"), "{}", ran.err);
}

#[test]
fn a_certificate_without_uncertainties_is_refused() {
    let copy = Copy::new("certificate-no-u");
    let machine = copy.0.path("machines/xkas2525/machine.toml");
    let text = std::fs::read_to_string(&machine).expect("the machine");
    std::fs::write(&machine, text.replacen("-24 ± 1 urad", "-24 urad", 1)).expect("written");
    let ran = copy.certify("certificate-program.toml");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("no-uncertainty") && ran.err.contains("EC0Y"), "{}", ran.err);
}

#[test]
fn what_the_readings_cannot_prove_is_undecided_and_what_they_disprove_fails() {
    let reported = |study: &str, changes: &[[&str; 2]]| {
        let copy = Copy::new(&format!("certificate-verdict-{}", changes[0][1].len()));
        changes.iter().for_each(|[from, to]| copy.change(study, from, to));
        let ran = copy.certify(study);
        assert_eq!(ran.status, 1, "{}", ran.err);
        let found = ran.json();
        (found["verdict"].clone(), found["reason"].as_str().expect("words").to_owned())
    };
    let program = "certificate-program.toml";
    // U = 16 µm against 15 µm: nothing can be proved.
    let (verdict, reason) = reported(program, &[["u = \"1.5 um\"", "u = \"8.0 um\""]]);
    assert!(verdict == "undecided" && reason.contains("cannot prove conformity"), "{reason}");
    // 9.5 µm against 10 µm with U = 3 µm.
    let (verdict, reason) = reported(program, &[["limit = \"15 um\"", "limit = \"10 um\""]]);
    assert!(verdict == "undecided" && reason.contains("nearer to"), "{reason}");
    let (verdict, reason) = reported(program, &[["limit = \"15 um\"", "limit = \"5.0 um\""]]);
    assert!(verdict == "fail" && reason.contains("beyond"), "{reason}");
    // Readings with tables that are called those of a program: within the limit, but not as predicted.
    let changes = [
        ["kind = \"tables\"", "kind = \"program\""],
        ["target = \"sinumerik\"\n", ""],
        ["kinematics = false", ""],
        ["loaded = \"xkas2525-tables\"", ""],
    ];
    let (verdict, reason) = reported("certificate.toml", &changes);
    assert!(verdict == "undecided" && reason.contains("not as predicted"), "{reason}");
}

/// All readings are within 20 µm, but in a corner of the zone, where no reading was taken, more is predicted.
#[test]
fn a_pass_says_what_is_not_excluded_elsewhere() {
    let copy = Copy::new("certificate-elsewhere");
    copy.change("certificate.toml", "limit = \"35 um\"", "limit = \"20 um\"");
    let ran = copy.certify("certificate.toml");
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    let largest = number(&found["zone"]["largest_um"]);
    let reported = format!("elsewhere in the zone up to {largest:.1} µm are not excluded");
    assert!(
        largest > 20.0 && found["reason"].as_str().expect("words").contains(&reported),
        "{found}"
    );
}
