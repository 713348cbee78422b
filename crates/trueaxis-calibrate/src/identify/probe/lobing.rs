//! How the pre-travel of a probe follows the direction: functions to be fitted.

use std::f64::consts::TAU;
use trueaxis_geometry::Vec3;

/// Powers of the sine of the latitude go to this: kinematic seats press and tilt, no more.
const MOST_AXIAL: usize = 2;

/// How the direction table goes on between the hits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LobingModel {
    /// Harmonics of the direction.
    Fourier,
    /// A periodic cubic spline with evenly spaced knots.
    Spline,
}

impl LobingModel {
    /// All with their names in files.
    pub const ALL: [(Self, &'static str); 2] =
        [(Self::Fourier, "fourier"), (Self::Spline, "spline")];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fourier => "fourier",
            Self::Spline => "spline",
        }
    }
}

/// One function: a harmonic around, times powers of cosine and sine of the latitude.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Term {
    /// Periods per turn.
    pub order: usize,
    /// The sine rather than the cosine.
    pub sine: bool,
    /// Power of the sine of the latitude (0 on a ring).
    pub axial: usize,
}

/// A set of functions of the direction. None has the first degree: that is an offset of the ball.
#[derive(Debug, Clone, PartialEq)]
pub struct Lobing {
    /// Harmonics or a spline.
    pub model: LobingModel,
    /// The highest order; of a spline the number of knots.
    pub size: usize,
    /// What is fitted.
    pub terms: Vec<Term>,
}

impl Lobing {
    /// Harmonics up to an order, on a ring or (`solid`) in three dimensions.
    ///
    /// ```text
    ///     t(u) = Σ cos^m λ · sin^p λ · (a cos mψ + b sin mψ)      m + p ≤ K, p ≤ 2   docs/model.md eq. 137
    /// ```
    pub fn harmonics(order: usize, solid: bool) -> Self {
        let axial = if solid { MOST_AXIAL.min(order) } else { 0 };
        let mut terms = Vec::new();
        for p in 0..=axial {
            terms.extend((0..=order - p).filter(|m| m + p != 1).flat_map(|m| pair(m, p)));
        }
        Self { model: LobingModel::Fourier, size: order, terms }
    }

    /// A spline with so many knots; its coefficients go around in harmonics, of which the first is
    /// left out.
    pub fn spline(knots: usize) -> Self {
        let orders = (0..=knots / 2).filter(|m| *m != 1).flat_map(|m| pair(m, 0));
        // At the knots the sine of half their number is zero.
        let terms = orders.filter(|t| !(t.sine && 2 * t.order == knots)).collect();
        Self { model: LobingModel::Spline, size: knots, terms }
    }

    /// The functions in one direction of motion, as the probe sees it.
    pub fn values(&self, probe_direction: Vec3) -> Vec<f64> {
        let around = probe_direction.y.atan2(probe_direction.x);
        let level = probe_direction.x.hypot(probe_direction.y);
        match self.model {
            LobingModel::Fourier => {
                let value = |t: &Term| {
                    let angle = t.order as f64 * around;
                    let wave = if t.sine { angle.sin() } else { angle.cos() };
                    wave * level.powi(t.order as i32) * probe_direction.z.powi(t.axial as i32)
                };
                self.terms.iter().map(value).collect()
            }
            LobingModel::Spline => {
                let near = splines(around, self.size);
                let value = |t: &Term| {
                    let at = |(knot, weight): &(usize, f64)| {
                        let angle = TAU * (t.order * knot % self.size) as f64 / self.size as f64;
                        weight * if t.sine { angle.sin() } else { angle.cos() }
                    };
                    near.iter().map(at).sum()
                };
                self.terms.iter().map(value).collect()
            }
        }
    }
}

fn pair(order: usize, axial: usize) -> impl Iterator<Item = Term> {
    let kinds = if order == 0 { 1 } else { 2 };
    (0..kinds).map(move |sine| Term { order, sine: sine == 1, axial })
}

/// The four cubic B-splines that are not zero at an angle: knot and value.
fn splines(angle: f64, knots: usize) -> [(usize, f64); 4] {
    let place = (angle / TAU).rem_euclid(1.0) * knots as f64;
    let (first, s) = (place.floor() as usize, place.fract());
    let r = 1.0 - s;
    let weights = [
        r * r * r / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        (4.0 - 6.0 * r * r + 3.0 * r * r * r) / 6.0,
        s * s * s / 6.0,
    ];
    std::array::from_fn(|i| ((first + knots + i - 1) % knots, weights[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_counted() {
        // 1, cos 2ψ, sin 2ψ, cos 3ψ, sin 3ψ.
        assert_eq!(Lobing::harmonics(3, false).terms.len(), 5);
        // All polynomials on the sphere of degree 2 are 9, less 3 of degree 1.
        assert_eq!(Lobing::harmonics(2, true).terms.len(), 6);
        assert_eq!(Lobing::harmonics(0, true).terms.len(), 1);
        // As many as knots, less the first harmonic.
        assert_eq!(Lobing::spline(12).terms.len(), 10);
        assert_eq!(Lobing::spline(9).terms.len(), 7);
    }

    #[test]
    fn splines_sum_to_one_and_are_known_at_knots() {
        let at = splines(TAU * 3.0 / 8.0, 8);
        assert_eq!(at.map(|(k, _)| k), [2, 3, 4, 5]);
        for ((_, w), known) in at.iter().zip([1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0, 0.0]) {
            assert!((w - known).abs() < 1e-12);
        }
        assert!((splines(-0.1, 7).iter().map(|s| s.1).sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
