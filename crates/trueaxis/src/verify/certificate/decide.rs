//! The conclusions from the readings: every pose against the limit, and all of them against the prediction.
//!
//! ```text
//!     d = |m|,  U = k u_m                d + U ≤ limit: inside;  d − U > limit: outside       docs/model.md eq. 176
//!     E_n = max_i |m_i − l̂_i| / (k √(u_m² + V_ii))                                           docs/model.md eq. 175
//!     χ² = rᵀ (u_m² I + S Sᵀ)⁻¹ r,   r = m − l̂ of all poses                                  docs/model.md eq. 177
//! ```

use super::residual::Residual;
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::chi_square_above;
use trueaxis_part::tolerance::Outcome;

/// A correct prediction is rejected once in a hundred certificates.
const FALSE_ALARM: f64 = 0.01;

/// The decision rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// d ≤ limit.
    Simple,
    /// ISO 14253-1: conformity is proved below limit − U, non-conformity above limit + U.
    GuardBand,
}

/// The decision rule with its figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decision {
    /// The rule.
    pub rule: Rule,
    /// Largest permissible tip deviation at any pose of the validation, mm.
    pub limit_mm: f64,
    /// k of U = k·u. Unit: 1.
    pub coverage_factor: f64,
}

impl Decision {
    /// Whether a length that was measured with this U is within the limit. With a U of the size of the limit
    /// nothing can be proved by any rule.
    ///
    /// ```
    /// use trueaxis::part::tolerance::Outcome;
    /// use trueaxis::verify::certificate::{Decision, Rule};
    /// let d = Decision { rule: Rule::GuardBand, limit_mm: 0.010, coverage_factor: 2.0 };
    /// assert_eq!(d.judge(0.0079, 0.002), Outcome::Pass); // 7.9 + 2 ≤ 10 µm
    /// assert_eq!(d.judge(0.0081, 0.002), Outcome::Undecided);
    /// assert_eq!(d.judge(0.0121, 0.002), Outcome::Fail); // 12.1 − 2 > 10 µm
    /// assert_eq!(d.judge(0.0, 0.011), Outcome::Undecided); // U is larger than the limit
    /// ```
    pub fn judge(&self, length_mm: f64, expanded_mm: f64) -> Outcome {
        let blind = self.is_blind(expanded_mm);
        let band_mm = if self.rule == Rule::Simple { 0.0 } else { expanded_mm };
        match (length_mm - band_mm > self.limit_mm, length_mm + band_mm > self.limit_mm) {
            (true, _) if !blind || self.rule == Rule::GuardBand => Outcome::Fail,
            (_, false) if !blind => Outcome::Pass,
            _ => Outcome::Undecided,
        }
    }

    /// Whether U is as large as the limit, so that nothing can pass.
    pub fn is_blind(&self, expanded_mm: f64) -> bool {
        expanded_mm >= self.limit_mm
    }
}

/// How a reading and its prediction agree: |difference| over its expanded uncertainty, the worst coordinate.
///
/// *Source:* E_n of ISO/IEC 17043:2010, B.3.1.3.
pub fn e_n(difference_mm: &Vec3, predicted: &Residual, u_measured_mm: f64, k: f64) -> f64 {
    let u = predicted.u_mm().map(|u| u.hypot(u_measured_mm));
    difference_mm.abs().component_div(&u).max() / k
}

/// All readings against all predictions, with the correlations of the predictions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// χ². Unit: 1.
    pub chi_square: f64,
    /// Coordinates that were read.
    pub numbers: usize,
    /// χ² is above it once in a hundred certificates though the prediction is right. Unit: 1.
    pub limit: f64,
}

impl Agreement {
    /// Of the differences of all poses, mm; none if their covariance cannot be inverted (u_m = 0).
    pub fn of(
        differences_mm: &[Vec3],
        predicted: &[&Residual],
        u_measured_mm: f64,
    ) -> Option<Self> {
        let numbers = 3 * differences_mm.len();
        let factors = predicted.first()?.slopes.len();
        let slopes = DMatrix::from_fn(numbers, factors, |row, factor| {
            predicted[row / 3].slopes[factor].tip_mm[row % 3]
        });
        let mut covariance = &slopes * slopes.transpose();
        (0..numbers).for_each(|i| covariance[(i, i)] += u_measured_mm * u_measured_mm);
        let r = DVector::from_iterator(numbers, differences_mm.iter().flatten().copied());
        let solved = covariance.cholesky()?.solve(&r);
        let limit = chi_square_above(FALSE_ALARM, numbers as f64);
        Some(Self { chi_square: r.dot(&solved), numbers, limit })
    }

    /// Whether the machine agrees with its identified errors.
    pub fn holds(&self) -> bool {
        self.chi_square <= self.limit
    }
}
