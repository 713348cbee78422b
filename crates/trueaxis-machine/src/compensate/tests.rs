//! The single steps: their Jacobian, and the residual error after each.

// So that whoever reads this file alone, such as the house rules, knows what it is.
#[cfg(test)]
use super::{Compensator, Scope, Trial};
use crate::axis::Command;
use crate::compensate::columns::Columns;
use crate::compensate::rotary::Freedom;
use crate::errors::{BodyName, Rotation};
use crate::file::NoTables;
use crate::{Deviation, ErrorModel, Machine, Squareness};
use trueaxis_geometry::Vec3;

/// Head-head, table-table and one of each, the tool and the workpiece beside every centre.
const CHAINS: [&str; 3] = ["w b X Y Z C A t", "w C' A' b X Y Z t", "w X' C' b Y Z A t"];

/// Errors of 1 mm and 1 mrad, slopes and all.
const ERRORS: &str = r#"
    [workpiece]
    placement = ["shift 120 -80 60 mm", "turn Z 20 deg"]
    [tool]
    placement = ["shift 0 0 -200 mm", "turn Y 10 deg"]
    length = "100 mm"
    [location]
    EC0Y = "900 urad"
    EB0Z = "-700 urad"
    EA0C = "1000 urad"
    EX0C = "0.8 mm"
    EB0A = "-600 urad"
    EY0A = "-0.9 mm"
    [motion.X]
    EXX = { polynomial = ["0 mm", "0.8 mm", "-0.5 mm"], scale = "500 mm" }
    EBX = { polynomial = ["0 urad", "600 urad", "300 urad"], scale = "500 mm" }
    [motion.C]
    EYC = { fourier = { mean = "0 mm", terms = [[2, "0.4 mm", "0.5 mm"]] }, reversal = "0.2 mm" }
    EAC = { fourier = { mean = "0 urad", terms = [[1, "700 urad", "400 urad"], [3, "200 urad", "-300 urad"]] } }
    ECC = { fourier = { mean = "0 urad", terms = [[1, "-500 urad", "600 urad"]] } }
    [motion.A]
    ECA = { fourier = { mean = "300 urad", terms = [[1, "400 urad", "0 urad"]] } }
"#;

fn bad_machine(chain: &str, frame: &str) -> Machine {
    let head = "[machine]\nname = \"bad\"\n";
    let text = format!("{head}chain = \"{chain}\"\nerror_frame = \"{frame}\"\n{ERRORS}");
    let (machine, problems) = Machine::check("bad.toml", &text, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

/// A command by the letters X Y Z C A.
fn command(machine: &Machine, xyzca: [f64; 5]) -> Command {
    let mut command = Command::default();
    for (letter, q) in "XYZCA".chars().zip(xyzca) {
        let axis = BodyName::new(letter).and_then(|name| machine.axis_index(name));
        command[axis.expect("an axis")] = q;
    }
    command
}

#[test]
fn law_the_columns_are_the_limits_of_differences() {
    let side = [0.0, 0.0, 0.0, 1.0, -1.0, 0.0];
    for (chain, frame) in CHAINS.iter().flat_map(|c| [(c, "fixed"), (c, "moving")]) {
        for rotation in [Rotation::Exact, Rotation::SmallAngle] {
            for squareness in [Squareness::Carried, Squareness::Direction] {
                let model = ErrorModel { rotation, squareness };
                let machine = bad_machine(chain, frame).with_model(model);
                let command = command(&machine, [210.0, -130.0, 70.0, 0.8, -0.5]);
                let at = |command: &Command| -> Deviation {
                    let errors = machine.errors_at(command, &side).expect("errors");
                    machine.deviation(command, &errors)
                };
                let errors = machine.errors_at(&command, &side).expect("errors");
                let columns = Columns::of(&machine, &command, &side, &errors);
                for axis in 0..5 {
                    let h = 1e-4;
                    let moved = |by: f64| -> [Vec3; 2] {
                        let mut command = command;
                        command[axis] += by;
                        let d = at(&command);
                        [d.nominal_tip.vector() + d.tip_mm, d.nominal_axis.vector() + d.axis]
                    };
                    let (plus, minus) = (moved(h), moved(-h));
                    let [tip, direction] = [0, 1].map(|k| (plus[k] - minus[k]) / (2.0 * h));
                    let what = format!("{chain} {frame} {model:?} {axis}");
                    assert!((tip - columns.tip[axis]).norm() < 1e-5, "{what}: tip");
                    assert!((direction - columns.axis[axis]).norm() < 1e-8, "{what}: axis");
                }
            }
        }
    }
}

/// The residual error of the tip, mm, and of the axis at each evaluation, while above rounding.
fn residuals(compensator: &Compensator, command: [f64; 6]) -> Vec<[f64; 2]> {
    let side = [0.0; 6];
    let machine = compensator.machine();
    let errors = machine.errors_at(&command, &side).expect("errors");
    let before = machine.deviation(&command, &errors);
    let mut now = Trial { command, errors, residual: before };
    let mut all = Vec::new();
    for step in 0..6 {
        all.push([now.residual.tip_mm.norm(), now.residual.axis.norm()]);
        let view = compensator.view(&now, &side).expect("three directions");
        let next = compensator.step(&now, &view, &Freedom::Both, step == 0);
        now = compensator.trial(next, &side, &before).expect("errors");
    }
    all
}

#[test]
fn law_each_step_squares_what_is_left() {
    for chain in CHAINS {
        let machine = bad_machine(chain, "moving");
        let compensator = Compensator::of(&machine, Scope::Pose).expect("three linear axes");
        let mut orders = Vec::new();
        for k in 0..40 {
            let k = f64::from(k);
            let xyzca = [10.0 * k, 300.0 - 9.0 * k, -5.0 * k, 0.7 * k, 0.3 + 0.02 * k];
            let residuals = residuals(&compensator, command(&machine, xyzca));
            // The order from three values in a row: ln(e₂/e₁)/ln(e₁/e₀), of the axis (no unit).
            let [e0, e1, e2] = [0, 1, 2].map(|i| residuals[i][1]);
            assert!(
                e1 < 20.0 * e0 * e0 && e2 < (20.0 * e1 * e1).max(1e-14),
                "{chain} {residuals:?}"
            );
            if e2 > 1e-14 {
                orders.push((e2 / e1).ln() / (e1 / e0).ln());
            }
            // Three corrections of 1 mm and 1 mrad are exact to rounding.
            assert!(residuals[3][0] < 1e-10 && residuals[3][1] < 1e-13, "{chain} {residuals:?}");
        }
        orders.sort_by(f64::total_cmp);
        let median = orders[orders.len() / 2];
        let known = orders.len() > 10 && (1.8..2.3).contains(&median);
        assert!(known, "{chain}: order {median} of {orders:?}");
    }
}
