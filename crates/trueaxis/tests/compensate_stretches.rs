//! A program is read and followed ahead of what is written, stretch by stretch: where a stretch ends, and that the writing ends early,
//! does not matter.

mod library;

use library::with_lost_motion;
use std::collections::BTreeMap;
use trueaxis::compensate::program::{ProgramOptions, compensate_program};
use trueaxis::geometry::Vec3;
use trueaxis::input::{Diagnostics, Severity};
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Options, SetUp, SetUpTool, simulate};

fn codes(problems: &Diagnostics) -> Vec<String> {
    problems.iter().map(ToString::to_string).collect()
}

/// Tools of other lengths, lengths that are switched on, off and over while the tool stays, with tool-centre point
/// and without it, and with lost motion: corrections are found ahead in stretches, and wherever a change falls in one, what is written
/// is what pose by pose writes.
#[test]
fn law_changes_of_tools_and_lengths_do_not_matter_to_the_batch() {
    let tool = |length_mm: f64| SetUpTool {
        name: format!("T{length_mm}"),
        tip_mm: Vec3::new(0.0, 0.0, -length_mm),
        ..SetUpTool::default()
    };
    let tools = BTreeMap::from([(1, tool(90.0)), (2, tool(60.5)), (3, tool(112.25))]);
    let setup = SetUp { given: true, tools, ..SetUp::default() };
    let moves = |from: usize, count: usize| -> String {
        let line = |k: usize| {
            let t = 0.05 * (from + k) as f64;
            let (x, y, z) = (20.0 * t.cos(), 15.0 * (0.7 * t).sin(), 12.0 + 3.0 * (0.3 * t).sin());
            let (a, c) = (20.0 + 9.0 * (0.9 * t).sin(), 30.0 * (0.4 * t).cos());
            format!("G1 X{x:.4} Y{y:.4} Z{z:.4} A{a:.4} C{c:.4} F900\n")
        };
        (0..count).map(line).collect()
    };
    let program = |counts: &[usize]| {
        let mut text = "G21 G90 G94 G54\nT1 M6\nG43.4 H1 Z60.\n".to_owned();
        let changes = [
            "G49\nG0 Z0\nT2 M6\nG43.4 H2 Z60.\n",
            "G49\nG43 H2 Z50.\n",
            "G43 H3 Z55.\n",
            "G49\nG0 Z0\nT3 M6\nG43.4 H3 Z50.\n",
            "G49\nG0 Z0\nT1 M6\nG43 H1 Z50.\n",
        ];
        for (i, change) in changes.iter().enumerate() {
            text += &moves(100 * i, counts[i % counts.len()]);
            text += change;
        }
        text + &moves(7, 40) + "G49\nM30\n"
    };
    let text = "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z t\"\n[tool]\nlength = \"90 mm\"\n\
                [location]\nEY0A = \"12 um\"\nEA0C = \"30 urad\"\nEB0Z = \"-20 urad\"\n\
                [motion.X]\nEXX = { polynomial = [\"0 um\", \"9 um\"], scale = \"100 mm\" }\n\
                [motion.Y]\nEYY = { polynomial = [\"2 um\", \"-7 um\"], scale = \"100 mm\" }\n\
                [motion.Z]\nEZZ = { polynomial = [\"0 um\", \"5 um\"], scale = \"100 mm\" }\n";
    let stated = Machine::check("m.toml", text, &NoTables).0.expect("a machine");
    let mut compared = 0;
    for machine in [with_lost_motion(&stated, 0.004), stated] {
        for counts in [&[3, 40][..], &[1023, 1, 1024], &[300, 5, 1100]] {
            let program = Program::new("t.nc", program(counts).into_bytes(), Control::Fanuc);
            let by = |pose_by_pose| {
                let options = ProgramOptions { pose_by_pose, ..ProgramOptions::default() };
                let (done, problems) = compensate_program(&machine, &program, &setup, &options);
                let found = done.map(|d| (String::from_utf8(d.text.into_vec()), d.found.axis_left));
                (found, codes(&problems))
            };
            let [batch, scalar] = [false, true].map(by);
            assert_eq!(batch, scalar, "{counts:?}");
            compared += usize::from(batch.0.is_some());
        }
    }
    assert_eq!(compared, 6);
}

/// After the first error the program is executed on without being written or timed; the interpreter gets the true place all
/// the same, so that it finds no mistakes that are none: with a new tool an arc begins where the axes are.
#[test]
fn law_an_error_makes_no_others() {
    let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[tool]\nlength = \"100 mm\"\n\
                [axis.Z]\ntravel = [\"-150 mm\", \"0 mm\"]\n\
                [motion.X]\nEXX = { polynomial = [\"0 um\", \"10 um\"], scale = \"100 mm\" }\n";
    let (machine, problems) = Machine::check("m.toml", text, &NoTables);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let moves: String = (0..8000).map(|k| format!("G1 X{} Y{}\n", k % 70, k % 50)).collect();
    let arc =
        "T2 M6\nG54 G0 X7. Y0. S7000 M3\nG43 Z20. H2\nG1 Z-48. F900\nG3 X7. Y0. I-7. F900\nM30\n";
    let program = |first: &str| {
        let text = format!("G21 G90 G94 G54 F500\nT1 M6\nG43 Z50. H1\n{first}\n{moves}{arc}");
        Program::new("p.nc", text.into_bytes(), Control::Fanuc)
    };
    let options = ProgramOptions::default();
    let (_, problems) =
        compensate_program(&machine, &program("G1 Z-400."), &SetUp::default(), &options);
    let errors = |problems: &Diagnostics| -> Vec<_> {
        let found = problems.iter().filter(|p| p.severity == Severity::Error);
        found.map(|p| (p.code, p.place.line)).collect()
    };
    assert_eq!(errors(&problems).len(), 1, "{problems:?}");
    let run =
        simulate(&machine, &program("G1 A30."), &SetUp::default(), &Options::default(), &mut []);
    assert_eq!(errors(&run.problems), [("unknown-axis", 4)], "{:?}", run.problems);
}
