//! A new folder of every kind: each command that its files name runs in it, and what is there is left alone.

mod command;

use command::{Folder, trueaxis};

const KINDS: [&str; 4] = ["three-axis", "table-table", "head-head", "head-table"];

/// Runs a command whose last words are files of the folder.
fn done(arguments: &[&str], status: i32) -> String {
    let ran = trueaxis(arguments);
    assert_eq!(ran.status, status, "{arguments:?}\n{}{}", ran.out, ran.err);
    ran.out
}

#[test]
fn every_command_runs_in_a_new_folder() {
    for kind in KINDS {
        let temporary = Folder::new(&format!("new-{kind}"));
        let folder = temporary.path("my machine");
        done(&["new", &folder, "--kind", kind], 0);
        let at = |name: &str| temporary.path(&format!("my machine/{name}"));
        let check = done(&["check", &at("machine.toml")], 0);
        assert!(check.starts_with("my machine"), "{check}");
        done(&["solve", &at("machine.toml"), "--tip", "0 0 0", "--axis", "0 0 1"], 0);
        done(&["simulate", &at("machine.toml"), &at("part.nc")], 0);
        let predicted = done(&["predict", &at("study.toml"), "--format", "json"], 0);
        let predicted: serde_json::Value = serde_json::from_str(&predicted).expect("a document");
        for found in predicted["characteristics"].as_array().expect("characteristics") {
            assert!(found["outcome"] == "pass", "{found}");
        }
        // Nothing is measured: what the machine may do is in u.
        let u = |i: usize| predicted["characteristics"][i]["u_mm"].as_f64().expect("u");
        assert!(u(0) > 1e-4 && u(4) > 2e-4, "{} {}", u(0), u(4));
        let plan = done(&["plan", &at("campaign.toml"), "--format", "json"], 0);
        assert!(plan.contains("trueaxis/plan"), "{plan}");
        done(&["compensate", "program", &at("machine.toml"), &at("part.nc"), "-o", &at("c.nc")], 0);
    }
}

/// Readings of a virtual machine with a squareness of 40 µrad lead back to it, within its U.
#[test]
fn a_campaign_of_a_new_folder_finds_the_errors() {
    for kind in KINDS {
        let temporary = Folder::new(&format!("find-{kind}"));
        let at = |name: &str| temporary.path(&format!("m/{name}"));
        done(&["new", &temporary.path("m"), "--kind", kind], 0);
        let (name, file) = match kind {
            "three-axis" => ("EC0X", "campaign.toml"),
            _ => ("EC0Y", "planned/campaign.toml"),
        };
        if kind != "three-axis" {
            let words = ["plan", &at("campaign.toml"), "--control", "fanuc", "-o", &at("planned")];
            done(&words, 0);
        }
        let machine = std::fs::read_to_string(at("machine.toml")).expect("a machine");
        let actual = machine.replace(&format!("{name} = \"0 ±"), &format!("{name} = \"40 ±"));
        assert_ne!(machine, actual);
        temporary.file("m/machine.toml", &actual);
        let readings = if kind == "three-axis" { "readings" } else { "planned/readings" };
        done(&["measure", &at(file), "-o", &at(readings)], 0);
        temporary.file("m/machine.toml", &machine);
        let campaign = std::fs::read_to_string(at(file)).expect("a campaign");
        temporary.file(&format!("m/{file}"), campaign.replace("# readings =", "readings ="));
        let measured = at("measured.toml");
        let ran = trueaxis(&["identify", &at(file), "-o", &measured, "--format", "json"]);
        assert_ne!(ran.status, 2, "{}", ran.err);
        let document = ran.json();
        let errors = document["errors"].as_array().expect("errors");
        let found = errors.iter().find(|e| e["name"] == name).expect(name);
        let number = |key: &str| found[key].as_f64().unwrap_or_else(|| panic!("{key}: {found}"));
        let (value, expanded) = (number("value_urad"), number("U_urad"));
        assert!((value - 40.0).abs() < expanded && expanded < 40.0, "{kind}: {found}");
        // What was found can be corrected: no axis stands at the end of its travel.
        let words = ["compensate", "program", &measured, &at("part.nc"), "-o", &at("measured.nc")];
        done(&words, 0);
    }
}

#[test]
fn what_is_there_is_left_alone() {
    let temporary = Folder::new("new-there");
    let file = temporary.file("notes.txt", "mine");
    let ran = trueaxis(&["new", &temporary.path("")]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("error[unwritable-folder]"), "{}", ran.err);
    assert_eq!(std::fs::read_to_string(&file).expect("the file"), "mine");
    assert!(!std::path::Path::new(&temporary.path("machine.toml")).exists());
    let ran = trueaxis(&["new", &temporary.path("m"), "--name", "a \"b\""]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("cannot contain"), "{}", ran.err);
    assert!(!std::path::Path::new(&temporary.path("m")).exists());
    // Its hint names nothing that the command does not have.
    let ran = trueaxis(&["new", &temporary.path("nowhere/m")]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("its folder does not exist"), "{}", ran.err);
    assert!(!ran.err.contains("--output"), "{}", ran.err);
    let ran = trueaxis(&["new", &file]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("error[unwritable-folder]"), "{}", ran.err);
}

/// A machine by answers: every choice gives a file that is taken, with the chain that was answered; an axis whose plus is against
/// ISO 841 goes where the usual one goes with the other sign.
#[test]
fn law_a_machine_by_answers_is_taken_and_its_signs_are_those_of_iso_841() {
    use trueaxis_templates::{Answers, Kind, machine_file};
    let temporary = Folder::new("answers");
    let tip = |name: &str, at: &str| {
        let text = done(&["pose", &temporary.path(name), "--at", at, "--format", "json"], 0);
        let pose: serde_json::Value = serde_json::from_str(&text).expect("a pose");
        let vector = |key: &str| -> Vec<f64> {
            let of = pose["nominal"][key].as_array().unwrap_or_else(|| panic!("{key}: {pose}"));
            of.iter().map(|v| v.as_f64().expect("a number")).collect()
        };
        [vector("tip_mm"), vector("axis")].concat()
    };
    for kind in Kind::ALL {
        let tiltings =
            if kind == Kind::ThreeAxis { vec![None] } else { vec![Some('A'), Some('B')] };
        for (tilting, table) in tiltings.into_iter().flat_map(|t| (0..8_u32).map(move |k| (t, k))) {
            let chosen = |(i, axis): (usize, char)| (table >> i & 1 == 1).then_some(axis);
            let workpiece = "XYZ".chars().enumerate().filter_map(chosen).collect();
            let usual = Answers { tilting, workpiece, ..Answers::of(kind, "m") };
            let reversed: Vec<char> =
                "XYZ".chars().chain(tilting.map(|_| 'C')).chain(tilting).collect();
            let other = Answers { reversed, ..usual.clone() };
            for (name, answers) in [("usual.toml", &usual), ("other.toml", &other)] {
                temporary.file(name, machine_file(answers).expect("a machine file"));
                done(&["check", &temporary.path(name)], 0);
            }
            let turned = |sign: f64| match tilting {
                Some(tilting) => format!(" C={} {tilting}={}", 30.0 * sign, 20.0 * sign),
                None => String::new(),
            };
            let at = |sign: f64| {
                format!("X={} Y={} Z={}{}", 10.0 * sign, 20.0 * sign, sign, turned(sign))
            };
            let (plus, minus) = (tip("usual.toml", &at(1.0)), tip("other.toml", &at(-1.0)));
            for (a, b) in plus.iter().zip(&minus) {
                assert!((a - b).abs() < 1e-9, "{usual:?}: {plus:?} {minus:?}");
            }
            // Each squareness of the file changes the angle of its axes, as the workpiece sees them.
            let text = machine_file(&usual).expect("a machine file");
            for (angle, axes) in [("EC0", "XY"), ("EA0", "YZ"), ("EB0", "XZ")] {
                let is_of = |line: &&str| {
                    axes.chars().any(|axis| line.starts_with(&format!("{angle}{axis} = ")))
                };
                let line = text.lines().find(is_of).unwrap_or_else(|| panic!("{angle}: {text}"));
                let name = &line[..4];
                temporary
                    .file("turned.toml", text.replace(line, &format!("{name} = \"100 urad\"")));
                let way = |axis: char| {
                    let actual = |value: f64| {
                        let at = format!("{axis}={value}");
                        let words = [
                            "pose",
                            &temporary.path("turned.toml"),
                            "--at",
                            &at,
                            "--format",
                            "json",
                        ];
                        let pose: serde_json::Value =
                            serde_json::from_str(&done(&words, 0)).expect("a pose");
                        [0, 1, 2].map(|i| pose["actual"]["tip_mm"][i].as_f64().expect("a number"))
                    };
                    let (from, to) = (actual(-100.0), actual(-50.0));
                    [0, 1, 2].map(|i| (to[i] - from[i]) / 50.0)
                };
                let [a, b] = [0, 1].map(|i| way(axes.as_bytes()[i] as char));
                let cosine: f64 = (0..3).map(|i| a[i] * b[i]).sum();
                assert!((cosine.abs() - 1e-4).abs() < 1e-8, "{name} of {usual:?}: {cosine}");
            }
            // ISO 841: seen from the workpiece the tool goes to plus, whatever carries it.
            let (zero, x) = (tip("usual.toml", "X=0"), tip("usual.toml", "X=10"));
            assert!((x[0] - zero[0] - 10.0).abs() < 1e-9, "{usual:?}");
        }
    }
}
