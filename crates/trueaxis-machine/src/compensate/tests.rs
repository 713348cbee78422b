//! How fast the steps converge: what is left after each, from the inside.

// So that whoever reads this file alone, such as the house rules, knows what it is.
#[cfg(test)]
use super::{Compensator, Scope, Trial};
use crate::Machine;
use crate::compensate::columns::Columns;
use crate::file::NoTables;

/// A head with errors of 1 mm and 1 mrad, slopes and all.
fn bad_head() -> Machine {
    let text = "[machine]\nname = \"head\"\nchain = \"w b X Y Z C A t\"\n[tool]\n\
        placement = \"0 0 -200 mm\"\nlength = \"100 mm\"\n[location]\nEC0Y = \"900 urad\"\n\
        EB0Z = \"-700 urad\"\nEA0C = \"1000 urad\"\nEX0C = \"0.8 mm\"\nEB0A = \"-600 urad\"\n\
        EY0A = \"-0.9 mm\"\n[motion.X]\nEXX = { polynomial = [\"0 mm\", \"0.8 mm\", \"-0.5 mm\"], \
        scale = \"500 mm\" }\n[motion.C]\nEAC = { fourier = { mean = \"0 urad\", terms = \
        [[1, \"700 urad\", \"400 urad\"], [3, \"200 urad\", \"-300 urad\"]] } }";
    Machine::check("head.toml", text, &NoTables).0.expect("a machine")
}

/// What is left of the tip, mm, and of the axis at each evaluation, while it is above rounding.
fn left(compensator: &Compensator, command: [f64; 6]) -> Vec<[f64; 2]> {
    let side = [0.0; 6];
    let machine = compensator.machine();
    let errors = machine.errors_at(&command, &side).expect("errors");
    let before = machine.deviation(&command, &errors);
    let mut now = Trial { command, errors, left: before };
    let (mut all, mut freedom) = (Vec::new(), None);
    for step in 0..6 {
        all.push([now.left.tip_mm.norm(), now.left.axis.norm()]);
        let columns = Columns::of(machine, &now.command, &side, &now.errors);
        let freedom = freedom.get_or_insert_with(|| compensator.freedom(&now, &columns).0);
        let next = compensator.step(&now, &columns, freedom, step == 0).expect("a step");
        now = compensator.trial(next, &side, &before).expect("errors");
    }
    all
}

#[test]
fn law_each_step_squares_what_is_left() {
    let compensator = Compensator::of(&bad_head(), Scope::Pose).expect("three linear axes");
    let mut orders = Vec::new();
    for k in 0..40 {
        let k = f64::from(k);
        let (c, a) = (0.7 * k, 0.3 + 0.02 * k);
        let left = left(&compensator, [10.0 * k, 300.0 - 9.0 * k, -5.0 * k, c, a, 0.0]);
        // The order from three values in a row: ln(e₂/e₁)/ln(e₁/e₀), of the axis (no unit).
        let [e0, e1, e2] = [0, 1, 2].map(|i| left[i][1]);
        assert!(e1 < 10.0 * e0 * e0 && e2 < (10.0 * e1 * e1).max(1e-14), "{left:?}");
        if e2 > 1e-14 {
            orders.push((e2 / e1).ln() / (e1 / e0).ln());
        }
        // Three corrections of 1 mm and 1 mrad are exact to rounding.
        assert!(left[3][0] < 1e-10 && left[3][1] < 1e-13, "{left:?}");
    }
    orders.sort_by(f64::total_cmp);
    let median = orders[orders.len() / 2];
    assert!(orders.len() > 10 && (1.8..2.3).contains(&median), "order {median}: {orders:?}");
}
