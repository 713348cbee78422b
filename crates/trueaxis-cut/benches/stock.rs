//! Stock at 0.5 mm: a block of 100 × 100 × 40 mm, a cutter of 10 mm in rows of 0.3 mm moves, one pose each.
//!
//! ```sh
//! cargo bench -p trueaxis-cut --bench stock
//! ```
//!
//! CAMotics does 1,240 moves a second in three axes at 0.5 mm on the machines of this project; ten times that is asked for in five axes.
#![allow(clippy::print_stdout, reason = "a bench speaks")]

use std::time::Instant;
use trueaxis_cut::stock::Stock;
use trueaxis_cut::{Cutter, ToolPose};
use trueaxis_geometry::Vec3;

const CAMOTICS_PER_S: f64 = 1_240.0;

fn main() {
    let cutters = [
        ("ball, three axes", Cutter::ball(10.0, 30.0), false),
        ("ball, five axes", Cutter::ball(10.0, 30.0), true),
        ("bull nose, five axes", Cutter::bull(10.0, 1.0, 30.0), true),
        ("flat end, five axes", Cutter::flat(10.0, 30.0), true),
    ];
    for (name, cutter, five) in cutters {
        let cutter = cutter.expect("a cutter");
        let poses = rows(five);
        let high = Vec3::new(100.0, 100.0, 40.0);
        let mut stock = Stock::block(&Vec3::zeros(), &high, 0.5).expect("a block");
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let begin = Instant::now();
        let taken = one.install(|| stock.cut(&cutter, &poses));
        let rate = poses.len() as f64 / begin.elapsed().as_secs_f64();
        let volume: f64 = taken.iter().map(|t| t.mean_mm3()).sum();
        println!(
            "{name:22} {rate:8.0} moves a second on one core, {:.1} times CAMotics; {volume:.0} mm³ of {} moves",
            rate / CAMOTICS_PER_S,
            poses.len()
        );
    }
}

/// Rows 1 mm apart over a wavy floor 3 to 7 mm under the top.
fn rows(five: bool) -> Vec<ToolPose> {
    let mut poses = Vec::new();
    for row in 0..100 {
        for k in 0..333 {
            let (x, y) = (0.3 * f64::from(k), f64::from(row));
            let z = 35.0 + 2.0 * (x / 9.0).sin() * (y / 11.0).cos();
            let lean = 0.25 * (x / 20.0).sin();
            let axis = match five {
                true => Vec3::new(lean, 0.17, 1.0).normalize(),
                false => Vec3::z(),
            };
            poses.push(ToolPose { tip_mm: Vec3::new(x, y, z), axis });
        }
    }
    poses
}
