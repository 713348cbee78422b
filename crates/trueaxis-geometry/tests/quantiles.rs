//! Quantiles against those of mpmath (script: `oracles/quantiles.py`).

use trueaxis_geometry::statistics::{
    chi_square_above, chi_square_tail, fisher_above, normal_quantile_above, normal_tail,
    student_above,
};

const TABLE: &str = include_str!("data/quantiles.csv");

/// Kind, probability, degrees of freedom (0 where there are none), quantile.
fn rows() -> impl Iterator<Item = (&'static str, f64, [f64; 2], f64)> {
    TABLE.lines().skip(2).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |i: usize| cells[i].parse().unwrap_or(0.0);
        (cells[0], number(1), [number(2), number(3)], number(4))
    })
}

fn ours(kind: &str, tail: f64, [first, second]: [f64; 2]) -> f64 {
    match kind {
        "normal" => normal_quantile_above(tail),
        "chi_square" => chi_square_above(tail, first),
        "student" => student_above(tail, first),
        _ => fisher_above(tail, first, second),
    }
}

#[test]
fn oracle_quantiles_from_one_to_a_million_degrees_of_freedom() {
    let mut counts = std::collections::BTreeMap::new();
    for (kind, tail, freedoms, value) in rows() {
        let found = ours(kind, tail, freedoms);
        // F of hundreds of thousands of degrees of freedom: the logarithms of the beta function lose digits.
        let allowed = if kind == "fisher" { 2e-9 } else { 1e-10 };
        let off = (found - value).abs() / value.abs().max(1e-3);
        assert!(off < allowed, "{kind} {tail} {freedoms:?}: {found} instead of {value}, {off:e}");
        *counts.entry(kind).or_insert(0) += 1;
    }
    assert_eq!(counts.values().copied().collect::<Vec<_>>(), [126, 90, 9, 98]);
}

#[test]
fn law_the_tail_beyond_a_quantile_is_its_probability() {
    for (kind, tail, freedoms, value) in rows() {
        let found = match kind {
            "normal" => normal_tail(value),
            "chi_square" => chi_square_tail(value, freedoms[0]),
            _ => continue,
        };
        assert!((found / tail - 1.0).abs() < 1e-8, "{kind} {tail} {freedoms:?}: {found}");
    }
}

/// t² of ν is F of 1 and ν, F of n and infinity is χ²/n, F of n and d is 1/F of d and n.
#[test]
fn law_distributions_agree_with_each_other() {
    for tail in [0.4, 0.025, 1e-4, 1e-9] {
        for n in [0.3f64, 1.0, 2.7, 14.0, 400.0] {
            let same = |a: f64, b: f64, allowed: f64| {
                assert!((a / b - 1.0).abs() < allowed, "{tail} {n}: {a} and {b}");
            };
            // 1 − tail has lost digits of the tail.
            let lost = 1e-15 / tail / n.min(1.0);
            same(student_above(0.5 * tail, n).powi(2), fisher_above(tail, 1.0, n), 1e-12);
            same(
                fisher_above(tail, n, 7.0) * fisher_above(1.0 - tail, 7.0, n),
                1.0,
                1e-11 + 10.0 * lost,
            );
            same(student_above(1.0 - tail, n), -student_above(tail, n), lost);
            // ν = 10⁹: z and the first term of its series
            let z = normal_quantile_above(tail);
            same(student_above(tail, 1e9), z + z * (z * z + 1.0) / 4e9, 1e-12);
        }
    }
}
