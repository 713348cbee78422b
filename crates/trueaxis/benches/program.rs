//! A program compensated, as ratios to reading and writing the same program with the standard library.
//!
//! The peer is what a script does that changes numbers in a program: it reads the words of each line,
//! adds a constant to X, Y and Z, and writes the line. The whole compensation executes the program,
//! solves every pose on the machine with its errors, writes, and simulates both programs again. Target:
//! 10^6 five-axis lines in 10 s on two cores, 10 µs per line by the clock.

#![allow(clippy::print_stdout, reason = "a bench speaks")]

use std::f64::consts::TAU;
use std::fmt::Write;
use std::hint::black_box;
use std::time::{Duration, Instant};
use trueaxis::compensate::program::{ProgramOptions, compensate_program};
use trueaxis::files;
use trueaxis::machine::Machine;
use trueaxis::nc::{Control, NoLibrary, Program, Settings, Step, interpret};
use trueaxis::simulate::SetUp;

const LINES: usize = 50_000;
const ROUNDS: usize = 5;

/// Round a cone of 15 deg, forth and back: about 1.2 mm and 0.5 deg in a block.
fn angles() -> String {
    let mut text = String::from("G21 G90 G94\nG43.4 H1\nG0 X155. Y0 Z150. A15. C0\n");
    for i in 0..LINES {
        let u = TAU * (i % 720) as f64 / 720.0;
        let t = if i / 720 % 2 == 0 { u } else { TAU - u };
        let (x, y) = (134.66 * t.cos(), 134.66 * t.sin());
        let c = t.to_degrees() - 180.0;
        let _ = writeln!(text, "N{i} G1 X{x:.4} Y{y:.4} Z-57.4 A15.0 C{c:.4} F800.");
    }
    text + "M30\n"
}

fn vectors() -> String {
    let mut text = String::from("G54 G17 G710 G90 G94\nTRAORI\nORIWKS ORIVECT\n");
    text.push_str("G0 X155 Y0 Z150 A3=-0.258819045 B3=0 C3=0.965925826\n");
    for i in 0..LINES {
        let u = TAU * (i % 720) as f64 / 720.0;
        let t = if i / 720 % 2 == 0 { u } else { TAU - u };
        let (s, c) = t.sin_cos();
        let (x, y) = (134.66 * c, 134.66 * s);
        let (a3, b3) = (-0.258_819_045 * c, -0.258_819_045 * s);
        let _ = writeln!(
            text,
            "N{i} G1 X{x:.6} Y{y:.6} Z-57.4 A3={a3:.9} B3={b3:.9} C3=0.965925826 F800"
        );
    }
    text + "M30\n"
}

/// Straight lines of 1 mm without tool-centre point.
fn three_axes() -> String {
    let mut text = String::from("G21 G90 G94\nG0 X0 Y0 Z-10.\n");
    for i in 0..LINES {
        let t = TAU * i as f64 / 600.0;
        let (x, y) = (100.0 * t.cos(), 100.0 * t.sin());
        let _ =
            writeln!(text, "N{i} G1 X{x:.3} Y{y:.3} Z{:.3} F800.", -20.0 + 5.0 * (0.1 * t).sin());
    }
    text + "M30\n"
}

/// The words of each line, with a constant on X, Y and Z.
fn plain(text: &str) -> usize {
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        for word in line.split(' ') {
            let number = word.get(1..).and_then(|n| n.parse::<f64>().ok());
            match (word.as_bytes().first(), number) {
                (Some(b'X' | b'Y' | b'Z'), Some(value)) => {
                    let _ = write!(out, "{}{:.3} ", &word[..1], value + 0.001);
                }
                _ => {
                    out.push_str(word);
                    out.push(' ');
                }
            }
        }
        out.push('\n');
    }
    black_box(out).len()
}

/// The program executed by its control, nothing else.
fn executed(program: &Program) -> usize {
    let mut moves = 0;
    interpret(program, &NoLibrary, &Settings::default(), &mut |step| {
        moves += usize::from(matches!(step, Step::Move(_)));
    });
    moves
}

fn compensated(machine: &Machine, program: &Program, pose_by_pose: bool) -> usize {
    let options = ProgramOptions { pose_by_pose, ..ProgramOptions::default() };
    let (done, problems) = compensate_program(machine, program, &SetUp::default(), &options);
    assert!(done.is_some(), "{problems:?}");
    done.map_or(0, |done| done.text.len())
}

fn best(mut work: impl FnMut() -> usize) -> Duration {
    let time = |_| {
        let start = Instant::now();
        black_box(work());
        start.elapsed()
    };
    (0..ROUNDS).map(time).min().unwrap_or_default()
}

fn machine(name: &str) -> Machine {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines");
    // why: the shipped machines are sound; a test reads them.
    files::machine(format!("{root}/{name}/machine.toml").as_ref()).0.expect("a machine")
}

fn main() {
    let cases = [
        ("five axes, vectors", "xkas2525", "b.mpf", Control::Sinumerik840d, vectors()),
        ("five axes, angles", "xkas2525", "b.nc", Control::Fanuc, angles()),
        ("three axes", "three-axis-mill", "b.nc", Control::Fanuc, three_axes()),
    ];
    println!("{LINES} lines, best of {ROUNDS} rounds by the clock; ratio to plain parse + write");
    for (name, at, file, control, text) in cases {
        let machine = machine(at);
        let program = Program::new(file, text.clone().into_bytes(), control);
        let rows = [
            ("plain parse + write", best(|| plain(&text))),
            ("executed by the control", best(|| executed(&program))),
            ("compensated", best(|| compensated(&machine, &program, false))),
            ("compensated pose by pose", best(|| compensated(&machine, &program, true))),
        ];
        let first = rows[0].1.as_secs_f64();
        println!("{name} on {at}");
        for (row, time) in rows {
            let micros = time.as_secs_f64() * 1e6 / LINES as f64;
            println!("  {row:26} {micros:8.3} µs/line {:8.1} x", time.as_secs_f64() / first);
        }
    }
}
