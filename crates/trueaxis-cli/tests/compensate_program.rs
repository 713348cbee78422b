//! `trueaxis compensate program` as a user sees it, with what must be refused.

mod command;

use command::{Folder, trueaxis};
use serde_json::Value;

const MACHINE: &str = "machines/xkas2525/machine.toml";
const FRUSTUM: &str = "examples/06_compensate/frustum.mpf";

fn compensate(more: &[&str]) -> command::Ran {
    let mut all = vec!["compensate", "program"];
    all.extend(more);
    trueaxis(&all)
}

#[test]
fn the_document_has_the_agreed_keys() {
    let folder = Folder::new("program-json");
    let (out, report) = (folder.path("c.mpf"), folder.path("r.html"));
    let ran = compensate(&[MACHINE, FRUSTUM, "-o", &out, "--report", &report, "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/compensate-program/1");
    assert_eq!(found["blocks"], 724);
    assert_eq!(found["proved"], true);
    assert_eq!(found["left"]["rapid from which no cut begins"], 1);
    for key in ["tip_at_ends_um", "axis_at_ends_urad", "tip_between_um", "axis_between_urad"] {
        let [before, after] =
            ["before", "after"].map(|when| found[when][key]["value"].as_f64().unwrap());
        assert!(before > 50.0 && after < 2.0, "{key}: {before} {after}");
    }
    let row = |i: usize| found["convention_check"][i].clone();
    assert_eq!([0, 1].map(|i| row(i)["what"].clone()), ["no correction", "all signs wrong"]);
    let [none, all] = [0, 1].map(|i| row(i)["tip_um"].as_f64().unwrap());
    // Errors hardly change over a correction: the wrong signs leave twice what is there without.
    assert!(none > 40.0 && (all / none - 2.0).abs() < 0.01, "{none} {all}");
    let page = std::fs::read_to_string(&report).unwrap();
    assert!(page.starts_with("<!doctype html>") || page.starts_with("<!DOCTYPE html>"));
    // Words that say nothing of places, and comments, are as they were.
    let [was, is] = [command::root().join(FRUSTUM), out.clone().into()]
        .map(|path| std::fs::read_to_string(path).unwrap());
    assert!(is.starts_with("; TRUEAXIS COMPENSATED FOR XKAS2525x60"));
    for (a, b) in was.lines().zip(is.lines().skip(1)) {
        let fixed = |line: &str| {
            let words: Vec<String> = line
                .split(' ')
                .filter(|w| !w.starts_with(['X', 'Y', 'Z']) && !w.contains("3="))
                .map(str::to_owned)
                .collect();
            words.join(" ")
        };
        assert_eq!(fixed(a), fixed(b));
    }
    let again = compensate(&[MACHINE, &out, "-o", &folder.path("d.mpf")]);
    assert_eq!(again.status, 2);
    assert!(again.err.contains("already-compensated"), "{}", again.err);
}

#[test]
fn the_compensated_frustum_is_better_by_more_than_fifty() {
    let folder = Folder::new("program-frustum");
    let ran =
        compensate(&[MACHINE, FRUSTUM, "-o", &folder.path("frustum-comp.mpf"), "--no-rounding"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let root = command::root().canonicalize().unwrap().display().to_string();
    let study = std::fs::read_to_string(
        command::root().join("examples/06_compensate/frustum-compensated.toml"),
    );
    let study = study
        .unwrap()
        .replace("\"../../frustum-comp.mpf\"", "\"frustum-comp.mpf\"")
        .replace("../..", &root)
        .replace("samples = 10000", "samples = 0");
    let path = folder.path("study.toml");
    std::fs::write(&path, study).unwrap();
    let ran = trueaxis(&["predict", &path, "--no-report", "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    let (mut before, mut after) = (Vec::new(), Vec::new());
    leaves(&found["variants"][0]["indices_mm"], &mut before);
    leaves(&found["indices"], &mut after);
    assert_eq!(before.len(), after.len());
    for (before, after) in before.iter().zip(&after) {
        assert!(after.abs() <= 0.02 * before.abs(), "{before} -> {after} mm");
    }
    assert!(before.len() >= 10);
}

/// The values of all indices, in the order of the document.
fn leaves(found: &Value, values: &mut Vec<f64>) {
    match (found, found.get("value")) {
        (Value::Number(number), _) => values.extend(number.as_f64()),
        (_, Some(value)) => values.extend(value.as_f64()),
        (Value::Object(entries), _) => entries.values().for_each(|v| leaves(v, values)),
        _ => {}
    }
}

/// A program text on a machine: refused with this code, and nothing is written.
fn refused(name: &str, machine: &str, text: &str, more: &[&str], code: &str) {
    ends(2, name, machine, text, more, code);
}

fn ends(status: i32, name: &str, machine: &str, text: &str, more: &[&str], code: &str) {
    let folder = Folder::new(&format!("program-{code}"));
    let (program, out) = (folder.path(name), folder.path("out.nc"));
    std::fs::write(&program, text).unwrap();
    let mut all = vec![machine, &program, "-o", &out];
    all.extend(more);
    let ran = compensate(&all);
    assert_eq!(ran.status, status, "{code}: {}{}", ran.out, ran.err);
    assert!(ran.err.contains(&format!("[{code}]")), "{code}: {}", ran.err);
    assert!(!std::path::Path::new(&out).exists(), "{code}: something was written");
}

const MILL: &str = "machines/three-axis-mill/machine.toml";

#[test]
fn what_cannot_be_corrected_is_named_and_nothing_is_written() {
    let begin = "G21 G90 G94 F500\nG0 X100 Y100 Z-50\n";
    let on_mill = |text: &str, code| {
        refused("a.ngc", MILL, &format!("{begin}{text}\nM2\n"), &["--control", "linuxcnc"], code);
    };
    // The text says millimetres, the call before has said inches.
    let in_a_call = format!("o1 sub\nG20\no1 endsub\n{begin}o1 call\nG1 X5\nM2\n");
    refused("i.ngc", MILL, &in_a_call, &["--control", "linuxcnc"], "inch-program");
    on_mill("G84 X100 Y100 Z-60 R-45", "not-unrolled");
    let end = format!("{begin}G1 X300 Y150 Z0\nM2\n");
    refused("t.ngc", MILL, &end, &[], "correction-leaves-travel");
    on_mill("G1 Xnan", "missing-value");
    refused(
        "b.ngc",
        MILL,
        &format!("{begin}G1 X150\nM2\n"),
        &["--limit", "0.1 um"],
        "correction-too-large",
    );
    refused(
        "c.ngc",
        MILL,
        &format!("{begin}G1 X150\nM2\n"),
        &["--increment", "5 deg"],
        "bad-number",
    );
    refused("d.ngc", MILL, &format!("{begin}G1 X150\nM2\n"), &["--residual=-1 um"], "bad-number");
    refused("e.ngc", MILL, "", &[], "empty-program");
}

#[test]
fn loops_are_unrolled() {
    let folder = Folder::new("program-flat");
    let (program, out) = (folder.path("loop.ngc"), folder.path("flat.ngc"));
    let text = "G21 G90 G94 F500\nG0 X100 Y100 Z-50\no1 repeat [2] (twice)\nG91 G1 X[60/2] (along)\n\
                G1 Y30\no1 endrepeat\nM2\n";
    std::fs::write(&program, text).unwrap();
    let ran = compensate(&[MILL, &program, "-o", &out]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.err.contains("note[unrolled]"), "{}", ran.err);
    let flat = std::fs::read_to_string(&out).unwrap();
    assert_eq!(flat.matches("(along)").count(), 2, "{flat}");
    assert!(!flat.contains("repeat [") && !flat.contains("X[60"), "{flat}");
}

#[test]
fn the_program_itself_is_not_overwritten() {
    let ran = compensate(&[MACHINE, FRUSTUM, "-o", FRUSTUM]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("is read by this command"), "{}", ran.err);
}

#[test]
fn a_program_that_does_not_keep_the_residual_is_not_written() {
    let folder = Folder::new("program-unproved");
    let (program, out) = (folder.path("p.ngc"), folder.path("out.ngc"));
    // A mill cannot turn its tool: 12 urad stay.
    std::fs::write(&program, "G21 G90 G94 F500\nG0 X100 Y100 Z-50\nG1 X150\nM2\n").unwrap();
    let ran = compensate(&[MILL, &program, "-o", &out, "--residual-axis", "1 urad"]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert!(ran.err.contains("[not-proved]") && ran.out.contains("NOT PROVED"), "{}", ran.err);
    assert!(!std::path::Path::new(&out).exists());
    let asked = [MILL, &program, "-o", &out, "--residual-axis", "1 urad", "--keep-unproved"];
    assert_eq!(compensate(&asked).status, 1);
    assert!(!std::path::Path::new(&out).exists());
    let kept = std::fs::read_to_string(folder.path("out.unproved.ngc")).unwrap();
    assert!(kept.starts_with("(TRUEAXIS COMPENSATED NOT PROVED"), "{kept}");
    assert_eq!(compensate(&[MILL, &program, "-o", &out]).status, 0);
}

/// The same program in millimetres and in inches, for each control.
const BOTH_UNITS: [(&str, &str, &str); 4] = [
    (
        "p.ngc",
        "G21\nG90 G94 F508\nG0 X25.4 Y25.4 Z-25.4\nG1 X127 Y50.8\nG2 X152.4 Y76.2 I0 J25.4\nG91 G1 X25.4 Y12.7\nG90 G81 X101.6 \
         Y76.2 Z-50.8 R-38.1\nG80\nG0 Z-25.4\nM2\n",
        "G20\nG90 G94 F20\nG0 X1 Y1 Z-1\nG1 X5 Y2\nG2 X6 Y3 I0 J1\nG91 G1 X1 Y0.5\nG90 G81 X4 \
         Y3 Z-2 R-1.5\nG80\nG0 Z-1\nM2\n",
    ),
    (
        "p.nc",
        "%\nO1\nG21 G90 G94 F508.\nG0 X25.4 Y25.4 Z-25.4\nG1 X127. Y50.8\nG2 X152.4 Y76.2 R25.4\nG1 X25.4\nM30\n%\n",
        "%\nO1\nG20 G90 G94 F20.\nG0 X1. Y1. Z-1.\nG1 X5. Y2.\nG2 X6. Y3. R1.\nG1 X1.\nM30\n%\n",
    ),
    (
        "p.mpf",
        "G710 G90 G94 F508\nG0 X25.4 Y25.4 Z-25.4\nG1 X127 Y50.8\nG2 X152.4 Y76.2 CR=25.4\nG1 X=IC(25.4)\nM30\n",
        "G700 G90 G94 F20\nG0 X1 Y1 Z-1\nG1 X5 Y2\nG2 X6 Y3 CR=1\nG1 X=IC(1)\nM30\n",
    ),
    (
        "p.h",
        "0 BEGIN PGM P MM\n1 L X+25.4 Y+25.4 Z-25.4 R0 FMAX\n2 L X+127 Y+50.8 F508\n3 L IX+25.4\n4 M30\n5 END PGM P MM\n",
        "0 BEGIN PGM P INCH\n1 L X+1 Y+1 Z-1 R0 FMAX\n2 L X+5 Y+2 F200\n3 L IX+1\n4 M30\n5 END PGM P INCH\n",
    ),
];

/// The places and times of a program: X, Y, Z in mm, the time of the whole in s.
fn places(folder: &Folder, program: &str) -> (Vec<[f64; 3]>, f64) {
    let table = folder.path("places.csv");
    let words = ["simulate", MILL, program, "--no-report", "--path", &table, "--format", "json"];
    let time_s = trueaxis(&words).json()["time_s"].as_f64().expect("a time");
    let text = std::fs::read_to_string(&table).expect("the table");
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = rows.next().expect("a head");
    let column = |name: &str| names.iter().position(|n| *n == name).expect("a column");
    let columns = ["X_mm", "Y_mm", "Z_mm"].map(column);
    (rows.map(|row| columns.map(|i| row[i].parse().expect("a number"))).collect(), time_s)
}

#[test]
fn inches_are_compensated_like_millimetres() {
    for (name, metric, inch) in BOTH_UNITS {
        let folder = Folder::new(&format!("units-{name}"));
        let compensated = [("mm", metric), ("inch", inch)].map(|(unit, text)| {
            let program = folder.path(&format!("{unit}-{name}"));
            let out = folder.path(&format!("{unit}-out-{name}"));
            std::fs::write(&program, text).unwrap();
            let ran = compensate(&[MILL, &program, "-o", &out]);
            assert_eq!(ran.status, 0, "{unit} {name}: {}{}", ran.out, ran.err);
            places(&folder, &out)
        });
        let [(metric, metric_s), (inch, inch_s)] = compensated;
        // Of the same length of way: pieces may be cut at other places.
        let end = |places: &[[f64; 3]]| places[places.len() - 1];
        for (a, b) in end(&metric).iter().zip(end(&inch)) {
            assert!((a - b).abs() < 1.2e-3, "{name}: {a} mm and {b} mm");
        }
        let range = |places: &[[f64; 3]], i: usize| {
            let all = places.iter().map(|p| p[i]);
            [all.clone().fold(f64::INFINITY, f64::min), all.fold(f64::NEG_INFINITY, f64::max)]
        };
        for i in 0..3 {
            for (a, b) in range(&metric, i).iter().zip(range(&inch, i)) {
                assert!((a - b).abs() < 1.2e-3, "{name}: {a} mm and {b} mm");
            }
        }
        assert!((metric_s - inch_s).abs() < 1e-3 * metric_s, "{name}: {metric_s} s and {inch_s} s");
    }
}

/// The words of the contour are corrected, G41 stays, and the centre of the tool keeps the residual.
#[test]
fn radius_compensation_stays_where_the_centre_keeps_its_path() {
    const I5: &str = "machines/i5-engraver/machine.toml";
    const PROGRAM: &str = "examples/06_compensate/everyday-fanuc.nc";
    const SET_UP: &str = "examples/06_compensate/everyday-fanuc.setup.toml";
    let folder = Folder::new("radius");
    let out = folder.path("out.nc");
    let ran = compensate(&[I5, PROGRAM, "--setup", SET_UP, "-o", &out]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let left = ran.err.split("leaves its path by up to ").nth(1).expect("the number");
    let left: f64 = left.split(' ').next().and_then(|n| n.parse().ok()).expect("a number");
    assert!(left > 0.1 && left < 2.0, "{left} µm");
    assert!(std::fs::read_to_string(&out).unwrap().contains("G41 D1"));
    // A tool that does not fit into the lead-in of radius 10.
    let text = std::fs::read_to_string(command::root().join(SET_UP)).unwrap();
    let set_up = folder.path("large.toml");
    std::fs::write(&set_up, text.replace("diameter = \"8 mm\"", "diameter = \"30 mm\"")).unwrap();
    let none = folder.path("none.nc");
    let ran = compensate(&[I5, PROGRAM, "--setup", &set_up, "-o", &none]);
    assert!(ran.status == 2 && ran.err.contains("tool-too-large"), "{}", ran.err);
    assert!(!std::path::Path::new(&none).exists());
}

/// Programs, and the line in which the same program states the radius of its tool.
const CONTOURS: [(&str, &str, [&str; 2]); 3] = [
    (
        "c.nc",
        "G21 G17 G90 G94 G40\nT1 M6\nG54 G0 X-10. Y-10. S1000 M3\nG43 H1 Z5.\nG1 Z-2. F200\nG41 D1 X0 Y0 F500\n\
         Y20.\nG2 X20. Y20. I10. J0\nG1 Y0 M8\nX0\nG40 X-10. Y-10.\nG0 Z50. M9\nM30\n",
        ["T1 M6\n", "T1 M6\nG10 L12 P1 R3.\n"],
    ),
    (
        "c.mpf",
        "T1 D1\nM6\nG71 G17 G90 G94 F500 G54\nG0 X-10 Y-10 Z5 S1000 M3\nG1 Z-2\nG41 G1 X0 Y0\nY20\n\
         G2 X20 Y20 I10 J0\nG1 Y0 M8\nX0\nG40 X-10 Y-10\nG0 Z50 M9\nM30\n",
        ["T1 D1\n", "$TC_DP6[1,1]=3\nT1 D1\n"],
    ),
    (
        "c.h",
        "0 BEGIN PGM C MM\n1 TOOL CALL 1 Z S1000 F500\n2 L X-10 Y-10 Z+5 R0 FMAX M3\n3 L Z-2 F200\n\
         4 APPR LCT X+0 Y+10 R5 RL F500\n5 L Y+20\n6 CC X+10 Y+20\n7 C X+20 Y+20 DR-\n8 L Y+0 M8\n9 L X+0\n\
         10 L Y+10\n11 DEP LCT X-10 Y-10 R5\n12 L Z+50 R0 FMAX M9\n13 END PGM C MM\n",
        ["1 TOOL CALL", "TOOL DEF 1 L+100 R+3\n1 TOOL CALL"],
    ),
];

/// Arcs that become lines do not keep the residual along the contour: the path of the centre is written.
#[test]
fn the_path_of_the_centre_is_written_where_the_contour_does_not_do() {
    const SET_UP: &str = "workpiece_at = \"G54\"\n[work_offset.G54]\nX = \"100 mm\"\nY = \"100 mm\"\n\
         Z = \"-450 mm\"\n[tool.1]\nlength = \"100 mm\"\n";
    let with_diameter = format!("{SET_UP}diameter = \"6 mm\"\n");
    for (name, text, [line, stated]) in CONTOURS {
        centre_is_written(name, text, &with_diameter);
        centre_is_written(name, &text.replace(line, stated), SET_UP);
    }
    // LinuxCNC's G41.1 states it in the block itself; its contour keeps the residual.
    let folder = Folder::new("direct");
    let program = folder.file("c.ngc", CONTOURS[0].1.replace("G41 D1", "G41.1 D6"));
    let (set_up, out) = (folder.file("s.toml", SET_UP), folder.path("out.ngc"));
    let ran = compensate(&[MILL, &program, "--setup", &set_up, "-o", &out, "--residual", "2 um"]);
    assert!(ran.status == 0 && ran.err.contains("radius-compensation-kept"), "{}", ran.err);
}

fn centre_is_written(name: &str, text: &str, set_up: &str) {
    let folder = Folder::new(&format!("centre-{name}"));
    let program = folder.file(name, text);
    let set_up = folder.file("s.toml", set_up);
    let out = folder.path(&format!("out-{name}"));
    let words = [MILL, &program, "--setup", &set_up, "-o", &out, "--residual", "2 um"];
    let ran = compensate(&words);
    assert_eq!(ran.status, 0, "{name}: {}{}", ran.out, ran.err);
    assert!(ran.err.contains("radius-compensation-removed"), "{name}: {}", ran.err);
    let written = std::fs::read_to_string(&out).unwrap();
    assert!(!["G41", "RL", "APPR"].iter().any(|w| written.contains(w)), "{name}: {written}");
    assert!(written.contains("M8") && written.contains("M9"), "{name}: {written}");
    // The tool of radius 3 goes round an arc of radius 10 about (10, 20), within the errors of the machine.
    let path = folder.path("path.csv");
    let simulate = ["simulate", MILL, &out, "--setup", &set_up, "--no-report", "--path", &path];
    assert_eq!(trueaxis(&simulate).status, 0, "{name}");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = rows.next().expect("a head");
    let column = |of: &str| head.iter().position(|n| *n == of).expect("a column");
    let [x, y] = ["tip_x_mm", "tip_y_mm"].map(column);
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let farthest = rows.map(|r| (number(r[x]), number(r[y]))).filter(|(_, y)| *y > 20.1);
    let radii: Vec<f64> = farthest.map(|(x, y)| (x - 10.0).hypot(y - 20.0)).collect();
    assert!(radii.len() > 50, "{name}: {}", radii.len());
    assert!(radii.iter().all(|r| (r - 13.0).abs() < 0.02), "{name}: {radii:?}");
}

/// One side of a part that is clamped beside the centre of the table.
const DYNAMIC: &str = "G21 G17 G90 G94 G40 G49\nT1 M6\nG54\nG53 G0 Z0\nG0 A-60. C30.\nG254\n\
    G0 X-10. Y-5. S5000 M3\nG43 H1 Z20.\nG1 Z0 F300\nX10.\nG2 X10. Y5. I0. J5.\nG1 X-10.\nY-5.\nG0 Z20.\n\
    G255\nG53 G0 Z0\nG0 A0 C0\nM30\n";

/// While G254 is on the rotary axes stand, so that only the place can be corrected.
#[test]
fn a_program_with_a_dynamic_work_offset_is_corrected_in_place_alone() {
    const I5: &str = "machines/i5-engraver/machine.toml";
    let folder = Folder::new("dynamic");
    let (program, set_up) = (folder.path("d.nc"), folder.path("d.toml"));
    std::fs::write(&program, DYNAMIC).unwrap();
    let text = "name = \"side\"\ncontrol = \"haas\"\nworkpiece_at = \"G54\"\n[work_offset.G54]\nX = \"12 mm\"\n\
                Y = \"-7 mm\"\nZ = \"-55 mm\"\n[tool.1]\nname = \"mill\"\nlength = \"90 mm\"\n[start]\nZ = \"100 mm\"\n";
    std::fs::write(&set_up, text).unwrap();
    let out = folder.path("out.nc");
    let ran = compensate(&[I5, &program, "--setup", &set_up, "-o", &out]);
    assert!(ran.status == 2 && ran.err.contains("turning-dynamic-offset"), "{}", ran.err);
    assert!(!std::path::Path::new(&out).exists());
    let more = ["--position-only", "--format", "json"];
    let ran = compensate(&[&[I5, &program, "--setup", &set_up, "-o", &out], &more[..]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    assert_eq!(found["proved"], true);
    let tip = |when: &str| found[when]["tip_at_ends_um"]["value"].as_f64().unwrap();
    assert!(tip("before") > 10.0 && tip("after") < 2.0, "{} {}", tip("before"), tip("after"));
    let written = std::fs::read_to_string(&out).unwrap();
    let inside = written.split("G254").nth(1).and_then(|rest| rest.split("G255").next()).unwrap();
    assert!(!inside.contains(['A', 'C']), "{inside}");
}

/// Simulated without places between the ends of blocks, the program as it was has the deviations that the proof states.
#[test]
fn the_deviations_before_are_those_of_the_simulated_path() {
    let folder = Folder::new("program-path");
    let (out, path) = (folder.path("c.mpf"), folder.path("p.csv"));
    let found = compensate(&[MACHINE, FRUSTUM, "-o", &out, "--format", "json"]).json();
    let options = ["--no-report", "--no-densify", "--path", &path];
    let ran = trueaxis(&[&["simulate", MACHINE, FRUSTUM], &options[..]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    let text = std::fs::read_to_string(&path).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let column = |name: &str| names.iter().position(|n| *n == name).unwrap();
    let cut: Vec<_> = lines.filter(|row| row[column("rapid")] == "0").collect();
    assert_eq!(found["ends_compared"], cut.len());
    for (key, unit, axes) in
        [("tip_at_ends", "um", ["x", "y", "z"]), ("axis_at_ends", "urad", ["i", "j", "k"])]
    {
        let square = |row: &Vec<&str>| {
            let values = axes.map(|a| row[column(&format!("dev_{a}_{unit}"))]);
            values.iter().map(|v| v.parse::<f64>().unwrap().powi(2)).sum::<f64>()
        };
        let rms = (cut.iter().map(square).sum::<f64>() / cut.len() as f64).sqrt();
        let stated = |when: &str| found[when][format!("{key}_rms_{unit}")].as_f64().unwrap();
        assert!((stated("before") / rms - 1.0).abs() < 1e-6, "{key}: {} {rms}", stated("before"));
        let largest = found["after"][format!("{key}_{unit}")]["value"].as_f64().unwrap();
        assert!(stated("after") > 0.0 && stated("after") < largest, "{key}");
    }
}
