//! Sensitivity indices of the function of Ishigami, which has them in closed form.
//!
//! ```text
//! f = sin x₁ + 7 sin² x₂ + 0.1 x₃⁴ sin x₁,   xᵢ uniform in −π..π
//! ```
//!
//! *Source:* T. Ishigami, T. Homma, Proc. ISUMA 1990; the closed form in Saltelli et al., Global Sensitivity Analysis: The
//! Primer, 2008.

use std::f64::consts::PI;
use trueaxis_study::sensitivity::{GroupShares, Rows};
use trueaxis_study::{Column, ColumnPlan, Set, Spreading};

const A: f64 = 7.0;
const B: f64 = 0.1;

fn ishigami(x: [f64; 3]) -> f64 {
    x[0].sin() + A * x[1].sin().powi(2) + B * x[2].powi(4) * x[0].sin()
}

/// First and total indices.
fn closed_form() -> [[f64; 3]; 2] {
    let v1 = 0.5 * (1.0 + B * PI.powi(4) / 5.0).powi(2);
    let v2 = A * A / 8.0;
    let v13 = B * B * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
    let v = v1 + v2 + v13;
    [[v1 / v, v2 / v, 0.0], [(v1 + v13) / v, v2 / v, v13 / v]]
}

fn shares(spreading: Spreading, rows: usize, seed: u64) -> Vec<GroupShares> {
    let names = ["x1", "x2", "x3"];
    let column = |set: Set, first: usize, i: usize| {
        let plan = ColumnPlan { spreading, seed, set, count: rows as u64, dimension: first + i };
        Column::new(plan, names[i])
    };
    let mut a: Vec<Column> = (0..3).map(|i| column(Set::First, 0, i)).collect();
    let mut b: Vec<Column> = (0..3).map(|i| column(Set::Second, 3, i)).collect();
    let mut found = Rows { mixed: vec![Vec::new(); 3], ..Rows::default() };
    for row in 0..rows as u64 {
        let at = |columns: &mut Vec<Column>| -> [f64; 3] {
            std::array::from_fn(|i| PI * (2.0 * columns[i].at(row) - 1.0))
        };
        let (x, y) = (at(&mut a), at(&mut b));
        found.a.push(ishigami(x));
        found.b.push(ishigami(y));
        for i in 0..3 {
            let mut mixed = x;
            mixed[i] = y[i];
            found.mixed[i].push(ishigami(mixed));
        }
    }
    found.shares().unwrap()
}

/// Sensitivity indices are those of the closed form of Ishigami's function, with random points, a Latin hypercube and the sequence of Sobol'.
#[test]
fn paper_indices_are_those_of_the_closed_form() {
    let [first, total] = closed_form();
    // Saltelli et al. 2008 print 0.3139, 0.4424, 0 and 0.5576, 0.4424, 0.2437.
    for (ours, printed) in
        first.iter().chain(&total).zip([0.3139, 0.4424, 0.0, 0.5576, 0.4424, 0.2437])
    {
        assert!((ours - printed).abs() < 5e-5);
    }
    for (spreading, within) in
        [(Spreading::Random, 0.02), (Spreading::LatinHypercube, 0.02), (Spreading::Sobol, 0.002)]
    {
        let found = shares(spreading, 1 << 16, 1);
        for i in 0..3 {
            let (f, t) = (found[i].first, found[i].total);
            assert!((f.ratio - first[i]).abs() < within, "{spreading:?} {i}: {f:?}");
            assert!((t.ratio - total[i]).abs() < within, "{spreading:?} {i}: {t:?}");
            // The error lies within five of its standard uncertainties.
            assert!((f.ratio - first[i]).abs() < 5.0 * f.u_ratio, "{spreading:?} {i}: {f:?}");
            assert!((t.ratio - total[i]).abs() < 5.0 * t.u_ratio, "{spreading:?} {i}: {t:?}");
        }
    }
}

/// Sensitivity indices: of 400 studies the interval of 95 % holds the closed form in 95 %: within four standard deviations, 4.4 %.
#[test]
fn law_intervals_hold_what_they_say() {
    let [first, total] = closed_form();
    let mut held = [0.0; 6];
    let studies = 400;
    for seed in 0..studies {
        let found = shares(Spreading::Random, 1024, seed);
        for i in 0..3 {
            let within = |ratio: f64, u: f64, is: f64| f64::from((ratio - is).abs() < 1.96 * u);
            held[i] += within(found[i].first.ratio, found[i].first.u_ratio, first[i]);
            held[i + 3] += within(found[i].total.ratio, found[i].total.u_ratio, total[i]);
        }
    }
    for (i, held) in held.iter().enumerate() {
        let share = held / studies as f64;
        assert!((share - 0.95).abs() < 0.044, "{i}: {share}");
    }
}

/// Sensitivity indices are those of SALib 1.6.0 at 4096 rows, within both intervals, with the half-width of its interval of 95 % by its bootstrap: oracles/sobol.py.
#[test]
fn oracle_indices_are_those_of_salib() {
    let salib = [
        [0.3142, 0.0305, 0.5576, 0.0420],
        [0.4434, 0.0265, 0.4422, 0.0204],
        [-0.0003, 0.0276, 0.2445, 0.0133],
    ];
    let found = shares(Spreading::Sobol, 4096, 1);
    for (i, [first, of_first, total, of_total]) in salib.into_iter().enumerate() {
        let both = |u: f64, other: f64| (1.96 * u).hypot(other);
        let (f, t) = (found[i].first, found[i].total);
        assert!((f.ratio - first).abs() < both(f.u_ratio, of_first), "{i}: {f:?}");
        assert!((t.ratio - total).abs() < both(t.u_ratio, of_total), "{i}: {t:?}");
        // Both intervals are as wide, within a third.
        assert!((1.96 * f.u_ratio / of_first - 1.0).abs() < 0.34, "{i}: {f:?} {of_first}");
        assert!((1.96 * t.u_ratio / of_total - 1.0).abs() < 0.34, "{i}: {t:?} {of_total}");
    }
}
