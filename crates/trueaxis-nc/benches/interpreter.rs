//! Reading and interpreting a generated five-axis program.
//!
//! The target is a ratio in one run: interpreting is not slower than splitting the same text at its
//! blanks and reading nothing but its numbers with the standard library.

use std::fmt::Write;

use divan::counter::ItemsCount;
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};

const LINES: usize = 100_000;

fn main() {
    divan::main();
}

/// Five words and F in each line, three to five decimals.
fn text() -> String {
    let mut text = String::from("G21 G90\nG1 F1000\n");
    for i in 0..LINES {
        let t = i as f64 * 1e-3;
        let (x, y, z) = (100.0 * t.cos(), 100.0 * t.sin(), -0.01 * t);
        let (a, c) = (30.0 * (0.3 * t).sin(), (57.3 * t) % 360.0);
        let _ = writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.5} A{a:.4} C{c:.4} F{}.", 1000 + i % 7);
    }
    text
}

#[divan::bench]
fn interpret_five_axes(bencher: divan::Bencher<'_, '_>) {
    let program = Program::new("bench", text().into_bytes(), Control::LinuxCnc);
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

#[divan::bench]
fn std_numbers_alone(bencher: divan::Bencher<'_, '_>) {
    let text = text();
    bencher.counter(ItemsCount::new(LINES)).bench(|| {
        let words = text.lines().flat_map(|l| l.split(' '));
        words.filter_map(|w| w.get(1..)?.parse::<f64>().ok()).sum::<f64>()
    });
}
