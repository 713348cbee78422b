//! Effective degrees of freedom and coverage factor of each uncertainty, where sizes of errors and noise were found from
//! the residual (docs/model.md eq. 312).
//!
//! What the stated noise, a stated length and other stated uncertainties leave is known exactly (GUM G.4.3: ν infinite).

use super::adequacy::Prepared;
use super::selection::Sums;
use trueaxis_geometry::statistics;
use trueaxis_measure::unknowns::mixed::{self, Rest, Sizes, Solved};

/// More degrees of freedom than this make no difference.
const MANY: f64 = 1000.0;

/// k for 95.45 %: Student's t, the degrees of freedom cut to a whole number, at least 1 (docs/model.md eq. 251); `None`:
/// infinitely many.
///
/// ```
/// use trueaxis_calibrate::identify::freedom::coverage_factor;
/// assert_eq!(coverage_factor(None), 2.0);
/// assert!((coverage_factor(Some(4.9)) - 2.87).abs() < 0.005); // GUM table G.2, ν = 4
/// ```
pub fn coverage_factor(degrees_of_freedom: Option<f64>) -> f64 {
    let Some(count) = degrees_of_freedom.filter(|count| *count < MANY) else { return 2.0 };
    statistics::coverage_factor(count.floor().max(1.0))
}

/// ν of the uncertainty of each listed unknown; `None`: infinitely many.
pub(super) fn degrees_of_freedom(
    prepared: &Prepared<'_>,
    (sums, rest): (&Sums, &Rest),
    sizes: &Sizes,
) -> Vec<Option<f64>> {
    let known = || vec![None; prepared.listed()];
    if sizes.noise <= 1.0 && sizes.times.iter().all(|t| *t == 0.0) {
        return known();
    }
    let both = rest.covariance_of_sizes(&prepared.ranges, sizes).zip(prepared.inverse(sums, sizes));
    let Some((of_sizes, inverse)) = both else { return known() };
    let (scale, before) = (prepared.scale(sizes), prepared.known_before());
    let solved =
        Solved { inverse: &inverse, scale: &scale, before: &before, listed: prepared.listed() };
    mixed::degrees_of_freedom(solved, &prepared.ranges, &of_sizes)
}
