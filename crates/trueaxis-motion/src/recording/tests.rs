//! What is kept against the simulation itself.

// So that whoever reads this file alone, such as the house rules, can see what it is.
use super::super::Batch;
use super::super::Densify;
use super::super::Observer;
use super::super::Options;
use super::super::Run;
use super::super::SetUp;
use super::super::SetUpTool;
use super::super::Stop;
#[cfg(test)]
use super::super::series::Quantity;
use super::super::simulate;
use super::detail::from_piece;
use super::*;
use std::fmt::Write as _;
use std::sync::Arc;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::file::NoTables;
use trueaxis_machine::heat::{TemperatureLog, TemperatureRun};
use trueaxis_nc::{Control, Program};

const MACHINE: &str = "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z t\"\n\
    [axis.X]\ntravel = [\"-500 mm\", \"500 mm\"]\nmax_velocity = \"500 mm/s\"\n\
    [axis.C]\ntravel = \"unlimited\"\n[tool]\nlength = \"100 mm\"\n\
    [location]\nEC0Y = \"10 urad\"\nEA0Z = \"-7 urad\"\n\
    [motion.X]\nEXX = { constant = \"3 um\", reversal = \"2 um\" }\n";

fn machine() -> Machine {
    let (machine, problems) = Machine::check("machine.toml", MACHINE, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

/// Lines, circles, a dwell, rapid moves; `blocks` short pieces of a wave.
fn program(blocks: usize) -> Program {
    let mut text = String::from("O1\nG90 G21 G94 G0 X0 Y0 Z50\nG1 Z0 F1000\n");
    for k in 0..blocks {
        let x = k as f64 * 0.4 % 300.0;
        let (y, c) = (30.0 * (k as f64 * 0.07).sin(), k as f64 * 0.9 % 170.0);
        let _ = writeln!(text, "X{x:.4} Y{y:.4} C{c:.3}");
    }
    text += "G4 P500\nG2 X100 Y0 R160\nG0 Z80\nM30\n";
    Program::new("program.nc", text.into_bytes(), Control::Fanuc)
}

/// Every node as the simulation reported it.
#[derive(Default)]
struct Seen {
    moments: Vec<Moment>,
    flags: Vec<bool>,
}

impl Observer for Seen {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            let deviation = batch.deviation(i);
            self.flags.push(node.last);
            self.moments.push(Moment {
                time_s: stamp.time_s,
                command: node.command,
                approach: batch.approach(i),
                tip_mm: deviation.nominal_tip.vector(),
                off_tip_um: deviation.tip_mm * 1e3,
                off_axis_urad: deviation.axis * 1e6,
                along_path_um: batch.along_path_mm[i] * 1e3,
                speed: stamp.speed,
                program: node.origin.program,
                line: node.origin.line,
                tool: batch.tool,
                rapid: node.is_rapid(),
                waits: node.dwell_s > 0.0,
            });
        }
    }
}

fn recorded(blocks: usize, most: usize) -> (Recording, Seen, Run) {
    let (machine, program, setup) = (machine(), program(blocks), SetUp::default());
    let options = Options::default();
    let mut seen = Seen::default();
    let mut recorder = Recorder::of(&machine, &setup, &options).at_most(most);
    let run = simulate(&machine, &program, &setup, &options, &mut [&mut seen, &mut recorder]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    (recorder.finish(), seen, run)
}

#[test]
fn at_its_nodes_it_is_the_simulation() {
    let (recording, seen, _) = recorded(700, usize::MAX);
    assert_eq!((recording.nodes(), recording.kept()), (seen.moments.len(), seen.moments.len()));
    assert!(!recording.is_thinned() && seen.moments.iter().any(|m| m.waits));
    agree(&recording, &seen);
}

fn agree(recording: &Recording, seen: &Seen) {
    for seen in &seen.moments {
        let found = recording.at(seen.time_s).unwrap();
        assert_eq!((found.command, found.approach), (seen.command, seen.approach));
        assert_eq!((found.line, found.rapid, found.waits), (seen.line, seen.rapid, seen.waits));
        assert_eq!(found.tool, seen.tool);
        let near =
            |a: Vec3, b: Vec3, most: f64| assert!((a - b).norm() < most, "{found:?} {seen:?}");
        near(found.tip_mm, seen.tip_mm, 1e-9);
        near(found.off_tip_um, seen.off_tip_um, 1e-6);
        near(found.off_axis_urad, seen.off_axis_urad, 1e-6);
        near(found.along_path_um, seen.along_path_um, 1e-5);
        assert!((found.speed - seen.speed).abs() < 1e-4);
    }
}

#[test]
fn tools_and_temperatures_are_those_of_the_time() {
    let warm = "[scale.X]\nexpansion = \"10 um/(m K)\"\ntable_temperature = \"20 degC\"\n\
                sensors = { scale_x = \"0 mm\" }\n";
    let text = format!("{MACHINE}{warm}");
    let (machine, mut problems) = Machine::check("machine.toml", &text, &NoTables);
    let log =
        TemperatureLog::parse("log.csv", "time_s,scale_x_degC\n0,20\n600,50\n", &mut problems);
    let run = TemperatureRun { log: Arc::new(log.unwrap()), start_s: 5.0 };
    let options = Options { temperatures: Some(run), ..Options::default() };
    let tool =
        |length_mm: f64| SetUpTool { tip_mm: -Vec3::z() * length_mm, ..SetUpTool::default() };
    let tools = [(1, tool(80.0)), (2, tool(123.0))].into();
    let setup = SetUp { given: true, tools, ..SetUp::default() };
    let text = "O1\nG90 G21 G94\nT1 M6\nG1 X400 Y100 F3000\nT2 M6\nC40\nX10 A5\nG4 P9000\nT1 M6\nZ9\nM30\n";
    let program = Program::new("tools.nc", text.as_bytes().to_vec(), Control::Fanuc);
    let (machine, mut seen) = (machine.unwrap(), Seen::default());
    let mut recorder = Recorder::of(&machine, &setup, &options);
    let run = simulate(&machine, &program, &setup, &options, &mut [&mut seen, &mut recorder]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    let recording = recorder.finish();
    let changes = seen.moments.windows(2).filter(|pair| pair[0].tool != pair[1].tool).count();
    assert!(changes == 3 && recording.stretches.len() > 40, "{changes}");
    agree(&recording, &seen);
}

#[test]
fn between_its_nodes_it_is_the_machine() {
    let (recording, _, _) = recorded(300, usize::MAX);
    let machine = machine();
    for k in 0..=500 {
        let moment = recording.at(recording.end_s() * f64::from(k) / 500.0).unwrap();
        let errors = machine.errors_at(&moment.command, &moment.approach).unwrap();
        let deviation = machine.deviation(&moment.command, &errors);
        assert!((moment.off_tip_um - deviation.tip_mm * 1e3).norm() < 1e-9);
        let nominal = machine.body_poses(&moment.command, &ErrorValues::default());
        let actual = machine.body_poses(&moment.command, &errors);
        for (i, [n, a]) in recording.bodies(&moment).iter().enumerate() {
            assert_eq!((n.shift_mm(), a.shift_mm()), (nominal[i].shift_mm(), actual[i].shift_mm()));
            assert_eq!((n.linear(), a.linear()), (nominal[i].linear(), actual[i].linear()));
        }
    }
    // Half of the time between two nodes is half of the distance.
    let [a, b] = [40, 41].map(|i| recording.at(recording.columns.time_s[i]).unwrap());
    let middle = recording.at(0.5 * (a.time_s + b.time_s)).unwrap();
    assert!((middle.command[1] - 0.5 * (a.command[1] + b.command[1])).abs() < 1e-9);
    let ends = [-1.0, f64::NAN, 1e9].map(|t| recording.at(t).unwrap().time_s);
    assert_eq!(ends, [0.0, 0.0, recording.end_s()]);
}

#[test]
fn extents_are_those_of_all_nodes() {
    let (recording, seen, _) = recorded(900, usize::MAX);
    let end_s = recording.end_s();
    let all: Vec<Quantity> = recording.quantities().iter().map(|q| q.quantity).collect();
    for k in 0..60_u32 {
        let share = |n: u32| f64::from(k.wrapping_mul(n) >> 8) / f64::from(u32::MAX >> 8);
        let (a, b) = (share(2_654_435_769) * end_s, share(0x9E37_79B1 ^ 0x5555_1234) * end_s);
        let (from_s, to_s) = (a.min(b) - 0.1, a.max(b) + 1e-6);
        let curves = recording.curves(from_s, to_s, 1, &all);
        for (i, of) in all.iter().enumerate() {
            let [low, high] = brute(&recording, &seen.moments, *of, from_s, to_s);
            let slack = 1e-6 * (1.0 + low.abs().max(high.abs()));
            let found = [curves.low[i], curves.high[i]].map(f64::from);
            assert!(
                (found[0] - low).abs() < slack && (found[1] - high).abs() < slack,
                "{of:?} {from_s} … {to_s}: {found:?}, not {:?}",
                [low, high]
            );
        }
    }
    let after = recording.curves(end_s + 1.0, end_s + 2.0, 3, &all[..1]);
    assert!(after.low.iter().chain(&after.high).all(|v| v.is_nan()));
}

/// Node by node, and the straight lines to the edges.
fn brute(r: &Recording, seen: &[Moment], of: Quantity, from_s: f64, to_s: f64) -> [f64; 2] {
    let value = |i: usize| f64::from(r.columns.value(of, i));
    let mut values = Vec::new();
    for i in 1..seen.len() {
        let (a, b) = (seen[i - 1].time_s, seen[i].time_s);
        let (from, to) = (from_s.max(a), to_s.min(b));
        if from > to || (a == b && !matches!(of, Quantity::AxisSpeed(_))) {
            continue;
        }
        match of {
            // A piece that is only touched has no part in the stretch of time.
            Quantity::AxisSpeed(_) if from < to => values.push(value(i)),
            Quantity::AxisSpeed(_) => {}
            _ => values.extend(
                [from, to].map(|t| value(i - 1) + (value(i) - value(i - 1)) * (t - a) / (b - a)),
            ),
        }
    }
    let fold = |f: fn(f64, f64) -> f64, v: f64| values.iter().copied().fold(v, f);
    [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)]
}

#[test]
fn a_path_with_few_points_keeps_the_extremes_and_its_chord() {
    let (recording, seen, _) = recorded(2000, usize::MAX);
    let whole = recording.path(0.0, recording.end_s(), usize::MAX, Colour::Deviation);
    assert!(whole.is_complete && whole.chord_mm == 0.0 && whole.line.len() == seen.moments.len());
    let mut before = f64::INFINITY;
    for most in [8, 50, 300, 1500] {
        for colour in [Colour::Deviation, Colour::Feed, Colour::Load] {
            let drawn = recording.path(0.0, recording.end_s(), most, colour);
            let all = recording.path(0.0, recording.end_s(), usize::MAX, colour);
            assert!(drawn.line.len() <= most && !drawn.is_complete);
            assert_eq!(drawn.range, all.range);
            let highest = drawn.value.iter().copied().fold(0.0, f32::max);
            assert_eq!(highest, all.range[1]);
        }
        let drawn = recording.path(0.0, recording.end_s(), most, Colour::Deviation);
        assert!((chord(&drawn, &seen.moments) - drawn.chord_mm).abs() < 1e-3);
        assert!(drawn.chord_mm < before, "{most}: {}", drawn.chord_mm);
        before = drawn.chord_mm;
    }
    assert!(before < 0.5);
    // A window begins at the node before it and ends at the node after it.
    let window = recording.path(1.0, 1.5, usize::MAX, Colour::Feed);
    let (first, last) = (window.time_s[0], window.time_s[window.time_s.len() - 1]);
    assert!(first <= 1.0 && last >= 1.5 && window.time_s[1] > 1.0);
}

#[test]
fn rows_stay_rows_wherever_their_corners_are() {
    for length in [50, 64, 100, 117] {
        let mut text = String::from("O1\nG90 G21 G94 F3000\n");
        for k in 0..40 * length {
            let (row, along) = (k / length, k % length);
            let x = if row % 2 == 0 { along } else { length - 1 - along };
            let _ =
                writeln!(text, "G1 X{x} Y{:.1} Z{:.3}", f64::from(row) * 0.5, f64::from(k) * 1e-4);
        }
        let program = Program::new("rows.nc", text.into_bytes(), Control::Fanuc);
        let (machine, setup) = (machine(), SetUp::default());
        let options = Options { densify: Densify::Off, ..Options::default() };
        let mut recorder = Recorder::of(&machine, &setup, &options);
        simulate(&machine, &program, &setup, &options, &mut [&mut recorder]);
        let recording = recorder.finish();
        let drawn = recording.path(0.0, recording.end_s(), 300, Colour::Deviation);
        assert!(drawn.chord_mm < 0.1 * f64::from(length), "{length}: {}", drawn.chord_mm);
    }
}

/// The greatest distance of a node from the piece that is drawn over it.
fn chord(drawn: &PathPoints, seen: &[Moment]) -> f64 {
    let origin = Vec3::from(drawn.origin_mm);
    let tip = |i: usize| Vec3::from(drawn.tip_mm[i].map(f64::from)) + origin;
    let mut chord = 0.0_f64;
    for m in seen {
        let to = drawn.time_s.partition_point(|t| *t < m.time_s).max(1);
        if drawn.time_s[to] != m.time_s {
            chord = chord.max(from_piece(m.tip_mm, tip(to - 1), tip(to)).0);
        }
    }
    chord
}

#[test]
fn it_goes_from_block_to_block() {
    let (recording, seen, _) = recorded(50, usize::MAX);
    let line = |time_s: f64| recording.at(time_s).unwrap().line;
    let mut time_s = 0.0;
    let mut lines = vec![line(time_s)];
    while time_s < recording.end_s() {
        time_s = recording.next_block(time_s);
        lines.push(line(time_s));
    }
    let mut expected: Vec<u32> = seen.moments.iter().map(|m| m.line).collect();
    expected.dedup();
    assert_eq!(lines, expected);
    assert_eq!(line(recording.previous_block(time_s)), expected[expected.len() - 2]);
    assert_eq!(recording.previous_block(0.0), 0.0);
    for wanted in [3, 10, 40] {
        assert_eq!(line(recording.block_of_line(0, wanted).unwrap()), wanted);
    }
    assert_eq!(line(recording.block_of_line(0, 1).unwrap()), 2); // the number of the program
    assert_eq!((recording.block_of_line(0, 9999), recording.block_of_line(7, 1)), (None, None));
}

#[test]
fn memory_is_bounded_and_no_peak_is_lost() {
    let (whole, seen, _) = recorded(3000, usize::MAX);
    let (thin, _, _) = recorded(3000, 500);
    assert!(thin.is_thinned() && thin.kept() <= 501 && thin.nodes() == seen.moments.len());
    assert_eq!(thin.end_s(), whole.end_s());
    assert!(thin.columns.time_s.windows(2).all(|pair| pair[0] < pair[1]));
    let all: Vec<Quantity> = whole.quantities().iter().map(|q| q.quantity).collect();
    let [a, b] = [&thin, &whole].map(|r| r.curves(0.0, r.end_s(), 1, &all));
    for (i, of) in all.iter().enumerate() {
        let pairs = [(a.low[i], b.low[i]), (a.high[i], b.high[i])];
        assert!(pairs.iter().all(|(a, b)| (a - b).abs() <= 1e-5 * b.abs()), "{of:?} {pairs:?}");
    }
    // What is kept is what was there.
    for time_s in &thin.columns.time_s {
        let (a, b) = (thin.at(*time_s).unwrap(), whole.at(*time_s).unwrap());
        assert_eq!((a.command, a.off_tip_um, a.line), (b.command, b.off_tip_um, b.line));
    }
}

#[test]
fn a_simulation_ends_when_it_is_asked_to() {
    struct Asks(Stop, usize);
    impl Observer for Asks {
        fn path(&mut self, batch: &Batch<'_>) {
            self.1 += batch.nodes.len();
            self.0.request();
        }
    }
    let (machine, setup) = (machine(), SetUp::default());
    let options = Options { densify: Densify::Off, ..Options::default() };
    let mut asks = Asks(options.stop.clone(), 0);
    let run = simulate(&machine, &program(40_000), &setup, &options, &mut [&mut asks]);
    assert!(run.stopped && asks.1 < 10_000, "{}", asks.1);
    let options = Options::default();
    let run = simulate(&machine, &program(10), &setup, &options, &mut []);
    assert!(!run.stopped);
}
