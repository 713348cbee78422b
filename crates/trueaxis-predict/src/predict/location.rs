//! The location diameter: the circle on which the holes are, as a drawing tolerates it.
//!
//! ```text
//!     least squares:  Σ (|pᵢ − c| − D/2)² → min over c, D
//!     by pairs:       Dᵢ = |pᵢ − pᵢ₊ₙ/₂|, opposite holes
//! ```
//!
//! An error that changes with a quantity of the machine by dᵢ at hole i, n its direction from the centre, changes
//! them by (docs/model.md eq. 31a)
//!
//! ```text
//!     ΔD = 2·mean(nᵢ·dᵢ)    evenly spaced holes
//!     ΔDᵢ = nᵢ·dᵢ + nᵢ₊ₙ/₂·dᵢ₊ₙ/₂
//! ```

use super::holes::Hole;
use trueaxis_geometry::Vec3;
use trueaxis_part::fit::circle::least_squares;

/// The circle of the holes at 20 °C, less the nominal one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocationCircle {
    /// Its diameter by least squares, less the nominal one, mm.
    pub diameter_error_mm: f64,
    /// Standard uncertainty of that, mm.
    pub u_diameter_mm: f64,
    /// Smallest and largest distance of opposite holes, less the nominal diameter; none where the number of
    /// holes is odd. Unit: mm.
    pub opposite_mm: Option<[f64; 2]>,
    /// Standard uncertainties of these two, mm.
    pub u_opposite_mm: Option<[f64; 2]>,
    /// Where its centre is, less where it should be, mm.
    pub centre_mm: [f64; 2],
}

impl LocationCircle {
    /// Of holes evenly on a circle in X and Y, with how far each of them goes outwards with each uncertain quantity of
    /// the machine, mm; none for fewer than three.
    pub fn of(nominal_mm: &[Vec3], holes: &[Hole], outwards_mm: &[Vec<f64>]) -> Option<Self> {
        let count = nominal_mm.len();
        if count < 3 || holes.len() != count || outwards_mm.len() != count {
            return None;
        }
        let centre = nominal_mm.iter().sum::<Vec3>() / count as f64;
        let diameter_mm = 2.0 * (nominal_mm[0] - centre).xy().norm();
        let actual: Vec<[f64; 2]> = nominal_mm
            .iter()
            .zip(holes)
            .map(|(at, hole)| (at - centre + hole.error_mm).xy().into())
            .collect();
        let circle = least_squares(&actual).ok()?;
        let mean = |quantity: usize| {
            2.0 * outwards_mm.iter().map(|hole| hole[quantity]).sum::<f64>() / count as f64
        };
        let pairs = opposite(&actual, diameter_mm, outwards_mm);
        Some(Self {
            diameter_error_mm: 2.0 * circle.radius_mm - diameter_mm,
            u_diameter_mm: root_sum_square((0..outwards_mm[0].len()).map(mean)),
            opposite_mm: pairs.map(|both| both.map(|(error, _)| error)),
            u_opposite_mm: pairs.map(|both| both.map(|(_, u)| u)),
            centre_mm: circle.center_mm,
        })
    }

    /// The largest deviation from the nominal diameter, of opposite holes where there are some, and its standard
    /// uncertainty, mm.
    pub fn largest_mm(&self) -> (f64, f64) {
        match (self.opposite_mm, self.u_opposite_mm) {
            (Some([low, high]), Some([u_low, u_high])) => match low.abs() > high.abs() {
                true => (low, u_low),
                false => (high, u_high),
            },
            _ => (self.diameter_error_mm, self.u_diameter_mm),
        }
    }
}

/// The shortest and the longest distance of opposite holes, less the nominal one, with their u.
fn opposite(
    actual: &[[f64; 2]],
    diameter_mm: f64,
    outwards_mm: &[Vec<f64>],
) -> Option<[(f64, f64); 2]> {
    let half = actual.len() / 2;
    if actual.len() != 2 * half {
        return None;
    }
    let pair = |i: usize| {
        let (a, b) = (actual[i], actual[i + half]);
        let error = (a[0] - b[0]).hypot(a[1] - b[1]) - diameter_mm;
        let both = outwards_mm[i].iter().zip(&outwards_mm[i + half]);
        (error, root_sum_square(both.map(|(one, other)| one + other)))
    };
    let all: Vec<(f64, f64)> = (0..half).map(pair).collect();
    let least = all.iter().copied().min_by(|a, b| a.0.total_cmp(&b.0))?;
    let most = all.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some([least, most])
}

fn root_sum_square(parts: impl Iterator<Item = f64>) -> f64 {
    parts.map(|part| part * part).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(count: usize, error: impl Fn(Vec3) -> Vec3) -> Option<LocationCircle> {
        let centre = Vec3::new(2300.0, 1150.0, 0.0);
        let from = |i: usize| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
            1000.0 * Vec3::new(cos, sin, 0.0)
        };
        let nominal: Vec<Vec3> = (0..count).map(|i| centre + from(i)).collect();
        let hole = |i: usize| Hole {
            increments: [0; 3],
            error_mm: error(from(i)),
            u_mm: Vec3::zeros(),
            u_distance_mm: 0.0,
        };
        // Two quantities: one that the part grows with, 1 µm/m, and one that shifts it along x by 5 µm.
        let outwards: Vec<Vec<f64>> =
            (0..count).map(|i| vec![1e-3, 5e-3 * from(i).x / 1000.0]).collect();
        LocationCircle::of(&nominal, &(0..count).map(hole).collect::<Vec<_>>(), &outwards)
    }

    /// A part that shrinks by 23 µm/m has a diameter of 2 m smaller by 46 µm, wherever it stands; its holes
    /// may then be far from their places, the diameter does not know.
    #[test]
    fn growth_and_shift_by_hand() {
        for count in [3, 4, 31, 32] {
            let shrunk = found(count, |p| -23e-6 * p + Vec3::new(0.3, -0.4, 9.0)).unwrap();
            assert!((shrunk.diameter_error_mm + 0.046).abs() < 1e-9, "{shrunk:?}");
            assert!((shrunk.centre_mm[0] - 0.3).abs() < 1e-9, "{shrunk:?}");
            assert!((shrunk.centre_mm[1] + 0.4).abs() < 1e-9, "{shrunk:?}");
            assert_eq!(shrunk.opposite_mm.is_some(), count % 2 == 0);
            // 1 µm/m over 2 m; the shift does not change a diameter.
            assert!((shrunk.u_diameter_mm - 2e-3).abs() < 1e-12, "{shrunk:?}");
            if let Some(both) = shrunk.u_opposite_mm {
                assert!(both.iter().all(|u| (u - 2e-3).abs() < 1e-12), "{shrunk:?}");
            }
        }
        // x grows by 20 µm/m, y not at all: pairs from 0 to 40 µm, the mean circle 20 µm.
        let oval = found(32, |p| Vec3::new(20e-6 * p.x, 0.0, 0.0)).unwrap();
        assert!((oval.diameter_error_mm - 0.020).abs() < 1e-6, "{oval:?}");
        let [low, high] = oval.opposite_mm.unwrap();
        assert!(low.abs() < 1e-9 && (high - 0.040).abs() < 1e-9, "{oval:?}");
        assert_eq!(found(2, |p| p), None);
    }
}
