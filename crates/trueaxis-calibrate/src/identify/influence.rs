//! What each reading does to the result, and which do not fit.
//!
//! ```text
//!     H = J C Jᵀ       leverage = tr H       t = r/(s √(1 − Hᵢᵢ))
//!     D = rᵀ(I − H)⁻¹ H (I − H)⁻¹ r / p      Cook's distance of the whole row    docs/model.md eq. 129
//! ```

use super::adequacy::LEVEL_OF_READINGS;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use trueaxis_geometry::statistics::{normal_quantile_above, robust_deviation, student_above};
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::Fit;

/// What one row does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Influence {
    /// How much of its own it predicts: 0 to the number of its channels. Unit: 1.
    pub leverage: f64,
    /// Cook's distance: how far the unknowns move without it, in units of their spread. Unit: 1.
    pub cook: f64,
    /// Residuals over their standard deviations, before the common scale. Unit: 1.
    pub standardised: [f64; 3],
}

/// A number that does not fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlier {
    /// Its row.
    pub row: usize,
    /// Its channel.
    pub channel: usize,
    /// Its studentised residual. Unit: 1.
    pub studentised: f64,
    /// Its residual. Unit: mm or rad.
    pub residual: f64,
}

/// All rows.
#[derive(Debug, Clone)]
pub struct Influences {
    /// One entry a row.
    pub rows: Vec<Influence>,
    /// Numbers beyond the limit, the worst first.
    pub outliers: Vec<Outlier>,
    /// The limit of studentised residuals: 1 % that any of all numbers is beyond it (Bonferroni). Unit: 1.
    pub limit: f64,
}

/// Leverage, Cook's distance, and what does not fit.
pub fn influences(design: &Design, readings: &Readings, weights: &[f64], fit: &Fit) -> Influences {
    let n = design.unknowns();
    let of_chunk = |rows: &[usize]| {
        let mut slopes = vec![0.0; 3 * n];
        rows.iter().map(|i| row(design, readings, weights, fit, *i, &mut slopes)).collect()
    };
    let indices: Vec<usize> = (0..readings.len()).collect();
    let rows: Vec<Influence> = indices
        .par_chunks(512)
        .map(of_chunk)
        .collect::<Vec<Vec<Influence>>>()
        .into_iter()
        .flatten()
        .collect();
    let channels = |i: usize| channels(design, readings, i);
    let all = || (0..rows.len()).flat_map(|i| (0..channels(i)).map(move |c| (i, c)));
    let numbers = all().count().max(1);
    let scatter = robust_deviation(all().map(|(i, c)| rows[i].standardised[c]));
    let (scale, limit) = scale_and_limit(scatter, numbers, fit.degrees_of_freedom);
    let mut outliers: Vec<Outlier> = all()
        .map(|(row, channel)| Outlier {
            row,
            channel,
            studentised: rows[row].standardised[channel] / scale,
            residual: fit.residuals[row][channel],
        })
        .filter(|o| o.studentised.abs() > limit)
        .collect();
    outliers.sort_by(|a, b| b.studentised.abs().total_cmp(&a.studentised.abs()));
    Influences { rows, outliers, limit }
}

/// The median of n sizes of normal numbers has a relative standard deviation of so much over √n: 1/(2 f(m) m), f(m) = 2 φ(m),
/// m = 0.6745.
const OF_THE_MEDIAN: f64 = 1.1664;

/// What standardised residuals are divided by, and the limit of what comes out.
///
/// The stated noise counts, with the normal distribution; where the middle of all numbers says that it is larger, beyond two
/// standard deviations of such a middle, that is the scale, and being estimated it has Student's limit.
fn scale_and_limit(scatter: f64, numbers: usize, freedom: usize) -> (f64, f64) {
    let tail = 0.5 * LEVEL_OF_READINGS / numbers as f64;
    match scatter > 1.0 + 2.0 * OF_THE_MEDIAN / (numbers as f64).sqrt() {
        true => (scatter, student_above(tail, freedom.max(3) as f64)),
        false => (1.0, normal_quantile_above(tail)),
    }
}

fn channels(design: &Design, readings: &Readings, i: usize) -> usize {
    design.instruments[readings.instruments[i] as usize].sight.channels()
}

fn row(
    design: &Design,
    readings: &Readings,
    weights: &[f64],
    fit: &Fit,
    i: usize,
    slopes: &mut [f64],
) -> Influence {
    let channels = design.slopes(readings, i, slopes);
    let noise = design.instruments[readings.instruments[i] as usize].noise;
    let weight = weights.get(i).copied().unwrap_or(1.0);
    let n = design.unknowns();
    let slope = |c: usize| &slopes[c * n..(c + 1) * n];
    let found = fit.sight.rank.max(1) as f64;
    let mut h = Matrix3::zeros();
    let mut r = Vector3::zeros();
    for c in 0..channels {
        r[c] = fit.residuals[i][c] / noise[c];
        let bent: Vec<f64> = (0..n)
            .map(|k| fit.covariance.column(k).iter().zip(slope(c)).map(|(a, b)| a * b).sum())
            .collect();
        for d in 0..channels {
            let sum: f64 = bent.iter().zip(slope(d)).map(|(a, b)| a * b).sum();
            h[(c, d)] = weight * sum / (noise[c] * noise[d]);
        }
    }
    let kept = Matrix3::identity() - h;
    // A reading that alone decides something predicts itself whatever it is.
    let alone = kept.try_inverse().filter(|m| m.iter().all(|v| v.abs() < 1e6));
    let cook = alone.map_or(f64::INFINITY, |m| {
        let without = m * r;
        weight * without.dot(&(h * without)) / found
    });
    let standardised = std::array::from_fn(|c| match c < channels && kept[(c, c)] > 1e-6 {
        true => r[c] / kept[(c, c)].sqrt(),
        false => 0.0,
    });
    Influence { leverage: h.trace(), cook, standardised }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_geometry::statistics::SplitMix64;

    fn normal(dice: &mut SplitMix64) -> f64 {
        let unit = ((dice.bits() >> 11) as f64 + 0.5) / (1u64 << 53) as f64;
        normal_quantile_above(unit)
    }

    /// One good campaign in a hundred has a number beyond the limit, however many numbers there are.
    #[test]
    fn law_one_good_campaign_in_a_hundred_has_a_reading_called_wrong() {
        let mut dice = SplitMix64::new(11);
        for numbers in [30, 120, 1000] {
            let campaigns = 4000;
            let mut called = 0;
            for _ in 0..campaigns {
                let z: Vec<f64> = (0..numbers).map(|_| normal(&mut dice)).collect();
                let scatter = robust_deviation(z.iter().copied());
                let (scale, limit) = scale_and_limit(scatter, numbers, numbers - 10);
                called += usize::from(z.iter().any(|z| (z / scale).abs() > limit));
            }
            // 40 are expected; four standard deviations are 25.
            assert!((15..=65).contains(&called), "{numbers}: {called}");
        }
        // Twice the noise, not stated, is the scale.
        let z: Vec<f64> = (0..120).map(|_| 2.0 * normal(&mut dice)).collect();
        let (scale, _) = scale_and_limit(robust_deviation(z.iter().copied()), 120, 110);
        assert!((scale - 2.0).abs() < 0.4, "{scale}");
    }
}
