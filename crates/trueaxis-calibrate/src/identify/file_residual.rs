//! What a written machine file leaves at the measured poses.
//!
//! ```text
//!     y ≈ J_e e + J_s s       e: the errors that the file states, all others 0;   s: the set-ups, fitted again
//! ```
//!
//! An error that is not observable by itself stands in no file, also where the readings know its sum with another one well. The
//! file then has a part of that sum, and may fit the machine worse than one without any of the unknown errors.

use super::errors::Identification;
use super::machine_file::is_stated;
use super::robust::linearised;
use super::score::Rms;
use super::selection::Sums;
use nalgebra::DVector;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::fit::{Observability, linear_residuals};

/// A file that leaves more than this times what the errors that were found leave is not what was measured. Unit: 1.
const PARTIAL: f64 = 1.5;

/// The residual of the machine that the file describes, its set-ups fitted.
pub fn residual_of_file(found: &Identification, readings: &Readings) -> Rms {
    let (design, weights) = (&found.design, &found.weights);
    let z = linearised(design, readings, &found.fit);
    let mut sums = Sums::of(design, readings, &z, weights);
    let priors = Sums::of_priors(design);
    sums.normal += &priors.normal;
    sums.gradient += &priors.gradient;
    let mut values = DVector::zeros(design.unknowns());
    let (made, free): (Vec<usize>, Vec<usize>) = (0..design.unknowns())
        .partition(|k| design.terms.get(*k).is_some_and(|t| !t.basis.is_servo()));
    for k in made.into_iter().filter(|k| is_stated(found, *k)) {
        values[k] = found.found[k].value.map_or(0.0, |(value, _)| value);
    }
    let rest = (&sums.gradient - &sums.normal * &values).select_rows(&free);
    let normal = sums.normal.select_rows(&free).select_columns(&free);
    let fitted = Observability::of(&normal).solve(&rest);
    free.iter().zip(fitted.iter()).for_each(|(k, value)| values[*k] = *value);
    Rms::of(design, readings, &linear_residuals(design, readings, &z, |_| &values))
}

/// Warns of a machine file that does not describe the machine that was found.
pub fn check_file(
    found: &Identification,
    readings: &Readings,
    place: Place,
    problems: &mut Diagnostics,
) {
    let (file, all) = (residual_of_file(found, readings), found.score.in_sample);
    // NaN is more.
    if file.noise <= PARTIAL * all.noise {
        return;
    }
    let shown = |rms: Rms| match rms.length_mm {
        Some(mm) => format!("{:.1} µm", mm * 1e3),
        None => format!("{:.1} times the noise", rms.noise),
    };
    let message = format!(
        "at the measured poses the machine of this file misses the readings by {} (root mean square), one without the unknown errors by {}, and \
         all that was found by {}: errors that are known only together with others are not in it",
        shown(file),
        shown(found.score.before),
        shown(all)
    );
    let hint = "measure what the report names under \"Not observable\", or write the prediction by all errors: --predictor NEW.toml";
    problems.warn("partial-machine-file", place, message, hint);
}
