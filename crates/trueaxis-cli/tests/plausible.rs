//! Slips of the unit: warned of or refused with the value, its unit, its row and the entry that changes the range.

mod command;

use command::{Folder, Ran, root, trueaxis};
use std::fs;

/// Every diagnostic of a run: severity, code, message and hint, place.
fn diagnostics(ran: &Ran) -> Vec<(String, String, String, String)> {
    let document = ran.json();
    let all = document["diagnostics"].as_array().expect("a list").clone();
    let text = |d: &serde_json::Value, key: &str| d[key].as_str().unwrap_or_default().to_owned();
    let of = |d: &serde_json::Value| {
        let words = format!("{} {}", text(d, "message"), text(d, "hint"));
        let file = text(d, "file");
        let place = format!("{}:{}", file.rsplit('/').next().unwrap_or(&file), d["line"]);
        (text(d, "severity"), text(d, "code"), words, place)
    };
    all.iter().map(of).collect()
}

#[track_caller]
fn found(arguments: &[&str], status: i32, severity: &str, code: &str, words: &[&str]) {
    let ran = trueaxis(&[arguments, &["--format", "json"]].concat());
    assert_eq!(ran.status, status, "{}", ran.err);
    let all = diagnostics(&ran);
    let of = all.iter().find(|d| (d.0.as_str(), d.1.as_str()) == (severity, code));
    let (_, _, message, place) = of.unwrap_or_else(|| panic!("{code} is missing: {all:?}"));
    for word in words {
        assert!(message.contains(word) || place == word, "`{word}`: {place}: {message}");
    }
}

const IMPOSSIBLE: &str = "impossible-value";
const IMPLAUSIBLE: &str = "implausible-value";

#[test]
fn readings_under_a_heading_of_the_wrong_unit_are_refused() {
    let words = ["bad-unit.csv:3", "`x_mm` is 29810 µm", "[plausible]: reading_um = "];
    let campaign = "crates/trueaxis-cli/tests/data/bad-unit.toml";
    found(&["identify", campaign], 2, "error", IMPOSSIBLE, &words);

    // Each heading alone; a comment moves the row.
    let folder = Folder::new("plausible-units");
    let readings = fs::read_to_string(root().join("examples/05_identify/probe-ball.csv")).unwrap();
    let campaign = |more: &str| {
        let text = fs::read_to_string(root().join("examples/05_identify/probe-ball.toml")).unwrap();
        let machines = root().join("machines").display().to_string();
        text.replace("../../machines", &machines) + more
    };
    let path = folder.file("probe-ball.toml", campaign(""));
    for axis in ["x", "y", "z"] {
        let heading = format!("{axis}_mm");
        folder.file(
            "probe-ball.csv",
            readings.replacen(&format!("{axis}_um"), &heading, 1).replacen('#', "#\n#", 1),
        );
        found(&["identify", &path], 2, "error", IMPOSSIBLE, &[&heading, "µm"]);
    }
    // Who says that the machine is so is believed.
    let path = folder.file("probe-ball.toml", campaign("[plausible]\nreading_um = 100000\n"));
    let ran = trueaxis(&["identify", &path, "--format", "json"]);
    assert!(diagnostics(&ran).iter().all(|d| d.1 != IMPOSSIBLE && d.1 != IMPLAUSIBLE));
}

#[test]
fn readings_far_below_their_noise_are_of_another_unit() {
    let folder = Folder::new("plausible-small");
    let text = fs::read_to_string(root().join("examples/05_identify/probe-ball.toml")).unwrap();
    let text = text.replace("../../machines", &root().join("machines").display().to_string());
    let path = folder.file("probe-ball.toml", text);
    let readings = fs::read_to_string(root().join("examples/05_identify/probe-ball.csv")).unwrap();
    let mut rows = Vec::new();
    for line in readings.lines().filter(|l| !l.starts_with('#')) {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        for cell in &mut cells[5..8] {
            // Values in mm under the heading in µm.
            *cell = cell.parse::<f64>().map_or(cell.clone(), |um| (um * 1e-3).to_string());
        }
        rows.push(cells.join(","));
    }
    folder.file("probe-ball.csv", rows.join("\n") + "\n");
    let ran = trueaxis(&["identify", &path, "--format", "json"]);
    let all = diagnostics(&ran);
    assert!(all.iter().any(|d| d.1 == "small-readings" && d.2.contains("noise")), "{all:?}");
}

#[test]
fn a_machine_file_with_a_slip_of_the_unit() {
    let folder = Folder::new("plausible-machine");
    let machine = |travel: &str, rest: &str| {
        format!(
            "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[axis.X]\ntravel = [\"0 mm\", \"{travel}\"]\n{rest}"
        )
    };
    let check = |text: String, status, severity, code, words: &[&str]| {
        let path = folder.file("machine.toml", text);
        found(&["check", &path], status, severity, code, words);
    };
    folder.file("X.csv", "# X\nposition_mm,EXX_um\n0,0\n250,100000\n500,3\n");
    let table = "[motion.X]\ntable = \"X.csv\"\n";
    let words = ["X.csv:4", "`EXX_um` is 100000 µm", "position_error_um"];
    check(machine("500 mm", table), 2, "error", IMPOSSIBLE, &words);
    // 8 mm within 20 m are warned of where the travel is 500 mm only.
    folder.file("X.csv", "position_mm,EXX_um\n0,0\n500,8000\n20000,3\n");
    check(machine("500 mm", table), 0, "warning", IMPLAUSIBLE, &["X.csv:3", "8000 µm"]);
    let path = folder.file("machine.toml", machine("20 m", table));
    let all = diagnostics(&trueaxis(&["check", &path, "--format", "json"]));
    assert!(all.iter().all(|d| d.1 != IMPLAUSIBLE), "{all:?}");

    let scale = |alpha: &str, celsius: &str| {
        format!(
            "[scale.X]\nexpansion = \"{alpha}\"\ntable_temperature = \"{celsius}\"\nsensors = {{ x = \"0 mm\" }}\n"
        )
    };
    let text = machine("500 mm", &scale("11.5e-3 1/K", "20 degC"));
    check(text, 2, "error", IMPOSSIBLE, &["machine.toml:7", "11500 µm/(m·K)"]);
    let text = machine("500 mm", &scale("11.5 um/(m K)", "68 degC"));
    check(text, 0, "warning", IMPLAUSIBLE, &["machine.toml:8", "68 °C", "68 °F is 20 °C"]);
    let text = machine("500 mm", &scale("11.5 um/(m K)", "293 degC"));
    check(text, 2, "error", IMPOSSIBLE, &["machine.toml:8", "temperature_celsius"]);
    let location = "[location]\nEC0Y = \"1 deg\"\n";
    check(
        machine("500 mm", location),
        0,
        "warning",
        IMPLAUSIBLE,
        &["machine.toml:7", "17450 µrad"],
    );
    let motion =
        "[motion.X]\nECX = { polynomial = [\"0 urad\", \"0.1 rad\"], scale = \"500 mm\" }\n";
    check(machine("500 mm", motion), 2, "error", IMPOSSIBLE, &["machine.toml:7", "100000 µrad"]);
}

/// 160 m: the collision check of such a tool would not end.
#[test]
fn a_tool_as_long_as_a_hall_is_refused_wherever_it_is_stated() {
    let folder = Folder::new("plausible-tool");
    let words = ["160000 mm", "tool_length_mm"];
    let engraver = "machines/i5-engraver/machine.toml";
    found(
        &["pose", engraver, "--at", "X=1", "--tool-length", "160000"],
        2,
        "error",
        IMPOSSIBLE,
        &words,
    );
    let machine = fs::read_to_string(root().join(engraver)).unwrap();
    let machine =
        folder.file("machine.toml", machine + "\n[tool.library.long]\nlength = \"160 m\"\n");
    found(&["check", &machine], 2, "error", IMPOSSIBLE, &words);
    let setup =
        fs::read_to_string(root().join("examples/02_simulate/ring-fanuc.setup.toml")).unwrap();
    let setup = folder.file("ring.setup.toml", setup.replace("\"90 mm\"", "\"160 m\""));
    let program = "examples/02_simulate/ring-fanuc.nc";
    let simulate = ["simulate", engraver, program, "--setup", &setup, "--no-report"];
    found(&simulate, 2, "error", IMPOSSIBLE, &words);
}

#[test]
fn a_test_of_the_standards_with_a_heading_of_the_wrong_unit() {
    let folder = Folder::new("plausible-standards");
    let laser = fs::read_to_string(root().join("examples/07_verify/x-axis-laser.csv")).unwrap();
    let path = folder.file("laser.csv", laser.replace("deviation_um", "deviation_mm"));
    let words = ["deviation_mm", "µm", "reading_um"];
    // 5.3 mm: far more than of any machine, but a laser can read it.
    found(&["evaluate", "iso230-2", &path], 0, "warning", IMPLAUSIBLE, &words);
    let conditions = folder.file("laser.toml", "[plausible]\nreading_um = 1e6\n");
    let stated = ["evaluate", "iso230-2", &path, "--conditions", &conditions, "--format", "json"];
    let ran = trueaxis(&stated);
    assert_eq!(ran.status, 0, "{}", ran.err);
}

/// A limit of metres lets everything pass: a slip of the unit there decides more than one in a reading.
#[test]
fn a_limit_or_an_uncertainty_with_a_slip_of_the_unit() {
    let laser = "examples/07_verify/x-axis-laser.csv";
    let folder = Folder::new("plausible-limits");
    let file = |limit: &str| {
        folder.file("limits.toml", format!("name = \"x\"\n[tolerance]\nA = \"{limit}\"\n"))
    };
    let evaluate = ["evaluate", "iso230-2", laser];
    let words = ["limits.toml:3", "reading_um"];
    let given = file("16 m");
    found(&[&evaluate[..], &["--tolerances", &given]].concat(), 2, "error", IMPOSSIBLE, &words);
    let given = file("5 mm");
    found(&[&evaluate[..], &["--tolerances", &given]].concat(), 0, "warning", IMPLAUSIBLE, &words);
    let typed = [&evaluate[..], &["--tolerance", "A=16 m"]].concat();
    found(&typed, 2, "error", IMPOSSIBLE, &["--tolerance:0", "16 m"]);
    let text = "name = \"x\"\n[tolerance]\nA = \"16 m\"\n[plausible]\nreading_um = 2e7\n";
    let stated = folder.file("stated.toml", text);
    let ran = trueaxis(&[&evaluate[..], &["--tolerances", &stated, "--format", "json"]].concat());
    assert!(ran.status < 2 && diagnostics(&ran).iter().all(|d| d.1 != IMPOSSIBLE), "{}", ran.err);

    let plate = fs::read_to_string(root().join("examples/07_verify/moody-1955.toml")).unwrap();
    let readings = "examples/07_verify/moody-1955.csv";
    for (old, new, key, status) in [
        // With such readings nothing is proved.
        ("0.25 arcsec", "0.25 deg", "noise_urad", 1),
        ("tolerance = \"8 um\"", "tolerance = \"8 mm\"", "reading_um", 0),
    ] {
        let conditions = folder.file("plate.toml", plate.replace(old, new));
        let plate = ["evaluate", "iso230-1", readings, "--conditions", &conditions];
        found(&plate, status, "warning", IMPLAUSIBLE, &[key]);
    }

    let study = fs::read_to_string(root().join("examples/03_predict/cone-on-i5.toml")).unwrap();
    let tolerances =
        folder.file("allowed.toml", "source = \"x\"\n[tolerance]\nroundness_mzc = \"100 m\"\n");
    let study = study.replace("../../", &format!("{}/", root().display())).replacen(
        "name =",
        &format!("tolerances = \"{tolerances}\"\nname ="),
        1,
    );
    let study = folder.file("study.toml", study);
    found(&["predict", &study], 2, "error", IMPOSSIBLE, &["allowed.toml:3", "reading_um"]);
}

/// The name of a file is as long as who wrote it wants.
#[test]
fn a_file_name_of_a_megabyte_is_cut_in_messages() {
    let folder = Folder::new("plausible-long-name");
    let text = fs::read_to_string(root().join("examples/05_identify/lathe-thermal.toml")).unwrap();
    let name = format!("\"{}.csv\", \"", "a".repeat(1_000_000));
    let study = folder
        .file("study.toml", text.replacen("\"lathe-thermal", &format!("{name}lathe-thermal"), 1));
    let ran = trueaxis(&["identify", "thermal", &study, "--format", "json"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.len() < 100_000 && ran.out.len() < 100_000, "{} bytes", ran.err.len());
    let json = ran.json();
    let places = json["diagnostics"].as_array().unwrap().iter();
    let longest = places.map(|d| d["file"].as_str().unwrap().chars().count()).max();
    assert_eq!(longest, Some(2000));
}

/// A point of a circle that has lost its decimal point, where no single value is impossible: the answer says it.
#[test]
fn an_answer_of_metres_says_so() {
    let folder = Folder::new("plausible-absurd");
    let example = root().join("examples/07_verify");
    let readings = fs::read_to_string(example.join("circle-xy.csv")).unwrap();
    let conditions = example.join("circle-xy.toml").display().to_string();
    let of = |text: String| {
        let path = folder.file("circle.csv", text);
        trueaxis(&["evaluate", "iso230-4", &path, "--conditions", &conditions, "--format", "json"])
    };
    let absurd = |ran: &Ran| {
        let all = diagnostics(ran);
        all.into_iter().filter(|d| d.1 == "absurd-result").map(|d| d.2).collect::<Vec<_>>()
    };
    assert!(absurd(&of(readings.clone())).is_empty());
    let ran = of(readings.replacen("-87.10913", "-87109.13", 1));
    let said = absurd(&ran);
    assert!(ran.status != 2 && said.len() == 1 && said[0].contains("_um"), "{said:?}");
}
