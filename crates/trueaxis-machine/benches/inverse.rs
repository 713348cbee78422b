//! Axis positions for a path of the tool: whole columns against one pose after the other.
//!
//! The path is that of a ball over a dome, with vectors: 10⁶ poses that follow each other by 0.3 mm. All ways give the
//! branch and the turn nearest to the pose before; `Machine::solve` lists all of them and takes the first.
//! The candidates take turns in one run and the medians are compared.
//!
//! ```text
//!     cargo bench -p trueaxis-machine --bench inverse
//! ```

#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

#[path = "common/mod.rs"]
mod common;

use common::{Candidate, POSES, machine, print, run};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_machine::Target;
use trueaxis_machine::axis::Command;
use trueaxis_machine::batch::{CommandTable, CompiledInverse, InstructionSet, TargetColumns};
use trueaxis_machine::tcp::TipControl;

/// `Machine::solve` computes this many poses per round.
const SLOW_POSES: usize = 20_000;
const STEP_MM: f64 = 0.3;
const SIDE_MM: f64 = 96.0;
const DOME_MM: f64 = 120.0;

/// Tip and tool axis of a pose.
fn target(i: usize) -> (Vec3, Vec3) {
    let per_row = (SIDE_MM / STEP_MM) as usize;
    let (row, k) = (i / per_row, i % per_row);
    let k = if row.is_multiple_of(2) { k } else { per_row - 1 - k };
    let along = (k as f64 / (per_row - 1) as f64 - 0.5) * SIDE_MM;
    let across = (row as f64 / (POSES / per_row) as f64 - 0.5) * SIDE_MM;
    let height = (DOME_MM * DOME_MM - along * along - across * across).sqrt();
    let normal = Vec3::new(along, across, height) / DOME_MM;
    let lean = normal + Vec3::new(0.17, 0.05 * (along / 10.0).sin(), 0.0);
    (normal * DOME_MM, lean.normalize())
}

fn main() {
    let machine = machine();
    let control = TipControl::of(&machine).expect("three linear axes");
    let inverse = CompiledInverse::of(&machine).expect("three linear axes");
    let targets: Vec<(Vec3, Vec3)> = (0..POSES).map(target).collect();
    let column = |of: fn(&(Vec3, Vec3)) -> Vec3, k: usize| -> Vec<f64> {
        targets.iter().map(|t| of(t)[k]).collect()
    };
    let tips = [0, 1, 2].map(|k| column(|t| t.0, k));
    let axes = [0, 1, 2].map(|k| column(|t| t.1, k));
    let columns = TargetColumns {
        tip_mm: tips.each_ref().map(Vec::as_slice),
        axis: axes.each_ref().map(Vec::as_slice),
    };
    let direction = |axis: Vec3| Direction::of(axis).expect("a direction");

    let mut candidates = vec![
        Candidate::new("TipControl, pose by pose", POSES, || {
            let (mut last, mut sum) = (Command::default(), 0.0);
            for (tip, axis) in &targets {
                last = control.aim_nearest(direction(*axis), &last).expect("reachable").command;
                assert!(control.place(*tip, &mut last));
                sum += last[0];
            }
            std::hint::black_box(sum);
        }),
        Candidate::new("Machine::solve", SLOW_POSES, || {
            let (mut last, mut sum) = (Command::default(), 0.0);
            for (tip, axis) in &targets[..SLOW_POSES] {
                let target = Target { tip: Point::from_vector(*tip), axis: direction(*axis) };
                last = machine.solve(&target, &last).expect("reachable").solutions[0].command;
                sum += last[0];
            }
            std::hint::black_box(sum);
        }),
    ];
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
        let (mut out, inverse, columns) = (CommandTable::zeros(5, POSES), &inverse, &columns);
        candidates.push(Candidate::new(format!("columns, {set:?}"), POSES, move || {
            let done = inverse.commands_by(set, columns, &[0.0; 6], &mut out.columns());
            done.expect("reachable");
        }));
    }
    run(&mut candidates);
    print(&candidates);
}
