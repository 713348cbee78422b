//! The Gaussian filter for profiles: round ones in undulations per revolution, open ones by a length.
//!
//! Docs/model.md eq. 231 to 233. *Source:* ISO 16610-21 (weights; half of an amplitude passes at the cut-off), ISO 12181-2
//! (undulations per revolution).

use std::f64::consts::{LN_2, PI, TAU};

/// The part of an amplitude that passes, by the ratio of the frequency to that of the cut-off: 2^(−ratio²).
///
/// ```
/// use trueaxis_form::filter::transmission;
/// assert_eq!((transmission(0.0), transmission(1.0)), (1.0, 0.5));
/// ```
pub fn transmission(ratio: f64) -> f64 {
    (-ratio * ratio).exp2()
}

/// Points for each undulation at the cut-off that are recommended.
pub const POINTS_PER_UNDULATION: f64 = 7.0;

/// The most work of a filter, in products.
const MOST_WORK: f64 = 4e9;

/// A profile at even steps around, filtered: each of its harmonics by its transmission. `None` where that is too much
/// work: the points are far more than the filter needs.
///
/// ```
/// use trueaxis_form::filter::closed;
/// // 5 undulations, cut-off 5: half of the amplitude.
/// let wave: Vec<f64> = (0..90).map(|i| (f64::from(i) * 4.0_f64.to_radians() * 5.0).cos()).collect();
/// assert!((closed(&wave, 5.0).unwrap()[0] - 0.5).abs() < 1e-12);
/// ```
pub fn closed(values: &[f64], undulations: f64) -> Option<Vec<f64>> {
    let n = values.len();
    // Beyond, less than 10⁻¹³ passes.
    let most = (undulations * 6.6).ceil().min(n as f64 / 2.0);
    if most * n as f64 > MOST_WORK {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n as f64;
    let mut filtered = vec![mean; n];
    let mut harmonic = 1.0;
    while harmonic <= most {
        let (sin, cos) = (TAU * harmonic / n as f64).sin_cos();
        let turn = |(c, s): (f64, f64)| (c * cos - s * sin, s * cos + c * sin);
        let mut at = (1.0, 0.0);
        let (mut a, mut b) = (0.0, 0.0);
        for v in values {
            (a, b) = (a + (v - mean) * at.0, b + (v - mean) * at.1);
            at = turn(at);
        }
        let is_last = 2.0 * harmonic >= n as f64;
        let share =
            transmission(harmonic / undulations) * if is_last { 1.0 } else { 2.0 } / n as f64;
        at = (1.0, 0.0);
        for f in &mut filtered {
            *f += share * (a * at.0 + b * at.1);
            at = turn(at);
        }
        harmonic += 1.0;
    }
    Some(filtered)
}

/// A profile at even steps along, filtered; half a cut-off at either end, where the weights find no points, is left
/// out. The first index of the result, and the values. `None` if the profile is not longer than the cut-off, or that is
/// too much work.
pub fn open(values: &[f64], step_mm: f64, cut_off_mm: f64) -> Option<(usize, Vec<f64>)> {
    let alpha = (LN_2 / PI).sqrt();
    let half = 0.5 * cut_off_mm / step_mm;
    let reach = cut_off_mm / step_mm;
    if !(half.is_finite() && 2.0 * half < (values.len() as f64) - 1.0) {
        return None;
    }
    if 2.0 * reach * values.len() as f64 > MOST_WORK {
        return None;
    }
    let whole =
        |steps: f64| (0..=values.len()).find(|k| *k as f64 >= steps).unwrap_or(values.len());
    let (half, reach) = (whole(half), whole(reach));
    let weights: Vec<f64> = (0..=reach)
        .map(|k| (-PI * (k as f64 * step_mm / (alpha * cut_off_mm)).powi(2)).exp())
        .collect();
    let at = |i: usize| {
        let range = i.saturating_sub(reach)..(i + reach + 1).min(values.len());
        let parts = range.map(|j| (weights[i.abs_diff(j)], values[j]));
        // Near an end the weights do not sum up to their whole: they are divided by their sum.
        let (sum, total) = parts.fold((0.0, 0.0), |(s, t), (w, v)| (s + w * v, t + w));
        sum / total
    };
    let last = values.len().saturating_sub(half);
    (half < last).then(|| (half, (half..last).map(at).collect()))
}

/// A profile at even steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Even {
    /// The values. Unit: that of the profile.
    pub values: Vec<f64>,
    /// The step. Unit: that of the places.
    pub step: f64,
    /// The first place. Unit: that of the places.
    pub first: f64,
    /// Whether the places were uneven, so that values lie on straight lines between them.
    pub is_interpolated: bool,
}

/// Values at increasing places, at as many even steps; `period` is that of a closed profile.
pub fn even(places: &[(f64, f64)], period: Option<f64>) -> Option<Even> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let n = sorted.len();
    let (first, last) = (sorted.first()?.0, sorted.last()?.0);
    let step = match period {
        Some(period) => period / n as f64,
        None if n > 1 => (last - first) / (n as f64 - 1.0),
        None => return None,
    };
    if step <= 0.0 {
        return None;
    }
    let ideal = |k: usize| first + step * k as f64;
    let uneven = sorted.iter().enumerate().any(|(k, (at, _))| (at - ideal(k)).abs() > 0.02 * step);
    if !uneven {
        let values = sorted.into_iter().map(|(_, v)| v).collect();
        return Some(Even { values, step, first, is_interpolated: false });
    }
    if let Some(period) = period {
        sorted.push((first + period, sorted[0].1));
    }
    let mut next = 1;
    let values = (0..n).map(|k| {
        let at = ideal(k);
        while next + 1 < sorted.len() && sorted[next].0 < at {
            next += 1;
        }
        let ((a, u), (b, v)) = (sorted[next - 1], sorted[next]);
        if b > a { u + (v - u) * ((at - a) / (b - a)).clamp(0.0, 1.0) } else { v }
    });
    Some(Even { values: values.collect(), step, first, is_interpolated: true })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_open_profile_passes_half_at_the_cut_off() {
        // 20 points per wave of 0.8 mm: the weights are sampled, so that 0.5 is met to 10⁻⁴.
        let wave: Vec<f64> = (0..400).map(|i| (TAU * f64::from(i) / 20.0).cos()).collect();
        let (first, filtered) = open(&wave, 0.04, 0.8).unwrap();
        assert_eq!((first, filtered.len()), (10, 380));
        let middle = filtered[200 - first];
        assert!((middle - 0.5).abs() < 1e-4, "{middle}");
        let level = open(&[3.0; 50], 0.1, 0.8).unwrap().1;
        assert!(level.iter().all(|v| (v - 3.0).abs() < 1e-12));
    }

    #[test]
    fn a_closed_profile_passes_its_harmonics() {
        let at = |i: i32| TAU * f64::from(i) / 360.0;
        let wave: Vec<f64> =
            (0..360).map(|i| 2.0 + (3.0 * at(i)).cos() + 0.1 * (100.0 * at(i)).sin()).collect();
        let found = closed(&wave, 15.0).unwrap();
        for (i, v) in (0..360).zip(&found) {
            let three = transmission(3.0 / 15.0) * (3.0 * at(i)).cos();
            assert!((v - 2.0 - three).abs() < 1e-12);
        }
    }

    #[test]
    fn uneven_places_are_made_even() {
        let line = [(0.0, 0.0), (1.0, 2.0), (4.0, 8.0)];
        let found = even(&line, None).unwrap();
        assert!(found.is_interpolated);
        assert_eq!(found.values, [0.0, 4.0, 8.0]);
    }

    #[test]
    fn more_work_than_a_computer_has_time_for_is_refused() {
        // 2 · 49 000 weights for each of 100 000 values: 10¹⁰ products
        assert!(open(&vec![0.0; 100_000], 1.0, 49_000.0).is_none());
        assert_eq!(open(&vec![0.0; 100_000], 1.0, 50.0).unwrap().1.len(), 99_950);
    }
}
