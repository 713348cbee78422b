//! Reading and interpreting a generated five-axis program of 10⁶ lines.
//!
//! The targets are ratios in one run: interpreting is quicker than splitting the same text at its
//! blanks and reading nothing but its numbers with the standard library; the memory-bound limit is
//! counting the line ends of the same text.

use std::fmt::Write;

use divan::counter::{BytesCount, ItemsCount};
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};

const LINES: usize = 1_000_000;

fn main() {
    divan::main();
}

/// Five words and F in each line, four to five decimals.
fn text() -> String {
    let mut text = String::from("G21 G90\nG1 F1000\n");
    for i in 0..LINES {
        let t = i as f64 * 1e-3;
        let (x, y, z) = (100.0 * t.cos(), 100.0 * t.sin(), -0.001 * t);
        let (a, c) = (30.0 * (0.3 * t).sin(), (57.3 * t) % 360.0);
        let _ = writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.5} A{a:.4} C{c:.4} F{}.", 1000 + i % 7);
    }
    text
}

/// The same in the words of a control.
fn written_for(control: Control) -> String {
    let text = text();
    match control {
        Control::Sinumerik840d => text.replacen("G21", "G71", 1),
        Control::Heidenhain => {
            let lines = text.lines().skip(2).map(|l| l.replacen("G1 ", "L ", 1));
            let lines = lines.map(|l| l.replace(['X', 'Y', 'Z', 'A', 'C'], "").to_owned() + "\n");
            // Klartext has block numbers and signs: 7 L X+1.5 Y-2.
            let signed = |l: String| {
                let mut words = l.split_whitespace();
                let head = words.next().unwrap_or_default().to_owned();
                let named = words.zip(["X", "Y", "Z", "A", "C", ""]).map(|(word, axis)| {
                    let plus = if axis.is_empty() || word.starts_with('-') { "" } else { "+" };
                    format!(" {axis}{plus}{word}")
                });
                named.fold(head, |line, word| line + &word) + "\n"
            };
            let numbered = |(i, line): (usize, String)| format!("{} {}", i + 1, signed(line));
            let body: String = lines.enumerate().map(numbered).collect();
            format!("0 BEGIN PGM BENCH MM\n{body}{} END PGM BENCH MM\n", LINES + 1)
        }
        Control::Fanuc | Control::Haas | Control::LinuxCnc => text,
    }
}

#[divan::bench(args = ["LinuxCNC", "FANUC", "SINUMERIK", "HEIDENHAIN"], sample_count = 10)]
fn interpret_five_axes(bencher: divan::Bencher<'_, '_>, control: &str) {
    let control = match control {
        "FANUC" => Control::Fanuc,
        "SINUMERIK" => Control::Sinumerik840d,
        "HEIDENHAIN" => Control::Heidenhain,
        _ => Control::LinuxCnc,
    };
    let program = Program::new("bench", written_for(control).into_bytes(), control);
    bencher.counter(ItemsCount::new(LINES)).bench(|| {
        let (mut sum, mut moves) = (0.0, 0);
        let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
            if let Step::Move(m) = step {
                sum += m.target.0[0];
                moves += 1;
            }
        });
        assert!(outcome.finished && moves == LINES);
        sum
    });
}

#[divan::bench(sample_count = 10)]
fn std_numbers_alone(bencher: divan::Bencher<'_, '_>) {
    let text = text();
    bencher.counter(ItemsCount::new(LINES)).bench(|| {
        let words = text.lines().flat_map(|l| l.split(' '));
        words.filter_map(|w| w.get(1..)?.parse::<f64>().ok()).sum::<f64>()
    });
}

/// The time for reading each byte once, for comparison.
#[divan::bench(sample_count = 10)]
fn line_ends_alone(bencher: divan::Bencher<'_, '_>) {
    let text = text().into_bytes();
    let bytes = BytesCount::new(text.len());
    bencher.counter(ItemsCount::new(LINES)).counter(bytes).bench(|| {
        let ends = |block: &[u8]| block.iter().map(|b| u32::from(*b == b'\n')).sum::<u32>();
        divan::black_box(&text).chunks(4096).map(ends).sum::<u32>()
    });
}
