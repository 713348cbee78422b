//! A five-axis program from its text to the deviations of the tool.
//!
//! The target is a ratio in one run: the whole path (parse, tool-centre point, nominal and actual
//! pose of every block, deviations) costs less than a microsecond per block, and not more than ten
//! times what interpreting alone costs.

use divan::counter::ItemsCount;
use std::fmt::Write;
use trueaxis::machine::Machine;
use trueaxis::nc::{Control, NoLibrary, Program, Settings, Step, interpret};
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, simulate};

const LINES: usize = 100_000;

fn main() {
    divan::main();
}

/// Five words and F in each line, three to five decimals; tool tips and rotary angles.
fn text() -> String {
    let mut text = String::from("G21 G90 G94\nG43.4 H1\nG1 F1000 X100. Y0 Z0 A0 C0\n");
    for i in 0..LINES {
        let t = i as f64 * 1e-3;
        let (x, y, z) = (100.0 * t.cos(), 100.0 * t.sin(), -0.01 * t);
        let (a, c) = (30.0 * (0.3 * t).sin(), 57.3 * t);
        let _ = writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.5} A{a:.4} C{c:.4} F{}.", 1000 + i % 7);
    }
    text
}

fn machine() -> Machine {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/i5-engraver/machine.toml");
    trueaxis::files::machine(path.as_ref()).0.expect("a shipped machine")
}

/// Keeps what a report would need least: the largest deviation.
struct Worst(f64);

impl Observer for Worst {
    fn path(&mut self, batch: &Batch<'_>) {
        for i in 0..batch.nodes.len() {
            self.0 = self.0.max(batch.deviation(i).tip_mm.norm());
        }
    }
}

#[divan::bench]
fn interpret_alone(bencher: divan::Bencher<'_, '_>) {
    let program = Program::new("bench.nc", text().into_bytes(), Control::Fanuc);
    bencher.counter(ItemsCount::new(LINES)).bench(|| {
        let mut sum = 0.0;
        interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
            if let Step::Move(m) = step {
                sum += m.target.0[0];
            }
        });
        sum
    });
}

fn whole(bencher: divan::Bencher<'_, '_>, densify: Densify) {
    let program = Program::new("bench.nc", text().into_bytes(), Control::Fanuc);
    let machine = machine();
    let options = Options { densify, ..Options::default() };
    bencher.counter(ItemsCount::new(LINES)).bench(|| {
        let mut worst = Worst(0.0);
        simulate(&machine, &program, &SetUp::default(), &options, &mut [&mut worst]);
        worst.0
    });
}

#[divan::bench]
fn whole_path(bencher: divan::Bencher<'_, '_>) {
    whole(bencher, Densify::Off);
}

#[divan::bench]
fn whole_path_densified(bencher: divan::Bencher<'_, '_>) {
    whole(bencher, Densify::default());
}
