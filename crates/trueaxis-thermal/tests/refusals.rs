//! Why a thermal model is refused, in numbers that can be checked by hand.

use trueaxis_thermal::thermal::{Cycle, Logs, ThermalModel, Zero, identify_thermal};

/// One sensor from 19 to 21 °C in every cycle, with its own coefficient in each, µm/K.
fn identified(um_per_k: &[f64]) -> ThermalModel {
    let cycle = |(g, k): (usize, &f64)| Cycle {
        name: format!("day {g}"),
        times_s: None,
        displacement_mm: vec![-1e-3 * k, 1e-3 * k],
        temperatures_celsius: vec![vec![19.0, 21.0]],
    };
    identify_thermal(&Logs {
        name: "by hand".to_owned(),
        error: "EX0t".to_owned(),
        sensors: vec!["spindle".to_owned()],
        cycles: um_per_k.iter().enumerate().map(cycle).collect(),
        later: Vec::new(),
        zero: Zero::Cycle,
        lags_s: Vec::new(),
        most_terms: 1,
        reference_celsius: 20.0,
        repeatability_mm: None,
    })
}

/// 1, 2 and 4 µm/K: the mean of the two other days leaves 2/1, 0.5/2 and 2.5/4 of each, and of the squares the geometric
/// mean is 0.3125^(2/3) = 46 %. Their logarithms scatter so much that with t of two degrees of freedom,
/// P √2/√(1 − P²) = 4.527, it may be 10 688 %.
#[test]
fn a_model_that_is_not_significant_says_how_much_it_may_leave() {
    let model = identified(&[1.0, 2.0, 4.0]);
    assert_eq!(model.chosen, 1);
    let refusal = model.refusal.expect("refused");
    let shares: Vec<f64> =
        refusal.split(" %").filter_map(|part| part.rsplit(' ').next()?.parse().ok()).collect();
    assert_eq!(shares.len(), 2, "{refusal}");
    let logarithms = [2.0_f64, 0.25, 0.625].map(|left| 2.0 * left.ln());
    let mean = logarithms.iter().sum::<f64>() / 3.0;
    let variance = logarithms.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / 2.0;
    let within = 0.954_499_736_f64;
    let t = within * (2.0 / (1.0 - within * within)).sqrt();
    let by_hand = [100.0 * mean.exp(), 100.0 * (mean + t * (variance / 3.0).sqrt()).exp()];
    assert!((by_hand[0] - 46.05).abs() < 0.01 && (by_hand[1] / 10_688.2 - 1.0).abs() < 1e-4);
    // Printed without decimals.
    assert!((shares[0] - by_hand[0]).abs() < 0.51, "{refusal}");
    assert!((shares[1] - by_hand[1]).abs() < 2.0, "{refusal}");
}
