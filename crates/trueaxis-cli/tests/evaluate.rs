//! `trueaxis evaluate` as a user sees it.

mod command;

use command::{Folder, trueaxis};

const DATA: &str = "examples/07_verify/x-axis-laser.csv";

#[test]
fn the_document_has_the_agreed_keys() {
    let ran = trueaxis(&["evaluate", "iso230-2", DATA, "--format", "json"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/evaluate/1");
    assert_eq!(found["standard"], "iso230-2");
    for key in
        ["A", "A_up", "A_down", "R", "R_up", "R_down", "E", "E_up", "E_down", "M", "B", "B_mean"]
    {
        assert!(found[format!("{key}_um")].is_f64(), "{key}");
        assert!(found["U_um"][key].is_f64(), "{key}");
    }
    assert_eq!(found["positions"].as_array().expect("positions").len(), 13);
}

#[test]
fn what_cannot_be_used_is_refused_with_its_place() {
    let folder = Folder::new("evaluate-bad");
    for (standard, text, code, place) in [
        ("iso230-2", "target_mm,direction,deviation_um\n0,up,nan\n", "not-a-number", ":2:6"),
        ("iso230-2", "target_mm,direction,deviation_um\n0,sideways,1\n", "bad-direction", ":2:1"),
        ("iso230-2", "target_mm;direction\n0;up\n", "missing-column", ":1:1"),
        (
            "iso230-2",
            "target_mm,deviation_um,temperature_degC\n0,1,20\n9,1,68\n",
            "temperature-range",
            ":3:1",
        ),
        ("iso230-2", "target_mm,deviation_um,temperature_degF\n0,1,68\n", "unknown-unit", ":1:24"),
        ("iso230-3", "time_s,x_um\n0,1\n9,1\n5,1\n", "time-backwards", ":4:1"),
        ("iso230-4", "x_mm,direction\n0,cw\n", "missing-column", ":1:1"),
        ("iso230-6", "diagonal,target_mm,deviation_um\n++,0,1\n", "bad-diagonal", ":2:1"),
        ("iso230-7", "angle_deg,radial_um\n0,1\n90,1\n", "angles-not-indexed", ":3:1"),
    ] {
        let file = folder.file("data.csv", text);
        let report = folder.path("report.html");
        let ran = trueaxis(&["evaluate", standard, &file, "--report", &report]);
        assert_eq!(ran.status, 2, "{text}{}", ran.err);
        assert!(ran.err.contains(&format!("error[{code}]")), "{code}: {}", ran.err);
        assert!(ran.err.contains(&format!("data.csv{place}")), "{place}: {}", ran.err);
        assert_eq!(folder.names(), ["data.csv"]);
    }
}

#[test]
fn what_is_missing_is_told_and_the_rest_is_evaluated() {
    let folder = Folder::new("evaluate-few");
    let text = "target_mm,run,direction,deviation_um\n0,1,up,1\n0,2,up,2\n100,1,up,4\n100,2,up,5\n";
    let file = folder.file("data.csv", text);
    let ran = trueaxis(&["evaluate", "iso230-2", &file, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    for code in ["few-positions", "few-runs", "one-direction"] {
        assert!(ran.err.contains(&format!("warning[{code}]")), "{code}: {}", ran.err);
    }
    assert!(ran.err.contains("clause 5.3.2"));
    let found = ran.json();
    assert!((found["E_up_um"].as_f64().expect("E↑") - 3.0).abs() < 1e-9);
    assert!(found["A_um"].is_null() && found["U_um"]["E_up"].is_null());
    assert_eq!(found["diagnostics"].as_array().expect("diagnostics").len(), 3);
}

#[test]
fn the_table_that_is_written_back_can_be_read() {
    let folder = Folder::new("evaluate-back");
    let mill =
        std::fs::read_to_string(command::root().join("machines/three-axis-mill/machine.toml"));
    let mill = mill.expect("a machine");
    let machine = folder.file("machine.toml", &mill);
    let ran = trueaxis(&["evaluate", "iso230-2", DATA, "--write-back", &machine, "X"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert_eq!(folder.names(), ["machine.toml", "x-axis-laser-EXX.csv"]);
    // The lines that it names, in place of [motion.X] of the machine file.
    let lines = ran.err.split("[motion.X]").nth(1).expect("a section");
    let start = mill.find("[motion.X]").expect("a section");
    let end = mill.find("[motion.Y]").expect("a section");
    let new = format!("{}[motion.X]{lines}\n{}", &mill[..start], &mill[end..]);
    let machine = folder.file("machine.toml", new);
    let ran =
        trueaxis(&["pose", &machine, "--at", "X=-300", "--approach", "X=+", "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let budget = ran.json()["budget"].clone();
    let exx = budget.as_array().expect("a budget").iter().find(|e| e["error"] == "EXX");
    // −5.154 µm of the laser: the table stands 5.154 µm too far in +X.
    let felt = exx.expect("EXX")["tip_um"][0].as_f64().expect("a number");
    assert!((felt + 5.154).abs() < 1e-6, "{felt}");
    // What the command did not write is not overwritten.
    let taken = folder.file("x-axis-laser-EXX.csv", "position_mm,EXX_um\n0,1\n1,2\n");
    let ran = trueaxis(&["evaluate", "iso230-2", DATA, "--write-back", &machine, "X"]);
    assert_eq!(ran.status, 2);
    assert!(std::fs::read_to_string(taken).expect("the file").starts_with("position_mm"));
}

#[test]
fn the_forms_of_others_are_read_or_refused_with_what_they_lack() {
    let import = "crates/trueaxis-cli/tests/import/";
    let (qif, report) = (format!("{import}circles.qif"), format!("{import}report.md"));
    let ran = trueaxis(&["evaluate", "iso230-4", &qif, "--feature", "bore", "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.err.contains("note[probe-radius]") && ran.err.contains("note[feature-points]"));
    assert!((ran.json()["G_ccw_um"].as_f64().expect("G") - 6.0).abs() < 2e-3);
    for (arguments, code, words) in [
        (vec!["iso230-4", &qif], "which-feature", "bore, boss"),
        (vec!["iso230-4", &qif, "--feature", "hole"], "unknown-feature", "`hole`"),
        (vec!["iso230-2", &qif], "no-such-readings", "no runs and no directions"),
        (vec!["iso230-4", &report], "no-such-readings", "use iso230-2"),
        (vec!["iso230-4", &report, "--import", "qif"], "bad-xml", "report.md:"),
        (vec!["iso230-2", DATA, "--import", "ecmc-md"], "empty-table", "no readings"),
    ] {
        let ran = trueaxis(&[&["evaluate"], &arguments[..]].concat());
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{}", ran.err);
        assert!(ran.err.contains(&format!("error[{code}]")), "{code}: {}", ran.err);
        assert!(ran.err.contains(words), "{words}: {}", ran.err);
    }
    let ran = trueaxis(&["evaluate", "iso230-2", &report, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    // R and E are not the standard's, B is; each with its line.
    assert_eq!(ran.err.matches("warning[not-by-the-standard]").count(), 2, "{}", ran.err);
    assert!(ran.err.contains("prints E = 2.00 µm; by ISO 230-2:2014 E is 4.00 µm"));
    assert!(ran.err.contains("report.md:39:1"));
}

/// The verdict of a geometric and of a probing test is the exit status.
#[test]
fn a_tolerance_decides_the_exit_status() {
    let folder = Folder::new("evaluate-tolerance");
    let plate = "examples/07_verify/moody-1955.csv";
    let beside =
        std::fs::read_to_string(command::root().join("examples/07_verify/moody-1955.toml"));
    let beside = beside.expect("conditions");
    // 4.07 µm with U = 0.37 µm.
    for (allowed, status, outcome) in
        [("8 um", 0, "pass"), ("4.2 um", 1, "undecided"), ("3 um", 1, "fail")]
    {
        let conditions = folder.path("plate.toml");
        std::fs::write(&conditions, beside.replace("8 um", allowed)).expect("written");
        let ran = trueaxis(&[
            "evaluate",
            "iso230-1",
            plate,
            "--conditions",
            &conditions,
            "--format",
            "json",
        ]);
        assert_eq!((ran.status, ran.json()["outcome"].as_str()), (status, Some(outcome)));
    }
    let ran = trueaxis(&["evaluate", "iso230-1", "examples/07_verify/circle-xy.csv"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("error[missing-test]"), "{}", ran.err);
    let ran = trueaxis(&["evaluate", "iso230-10", "examples/07_verify/probe-performance.csv"]);
    assert_eq!(ran.status, 0);
    assert!(ran.out.contains("P_FTU,3D of sphere at 0°"), "{}", ran.out);
}
