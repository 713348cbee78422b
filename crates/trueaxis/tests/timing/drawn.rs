//! Whole programs: the same times however finely the path is drawn; LinuxCNC's own planner.

use std::path::Path;
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, simulate};

/// The end of every block.
#[derive(Default)]
struct Ends(Vec<(u32, f64)>);

impl Observer for Ends {
    fn path(&mut self, batch: &Batch<'_>) {
        let nodes = batch.nodes.iter().zip(batch.stamps).filter(|(node, _)| node.last);
        self.0.extend(nodes.map(|(node, stamp)| (node.origin.line, stamp.time_s)));
    }
}

pub fn machine(chain: &str, limits: [&str; 3]) -> Machine {
    let mut text = format!("[machine]\nname = \"m\"\nchain = \"{chain}\"\n");
    for axis in ["X", "Y", "Z"] {
        let [v, a, j] = limits;
        text += &format!(
            "[axis.{axis}]\ntravel = [\"-1000 mm\", \"1000 mm\"]\nmax_velocity = \"{v}\"\n\
             max_acceleration = \"{a}\"\nmax_jerk = \"{j}\"\n"
        );
    }
    if chain.contains('C') {
        text += "[axis.C]\ntravel = \"unlimited\"\n";
    }
    text += "[tool]\nlength = \"100 mm\"\n";
    let (machine, problems) = Machine::check("machine.toml", &text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

pub fn ends(machine: &Machine, control: Control, text: &str, densify: Densify) -> Vec<(u32, f64)> {
    let program = Program::new("program", text.as_bytes().to_vec(), control);
    let (mut ends, options) = (Ends::default(), Options { densify, ..Options::default() });
    let run = simulate(machine, &program, &SetUp::default(), &options, &mut [&mut ends]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    ends.0
}

fn drawn(chord_mm: f64, spacing_mm: f64, angle_deg: f64) -> Densify {
    Densify::Tolerance { chord_mm, spacing_mm, angle_rad: angle_deg.to_radians() }
}

/// Every block ends at the same time.
fn assert_same_however_drawn(machine: &Machine, control: Control, text: &str) -> f64 {
    let default = ends(machine, control, text, Densify::default());
    assert!(!default.is_empty());
    for (chord_mm, spacing_mm, angle_deg) in
        [(0.05, 10.0, 1.0), (0.0002, 10.0, 1.0), (0.005, 0.5, 1.0), (10.0, 1e3, 30.0)]
    {
        let other = ends(machine, control, text, drawn(chord_mm, spacing_mm, angle_deg));
        assert_eq!(other.len(), default.len());
        for (a, b) in default.iter().zip(&other) {
            assert!(
                a.0 == b.0 && (a.1 - b.1).abs() <= 1e-9,
                "{a:?} {b:?} at {chord_mm} {spacing_mm}"
            );
        }
    }
    default.last().expect("a block").1
}

pub const ISSUE: [&str; 3] = ["60 m/min", "2 m/s^2", "20 m/s^3"];

#[test]
fn law_lines_and_circles_take_the_same_time_however_drawn() {
    let mill = machine("w X' Y' b Z t", ISSUE);
    let time_s = |text: &str| assert_same_however_drawn(&mill, Control::LinuxCnc, text);
    // Seven phases: 1 + 0.15 + 0.1 s.
    assert!((time_s("G21 G90 G17\nG1 X300 F18000\nM2\n") - 1.25).abs() < 1e-9);
    // 0.4π s and 2 √(V/J), and at most 2 % more.
    let circle = 0.4 * std::f64::consts::PI + 2.0 * 0.005_f64.sqrt();
    let took = time_s("G21 G90 G17\nG2 X0 Y0 I20 J0 F6000\nM2\n");
    assert!((circle..1.02 * circle).contains(&took), "{took} s for {circle} s");
    time_s(
        "G21 G90 G17 G64 P0.02\nG1 X40 F6000\nG3 X50 Y10 I0 J10\nG1 Y40\nG2 X60 Y50 Z-5 I10 J0\n\
         G3 X60 Y50 Z-20 I5 J5 P3\nG0 Z10\nG1 X0 Y0 F3000\nM2\n",
    );
}

#[test]
fn law_five_axis_moves_take_the_same_time_however_drawn() {
    let table = machine("w C' A' b X Y Z t", ISSUE);
    assert_same_however_drawn(
        &table,
        Control::Sinumerik840d,
        "TRAORI\nORIWKS ORIAXES\nG1 X50 Y0 Z20 A=10 C=0 F4000\nG64 X60 Y10 A=20 C=40\n\
         X60 Y30 A=15 C=70\nORIVECT\nG1 X40 Y40 A3=0.3 B3=0.2 C3=1\n\
         G2 X20 Y40 I-10 J0 A3=-0.2 B3=0.3 C3=1\nTRAFOOF\nG0 Z300\nM30\n",
    );
}

/// Five programs on the planner of LinuxCNC 2.9 (oracles/linuxcnc_times.py), which has no jerk limit: ours is so
/// large here that it adds less than 2 ms.
///
/// DIFFERENCE: LinuxCNC plans in whole cycles of 1 ms, about two more for each block that ends with a stop;
/// under G64 it accelerates with half of the stated acceleration, on arcs also with a share of that.
#[test]
fn oracle_five_programs_on_linuxcnc() {
    let mill = machine("w X' Y' b Z t", ["19.98 m/min", "2 m/s^2", "4000 m/s^3"]);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/linuxcnc-times");
    let mut count = 0;
    for line in include_str!("../data/linuxcnc-times.csv").lines().skip(2) {
        let (name, theirs) = line.split_once(',').expect("two columns");
        let theirs: f64 = theirs.parse().expect("a number");
        let text = std::fs::read_to_string(folder.join(format!("{name}.ngc"))).expect("a program");
        let ours = assert_same_however_drawn(&mill, Control::LinuxCnc, &text);
        // How much longer LinuxCNC takes.
        let more = theirs / ours - 1.0;
        assert!((-0.005..0.05).contains(&more), "{name}: {ours} s, LinuxCNC {theirs} s");
        count += 1;
    }
    assert_eq!(count, 5);
}
