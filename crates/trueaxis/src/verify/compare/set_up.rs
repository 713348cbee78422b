//! The fitted set-up against what is stated of it.
//!
//! ```text
//!     u²(x̂) = u₀² − C + Σ_e (C JᵀW S_e)²         |x̂| > 3.29 u: contradicted       docs/model.md eq. 345
//! ```

use nalgebra::DMatrix;
use trueaxis_measure::instruments::instrument::SetupError;
use trueaxis_measure::measure::Instrument;

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
    /// Key and symbol of this unit.
    pub unit: [&'static str; 2],
}

impl SetUpDeviation {
    /// Whether the readings contradict machine file and statement together.
    pub fn is_contradicted(&self) -> bool {
        // NaN agrees with nothing.
        self.value.is_nan() || self.value.abs() > NORMAL_999 * self.u
    }
}

/// The unknowns with a stated uncertainty. `taken` is the effect of each uncertain error of the machine on each unknown.
pub(super) fn deviations(
    instruments: &[Instrument],
    values: &[f64],
    covariance: &DMatrix<f64>,
    taken: &DMatrix<f64>,
) -> Vec<SetUpDeviation> {
    let mut found = Vec::new();
    let unknowns = instruments
        .iter()
        .enumerate()
        .flat_map(|(i, one)| one.unknowns.iter().map(move |unknown| (i, one, unknown)));
    for ((k, value), (instrument, of, unknown)) in values.iter().enumerate().zip(unknowns) {
        let Some(stated) = unknown.prior_u else { continue };
        let least = LEAST_SHARE * stated * stated;
        let square =
            (stated * stated - covariance[(k, k)]).max(least) + taken.row(k).norm_squared();
        let (unit, scale) = unit(unknown.error, of);
        let unknown = unknown.name.clone();
        found.push(SetUpDeviation {
            instrument,
            unknown,
            value: value * scale,
            u: square.sqrt() * scale,
            unit,
        });
    }
    found
}

/// Key and symbol of the unit, and its factor from mm, rad, 1 or these by the hour.
fn unit(error: SetupError, of: &Instrument) -> ([&'static str; 2], f64) {
    let turns = matches!(error, SetupError::ReferenceTurn(_) | SetupError::Tilt(_));
    let reads_angles =
        matches!(error, SetupError::Zero(_) | SetupError::Drift(_)) && of.sight.is_angle();
    match (error.is_share(), error.is_rate(), turns || reads_angles) {
        (true, ..) => (["um_per_m", "µm/m"], 1e6),
        (_, true, true) => (["urad_per_h", "µrad/h"], 1e6),
        (_, true, false) => (["um_per_h", "µm/h"], 1e3),
        (_, _, true) => (["urad", "µrad"], 1e6),
        _ => (["um", "µm"], 1e3),
    }
}
