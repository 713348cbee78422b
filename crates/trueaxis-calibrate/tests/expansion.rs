//! The expansion of a scale from runs at several temperatures.

use trueaxis_calibrate::identify::expansion::{Run, Runs, identify_expansion};
use trueaxis_input::MeasuredValue;

fn made(alpha: f64, celsius: &[f64], noise: impl Fn(usize, usize) -> f64) -> Runs {
    let positions_mm: Vec<f64> = (0..=10).map(|i| 230.0 * f64::from(i)).collect();
    let geometry = |p: f64| 0.1 * (p / 700.0).sin() + 8e-5 * p;
    let run = |(j, c): (usize, &f64)| Run {
        name: format!("run {j}"),
        celsius: MeasuredValue { value: *c, u: Some(0.0) },
        errors_mm: positions_mm
            .iter()
            .enumerate()
            .map(|(i, p)| geometry(*p) + alpha * p * (c - 20.0) + 0.002 * j as f64 + noise(i, j))
            .collect(),
    };
    let runs = celsius.iter().enumerate().map(run).collect();
    Runs { name: String::new(), positions_mm, runs }
}

/// Between −1 and 1 µm, without any pattern.
fn scatter(i: usize, j: usize) -> f64 {
    let seed = (i as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ (j as u64 + 1).wrapping_mul(0xD1B5_4A32_D192_ED03);
    let mixed = (seed ^ (seed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    ((mixed >> 32) as f64 / f64::from(u32::MAX) - 0.5) * 2e-3
}

#[test]
fn law_the_coefficient_comes_back_whatever_the_geometry() {
    for celsius in [&[29.3, 33.8][..], &[20.0, 24.0, 31.0, 22.0]] {
        let found = identify_expansion(&made(8.6e-6, celsius, |_, _| 0.0));
        assert!((found.per_k - 8.6e-6).abs() < 1e-16);
        assert!((found.slope_difference_per_k - 8.6e-6).abs() < 1e-16);
        assert!(found.u_per_k < 1e-15 && found.warnings.is_empty());
        assert_eq!(found.materials, ["glass"]);
    }
}

#[test]
fn noise_of_a_micrometre_moves_it_by_less_than_three_u() {
    let noise = scatter;
    let found = identify_expansion(&made(10.8e-6, &[20.0, 25.0, 30.0], noise));
    assert!((found.per_k - 10.8e-6).abs() < 3.0 * found.u_per_k, "{found:?}");
    // s ≈ 1/√3 µm; Σp² = 110·230²; Σt² = 50: s/√(…) ≈ 0.034e-6
    assert!((0.02e-6..0.08e-6).contains(&found.u_per_k), "{found:?}");
    assert_eq!(found.materials, ["steel tape"]);
}

#[test]
fn a_run_of_another_machine_is_named() {
    let noise = |i: usize, j: usize| match j {
        2 => 0.05 * (i as f64).sin(),
        _ => 0.1 * scatter(i, j),
    };
    let found = identify_expansion(&made(8e-6, &[20.0, 22.0, 24.0, 26.0, 28.0], noise));
    assert_eq!(found.warnings.len(), 1, "{:?}", found.warnings);
}
