//! Nails on a dome of 96 mm under rows of 0.3 mm moves: processor time for each nail.
//!
//! ```sh
//! cargo bench -p trueaxis-cut --bench nails              # 10^5 nails, 1.1·10^6 moves
//! cargo bench -p trueaxis-cut --bench nails -- 100000    # fewer moves
//! ```
//!
//! The limit is 25 µs for a ball in five axes; a scalar prototype took 68 µs, 28 in three axes with a tenth of the moves.
#![allow(clippy::print_stdout, reason = "a bench speaks")]

use std::time::Instant;
use trueaxis_cut::{Cutter, Nail, Reach, Sweep, ToolPose, cut};
use trueaxis_geometry::Vec3;

const SIZE_MM: f64 = 96.0;
const DOME_MM: f64 = 120.0;
const STEP_MM: f64 = 0.3;

fn main() {
    let asked = std::env::args().skip(1).find_map(|a| a.parse::<usize>().ok());
    let moves = asked.unwrap_or(1_100_000);
    let nails = nails(100_000);
    let cutters = [
        ("ball, three axes", Cutter::ball(10.0, 30.0), false),
        ("ball, five axes", Cutter::ball(10.0, 30.0), true),
        ("bull nose, five axes", Cutter::bull(10.0, 1.0, 30.0), true),
        ("flat end, five axes", Cutter::flat(10.0, 30.0), true),
    ];
    println!("{} nails, {moves} moves of {STEP_MM} mm", nails.len());
    for (name, cutter, five) in cutters {
        let cutter = cutter.expect("a cutter");
        let steps = rows(&cutter, moves, five);
        let begin = Instant::now();
        let sweep = Sweep::new(cutter, steps).expect("a sweep");
        let built_s = begin.elapsed().as_secs_f64();
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let begin = Instant::now();
        let left = one.install(|| cut(std::slice::from_ref(&sweep), &nails));
        let each_us = begin.elapsed().as_secs_f64() * 1e6 / nails.len() as f64;
        let missing = left.iter().filter(|r| **r == Reach::NotCut).count();
        let most =
            left.iter().filter_map(Reach::cut).map(|c| c.deviation_mm).fold(f64::MIN, f64::max);
        println!(
            "{name:22} {each_us:7.2} µs per nail on one core; tree {built_s:.2} s; most left {:.3} µm, {missing} not cut",
            1e3 * most
        );
    }
}

fn dome(x: f64, y: f64) -> (Vec3, Vec3) {
    let z = (DOME_MM * DOME_MM - x * x - y * y).sqrt();
    let point = Vec3::new(x, y, z);
    (point, point / DOME_MM)
}

fn nails(count: usize) -> Vec<Nail> {
    let side = (count as f64).sqrt().round() as usize;
    let at = |k: usize| (k as f64 + 0.5) / side as f64 * (SIZE_MM - 12.0) - 0.5 * (SIZE_MM - 12.0);
    let nail = |i: usize| {
        let (foot_mm, normal) = dome(at(i % side), at(i / side));
        Nail { foot_mm, normal, below_mm: 1.0, above_mm: 1.0 }
    };
    (0..side * side).map(nail).collect()
}

/// Rows to and fro that touch the dome; in five axes the tool leans 10° along its way and swings.
fn rows(cutter: &Cutter, moves: usize, five: bool) -> Vec<[ToolPose; 2]> {
    let per_row = (SIZE_MM / STEP_MM) as usize;
    let count = moves / per_row;
    let radius = cutter.widest_mm();
    let pose = |row: usize, k: usize| {
        let along = k as f64 * STEP_MM - 0.5 * SIZE_MM;
        let across = row as f64 / count as f64 * SIZE_MM - 0.5 * SIZE_MM;
        let (touch, normal) = dome(along, across);
        let axis = match five {
            true => (normal + Vec3::new(0.17, 0.05 * (along / 10.0).sin(), 0.0)).normalize(),
            false => Vec3::z(),
        };
        ToolPose { tip_mm: tip(cutter, radius, &touch, &normal, &axis), axis }
    };
    let mut steps = Vec::with_capacity(moves);
    for row in 0..count {
        let at = |k: usize| pose(row, if row % 2 == 0 { k } else { per_row - k });
        steps.extend((0..per_row).map(|k| [at(k), at(k + 1)]));
    }
    steps
}

/// The tip of a tool that touches a point: lowered along the normal until it does.
fn tip(cutter: &Cutter, radius: f64, touch: &Vec3, normal: &Vec3, axis: &Vec3) -> Vec3 {
    // The farthest point of the cutter against the normal, by its distance from far away.
    let far = 1e6;
    let arm = -normal * far;
    let axial = arm.dot(axis);
    let radial = (arm - axis * axial).norm();
    let (distance, _) = cutter.distance(radial, axial);
    debug_assert!(distance > far - 2.0 * radius - cutter.height_mm());
    touch + normal * (far - distance)
}
