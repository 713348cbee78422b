//! Our figures for the printed numbers of Zhang Jian et al. 2023 that describe the machine, its screen and its parts.

use crate::Ours;
use crate::shop::{machine, root};
use trueaxis::files::disk;
use trueaxis::identify::rtcp::screen::screen;
use trueaxis::identify::rtcp::{Purpose, calibrate, read_rtcp};
use trueaxis::machine::axis::Travel;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::{Options, SetUp, simulate};

pub const CLAIMS: &[(&str, Ours)] = &[
    ("003-travels", travels),
    ("003-rapids", || rapids("XYZ")),
    ("003-rotary-travels", rotary),
    ("003-spindle", spindle),
    ("003-beyond", beyond),
    ("003-screen", screen_values),
    ("003-ring-step", ring_step),
    ("003-wall", wall),
    ("003-ranges", || vec![31.0396 - 31.0090, 31.0069 - 30.9978]),
    ("003-segment-step", segment_step),
];

fn axis(letter: char) -> trueaxis::machine::axis::Axis {
    let machine = machine("i5-engraver");
    let found = machine.axes().iter().find(|a| a.name.letter() == letter);
    found.expect("an axis of that letter").clone()
}

fn width(letter: char) -> f64 {
    match axis(letter).travel {
        Travel::Between(from, to) => to - from,
        _ => f64::INFINITY,
    }
}

fn travels() -> Vec<f64> {
    "XYZ".chars().map(width).collect()
}

/// m/min.
fn rapids(letters: &str) -> Vec<f64> {
    letters.chars().map(|l| axis(l).limits.velocity.expect("stated") * 0.06).collect()
}

/// Both ends of A; 1 where C has no ends.
fn rotary() -> Vec<f64> {
    let Travel::Between(from, to) = axis('A').travel else { return Vec::new() };
    let endless = axis('C').travel == Travel::Unlimited;
    vec![from.to_degrees(), to.to_degrees(), f64::from(u8::from(endless))]
}

fn spindle() -> Vec<f64> {
    let machine = machine("i5-engraver");
    let equipment = machine.equipment();
    let speed = equipment.max_spindle_rad_per_s.expect("stated") * 30.0 / std::f64::consts::PI;
    let power = equipment.spindle_power_w.expect("stated") / 1e3;
    vec![speed, power, f64::from(equipment.magazine_places.expect("stated"))]
}

/// How many requests of a program are beyond spindle and magazine.
fn beyond() -> Vec<f64> {
    let machine = machine("i5-engraver");
    let count = |text: &str| {
        let text = format!("G21 G90\n{text}\nG0 Z10.\nM30\n");
        let program = Program::new("p.nc", text.into_bytes(), Control::Fanuc);
        let run = simulate(&machine, &program, &SetUp::default(), &Options::default(), &mut []);
        run.beyond_equipment().count() as f64
    };
    ["T12 M6\nS40000 M3", "T12 M6\nS40001 M3", "T13 M6\nS40000 M3"].map(count).to_vec()
}

/// The values of the picture, field by field, as they stand in our list of the screen.
fn screen_values() -> Vec<f64> {
    let path = root().join("examples/05_identify/rtcp-angles.toml");
    let study = read_rtcp(&disk(), &path, Purpose::Result).0.expect("an example");
    let found = calibrate(&study).expect("readings");
    let fields = screen(&study, &found);
    fields.iter().skip(10).map(|f| f.shown.parse().expect("a number")).collect()
}

/// 60 directions over a turn.
fn ring_step() -> Vec<f64> {
    let text = std::fs::read_to_string(root().join("examples/05_identify/ring-60.toml"));
    let text = text.expect("an example");
    let table: toml::Table = text.parse().expect("TOML");
    let diameter = table["ring"]["diameter"].as_str().expect("a text");
    let diameter: f64 = diameter.split_whitespace().next().unwrap_or("").parse().expect("mm");
    vec![360.0 / 60.0, diameter]
}

/// Thickness of the wall in the example, and whether it lies in the printed range.
fn wall() -> Vec<f64> {
    let text = std::fs::read_to_string(root().join("examples/06_compensate/bangle-adapt.toml"));
    let table: toml::Table = text.expect("an example").parse().expect("TOML");
    let thickness = table["wall"]["thickness"].as_str().expect("a text");
    let thickness: f64 = thickness.split_whitespace().next().unwrap_or("").parse().expect("mm");
    vec![f64::from(u8::from((0.2..=0.3).contains(&thickness)))]
}

/// The largest step of a rotary axis by the chord error of the screen, 1 µm, at the corner of the X travel.
fn segment_step() -> Vec<f64> {
    let s = trueaxis::identify::rtcp::Segments {
        chord_error_mm: 0.001,
        distance_mm: 180.0,
        shortest_mm: None,
        first_mm: None,
        sharpest_rad_per_mm: None,
    };
    vec![s.largest_step_rad().to_degrees()]
}
