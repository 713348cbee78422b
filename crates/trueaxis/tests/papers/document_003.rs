//! Our side of document-003.toml: Zhang Jian et al. 2023.

use crate::Ours;
use crate::shop::{command, machine, shown, target};
use std::f64::consts::PI;

pub const CLAIMS: &[(&str, Ours)] = &[
    ("003-eq-1-3-A90-C0", || linear_axes(90.0, 0.0)),
    ("003-eq-1-3-A30-C90", || linear_axes(30.0, 90.0)),
    ("003-eq-1-3-A-60-C45", || linear_axes(-60.0, 45.0)),
    ("003-angles", || angles(0)),
    ("003-angles-other-branch", || angles(1)),
    ("003-angles-upright", upright),
];

/// X, Y, Z for the tool tip (10, 20, 30) at these angles, on the branch that has them.
fn linear_axes(a_deg: f64, c_deg: f64) -> Vec<f64> {
    let machine = machine("i5-engraver");
    let ((sa, ca), (sc, cc)) = (a_deg.to_radians().sin_cos(), c_deg.to_radians().sin_cos());
    let wanted = target([10.0, 20.0, 30.0], [sc * sa, -cc * sa, ca]);
    let from = command(&machine, &format!("A={a_deg} C={c_deg}"));
    let best = machine.solve(&wanted, &from).expect("reachable").solutions[0].command;
    shown(&machine, &best, "XYZ")
}

/// C and A of one of the two branches with angles within half a turn.
fn angles(branch: usize) -> Vec<f64> {
    let machine = machine("i5-engraver");
    let wanted = target([10.0, 20.0, 30.0], [0.3, -0.2, 0.93]);
    let solved = machine.solve(&wanted, &[0.0; 6]).expect("reachable");
    let within = |s: &&trueaxis::machine::Solution| s.command[..2].iter().all(|q| q.abs() <= PI);
    let solution = solved.solutions.iter().filter(within).nth(branch);
    shown(&machine, &solution.expect("two branches").command, "CA")
}

/// An upright tool while C stands at 37 deg.
fn upright() -> Vec<f64> {
    let machine = machine("i5-engraver");
    let from = command(&machine, "C=37");
    let solved = machine.solve(&target([10.0, 20.0, 30.0], [0.0, 0.0, 1.0]), &from);
    shown(&machine, &solved.expect("reachable").solutions[0].command, "CA")
}
