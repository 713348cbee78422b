//! Our figures for the claims of Jiang et al.

use crate::Ours;
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::file::NoTables;
use trueaxis::nc::{Control, Program};
use trueaxis::simulate::timing::three_phase::{Block, Shape, ThreePhases};
use trueaxis::simulate::{Batch, Densify, Observer, Options, SetUp, simulate};

pub const CLAIMS: &[(&str, Ours)] = &[
    ("002-t1", || vec![phases(10.0, Shape::Constant).times_s[0]]),
    ("002-s1", || vec![phases(10.0, Shape::Constant).lengths[0], shortest()]),
    ("002-peak", || {
        [Shape::Constant, Shape::Smooth].map(|s| phases(10.0, s).peak_acceleration()).to_vec()
    }),
    ("002-q", || vec![great_circle().len() as f64 - 1.0]),
    ("002-great-circle", || {
        let axes = great_circle();
        let angle = |a: &Vec3, b: &Vec3| a.cross(b).norm().atan2(a.dot(b));
        let (first, last) = (&axes[0], &axes[axes.len() - 1]);
        let each = angle(first, last) / (axes.len() - 1) as f64;
        let uneven = axes.windows(2).map(|w| (angle(&w[0], &w[1]) - each).abs());
        let normal = first.cross(last).normalize();
        let off = axes.iter().map(|a| normal.dot(a).abs());
        vec![uneven.fold(0.0, f64::max), off.fold(0.0, f64::max)]
    }),
    ("002-cone", || vec![cone_deg()]),
];

/// 1000 mm/min, 500 mm/s², from rest to rest.
fn phases(length: f64, shape: Shape) -> ThreePhases {
    let feed = 1000.0 / 60.0;
    let block = Block { length, feed, acceleration: 500.0, start: 0.0, end: 0.0, shape };
    block.phases().expect("a block")
}

/// The shortest block that reaches F, found by halving.
fn shortest() -> f64 {
    let reaches = |length: f64| phases(length, Shape::Constant).top >= 1000.0 / 60.0;
    let (mut low, mut high) = (0.0, 10.0);
    while high - low > 1e-14 {
        let middle = 0.5 * (low + high);
        if reaches(middle) { high = middle } else { low = middle }
    }
    high
}

/// The tool axes of the last block of a program on a gantry like the paper's, WYXZCAT.
fn axes_of_last_block(text: &str, densify: Densify) -> Vec<Vec3> {
    struct Axes(Vec<(u32, Vec3)>);
    impl Observer for Axes {
        fn path(&mut self, batch: &Batch<'_>) {
            for (i, node) in batch.nodes.iter().enumerate() {
                self.0.push((node.origin.line, batch.deviation(i).nominal_axis.vector()));
            }
        }
    }
    let gantry = "[machine]\nname = \"gantry\"\nchain = \"w b Y X Z C A t\"\n\
                  [tool]\nlength = \"100 mm\"";
    let machine = Machine::check("gantry", gantry, &NoTables).0.expect("a machine");
    let program = Program::new("p.mpf", text.as_bytes().to_vec(), Control::Sinumerik840d);
    let options = Options { densify, ..Options::default() };
    let mut axes = Axes(Vec::new());
    let run = simulate(&machine, &program, &SetUp::default(), &options, &mut [&mut axes]);
    assert!(!run.problems.has_errors(), "{:?}", run.problems);
    let last = axes.0.last().expect("a path").0;
    let first = axes.0.iter().position(|(line, _)| *line == last).expect("a block");
    axes.0[first - 1..].iter().map(|(_, axis)| *axis).collect()
}

/// From upright to 30° in a skew plane, over 10 mm.
fn great_circle() -> Vec<Vec3> {
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let text = format!(
        "TRAORI\nORIWKS ORIVECT\nG1 F1000 X0 Y0 Z0 A3={} B3={} C3=1\nG1 X6 Y8 A3={} B3={} C3={}\n",
        0.1,
        0.2, // any direction to begin with
        0.1 * cos - 0.2 * sin,
        0.2 * cos + 0.1 * sin,
        cos
    );
    axes_of_last_block(&text, Densify::Count { spacing_mm: 0.1, angle_rad: 1_f64.to_radians() })
}

fn cone_deg() -> f64 {
    let text = "TRAORI\nORIWKS ORIVECT\nG1 F1000 X0 Y0 Z0 A3=0 B3=1 C3=1\n\
                G1 X10 A3=1 B3=0 C3=1 ORICONCW A6=0 B6=0 C6=1\n";
    let densify = Densify::Count { spacing_mm: 0.1, angle_rad: 1.0 };
    let axes = axes_of_last_block(text, densify);
    let turn = |w: &[Vec3]| (w[0].x * w[1].y - w[0].y * w[1].x).atan2(w[0].xy().dot(&w[1].xy()));
    axes.windows(2).map(turn).sum::<f64>().to_degrees()
}
