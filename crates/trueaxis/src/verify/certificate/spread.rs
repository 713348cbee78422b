//! The distribution of the length of the residual error: not normal, so it is sampled.
//!
//! ```text
//!     d = |l̂ + Σ z_j s_j|,  z drawn;  its 95 % quantile; the largest d of all poses of one draw     docs/model.md eq. 174
//! ```
//!
//! One draw moves all poses together: errors of the machine do.

use super::residual::Residual;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use trueaxis_geometry::Vec3;
use trueaxis_predict::predict::Sampling;

/// The bound that is reported is that of this share of all draws.
pub const SHARE: f64 = 0.95;

/// The length of the residual error over the draws.
#[derive(Debug, Clone, PartialEq)]
pub struct Lengths {
    /// Below it lies the length at each pose in 95 % of the draws, mm.
    pub within_mm: Vec<f64>,
    /// The same of the largest length of all poses, mm.
    pub largest_within_mm: f64,
    /// Root mean square over poses and draws, mm.
    pub rms_mm: f64,
}

/// Draws the factors and evaluates the residual error of every pose.
///
/// # Source
/// JCGM 101:2008, clause 7; ChaCha8 with one stream per draw, as [`trueaxis_predict::predict::monte_carlo`].
pub fn lengths(poses: &[Residual], sampling: Sampling) -> Lengths {
    let factors = poses.first().map_or(0, |p| p.slopes.len());
    let draws: Vec<Vec<f64>> = (0..sampling.samples)
        .into_par_iter()
        .map(|sample| {
            let mut random = ChaCha8Rng::seed_from_u64(sampling.seed);
            random.set_stream(sample as u64);
            let z: Vec<f64> = (0..factors).map(|_| StandardNormal.sample(&mut random)).collect();
            poses.iter().map(|pose| length_mm(pose, &z)).collect()
        })
        .collect();
    let within = |pose: usize| quantile(draws.iter().map(|d| d[pose]).collect());
    let largest = draws.iter().map(|d| d.iter().copied().fold(0.0, f64::max)).collect();
    let squares: f64 = draws.iter().flatten().map(|d| d * d).sum();
    let count = (draws.len() * poses.len()).max(1) as f64;
    Lengths {
        within_mm: (0..poses.len()).map(within).collect(),
        largest_within_mm: quantile(largest),
        rms_mm: (squares / count).sqrt(),
    }
}

fn length_mm(pose: &Residual, z: &[f64]) -> f64 {
    let moved: Vec3 = pose.slopes.iter().zip(z).map(|(s, z)| s.tip_mm * *z).sum();
    (pose.after.tip_mm + moved).norm()
}

fn quantile(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    values.get((SHARE * last as f64).round() as usize).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::super::residual::ToolDeviation;
    use super::*;

    /// Three equal independent coordinates: |l|/u has χ with 3 degrees of freedom, 95 % below 2.7955; one
    /// coordinate alone: 1.95996.
    #[test]
    fn law_lengths_of_normal_vectors_are_those_of_chi() {
        let off = |v| ToolDeviation { tip_mm: v, axis: Vec3::zeros() };
        let none = off(Vec3::zeros());
        let pose = |slopes: &[Vec3]| Residual {
            before: none,
            after: none,
            slopes: slopes.iter().map(|s| off(*s)).collect(),
        };
        let ball = pose(&[Vec3::x(), Vec3::y(), Vec3::z()]);
        let line = pose(&[Vec3::x(), Vec3::zeros(), Vec3::zeros()]);
        let found = lengths(&[ball, line], Sampling { samples: 100_000, seed: 5 });
        // The density there is 0.13 and 0.12: 100 000 draws give the quantile to 0.006.
        assert!((found.within_mm[0] - 2.7955).abs() < 0.02, "{found:?}");
        assert!((found.within_mm[1] - 1.9600).abs() < 0.02, "{found:?}");
        // The line is never longer than the ball, which it shares its draws with.
        assert_eq!(found.largest_within_mm, found.within_mm[0]);
        // ⟨|l|²⟩ = (3 + 1)/2
        assert!((found.rms_mm - 2f64.sqrt()).abs() < 0.01, "{found:?}");
    }
}
