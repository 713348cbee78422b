//! One of six kernels, so often as is asked: what `scripts/instructions` counts the instructions of.
//!
//! ```text
//!     instructions deviations 3
//! ```

use std::fmt::Write;
use std::hint::black_box;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_machine::axis::Command;
use trueaxis_machine::batch::{
    CommandTable, Commands, CompiledCompensator, CompiledInverse, CompiledMachine, DeviationTable,
    InstructionSet, TargetColumns,
};
use trueaxis_machine::compensate::{Compensator, Scope};
use trueaxis_machine::file::Tables;
use trueaxis_machine::{Machine, Target};
use trueaxis_motion::timing::{AxisLimits, Node, Planner, Timed};
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};

type Kernel = fn(u32);

const KERNELS: [(&str, Kernel); 6] = [
    ("deviations", deviations),
    ("corrections", corrections),
    ("inverse", inverse),
    ("branches", branches),
    ("reading", reading),
    ("timing", timing),
];

/// Poses, lines and nodes of one repetition.
const COUNT: usize = 4096;

fn main() {
    let mut words = std::env::args().skip(1).filter(|word| word != "--bench");
    let (name, times) = (words.next().unwrap_or_default(), words.next());
    let times = times.and_then(|times| times.parse().ok()).unwrap_or(1);
    match KERNELS.iter().find(|(kernel, _)| *kernel == name) {
        Some((_, kernel)) => kernel(times),
        None => {
            let names = KERNELS.map(|(kernel, _)| format!("{kernel} {COUNT}\n")).concat();
            std::io::Write::write_all(&mut std::io::stdout(), names.as_bytes()).expect("an output");
        }
    }
}

/// Positions with smooth errors, as a calibration has them.
struct Memory;

impl Tables for Memory {
    fn text(&self, name: &str) -> Result<String, String> {
        let letter = name.chars().next().ok_or("no name")?;
        let (unit, most) = if letter < 'X' { ("deg", 180.0) } else { ("mm", 500.0) };
        let mut text = format!("position_{unit},EX{letter}_um,EZ{letter}_um,EB{letter}_urad\n");
        for i in 0..50 {
            let t = f64::from(i) / 49.0;
            let value = |k: f64| 12.0 * (7.0 * t + k + f64::from(letter as u32)).sin();
            let row = [value(0.0), value(1.0), value(2.0)].map(|x| format!("{x:.4}")).join(",");
            let _ = writeln!(text, "{},{row}", most * (2.0 * t - 1.0));
        }
        Ok(text)
    }
}

fn machine() -> Machine {
    let mut text = String::from(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z C A t\"\n\
         [tool]\nplacement = \"0 0 -200 mm\"\nlength = \"100 mm\"\n\
         [location]\nEB0Z = \"11 urad\"\nEX0C = \"7 um\"\nEA0A = \"-5 urad\"\n",
    );
    for axis in "XYZCA".chars() {
        let _ = writeln!(text, "[motion.{axis}]\ntable = \"{axis}.csv\"");
    }
    let (machine, problems) = Machine::check("m.toml", &text, &Memory);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

/// A path over most of the travel, axis by axis.
fn positions() -> [Vec<f64>; 5] {
    let at = |size: f64, turns: f64| {
        let angle = move |i: usize| turns * i as f64 / COUNT as f64;
        (0..COUNT).map(|i| size * angle(i).sin()).collect()
    };
    [at(450.0, 3.0), at(400.0, 5.0), at(300.0, 2.0), at(3.0, 7.0), at(0.9, 11.0)]
}

fn deviations(times: u32) {
    let (machine, positions) = (CompiledMachine::new(&machine()), positions());
    let columns: Vec<&[f64]> = positions.iter().map(Vec::as_slice).collect();
    let mut found = DeviationTable::zeros(COUNT);
    for _ in 0..times {
        let (set, commands) = (InstructionSet::best(), Commands::new(&columns));
        machine.deviations_by(set, &commands, &mut found.columns()).expect("within the tables");
        black_box(&found);
    }
}

fn corrections(times: u32) {
    let compensator = Compensator::of(&machine(), Scope::Pose).expect("five axes");
    let (compensator, positions) = (CompiledCompensator::new(compensator), positions());
    let columns: Vec<&[f64]> = positions.iter().map(Vec::as_slice).collect();
    let mut found = CommandTable::zeros(5, COUNT);
    for _ in 0..times {
        let (set, commands) = (InstructionSet::best(), Commands::new(&columns));
        compensator.commands_by(set, &commands, &mut found.columns()).expect("corrections");
        black_box(&found);
    }
}

/// The tool goes round and tilts, never near the pole.
fn targets() -> Vec<Target> {
    let target = |i: usize| {
        let t = i as f64 / COUNT as f64;
        let (tilt, turn) = (0.5 + 0.3 * (9.0 * t).sin(), 5.0 * t);
        let axis = Vec3::new(tilt.sin() * turn.sin(), -tilt.sin() * turn.cos(), tilt.cos());
        let tip = Point::from_vector(Vec3::new(300.0 * t, 100.0 * turn.cos(), -20.0 * t));
        Target { tip, axis: Direction::of(axis).expect("a direction") }
    };
    (0..COUNT).map(target).collect()
}

fn inverse(times: u32) {
    let (inverse, targets) = (CompiledInverse::of(&machine()).expect("five axes"), targets());
    let column = |of: &dyn Fn(&Target) -> f64| -> Vec<f64> { targets.iter().map(of).collect() };
    let tips: [Vec<f64>; 3] = std::array::from_fn(|k| column(&|t| t.tip.vector()[k]));
    let axes: [Vec<f64>; 3] = std::array::from_fn(|k| column(&|t| t.axis.vector()[k]));
    let columns = TargetColumns {
        tip_mm: tips.each_ref().map(Vec::as_slice),
        axis: axes.each_ref().map(Vec::as_slice),
    };
    let (mut found, begin) = (CommandTable::zeros(5, COUNT), Command::default());
    for _ in 0..times {
        let set = InstructionSet::best();
        inverse.commands_by(set, &columns, &begin, &mut found.columns()).expect("a way");
        black_box(&found);
    }
}

fn branches(times: u32) {
    let (machine, targets) = (machine(), targets());
    for _ in 0..times {
        black_box(machine.follow(&targets, &Command::default()).expect("a way"));
    }
}

fn reading(times: u32) {
    let mut text = String::from("G21 G90 G94\nG1 F1000\n");
    for i in 0..COUNT {
        let t = i as f64 * 1e-3;
        let (x, y, z) = (100.0 * t.cos(), 100.0 * t.sin(), -0.001 * t);
        let (a, c) = (30.0 * (0.3 * t).sin(), (57.3 * t) % 360.0);
        let _ = writeln!(text, "X{x:.4} Y{y:.4} Z{z:.5} A{a:.4} C{c:.4} F{}.", 1000 + i % 7);
    }
    for _ in 0..times {
        let program = Program::new("p.nc", text.clone().into_bytes(), Control::Fanuc);
        let mut moves = 0;
        let count = &mut |step: Step| moves += usize::from(matches!(step, Step::Move(_)));
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), count);
        assert!(moves >= COUNT, "{moves} moves: {:?}", outcome.problems);
    }
}

fn timing(times: u32) {
    let limits =
        AxisLimits { velocity: [500.0; 6], acceleration: [3000.0; 6], jerk: [50_000.0; 6] };
    let node = |i: usize| {
        let t = i as f64 * 1e-2;
        let command = [50.0 * t.cos(), 50.0 * t.sin(), 3.0 * (7.0 * t).sin(), 0.0, 0.0, 0.0];
        let (length, feed) = (0.55, if i % 900 < 450 { 80.0 } else { 20.0 });
        Node { command, length, feed, stop: i % 1500 == 1499, tolerance: [0.01; 6], dwell_s: 0.0 }
    };
    let nodes: Vec<Node> = (0..COUNT).map(node).collect();
    for _ in 0..times {
        let mut end_s = 0.0;
        let mut out = |timed: Timed| end_s = timed.t_s;
        let mut planner = Planner::new(&limits).expect("limits");
        nodes.iter().for_each(|node| planner.push(node, &mut out).expect("a node"));
        planner.finish(&mut out);
        black_box(end_s);
    }
}
