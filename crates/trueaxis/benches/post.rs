//! Cutter locations to text, as ratios to a plain loop with the standard library's formatting.
//!
//! The loop is what a spreadsheet or a script does: equations 1 to 3 of Zhang et al. 2023 point by point,
//! one branch, no travel, no tolerance, `write!`. Target of the writer: at least 5 times the loop.
//! The whole post-processor also looks for the best branch and turn of the whole path, checks travel
//! and chords: its ratio is stated, not asked for.

#![allow(clippy::print_stdout, reason = "a bench speaks")]

use std::f64::consts::TAU;
use std::fmt::Write;
use std::hint::black_box;
use std::time::{Duration, Instant};
use trueaxis::cl::{ClFile, Reading};
use trueaxis::files;
use trueaxis::geometry::Vec3;
use trueaxis::nc::Control;
use trueaxis::nc::moves::{Axis, Feed, FeedMode};
use trueaxis::post::{PostOptions, post};
use trueaxis::writer::{Block, Heading, Target, Writer};

const POINTS: usize = 50_000;
const ROUNDS: usize = 7;

/// A spiral round a ring, the tool leaning outwards.
fn points() -> Vec<(Vec3, Vec3)> {
    let at = |i: usize| {
        let u = TAU * i as f64 / 240.0;
        let (s, c) = u.sin_cos();
        let tilt = 1.0 + 0.2 * (3.0 * u).sin();
        let tip = Vec3::new(30.0 * c, 28.0 * s, 10.0 * i as f64 / POINTS as f64);
        (tip, Vec3::new(tilt.sin() * c, tilt.sin() * s, tilt.cos()))
    };
    (0..POINTS).map(at).collect()
}

/// C and A in degrees, X, Y and Z.
fn machine_coordinates(tip: &Vec3, axis: &Vec3) -> [f64; 5] {
    let a = axis.x.hypot(axis.y).atan2(axis.z);
    let c = axis.x.atan2(-axis.y);
    let ((sa, ca), (sc, cc)) = (a.sin_cos(), c.sin_cos());
    let z = tip.z + 35.0;
    [
        tip.x * cc + tip.y * sc,
        (-tip.x * sc + tip.y * cc) * ca + z * sa,
        (tip.x * sc - tip.y * cc) * sa + z * ca,
        a.to_degrees(),
        c.to_degrees(),
    ]
}

fn plain(points: &[(Vec3, Vec3)]) -> usize {
    let mut text = String::new();
    for (tip, axis) in points {
        let [x, y, z, a, c] = machine_coordinates(tip, axis);
        let _ = writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.4} A{a:.5} C{c:.5} F1500.");
    }
    black_box(text).len()
}

/// The same without the numbers becoming text.
fn bare(points: &[(Vec3, Vec3)]) -> usize {
    let mut sum = 0.0;
    for (tip, axis) in points {
        sum += machine_coordinates(tip, axis).iter().sum::<f64>();
    }
    black_box(sum) as usize
}

fn by_writer(points: &[(Vec3, Vec3)]) -> usize {
    let mut writer = Writer::new(Control::Fanuc);
    // why: the built-in template and the numbers of this bench can be written.
    writer.write(&Block::Start(&Heading::default())).expect("sound");
    let feed = Feed { mode: FeedMode::PerMinute, value: 1500.0 };
    for (tip, axis) in points {
        let [x, y, z, a, c] = machine_coordinates(tip, axis);
        let target = Target::default()
            .at(Axis::X, x)
            .at(Axis::Y, y)
            .at(Axis::Z, z)
            .at(Axis::A, a)
            .at(Axis::C, c);
        writer.write(&Block::Line(target, feed)).expect("sound");
    }
    black_box(writer.finish()).len()
}

fn best(mut work: impl FnMut() -> usize) -> Duration {
    let time = |_| {
        let start = Instant::now();
        black_box(work());
        start.elapsed()
    };
    (0..ROUNDS).map(time).min().unwrap_or_default()
}

fn main() {
    let points = points();
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/i5-engraver/machine.toml");
    // why: the shipped machine is sound; a test reads it.
    let machine = files::machine(root.as_ref()).0.expect("a machine");
    let mut text = "UNITS/MM\nMULTAX/ON\nFEDRAT/1500,MMPM\n".to_owned();
    for (tip, axis) in &points {
        let _ = writeln!(
            text,
            "GOTO/{:.6},{:.6},{:.6},{:.9},{:.9},{:.9}",
            tip.x, tip.y, tip.z, axis.x, axis.y, axis.z
        );
    }
    let text = text.into_bytes();
    let read = || ClFile::read("bench.cls", text.clone(), &Reading::default()).0;
    let file = read();
    let off = PostOptions { tip_words: None, ..PostOptions::of(Control::Fanuc) };
    let rows = [
        ("plain loop, write!", best(|| plain(&points))),
        ("plain loop, nothing written", best(|| bare(&points))),
        ("the same loop, Writer", best(|| by_writer(&points))),
        ("reading the file", best(|| read().records().len())),
        (
            "post, tool-centre point off",
            best(|| post(&machine, &file, &off).0.map_or(0, |p| p.text.len())),
        ),
    ];
    let first = rows[0].1.as_secs_f64();
    println!("{POINTS} points, best of {ROUNDS} rounds; ratio to the first row");
    for (name, time) in rows {
        let seconds = time.as_secs_f64();
        let rate = POINTS as f64 / seconds / 1e6;
        println!(
            "{name:32} {:8.1} ns/point  {rate:7.2} M/s  {:6.2} x",
            seconds * 1e9 / POINTS as f64,
            first / seconds
        );
    }
    let (plain, bare, writer) = (first, rows[1].1.as_secs_f64(), rows[2].1.as_secs_f64());
    println!("formatting alone: {:.1} x (target: at least 5)", (plain - bare) / (writer - bare));
}
