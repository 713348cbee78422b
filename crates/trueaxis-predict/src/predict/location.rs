//! The location diameter: the circle on which the holes are, as a drawing tolerates it.
//!
//! ```text
//!     least squares:  Σ (|pᵢ − c| − D/2)² → min over c, D
//!     by pairs:       Dᵢ = |pᵢ − pᵢ₊ₙ/₂|, opposite holes
//! ```

use super::holes::Hole;
use trueaxis_geometry::Vec3;
use trueaxis_part::fit::circle::least_squares;

/// The circle of the holes at 20 °C, less the nominal one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocationCircle {
    /// Its diameter by least squares, less the nominal one, mm.
    pub diameter_error_mm: f64,
    /// Smallest and largest distance of opposite holes, less the nominal diameter; none where the number of
    /// holes is odd. Unit: mm.
    pub opposite_mm: Option<[f64; 2]>,
    /// Where its centre is, less where it should be, mm.
    pub centre_mm: [f64; 2],
}

impl LocationCircle {
    /// Of holes evenly on a circle in X and Y; none for fewer than three.
    pub fn of(nominal_mm: &[Vec3], holes: &[Hole]) -> Option<Self> {
        let count = nominal_mm.len();
        if count < 3 || holes.len() != count {
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
        let half = count / 2;
        let opposite = (count == 2 * half).then(|| {
            let far = (0..half).map(|i| {
                let (a, b) = (actual[i], actual[i + half]);
                (a[0] - b[0]).hypot(a[1] - b[1]) - diameter_mm
            });
            far.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], d| [l.min(d), h.max(d)])
        });
        Some(Self {
            diameter_error_mm: 2.0 * circle.radius_mm - diameter_mm,
            opposite_mm: opposite,
            centre_mm: circle.center_mm,
        })
    }
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
        LocationCircle::of(&nominal, &(0..count).map(hole).collect::<Vec<_>>())
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
        }
        // x grows by 20 µm/m, y not at all: pairs from 0 to 40 µm, the mean circle 20 µm.
        let oval = found(32, |p| Vec3::new(20e-6 * p.x, 0.0, 0.0)).unwrap();
        assert!((oval.diameter_error_mm - 0.020).abs() < 1e-6, "{oval:?}");
        let [low, high] = oval.opposite_mm.unwrap();
        assert!(low.abs() < 1e-9 && (high - 0.040).abs() < 1e-9, "{oval:?}");
        assert_eq!(found(2, |p| p), None);
    }
}
