//! What a measuring machine would find: its points scatter.

use super::super::monte_carlo::{Sampling, spreads};
use trueaxis_part::part::Part;

/// Measurements that are drawn: the deviation of the values is known to 3.5 %.
const SAMPLES: usize = 400;
const SEED: u64 = 14_406;

/// A characteristic as it would be measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The mean of its values; a form is found larger than it is, mm.
    pub mean_mm: f64,
    /// Standard uncertainty by the scatter of the points, mm.
    pub u_mm: f64,
}

/// The characteristics of a surface whose points are measured, each with this standard uncertainty along its normal, independent of the
/// others. Docs/model.md eq. 325.
pub(super) fn measured(
    part: &Part,
    deviations: &[f64],
    u_mm: f64,
) -> Result<Vec<Measured>, String> {
    let sample = |factors: &[f64], surface: &mut Vec<f64>, found: &mut [f64]| {
        surface.clear();
        surface.extend(deviations.iter().zip(factors).map(|(d, z)| d + z * u_mm));
        found.copy_from_slice(&part.evaluate(surface).map_err(|e| e.to_string())?);
        Ok::<(), String>(())
    };
    let sampling = Sampling { samples: SAMPLES, seed: SEED };
    let counts = [deviations.len(), part.characteristics.len()];
    let found = spreads(sampling, counts, sample, &|_| {})?;
    Ok(found.iter().map(|s| Measured { mean_mm: s.mean_mm, u_mm: s.u_mm }).collect())
}
