//! The fitted set-up against what is stated of it.
//!
//! ```text
//!     u²(x̂) = u₀² − C + Σ_e (C JᵀW S_e)²         |x̂| > 3.29 u: contradicted       docs/model.md eq. 345
//! ```

use super::design::Unknown;
use crate::instruments::Instrument;
use nalgebra::DMatrix;

/// Quantile of the normal distribution for 99.9 %, two-sided: a correct file is rejected so once in a thousand.
const NORMAL_999: f64 = 3.290_526_731;

/// Readings that tell nothing of an unknown leave it where it was stated, but for rounding. Unit: 1.
const LEAST_SHARE: f64 = 1e-8;

/// An unknown of the set-up that is stated with an uncertainty, and what the readings make of it.
#[derive(Debug, Clone, PartialEq)]
pub struct SetUpDeviation {
    /// The index of the instrument.
    pub instrument: usize,
    /// The unknown, such as `length`.
    pub unknown: String,
    /// Fitted less stated. Unit: µm, µrad, µm/m or by the hour.
    pub value: f64,
    /// Its standard uncertainty where machine file and statement are right. Unit: µm, µrad, µm/m or by the hour.
    pub u: f64,
    /// The standard uncertainty with which it is stated, in the same unit. Unit: µm, µrad, µm/m or by the hour.
    pub stated: f64,
    /// This unit.
    pub unit: &'static str,
}

impl SetUpDeviation {
    /// Whether the readings contradict machine file and statement together.
    pub fn is_contradicted(&self) -> bool {
        // NaN agrees with nothing.
        self.value.is_nan() || self.value.abs() > NORMAL_999 * self.u
    }
}

/// The unknowns with a stated uncertainty. `covariance` is that of the noise and the statements alone; `further` adds, by unknown, the
/// variance from all else that is uncertain.
pub fn deviations(
    instruments: &[Instrument],
    values: &[f64],
    covariance: &DMatrix<f64>,
    further: impl Fn(usize) -> f64,
) -> Vec<SetUpDeviation> {
    let mut found = Vec::new();
    let unknowns = instruments
        .iter()
        .enumerate()
        .flat_map(|(i, one)| one.unknowns.iter().map(move |unknown| (i, one, unknown)));
    for ((k, value), (instrument, of, unknown)) in values.iter().enumerate().zip(unknowns) {
        let Some(stated) = unknown.prior_u else { continue };
        let least = LEAST_SHARE * stated * stated;
        let square = (stated * stated - covariance[(k, k)]).max(least) + further(k);
        let (unit, scale) = Unknown::Setup(of, unknown).shown_unit();
        let [value, u, stated] = [*value, square.sqrt(), stated].map(|v| v * scale);
        let unknown = unknown.name.clone();
        found.push(SetUpDeviation { instrument, unknown, value, u, stated, unit });
    }
    found
}
