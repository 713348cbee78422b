//! Rows that do not belong to the others: found, left out of the fit, and named.
//!
//! A first fit by Huber's weights, which a few wrong rows cannot bend; then every row with a studentised residual
//! beyond its limit (1 % that any good row is) is left out of a fit by squares, until the same rows are.

use super::adequacy::LackOfFit;
use super::influence::influences;
use super::robust::huber;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{Fit, FitError, Rule, fit_by};

/// More rows than this share are not a few wrong ones: it is the model or the noise.
const MOST: f64 = 0.45;
/// As many numbers must remain beyond those that the unknowns take.
const LEAST_FREEDOM: usize = 5;
/// Rounds until the same rows are left out.
const ROUNDS: usize = 8;

/// The fit without gross rows and the weights of the rows, 0 or 1; `None` if there are none, or too many.
///
/// # Errors
/// As [`fit_by`].
pub fn without_gross(
    rule: Rule,
    design: &Design,
    readings: &Readings,
    plain: &Fit,
) -> Result<Option<(Fit, Vec<f64>)>, FitError> {
    if influences(design, readings, &[], plain).outliers.is_empty() {
        return Ok(None);
    }
    let fit = |weights: &[f64]| fit_by(rule, design, readings, weights);
    let (mut found, mut weights) = huber(plain.clone(), design, readings, fit)?;
    for _ in 0..ROUNDS {
        let mut next = vec![1.0; readings.len()];
        let influences = influences(design, readings, &weights, &found);
        influences.outliers.iter().for_each(|o| next[o.row] = 0.0);
        let left_out = next.iter().filter(|w| **w == 0.0).count() as f64;
        if left_out == 0.0 || left_out > MOST * readings.len() as f64 {
            return Ok(None);
        }
        let settled = next == weights;
        weights = next;
        found = fit(&weights)?;
        if found.degrees_of_freedom < LEAST_FREEDOM {
            return Ok(None);
        }
        if settled {
            // Where the others do not agree without them either, it is the model that does not belong.
            let agrees = !LackOfFit::of(&found, None).is_found();
            return Ok(agrees.then_some((found, weights)));
        }
    }
    Ok(None)
}
