//! What the commands show, as a user sees it from a clean clone.

mod command;

use command::{Folder, root, trueaxis};
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

const XKAS: &str = "machines/xkas2525/machine.toml";
const I5: &str = "machines/i5-engraver/machine.toml";
const MILL: &str = "machines/three-axis-mill/machine.toml";
const STUDY: &str = "examples/03_predict/nas979-on-xkas2525.toml";
const AT: &str = "X=3000 Y=1200 Z=-700 C=-90 A=15";

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

#[track_caller]
fn near(ours: &[f64], theirs: &[f64], allowed: f64) {
    assert_eq!(ours.len(), theirs.len());
    for (a, b) in ours.iter().zip(theirs) {
        assert!((a - b).abs() <= allowed, "{ours:?} and {theirs:?}");
    }
}

/// From oracles/poses.py: X=3000 Y=1200 Z=-700 C=-90 A=15 on the XKAS2525.
const TIP_UM: [f64; 3] = [35.13398347842371, -20.772794977920974, 11.643403837415356];
const AXIS_URAD: [f64; 3] = [357.2016634577238, 101.07296501926844, 166.4745542127519];

#[test]
fn oracle_pose_as_json() {
    let ran = trueaxis(&["pose", XKAS, "--at", AT, "--format", "json"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let pose = ran.json();
    assert_eq!(keys(&pose), ["schema", "nominal", "actual", "deviation", "budget", "diagnostics"]);
    assert_eq!(pose["schema"], "trueaxis/pose/1");
    assert_eq!(keys(&pose["nominal"]), ["tip_mm", "axis"]);
    assert_eq!(keys(&pose["actual"]), ["tip_mm", "axis"]);
    near(&numbers(&pose["deviation"]["tip_um"]), &TIP_UM, 1e-9);
    near(&numbers(&pose["deviation"]["axis_urad"]), &AXIS_URAD, 1e-9);
    // The budget sums to the whole within second order: 500 µrad of 500 µrad over 1 m.
    let budget = pose["budget"].as_array().expect("a list");
    assert_eq!(budget.len(), 72);
    assert_eq!(keys(&budget[0]), ["error", "tip_um", "axis_urad"]);
    for (name, whole) in [("tip_um", TIP_UM), ("axis_urad", AXIS_URAD)] {
        let mut sum = [0.0; 3];
        for share in budget {
            for (total, part) in sum.iter_mut().zip(numbers(&share[name])) {
                *total += part;
            }
        }
        near(&sum, &whole, 0.25);
    }
    for (i, nominal) in numbers(&pose["nominal"]["tip_mm"]).into_iter().enumerate() {
        let actual = number(&pose["actual"]["tip_mm"][i]);
        assert!(((actual - nominal) * 1e3 - TIP_UM[i]).abs() < 1e-8);
    }
}

#[test]
fn pose_as_text() {
    let ran = trueaxis(&["pose", XKAS, "--at", AT, "--bodies"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    for line in [
        "XKAS2525x60",
        "w b X Y Z C A t",
        "deviation 35.134 -20.773 11.643 µm",
        "axis, nominal -0.4226183 0.0000000 0.9063078",
        "Bodies in the machine frame",
    ] {
        let shown = ran.out.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" "));
        assert!(shown.into_iter().any(|l| l.starts_with(line)), "{line}\n{}", ran.out);
    }
    let zero = |word: &str| word.starts_with('-') && word[1..].chars().all(|c| "0.".contains(c));
    let signed: Vec<_> = ran.out.split_whitespace().filter(|w| w.len() > 1 && zero(w)).collect();
    assert!(signed.is_empty(), "{signed:?}");
}

#[test]
fn pose_with_other_tools_and_approach() {
    let tip = |arguments: &[&str]| {
        let ran = trueaxis(&[&["pose", MILL, "--format", "json"], arguments].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        (numbers(&ran.json()["nominal"]["tip_mm"]), numbers(&ran.json()["deviation"]["tip_um"]))
    };
    // The mill: table zero 100 mm up, spindle 600 mm up, so a 120 mm tool ends at 380 mm.
    near(&tip(&["--at", "X=10"]).0, &[10.0, 0.0, 380.0], 1e-12);
    near(&tip(&["--at", "X=10", "--tool", "endmill-10"]).0, &[10.0, 0.0, 380.0], 1e-12);
    near(&tip(&["--at", "X=10", "--tool-length", "100"]).0, &[10.0, 0.0, 400.0], 1e-12);
    near(&tip(&["--at", "X=10", "--tool-length", "-5"]).0, &[10.0, 0.0, 505.0], 1e-12);
    // Reversal 1.2 µm of EXX: half to each side, and the table moves by +X, the tool by -X.
    let [from_below, from_above] = ["X=+", "X=-"].map(|a| tip(&["--at", "X=10", "--approach", a]));
    let mean = tip(&["--at", "X=10"]);
    near(&[from_below.1[0] - mean.1[0]], &[-0.6], 1e-9);
    near(&[from_above.1[0] - mean.1[0]], &[0.6], 1e-9);
}

#[test]
fn poses_in_a_batch_are_the_single_pose() {
    let file = "examples/01_describe/positions.csv";
    let ran = trueaxis(&["pose", XKAS, "--at-file", file, "--format", "json"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let document = ran.json();
    assert_eq!(keys(&document), ["schema", "rows", "diagnostics"]);
    let row = &document["rows"][0];
    let names = ["dev_x_um", "dev_y_um", "dev_z_um"];
    near(&names.map(|n| number(&row[n])), &TIP_UM, 1e-9);
    let names = ["dev_i_urad", "dev_j_urad", "dev_k_urad"];
    near(&names.map(|n| number(&row[n])), &AXIS_URAD, 1e-9);
    // The CSV table carries the same doubles.
    let csv = trueaxis(&["pose", XKAS, "--at-file", file]);
    assert_eq!((csv.status, csv.err.as_str()), (0, ""));
    let mut lines = csv.out.lines();
    let heads: Vec<&str> = lines.next().expect("headings").split(',').collect();
    assert_eq!(heads[..5], ["X", "Y", "Z", "C", "A"]);
    assert_eq!(heads[5..], keys(row)[5..]);
    assert!(csv.out.contains("\n3000,1200,-700,-90,15,"), "{}", csv.out);
    let rows = document["rows"].as_array().expect("a list");
    assert_eq!(lines.clone().count(), rows.len());
    for (line, row) in lines.zip(rows) {
        let fields: Vec<f64> = line.split(',').map(|f| f.parse().expect("a number")).collect();
        assert_eq!(fields, keys(row).iter().map(|k| number(&row[*k])).collect::<Vec<_>>());
    }
}

#[test]
fn outside_the_travel_is_a_warning_beside_the_answer() {
    let folder = Folder::new("outside");
    let table = folder.file("far.csv", "\u{feff}X,Y\r\n10,0\r\n400,0\r\n500,0\r\n");
    let single = trueaxis(&["pose", MILL, "--at", "X=400", "--format", "json"]);
    assert_eq!((single.status, &single.json()["schema"]), (0, &"trueaxis/pose/1".into()));
    assert!(single.err.contains("warning[outside-travel]: the position of X"), "{}", single.err);
    let batch = trueaxis(&["pose", MILL, "--at-file", &table, "--format", "json"]);
    assert_eq!((batch.status, batch.json()["rows"].as_array().map(Vec::len)), (0, Some(3)));
    assert!(batch.err.contains("in 2 of 3 rows"), "{}", batch.err);
    assert!(batch.err.contains("far.csv:3:1"), "{}", batch.err);
    // The pose is reached, but not by this machine: entries are marked, and the user is informed.
    let solved = trueaxis(&["solve", I5, "--tip", "0 0 0", "--axis", "0 0 -1", "--format", "json"]);
    assert_eq!(
        (solved.status, &solved.json()["solutions"][0]["within_limits"]),
        (0, &false.into())
    );
    assert!(solved.err.contains("warning[outside-travel]"), "{}", solved.err);
}

/// From oracles/solve.py.
const BEST: [(&str, f64); 5] = [
    ("C", 56.30993247402021),
    ("A", 21.190997441077872),
    ("X", 22.188007849009164),
    ("Y", 26.082033404284996),
    ("Z", 59.60217983589249),
];

#[test]
fn oracle_solve_as_json() {
    let target = ["--tip", "10 20 30", "--axis", "0.3 -0.2 0.93"];
    let ran = trueaxis(&[&["solve", I5, "--format", "json"], &target[..]].concat());
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let document = ran.json();
    assert_eq!(document["schema"], "trueaxis/solve/1");
    assert_eq!(document["singular"], false);
    let solutions = document["solutions"].as_array().expect("a list");
    assert_eq!(solutions.len(), 2);
    let best = &solutions[0];
    assert_eq!(keys(best), ["axes", "within_limits", "rotary_travel_deg"]);
    assert_eq!(best["within_limits"], true);
    near(&BEST.map(|(axis, _)| number(&best["axes"][axis])), &BEST.map(|(_, q)| q), 1e-9);
    let travel = BEST[0].1.hypot(BEST[1].1);
    near(&[number(&best["rotary_travel_deg"])], &[travel], 1e-9);
    let text = trueaxis(&[&["solve", I5], &target[..]].concat());
    let mut lines = text.out.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" "));
    let found = lines.any(|l| l.starts_with("1 56.309932 21.190997 22.188008"));
    assert!(found, "{}", text.out);
}

/// Upright every angle of C does; where its travel leaves 0 out, it stands at the end next to 0.
#[test]
fn a_singular_pose_lies_within_the_travel() {
    let folder = Folder::new("solve-singular");
    let machine = folder.file(
        "m.toml",
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z C A t\"\n[axis.A]\ntravel = [\"-100 deg\", \"100 deg\"]\n\
         [axis.C]\ntravel = [\"10 deg\", \"90 deg\"]\n[tool]\nlength = \"10 mm\"\n",
    );
    let target = ["--tip", "0 0 0", "--axis", "0 0 1", "--format", "json"];
    let ran = trueaxis(&[&["solve", machine.as_str()], &target[..]].concat());
    let document = ran.json();
    let axes = &document["solutions"][0]["axes"];
    near(&[number(&axes["C"]), number(&axes["A"])], &[10.0, 0.0], 1e-9);
    assert_eq!(
        (ran.status, &document["solutions"][0]["within_limits"]),
        (0, &true.into()),
        "{}",
        ran.err
    );
}

#[test]
fn a_singular_pose_keeps_the_last_angle() {
    let target = ["--tip", "0 0 0", "--axis", "0 0 1", "--from", "C=33 A=5"];
    let ran = trueaxis(&[&["solve", I5, "--format", "json"], &target[..]].concat());
    assert_eq!(ran.status, 0);
    assert!(
        ran.err.starts_with("warning[singular-pose]: C turns about the tool axis"),
        "{}",
        ran.err
    );
    let document = ran.json();
    assert_eq!((&document["singular"], &document["held_axis"]), (&true.into(), &"C".into()));
    let axes = &document["solutions"][0]["axes"];
    near(&[number(&axes["C"]), number(&axes["A"])], &[33.0, 0.0], 1e-9);
    let text = trueaxis(&[&["solve", I5], &target[..]].concat());
    assert!(text.out.contains("singular pose: C turns about the tool axis"), "{}", text.out);
}

#[test]
fn a_path_is_solved_as_a_whole() {
    let file = "examples/01_describe/path.csv";
    let csv = trueaxis(&["solve", I5, "--path", file]);
    assert_eq!((csv.status, csv.err.as_str()), (0, ""));
    let rows: Vec<Vec<f64>> = csv
        .out
        .lines()
        .skip(1)
        .map(|l| l.split(',').map(|f| f.parse().expect("a number")).collect())
        .collect();
    assert_eq!(rows.len(), 13);
    // Once around in steps of 30 degrees: C goes on turning and never swings back.
    for pair in rows.windows(2) {
        assert!((pair[1][0] - pair[0][0] - 30.0).abs() < 1e-6, "{pair:?}");
    }
    let document = trueaxis(&["solve", I5, "--path", file, "--format", "json"]).json();
    assert_eq!(document["rows"].as_array().map(Vec::len), Some(13));
    let axes = &document["rows"][12]["axes"];
    assert_eq!(["C", "A", "X", "Y", "Z"].map(|a| number(&axes[a])).to_vec(), rows[12]);
}

#[test]
fn check_says_what_it_is_and_what_it_lacks() {
    let ran = trueaxis(&["check", XKAS]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    for line in [
        "XKAS2525x60\n  chain   w b X Y Z C A t\n",
        "  axis   carries   direction                         travel    fastest",
        "  X      tool      (1.0000 0.0000 0.0000)      0 .. 6200 mm   15 m/min",
        "  C      tool      (0.0000 0.0000 1.0000)   -360 .. 360 deg   60 deg/s",
        "  42 location errors, 30 error motions",
        "  Nothing that a prediction needs is missing.",
    ] {
        assert!(ran.out.contains(line), "{line}\n{}", ran.out);
    }
    let document = trueaxis(&["check", XKAS, "--format", "json"]).json();
    assert_eq!(
        (&document["schema"], &document["usable"]),
        (&"trueaxis/check/1".into(), &true.into())
    );
    assert_eq!(document["chain"], "w b X Y Z C A t");
    assert_eq!(document["axes"][4]["travel_deg"], serde_json::json!([-105.0, 105.0]));
    assert_eq!(document["errors"].as_array().map(Vec::len), Some(72));
    assert_eq!(document["lacks"].as_array().map(Vec::len), Some(0));
    // What a machine does not state is said.
    let ran = trueaxis(&["check", "machines/lei-hsu-mill/machine.toml"]);
    assert!(ran.out.contains("Missing") && ran.out.contains("travel of"), "{}", ran.out);
}

#[test]
fn every_shipped_machine_is_usable() {
    for folder in std::fs::read_dir(root().join("machines")).expect("machines").flatten() {
        let file = folder.path().join("machine.toml").display().to_string();
        let ran = trueaxis(&["check", &file]);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""), "{file}");
        assert!(ran.out.lines().all(|l| l.chars().count() <= 100), "{}", ran.out);
    }
}

/// Our key of an index and that of the oracle.
const INDICES: [(&str, &str, &str); 10] = [
    ("paper", "roundness_eq18_mm", "paper_roundness"),
    ("paper", "angularity_eq19_mm", "paper_angularity"),
    ("paper", "coaxiality_eq20_mm", "paper_coaxiality"),
    ("paper", "coaxiality_diameter_mm", "paper_coaxiality_diameter"),
    ("iso", "roundness_lsc_mm", "iso_roundness_lsc"),
    ("iso", "roundness_mzc_mm", "iso_roundness_mzc"),
    ("iso", "roundness_mic_mm", "iso_roundness_mic"),
    ("iso", "roundness_mcc_mm", "iso_roundness_mcc"),
    ("iso", "coaxiality_lsc_mm", "iso_coaxiality"),
    ("iso", "angularity_zone_mm", "iso_angularity_zone"),
];

#[test]
fn oracle_prediction_as_json() {
    let folder = Folder::new("json");
    let page = folder.path("report.html");
    let options = ["--format", "json", "--samples", "0", "--report", &page];
    let ran = trueaxis(&[&["predict", STUDY], &options[..]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert_eq!(ran.err, format!("report: {page}\n"));
    let ours = ran.json();
    let golden = root().join("crates/trueaxis/tests/data/nas979-xkas2525.json");
    let golden: Value =
        serde_json::from_str(&std::fs::read_to_string(golden).expect("a file")).expect("JSON");
    assert_eq!((&ours["schema"], &ours["verdict"]), (&"trueaxis/predict/1".into(), &"pass".into()));
    assert_eq!(keys(&ours["indices"]), ["paper", "iso", "volumetric_max_mm"]);
    assert_eq!(keys(&ours["indices"]["paper"]).len() + keys(&ours["indices"]["iso"]).len(), 10);
    let same = |ours: &Value, theirs: &Value| {
        assert_eq!(keys(ours), ["value", "u_mm"]);
        near(&[number(&ours["value"])], &[number(&theirs["value"])], 1e-10);
        near(&[number(&ours["u_mm"])], &[number(&theirs["u_linear_step_1"])], 1e-9);
    };
    for (family, key, name) in INDICES {
        same(&ours["indices"][family][key], &golden["indices_mm"][name]);
    }
    same(&ours["indices"]["volumetric_max_mm"], &golden["indices_mm"]["volumetric_max"]);
    for axis in ["X", "Y", "Z", "C", "A"] {
        let (ours, theirs) = (&ours["setting_command"][axis], &golden["setting_command"][axis]);
        near(&[number(ours)], &[number(theirs)], 1e-9);
    }
    let budget = ours["blame"].as_array().expect("a list");
    assert_eq!(budget.len(), 72 * 11);
    let share = budget
        .iter()
        .find(|s| s["error"] == "EA0A" && s["index"] == "coaxiality_lsc_mm")
        .expect("the share of EA0A");
    assert_eq!(keys(share), ["error", "index", "alone_mm", "without_mm"]);
    let theirs = &golden["blame"]["EA0A"]["iso_coaxiality"];
    for key in ["alone_mm", "without_mm"] {
        near(&[number(&share[key])], &[number(&theirs[key])], 1e-9);
    }
    let positions = ours["positions"].as_array().expect("a list");
    assert_eq!(positions.len(), 4);
    for (k, position) in positions.iter().enumerate() {
        let theirs = &golden["indices_all_positions_mm"][format!("iso_roundness_lsc@{}", k + 1)];
        let ours = &position["iso"]["roundness_lsc_mm"]["value"];
        near(&[number(ours)], &[number(&theirs["value"])], 1e-10);
    }
}

#[test]
fn prediction_as_text_and_its_report() {
    let folder = Folder::new("text");
    let page = folder.path("report.html");
    let options = ["--samples", "200", "--seed", "7", "--report", &page];
    let ran = trueaxis(&[&["predict", STUDY], &options[..]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert_eq!(folder.names(), ["report.html"]);
    for line in [
        "NAS979 frustum on the XKAS2525x60\n",
        "PASS: the part will be in tolerance",
        "Error budget",
        "zero touched with the tool along the cone axis",
    ] {
        assert!(ran.out.contains(line), "{line}\n{}", ran.out);
    }
    let line = ran.out.lines().find(|l| l.starts_with("  coaxiality, diameter")).expect("a line");
    let words: Vec<&str> = line.split_whitespace().collect();
    assert_eq!((words[2], words.last()), ("77.51", Some(&"pass")));
    assert!(words.contains(&"100.00"), "{line}");
    let html = std::fs::read_to_string(&page).expect("a report");
    assert!(html.starts_with("<!DOCTYPE html>") && html.trim_end().ends_with("</html>"));
    for foreign in ["http://", "https://", "<script", "src=", "@import", "url(http"] {
        let clean = html.replace("http://www.w3.org/", "");
        assert!(!clean.contains(foreign), "{foreign}");
    }
    // The same seed, the same bits; a report may be written over a report.
    let json = |seed: &str| {
        let options = ["--samples", "200", "--seed", seed, "--report", &page, "--format", "json"];
        trueaxis(&[&["predict", STUDY], &options[..]].concat()).out
    };
    assert_eq!(json("7"), json("7"));
    assert_ne!(json("7"), json("8"));
}

#[test]
fn a_failing_part_is_exit_status_1() {
    let folder = Folder::new("fail");
    let page = folder.path("fail.html");
    let study = "examples/03_predict/nas979-head-out-of-square.toml";
    let ran = trueaxis(&["predict", study, "--samples", "0", "--report", &page]);
    assert_eq!((ran.status, ran.err), (1, format!("report: {page}\n")));
    assert!(ran.out.contains("FAIL: the part will be out of tolerance"), "{}", ran.out);
    assert!(ran.out.contains("shim EA0A by"), "{}", ran.out);
    assert_eq!(folder.names(), ["fail.html"]);
    let ran = trueaxis(&["predict", study, "--samples", "0", "--no-report", "--format", "json"]);
    assert_eq!((ran.status, ran.err.as_str()), (1, ""));
    assert_eq!(ran.json()["verdict"], "fail");
}

#[test]
fn help_and_version() {
    for (verb, word) in [
        ("check", "Exit status"),
        ("pose", "--at-file"),
        ("solve", "--path"),
        ("predict", "--report"),
    ] {
        let ran = trueaxis(&[verb, "--help"]);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""));
        assert!(ran.out.contains(&format!("  trueaxis {verb} ")), "an example: {}", ran.out);
        assert!(ran.out.contains(word), "{}", ran.out);
    }
    let version = trueaxis(&["--version"]);
    assert_eq!(version.out, format!("trueaxis {}\n", env!("CARGO_PKG_VERSION")));
    let alone = trueaxis(&[]);
    assert_eq!((alone.status, alone.out.as_str()), (2, ""));
    assert!(alone.err.contains("Usage: trueaxis [OPTIONS] [COMMAND]"), "{}", alone.err);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = Folder::new("pipe");
    let rows: String = (0..20_000).map(|i| format!("{},0\n", i % 200)).collect();
    let table = folder.file("many.csv", format!("X,Y\n{rows}"));
    let mut child = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
        .args(["pose", MILL, "--at-file", &table])
        .current_dir(root())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut first = String::new();
    let mut reader = BufReader::new(child.stdout.take().expect("a pipe"));
    reader.read_line(&mut first).expect("a line");
    drop(reader);
    let ended = child.wait_with_output().expect("an end");
    assert!(first.starts_with("X,Y,tip_x_mm"), "{first}");
    assert_eq!(
        (ended.status.code(), String::from_utf8_lossy(&ended.stderr).as_ref()),
        (Some(0), "")
    );
}

const GANTRY: &str = "machines/gantry-001/machine.toml";

#[test]
fn paper_pose_at_temperatures() {
    // Zhang et al. 2019: 431 − 485.1 and 253.1 − 340.0 µm.
    for (at, temperature, i, machine, workpiece) in [
        ("X=3500 Y=0 Z=0", "scale_x=30.5 workpiece=30.5", 0, 431.0, 485.1),
        ("X=0 Y=2300 Z=0", "scale_y=31.2 workpiece=31.2", 1, 253.1, 340.032),
    ] {
        let words = ["pose", GANTRY, "--at", at, "--temperature", temperature];
        let ran = trueaxis(&[&words[..], &["--format", "json"]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        let pose = ran.json();
        let of = |value: &Value| numbers(&value["tip_um"])[i];
        let split = &pose["split"];
        assert!((of(&pose["machine"]) - machine).abs() < 1e-9);
        assert!((of(&split["workpiece"]) - workpiece).abs() < 1e-9);
        assert!((of(&split["geometric"]) + of(&split["scale"]) - machine).abs() < 1e-9);
        assert!((of(&pose["comprehensive"]) - (machine - workpiece)).abs() < 1e-9);
        assert_eq!(of(&pose["deviation"]), of(&pose["comprehensive"]));
        let budget = pose["budget"].as_array().expect("a list").iter();
        assert!((budget.map(of).sum::<f64>() - (machine - workpiece)).abs() < 1e-9);
    }
}

#[test]
fn temperatures_that_cannot_be_are_refused() {
    for (temperature, code) in [
        ("scale_x=305", "impossible-temperature"),
        ("scale_x=86F", "bad-temperature"),
        ("scale_u=30", "unknown-sensor"),
    ] {
        let ran = trueaxis(&["pose", GANTRY, "--at", "X=1", "--temperature", temperature]);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""));
        assert!(ran.err.contains(code), "{}", ran.err);
    }
}

#[test]
fn identify_expansion_of_the_example() {
    let file = "examples/05_identify/y-axis-two-temperatures.toml";
    let found = trueaxis(&["identify", "expansion", file, "--format", "json"]).json();
    assert_eq!(found["schema"], "trueaxis/identify/1");
    let (alpha, u) = (number(&found["expansion_um_per_m_k"]), number(&found["u_um_per_m_k"]));
    assert!((alpha - 8.6).abs() < u && (0.2..0.3).contains(&u), "{alpha} {u}");
    assert_eq!(found["materials"], serde_json::json!(["glass"]));
}

#[test]
fn paper_holes_of_the_torque_arm() {
    let file = "examples/03_predict/torque-arm.toml";
    let ran = trueaxis(&["predict", file, "--no-report", "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(
        ran.err.contains("COMPENSATING THE MACHINE ALONE MAKES THE PART WORSE: 0.508 mm instead")
    );
    let found = ran.json();
    let sets = found["sets"].as_array().expect("three");
    let worst: Vec<f64> = sets.iter().map(|s| number(&s["worst_mm"])).collect();
    // Whole micrometres leave half of one in each direction, and the little that the error changes
    // over the compensation itself.
    assert!(worst[2] <= 0.5e-3 * 2_f64.sqrt() + 1e-6, "{worst:?}");
    assert!(worst[1] > worst[0] && worst[0] > 0.046);
    let first = &sets[1]["holes"][0];
    // Machine-only at (3300, 1150): the residual error is the growth, 13.2e-6 · 10.8 K · p.
    let left = numbers(&first["error_um"]);
    near(&left[..2], &[-470.448, -163.944], 0.51);
    assert_eq!(sets[0]["holes"].as_array().map(Vec::len), Some(32));
}

#[test]
fn holes_over_a_log_leave_a_report() {
    let folder = Folder::new("shift");
    let page = folder.path("shift.html");
    let file = "examples/03_predict/torque-arm-over-a-shift.toml";
    let ran = trueaxis(&["predict", file, "--report", &page, "--format", "json"]);
    assert!(ran.status <= 1 && ran.err.contains("report: "), "{}", ran.err);
    let found = ran.json();
    let sets = |key: &str| found[key].as_array().map_or(0, Vec::len);
    assert_eq!((sets("sets"), sets("sets_at_start")), (3, 3));
    // Three hours in 32 shares, each hole in the middle of its own.
    near(&[number(&found["sets"][0]["holes"][0]["time_s"])], &[10_800.0 / 64.0], 1e-9);
    // The tables are known to 2 µm each.
    assert!(number(&found["sets"][0]["u_worst_mm"]) > 0.001);
    let page = std::fs::read_to_string(page).expect("a report");
    for words in
        ["<svg", "arrows magnified ", "WARNING", "MAKES THE PART WORSE", "u, µm", "after, s"]
    {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn simulations_over_a_log_tell_the_drift() {
    let folder = Folder::new("drift");
    let log = "time_s,scale_x_degC,scale_y_degC,workpiece_degC\n0,24,24,24\n9000,33,30,25\n";
    let log = folder.file("hall.csv", log);
    let program = "G21 G90 G94\nG1 X3000 Y1000 F2000\nG1 X0 Y0\nM30\n";
    let program = folder.file("part.nc", program);
    let of = |time: &str, value: &str| {
        let log = ["--temperature-log", &log, time, value];
        let words = [&["simulate", GANTRY, &program, "--no-report", "--format", "json"], &log[..]];
        trueaxis(&words.concat())
    };
    let found = of("--log-start", "1 h").json();
    let reported = &found["temperatures"];
    assert_eq!((number(&reported["from_s"]), &reported["log"]), (3600.0, &serde_json::json!(log)));
    near(&[number(&reported["sensors"]["scale_x"]["lowest_degC"])], &[27.6], 1e-9);
    // 9 K in 9000 s: in about 95 s at X = 3000 a tenth of a kelvin, 3 µm less what the workpiece
    // takes along.
    assert!((1.0..5.0).contains(&number(&reported["drift_um"]["value"])), "{reported}");
    let held = of("--log-time", "3600").json();
    assert!(held["temperatures"].is_null());
    let late = of("--log-start", "8950");
    assert_eq!(late.status, 2);
    assert!(late.err.contains("error[log-ends]") && late.err.contains("part.nc:2"), "{}", late.err);
    let outside = of("--log-start", "-5");
    assert!(outside.status == 2 && outside.err.contains("error[outside-log]"), "{}", outside.err);
    let both = trueaxis(&[
        "simulate",
        GANTRY,
        &program,
        "--temperature-log",
        &log,
        "--log-time",
        "1",
        "--log-start",
        "1",
    ]);
    assert_eq!(both.status, 2);
}
