//! Real programs: read without an unknown word that their control knows.

#![allow(clippy::print_stdout, reason = "says what was read and what is not here")]

mod support;

use std::collections::BTreeMap;
use std::path::PathBuf;

use support::{Folder, outside};
use trueaxis_nc::moves::Plane;
use trueaxis_nc::{Control, Program, Settings, Step, interpret};

/// Codes that mean "this control does not know it".
const UNKNOWN: [&str; 3] = ["unknown-word", "unknown-g-code", "unknown-m-code"];

/// Words in these programs that their control does not know either.
const NOT_OF_THE_CONTROL: [(&str, &str); 2] = [
    ("Test-C-Achse.gcode", "E, M83, M104 … are of a printer (Klipper)"),
    ("simple_curve_Gcode.txt", "E, M104, M109 … are of a printer (Marlin)"),
];

fn read(file: &PathBuf, control: Control) -> (usize, usize, BTreeMap<String, usize>, String) {
    let name = file.file_name().unwrap().to_string_lossy().into_owned();
    let program = Program::new(&name, std::fs::read(file).unwrap(), control);
    assert!(program.print() == program.source());
    let lathe = name == "TEST_TURN.NC";
    let settings = Settings {
        keep_going: true,
        absolute_centers: name == "CONTOUR_ABS.NC",
        diameters: lathe,
        plane: if lathe { Plane::Zx } else { Plane::Xy },
        ..Settings::default()
    };
    let folder = Folder(file.parent().unwrap().to_owned());
    let (mut moves, mut events) = (0, 0);
    let outcome = interpret(&program, &folder, &settings, &mut |step| match step {
        Step::Move(m) => {
            assert!(m.target.0.iter().all(|v| v.is_finite()));
            moves += 1;
        }
        Step::Event(..) => events += 1,
    });
    let mut codes = BTreeMap::new();
    for problem in outcome.problems.iter() {
        *codes.entry(problem.code.to_owned()).or_insert(0) += 1;
    }
    let all: Vec<_> = outcome.problems.iter().map(ToString::to_string).collect();
    (moves, events, codes, all.join("\n"))
}

#[test]
fn oracle_programs_of_others_are_read() {
    let Some(folder) = outside("nc") else { return };
    let sets = [
        ("LinuxCNC__linuxcnc", Control::LinuxCnc),
        ("MaestroFusion360__easy_gcode_plot", Control::Fanuc),
        ("Planet-Source-Code__cuq-a-5-axis-milling-machine-simulator__1-51046", Control::Fanuc),
        ("usnistgov__smstestbed", Control::Fanuc),
        ("Koaladeen__5-axis-3D-print-G-code-simulator", Control::Fanuc),
        ("zhangty019__MultiAxis_3DP_MotionPlanning", Control::Fanuc),
    ];
    let mut wrong = Vec::new();
    for (set, control) in sets {
        let mut files: Vec<_> =
            std::fs::read_dir(folder.join(set)).unwrap().flatten().map(|e| e.path()).collect();
        files.sort();
        for file in files {
            let (moves, events, codes, all) = read(&file, control);
            let name = file.file_name().unwrap().to_string_lossy().into_owned();
            println!("{name}: {moves} moves, {events} events, {codes:?}");
            let foreign = NOT_OF_THE_CONTROL.iter().any(|(n, _)| *n == name);
            let unknown = codes.keys().any(|c| UNKNOWN.contains(&c.as_str()));
            let errors = all.contains("error[") && !foreign;
            if unknown != foreign || moves == 0 || errors {
                wrong.push(format!("{name}\n{all}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
