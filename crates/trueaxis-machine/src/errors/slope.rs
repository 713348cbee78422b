//! Slopes of the errors: their derivatives by the position, for Newton's method.

use super::{Curve, Extrapolation, Rotation, SixErrors, Spline, StatedError};
use trueaxis_geometry::{Mat3, Vec3};

impl Curve {
    /// dE/dq at a programmed position, mm or rad per mm or rad; at a knot of a table with straight
    /// lines that of the line above it, beyond a table that gives no value that at its end.
    ///
    /// # Example
    /// ```
    /// use trueaxis_machine::errors::Curve;
    /// // EXX = 12 µm · q/100 mm − 5 µm · (q/100 mm)²: 0.12 − 0.1·2 = −0.08 µm/mm at 200 mm
    /// let exx = Curve::Polynomial { coefficients: vec![0.0, 0.012, -0.005], origin: 0.0, scale: 100.0 };
    /// assert!((exx.slope_at(200.0) + 8e-5).abs() < 1e-18);
    /// ```
    pub fn slope_at(&self, q: f64) -> f64 {
        match self {
            Self::Constant(_) => 0.0,
            Self::Polynomial { coefficients, origin, scale } => {
                let x = (q - origin) / scale;
                let falling = coefficients.iter().enumerate().skip(1).rev();
                falling.fold(0.0, |sum, (k, c)| sum * x + k as f64 * c) / scale
            }
            Self::Fourier { terms, .. } => terms.iter().fold(0.0, |sum, t| {
                let (sin, cos) = (t.order * q).sin_cos();
                sum + t.order * (t.sine * cos - t.cosine * sin)
            }),
            Self::Table { spline, outside } => table_slope_at(spline, *outside, q),
        }
    }
}

fn table_slope_at(spline: &Spline, outside: Extrapolation, q: f64) -> f64 {
    if spline.is_periodic() {
        return spline.slope_at(q);
    }
    let (from, to) = spline.range();
    let inside = q.clamp(from, to);
    if inside != q && outside == Extrapolation::Clamp { 0.0 } else { spline.slope_at(inside) }
}

impl StatedError {
    /// The slope of [`StatedError::at`].
    pub fn slope_at(&self, q: f64, approach: f64) -> f64 {
        let mean = self.mean.slope_at(q);
        self.reversal.as_ref().map_or(mean, |r| mean + 0.5 * approach * r.slope_at(q))
    }
}

impl SixErrors {
    /// dR/dq of the rotation of these errors, whose slopes are given.
    ///
    /// ```text
    ///     R = Rz(c)·Ry(b)·Rx(a)        dR/dq = [c'·ẑ + Rz·(b'·ŷ + Ry·a'·x̂)]× · R
    /// ```
    pub(crate) fn rotation_slope(&self, slopes: &Self, rotation: Rotation) -> Mat3 {
        let [_, _, _, a, b, c] = slopes.0;
        if rotation == Rotation::SmallAngle {
            return Vec3::new(a, b, c).cross_matrix();
        }
        let (sb, cb) = self.0[4].sin_cos();
        let (sc, cc) = self.0[5].sin_cos();
        let spin = Vec3::new(cc * cb * a - sc * b, sc * cb * a + cc * b, c - sb * a);
        let turn = Mat3::identity() + self.rotation_minus_identity(Rotation::Exact);
        spin.cross_matrix() * turn
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::errors::{Harmonic, Interpolation};

    #[test]
    fn slopes_are_the_limits_of_differences() {
        let table =
            Spline::new(&[0.0, 1.0, 2.0, 4.0], &[1.0, 3.0, -1.0, 2.0], Interpolation::NotAKnot);
        let spline = table.expect("a table");
        let curves = [
            Curve::Polynomial { coefficients: vec![1.0, 2.0, -1.0, 0.5], origin: 1.0, scale: 3.0 },
            Curve::Fourier {
                mean: 1.0,
                terms: vec![Harmonic { order: 3.0, cosine: 0.5, sine: -1.0 }],
            },
            Curve::Table { spline: spline.clone(), outside: Extrapolation::Extend },
            Curve::Table { spline, outside: Extrapolation::Clamp },
        ];
        let h = 1e-5;
        for curve in curves {
            for q in [-0.7, 0.3, 1.6, 3.9, 4.5] {
                let at = |q: f64| curve.at(q).expect("everywhere");
                let found = (at(q + h) - at(q - h)) / (2.0 * h);
                assert!((found - curve.slope_at(q)).abs() < 1e-8, "{curve:?} at {q}");
            }
        }
    }

    #[test]
    fn the_slope_of_a_rotation_is_the_limit_of_differences() {
        let six = SixErrors([0.0, 0.0, 0.0, 0.1, -0.2, 0.3]);
        let slopes = SixErrors([0.0, 0.0, 0.0, 1.0, 0.5, -2.0]);
        let moved = |h: f64| SixErrors(std::array::from_fn(|k| six.0[k] + h * slopes.0[k]));
        for rotation in [Rotation::Exact, Rotation::SmallAngle] {
            let at = |h: f64| moved(h).rotation_minus_identity(rotation);
            let found = (at(1e-5) - at(-1e-5)) / 2e-5;
            assert!((found - six.rotation_slope(&slopes, rotation)).amax() < 1e-9);
        }
    }
}
