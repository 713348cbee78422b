//! Fits that a few wrong rows cannot bend, and readings that are linear about a fit.

use nalgebra::DVector;
use trueaxis_geometry::statistics::{chi_square_above, robust_deviation};
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{Fit, FitError, by_rows};

/// Fits with new weights of a robust loss.
const ROBUST_PASSES: usize = 12;
/// Huber's bound: 82.14 % of normal numbers are within 1.345 standard deviations.
const HUBER_TAIL: f64 = 0.1786;

/// The fit with Huber's weights, from a first one.
pub(super) fn huber(
    mut found: Fit,
    design: &Design,
    readings: &Readings,
    fit: impl Fn(&[f64]) -> Result<Fit, FitError>,
) -> Result<(Fit, Vec<f64>), FitError> {
    let mut weights = Vec::new();
    for _ in 0..ROBUST_PASSES {
        let next = huber_weights(design, readings, &found);
        let changed = |(a, b): (&f64, &f64)| (a - b).abs() > 1e-3;
        let settled = !weights.is_empty() && !weights.iter().zip(&next).any(changed);
        weights = next;
        if settled {
            break;
        }
        found = fit(&weights)?;
    }
    Ok((found, weights))
}

/// Huber's weights: bound/|r| beyond the bound. A row counts as a whole, by the length of its
/// residual in units of the noise.
pub fn huber_weights(design: &Design, readings: &Readings, found: &Fit) -> Vec<f64> {
    let instrument = |i: usize| &design.instruments[readings.instruments[i] as usize];
    let in_noise = |i: usize, c: usize| found.residuals[i][c] / instrument(i).noise[c];
    let channels = |i: usize| instrument(i).sight.channels();
    let all = (0..readings.len()).flat_map(|i| (0..channels(i)).map(move |c| (i, c)));
    let scale = robust_deviation(all.map(|(i, c)| in_noise(i, c))).max(1e-12);
    // By the number of channels, once for all rows.
    let bounds = [1.0, 2.0, 3.0].map(|n| chi_square_above(HUBER_TAIL, n).sqrt());
    (0..readings.len())
        .map(|i| {
            let size: f64 = (0..channels(i)).map(|c| in_noise(i, c).powi(2)).sum();
            (bounds[channels(i) - 1] * scale / size.sqrt().max(1e-300)).min(1.0)
        })
        .collect()
}

/// Residual plus model, linear about the solution, mm or rad.
pub(super) fn linearised(design: &Design, readings: &Readings, first: &Fit) -> Vec<[f64; 3]> {
    let values = DVector::from_column_slice(&first.values);
    by_rows(design, readings, |i, c, slopes| {
        first.residuals[i][c] + slopes.iter().zip(values.iter()).map(|(a, b)| a * b).sum::<f64>()
    })
}
