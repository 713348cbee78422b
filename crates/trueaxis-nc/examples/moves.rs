//! Prints the moves of an NC program.
//!
//! ```text
//! cargo run -p trueaxis-nc --example moves -- part.mpf
//! ```
//!
//! The control follows from the ending: `.mpf` SINUMERIK, `.h` HEIDENHAIN, `.nc` FANUC, `.ngc`
//! LinuxCNC. Without a program a small one of LinuxCNC is shown.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example prints what it finds")]

use std::path::Path;
use std::process::ExitCode;

use trueaxis_nc::moves::{Axis, MoveKind};
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};

/// Used where no program is named: a quarter circle, then a hole.
const SAMPLE: &str = "G21 G17 G90 F300\nG0 X0 Y0 Z5\nG2 X10 Y10 I10\nG81 Z-3 R1\nM2\n";

fn main() -> ExitCode {
    let (name, text) = match std::env::args().nth(1) {
        None => ("sample.ngc".to_owned(), SAMPLE.as_bytes().to_vec()),
        Some(name) => match std::fs::read(&name) {
            Ok(text) => (name, text),
            Err(why) => {
                eprintln!("{name}: {why}");
                return ExitCode::from(2);
            }
        },
    };
    let control = match Path::new(&name).extension().and_then(|ending| ending.to_str()) {
        Some("mpf" | "MPF" | "spf" | "SPF") => Control::Sinumerik840d,
        Some("h" | "H") => Control::Heidenhain,
        Some("ngc") => Control::LinuxCnc,
        _ => Control::Fanuc,
    };
    let program = Program::new(&name, text, control);
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
        let Step::Move(step) = step else { return };
        let kind = match step.kind {
            MoveKind::Rapid => "rapid",
            MoveKind::Linear => "line",
            MoveKind::Arc(_) | MoveKind::SpatialArc(_) => "arc",
            MoveKind::Dwell { .. } => "wait",
            _ => "other",
        };
        let place = Axis::ALL.map(|axis| format!("{axis}{:.3}", step.target[axis])).join(" ");
        println!("{:>6}  {kind:<5}  {place}  F{}", step.origin.line, step.feed.value);
    });
    for problem in outcome.problems.iter() {
        eprintln!("{} {}: {}", problem.place, problem.code, problem.message);
    }
    if outcome.finished { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
