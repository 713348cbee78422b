//! What the noise of the points makes of an index: a zone is never narrower for it.
//!
//! ```text
//! b = mean over draws of I(E + u z) − I(E)        E of the prediction, z standard normal        docs/model.md eq. 212
//! ```

use super::CmmPoints;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use trueaxis_part::testpiece::PartSection;
use trueaxis_part::testpiece::cone::Cone;
use trueaxis_part::testpiece::measured::MeasuredFault;

/// The mean of an addition is known to u/√100.
const DRAWS: u64 = 100;

/// What the noise adds to each predicted index on average, mm, for points where those of the first part are.
pub(super) fn added_mm(
    cone: &Cone,
    predicted: &[PartSection],
    points: &CmmPoints,
) -> Result<Vec<f64>, MeasuredFault> {
    let (Some(part), false) = (points.parts.first(), predicted.is_empty()) else {
        return Ok(Vec::new());
    };
    let exact = cone.points_at(predicted, &part.points);
    let without = cone.measured(&exact, 0.0)?;
    let mut sums = vec![0.0; without.len()];
    for draw in 0..DRAWS {
        let mut generator = ChaCha8Rng::seed_from_u64(draw);
        let noisy = exact.iter().map(|p| {
            let z: f64 = StandardNormal.sample(&mut generator);
            cone.moved_outwards(p, z * points.point_u_mm)
        });
        let with = cone.measured(&noisy.collect::<Vec<_>>(), 0.0)?;
        for ((sum, with), without) in sums.iter_mut().zip(with).zip(&without) {
            if let (Some(with), Some(without)) = (with, without) {
                *sum += with.value_mm - without.value_mm;
            }
        }
    }
    Ok(sums.into_iter().map(|s| s / DRAWS as f64).collect())
}
