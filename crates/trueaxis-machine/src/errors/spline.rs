//! Interpolation between the knots of an error table.

/// How the values between the knots are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Cubic spline whose first two and last two pieces are one cubic each.
    NotAKnot,
    /// Cubic spline that repeats after the last knot.
    Periodic,
    /// Straight lines.
    Linear,
}

/// Why a table cannot be interpolated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SplineError {
    /// Fewer than two knots.
    #[error("the table has {0} rows, at least two are needed")]
    TooFewKnots(usize),
    /// The positions do not increase from this row on (counted from 0).
    #[error("the positions do not increase")]
    NotIncreasing(usize),
    /// A periodic table whose first and last value differ.
    #[error("the first value {first} and the last value {last} of a periodic table must be equal")]
    NotPeriodic {
        /// The first value.
        first: f64,
        /// The last value.
        last: f64,
    },
    /// A number is not finite.
    #[error("the table contains a number that is not finite")]
    NotFinite,
}

/// A piecewise cubic: on `[knots[i], knots[i+1]]` the value is `((c3·h + c2)·h + c1)·h + c0` with
/// `h = x − knots[i]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline {
    knots: Vec<f64>,
    pieces: Vec<[f64; 4]>,
    periodic: bool,
}

impl Spline {
    /// Interpolates a table.
    ///
    /// With the second derivatives Mᵢ at the knots, hᵢ = xᵢ₊₁ − xᵢ and slopes dᵢ:
    ///
    /// ```text
    ///     hᵢ₋₁ Mᵢ₋₁ + 2 (hᵢ₋₁ + hᵢ) Mᵢ + hᵢ Mᵢ₊₁ = 6 (dᵢ − dᵢ₋₁)          docs/model.md eq. 12
    ///     not-a-knot:  h₁ M₀ = (h₀ + h₁) M₁ − h₀ M₂, and the same at the other end
    ///     periodic:    the equation above across the seam, M₀ = Mₙ
    /// ```
    ///
    /// Two knots give a line, three a parabola.
    ///
    /// # Errors
    /// Positions that do not increase, non-finite numbers, a periodic table that does not close.
    ///
    /// # Example
    /// ```
    /// use trueaxis_machine::errors::{Interpolation, Spline};
    /// let x = [0.0, 1.0, 2.0, 3.0, 4.0];
    /// let cube = x.map(|v| v * v * v);
    /// let spline = Spline::new(&x, &cube, Interpolation::NotAKnot)?;
    /// assert!((spline.at(2.5) - 15.625).abs() < 1e-12); // a cubic is reproduced
    /// # Ok::<(), trueaxis_machine::errors::SplineError>(())
    /// ```
    ///
    /// # Source
    /// de Boor, A Practical Guide to Splines, 2001, ch. IV. The first and last row of the system in
    /// Zhang et al. 2019 have misprints (errata 001-1, 001-2).
    pub fn new(x: &[f64], y: &[f64], interpolation: Interpolation) -> Result<Self, SplineError> {
        if x.len() < 2 || y.len() != x.len() {
            return Err(SplineError::TooFewKnots(x.len().min(y.len())));
        }
        if !x.iter().chain(y).all(|v| v.is_finite()) {
            return Err(SplineError::NotFinite);
        }
        if let Some(row) = x.windows(2).position(|w| w[1] <= w[0]) {
            return Err(SplineError::NotIncreasing(row + 1));
        }
        let second = match interpolation {
            Interpolation::Linear => vec![0.0; x.len()],
            Interpolation::NotAKnot => second_derivatives_not_a_knot(x, y),
            Interpolation::Periodic => second_derivatives_periodic(x, y)?,
        };
        let pieces = (0..x.len() - 1).map(|i| piece(x, y, &second, i)).collect();
        Ok(Self { knots: x.to_vec(), pieces, periodic: interpolation == Interpolation::Periodic })
    }

    /// The value; outside the knots a periodic table repeats, otherwise the first or last piece is continued.
    pub fn at(&self, x: f64) -> f64 {
        let x = self.wrapped(x);
        let i = self.interval(x);
        let h = x - self.knots[i];
        let [c0, c1, c2, c3] = self.pieces[i];
        ((c3 * h + c2) * h + c1) * h + c0
    }

    /// The first derivative; outside the knots as [`Spline::at`].
    pub fn slope_at(&self, x: f64) -> f64 {
        let x = self.wrapped(x);
        let i = self.interval(x);
        let h = x - self.knots[i];
        let [_, c1, c2, c3] = self.pieces[i];
        (3.0 * c3 * h + 2.0 * c2) * h + c1
    }

    /// From pieces that fit together; `knots` rise and are one more than the pieces.
    pub(crate) fn from_pieces(knots: Vec<f64>, pieces: Vec<[f64; 4]>) -> Self {
        Self { knots, pieces, periodic: false }
    }

    /// The interpolant of `factor · y + add` through the same knots.
    pub(crate) fn changed(&self, factor: f64, add: f64) -> Self {
        let piece = |[c0, c1, c2, c3]: &[f64; 4]| {
            [factor * c0 + add, factor * c1, factor * c2, factor * c3]
        };
        Self { pieces: self.pieces.iter().map(piece).collect(), ..self.clone() }
    }

    /// The positions of the knots.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// First and last position.
    pub fn range(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.knots.len() - 1])
    }

    /// The four coefficients (rising powers of the distance from the left knot) of each piece.
    pub fn pieces(&self) -> &[[f64; 4]] {
        &self.pieces
    }

    /// Whether the table repeats after its last knot.
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    fn wrapped(&self, x: f64) -> f64 {
        let (from, to) = self.range();
        if !self.periodic || (from..=to).contains(&x) {
            return x;
        }
        from + (x - from).rem_euclid(to - from)
    }

    fn interval(&self, x: f64) -> usize {
        let right = self.knots.partition_point(|&k| k <= x);
        right.clamp(1, self.pieces.len()) - 1
    }
}

fn piece(x: &[f64], y: &[f64], second: &[f64], i: usize) -> [f64; 4] {
    let h = x[i + 1] - x[i];
    let slope = (y[i + 1] - y[i]) / h;
    [
        y[i],
        slope - h * (2.0 * second[i] + second[i + 1]) / 6.0,
        second[i] / 2.0,
        (second[i + 1] - second[i]) / (6.0 * h),
    ]
}

fn steps(x: &[f64]) -> Vec<f64> {
    x.windows(2).map(|w| w[1] - w[0]).collect()
}

fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    (0..x.len() - 1).map(|i| (y[i + 1] - y[i]) / (x[i + 1] - x[i])).collect()
}

fn second_derivatives_not_a_knot(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let (h, d) = (steps(x), slopes(x, y));
    match n {
        2 => return vec![0.0; 2],
        // One parabola through three points: M is constant.
        3 => return vec![2.0 * (d[1] - d[0]) / (h[0] + h[1]); 3],
        _ => {}
    }
    // Inner unknowns M₁ … Mₙ₋₂; M₀ and Mₙ₋₁ are put in from the end conditions.
    let inner = n - 2;
    let mut lower = vec![0.0; inner];
    let mut diagonal = vec![0.0; inner];
    let mut upper = vec![0.0; inner];
    let mut right = vec![0.0; inner];
    for k in 0..inner {
        (lower[k], upper[k]) = (h[k], h[k + 1]);
        diagonal[k] = 2.0 * (h[k] + h[k + 1]);
        right[k] = 6.0 * (d[k + 1] - d[k]);
    }
    let last = inner - 1;
    let (a, b) = (h[0], h[1]);
    diagonal[0] += a * (a + b) / b;
    upper[0] -= a * a / b;
    let (a, b) = (h[n - 2], h[n - 3]);
    diagonal[last] += a * (a + b) / b;
    lower[last] -= a * a / b;
    let solved = solve_tridiagonal(&lower, &diagonal, &upper, right);
    let mut second = vec![0.0; n];
    second[1..n - 1].copy_from_slice(&solved);
    second[0] = ((h[0] + h[1]) * second[1] - h[0] * second[2]) / h[1];
    let (a, b) = (h[n - 2], h[n - 3]);
    second[n - 1] = ((a + b) * second[n - 2] - a * second[n - 3]) / b;
    second
}

fn second_derivatives_periodic(x: &[f64], y: &[f64]) -> Result<Vec<f64>, SplineError> {
    let n = x.len() - 1;
    let (first, last) = (y[0], y[n]);
    let scale = y.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    if (first - last).abs() > 1e-12 * scale {
        return Err(SplineError::NotPeriodic { first, last });
    }
    let (h, d) = (steps(x), slopes(x, y));
    if n == 1 {
        return Ok(vec![0.0; 2]);
    }
    let before = |i: usize| (i + n - 1) % n;
    if n == 2 {
        // Both neighbours of M₀ are M₁: two equations in two unknowns, M₁ = −M₀.
        let m0 = 6.0 * (d[0] - d[1]) / (h[0] + h[1]);
        return Ok(vec![m0, -m0, m0]);
    }
    let lower: Vec<_> = (0..n).map(|i| h[before(i)]).collect();
    let diagonal: Vec<_> = (0..n).map(|i| 2.0 * (h[before(i)] + h[i])).collect();
    let right: Vec<_> = (0..n).map(|i| 6.0 * (d[i] - d[before(i)])).collect();
    let mut second = solve_cyclic(&lower, &diagonal, &h, right);
    second.push(second[0]);
    Ok(second)
}

/// Thomas' algorithm; the matrices above are diagonally dominant, so no pivoting is needed.
fn solve_tridiagonal(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    mut right: Vec<f64>,
) -> Vec<f64> {
    let n = right.len();
    let mut scaled_upper = vec![0.0; n];
    let mut pivot = diagonal[0];
    right[0] /= pivot;
    for i in 1..n {
        scaled_upper[i - 1] = upper[i - 1] / pivot;
        pivot = diagonal[i] - lower[i] * scaled_upper[i - 1];
        right[i] = (right[i] - lower[i] * right[i - 1]) / pivot;
    }
    for i in (0..n - 1).rev() {
        right[i] -= scaled_upper[i] * right[i + 1];
    }
    right
}

/// The cyclic system by a rank-one correction (Sherman–Morrison).
fn solve_cyclic(lower: &[f64], diagonal: &[f64], upper: &[f64], right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    let (corner_low, corner_up) = (upper[n - 1], lower[0]);
    let gamma = -diagonal[0];
    let mut changed = diagonal.to_vec();
    changed[0] -= gamma;
    changed[n - 1] -= corner_low * corner_up / gamma;
    let mut column = vec![0.0; n];
    column[0] = gamma;
    column[n - 1] = corner_low;
    let mut x = solve_tridiagonal(lower, &changed, upper, right);
    let z = solve_tridiagonal(lower, &changed, upper, column);
    let along = |v: &[f64]| v[0] + corner_up * v[n - 1] / gamma;
    let factor = along(&x) / (1.0 + along(&z));
    for (x, z) in x.iter_mut().zip(z) {
        *x -= factor * z;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periodic_spline_closes_with_its_slope() {
        let x: Vec<f64> = (0..=12).map(f64::from).collect();
        let y: Vec<f64> = (0..=12).map(|i| f64::from(i % 12).sin()).collect();
        let s = Spline::new(&x, &y, Interpolation::Periodic).unwrap();
        assert!((s.slope_at(0.0) - s.slope_at(12.0)).abs() < 1e-12);
    }

    #[test]
    fn refusals() {
        use SplineError as E;
        let new = |x: &[f64], y: &[f64]| Spline::new(x, y, Interpolation::NotAKnot);
        assert_eq!(new(&[1.0], &[1.0]), Err(E::TooFewKnots(1)));
        assert_eq!(new(&[1.0, 2.0, 2.0], &[0.0; 3]), Err(E::NotIncreasing(2)));
        assert_eq!(new(&[1.0, f64::NAN], &[0.0; 2]), Err(E::NotFinite));
        assert!(Spline::new(&[0.0, 1.0], &[1.0, 2.0], Interpolation::Periodic).is_err());
    }
}
