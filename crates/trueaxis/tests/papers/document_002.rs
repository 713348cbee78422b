//! Our side of document-002.toml.

use crate::Ours;
use trueaxis::simulate::timing::three_phase::{Block, Shape, ThreePhases};

pub const CLAIMS: &[(&str, Ours)] = &[
    ("002-t1", || vec![phases(10.0, Shape::Constant).times_s[0]]),
    ("002-s1", || vec![phases(10.0, Shape::Constant).lengths[0], shortest()]),
    ("002-peak", || {
        [Shape::Constant, Shape::Smooth].map(|s| phases(10.0, s).peak_acceleration()).to_vec()
    }),
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
