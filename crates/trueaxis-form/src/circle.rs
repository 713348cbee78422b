//! The four reference circles of a roundness section.
//!
//! | function | ISO 12181-1 | definition |
//! |---|---|---|
//! | [`least_squares`] | LSCI | smallest sum of squared radial deviations |
//! | [`minimum_zone`] | MZCI | two concentric circles around all points, as close together as possible |
//! | [`maximum_inscribed`] | MICI | the largest circle inside the profile: a plug in a hole |
//! | [`minimum_circumscribed`] | MCCI | the smallest circle around the profile: a ring on a shaft |
//!
//! All are solved in the true distances, not in a linearised (limaçon) model. A [`Fitter`] keeps
//! its memory from one call to the next, so that a Monte Carlo run allocates nothing.
//!
//! The results are verified: the fast method ends with contact points; a bound that holds for *every*
//! other centre (documented in each module) proves the result, and where that proof fails (an arc, a
//! cloud, large deviations) a branch-and-bound search over all centres decides.

mod circumscribed;
mod inscribed;
mod least_squares;
mod search;
mod zone;

use crate::Error;

/// A reference circle with the zone that the points fill about its centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zone {
    /// Centre in the coordinates of the points, mm.
    pub center_mm: [f64; 2],
    /// Radius of the reference circle itself: the mean radius for least squares and minimum
    /// zone (there of the two circles), the inner or outer radius for the other two.
    pub radius_mm: f64,
    /// Distance of the nearest point from the centre, mm.
    pub inner_mm: f64,
    /// Distance of the farthest point from the centre, mm.
    pub outer_mm: f64,
}

impl Zone {
    /// The roundness deviation about this centre.
    ///
    /// ```text
    /// RONt = r_max − r_min
    /// ```
    ///
    /// # Example
    /// ```
    /// let zone = trueaxis_form::circle::Zone {
    ///     center_mm: [0.0, 0.0], radius_mm: 10.0, inner_mm: 9.5, outer_mm: 10.5,
    /// };
    /// assert_eq!(zone.width_mm(), 1.0);
    /// ```
    /// # Source
    /// ISO 12181-1, roundness deviation, peak to valley.
    pub fn width_mm(&self) -> f64 {
        self.outer_mm - self.inner_mm
    }

    /// How far the centre is from the origin of the coordinates, as a diameter.
    ///
    /// ```text
    /// φ = 2 √(x² + y²)
    /// ```
    ///
    /// # Example
    /// ```
    /// let zone = trueaxis_form::circle::Zone {
    ///     center_mm: [0.003, 0.004], radius_mm: 10.0, inner_mm: 9.5, outer_mm: 10.5,
    /// };
    /// assert!((zone.coaxiality_mm() - 0.010).abs() < 1e-15);
    /// ```
    /// # Source
    /// ISO 1101, coaxiality: the zone is a cylinder of the tolerance as *diameter*.
    pub fn coaxiality_mm(&self) -> f64 {
        2.0 * self.center_mm[0].hypot(self.center_mm[1])
    }
}

/// The four reference circles of one section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circles {
    /// Least squares.
    pub lsc: Zone,
    /// Minimum zone.
    pub mzc: Zone,
    /// Maximum inscribed.
    pub mic: Zone,
    /// Minimum circumscribed.
    pub mcc: Zone,
}

/// Limit of the coordinates; larger ones overflow when squared twice.
const LARGEST_MM: f64 = 1e100;

/// The points relative to their mean, so that a distant origin costs no digits.
#[derive(Debug, Clone, Default)]
struct Cloud {
    x: Vec<f64>,
    y: Vec<f64>,
    origin: [f64; 2],
    size: f64,
}

/// Distance and direction of every point from one centre.
#[derive(Debug, Clone, Default)]
struct Polar {
    distance: Vec<f64>,
    ux: Vec<f64>,
    uy: Vec<f64>,
    min: f64,
    max: f64,
}

/// Half of the largest angle at the centre without a point.
#[derive(Debug, Clone, Copy)]
struct HalfGap {
    sin: f64,
    cos: f64,
}

/// Fits circles and keeps its memory between calls.
///
/// # Example
/// ```
/// use trueaxis_form::circle::Fitter;
/// let square = [[1.0, 0.0], [0.0, 2.0], [-1.0, 0.0], [0.0, -2.0]];
/// let circles = Fitter::default().all(&square)?;
/// assert_eq!(circles.mzc.width_mm(), 1.0);
/// assert_eq!(circles.mcc.radius_mm, 2.0);
/// # Ok::<(), trueaxis_form::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Fitter {
    cloud: Cloud,
    polar: Polar,
    lift: inscribed::Lift,
    angles: Vec<f64>,
}

/// The circle with the smallest sum of squared radial deviations (LSCI).
///
/// ```text
/// Σ (|pᵢ − c| − r)² → min
/// ```
///
/// # Errors
/// Fewer than three points, one that is not finite, all on one place or line.
///
/// # Example
/// ```
/// let circle = trueaxis_form::circle::least_squares(&[[3.0, 1.0], [2.0, 2.0], [1.0, 1.0]])?;
/// assert!((circle.center_mm[0] - 2.0).abs() < 1e-15 && (circle.radius_mm - 1.0).abs() < 1e-15);
/// # Ok::<(), trueaxis_form::Error>(())
/// ```
/// # Source
/// ISO 12181-1, least squares reference circle; the geometric distance, not the algebraic one.
/// A cloud of points that is no circle can have several minima: the best of many starts is taken.
pub fn least_squares(points_mm: &[[f64; 2]]) -> Result<Zone, Error> {
    Fitter::default().least_squares(points_mm)
}

/// The two concentric circles around all points that are closest together (MZCI).
///
/// ```text
/// max |pᵢ − c| − min |pᵢ − c| → min
/// ```
///
/// # Errors
/// As [`least_squares`], and [`Error::NoCentre`] if no centre is better than all around it.
///
/// # Example
/// ```
/// let cross = [[1.0, 0.0], [0.0, 2.0], [-1.0, 0.0], [0.0, -2.0]];
/// assert_eq!(trueaxis_form::circle::minimum_zone(&cross)?.width_mm(), 1.0);
/// # Ok::<(), trueaxis_form::Error>(())
/// ```
/// # Source
/// ISO 12181-1, minimum zone reference circles. Two outer and two inner contact points that
/// take turns around the centre: Rivlin 1979, "Approximation by circles".
pub fn minimum_zone(points_mm: &[[f64; 2]]) -> Result<Zone, Error> {
    Fitter::default().minimum_zone(points_mm)
}

/// The largest circle within the points that holds none of them (MICI).
///
/// ```text
/// min |pᵢ − c| → max, contact points on all sides of c
/// ```
///
/// # Errors
/// As [`minimum_zone`].
///
/// # Example
/// ```
/// let triangle = [[0.0, 0.0], [8.0, 0.0], [4.0, 8.0]];
/// assert_eq!(trueaxis_form::circle::maximum_inscribed(&triangle)?.radius_mm, 5.0);
/// # Ok::<(), trueaxis_form::Error>(())
/// ```
/// # Source
/// ISO 12181-1, maximum inscribed reference circle. Of several, the largest one.
pub fn maximum_inscribed(points_mm: &[[f64; 2]]) -> Result<Zone, Error> {
    Fitter::default().maximum_inscribed(points_mm)
}

/// The smallest circle that holds every point (MCCI).
///
/// ```text
/// max |pᵢ − c| → min
/// ```
///
/// # Errors
/// As [`least_squares`].
///
/// # Example
/// ```
/// let points = [[-3.0, 0.0], [3.0, 0.0], [0.0, 1.0]];
/// assert_eq!(trueaxis_form::circle::minimum_circumscribed(&points)?.radius_mm, 3.0);
/// # Ok::<(), trueaxis_form::Error>(())
/// ```
/// # Source
/// ISO 12181-1, minimum circumscribed reference circle.
pub fn minimum_circumscribed(points_mm: &[[f64; 2]]) -> Result<Zone, Error> {
    Fitter::default().minimum_circumscribed(points_mm)
}

impl Fitter {
    /// All four circles; about half the work of the four single calls.
    ///
    /// # Errors
    /// As [`minimum_zone`].
    pub fn all(&mut self, points_mm: &[[f64; 2]]) -> Result<Circles, Error> {
        self.cloud.load(points_mm)?;
        let lsc = self.lsc()?;
        let mzc = self.mzc()?;
        let mic = self.mic()?;
        Ok(Circles { lsc, mzc, mic, mcc: self.mcc() })
    }

    /// As the function [`least_squares`].
    ///
    /// # Errors
    /// As there.
    pub fn least_squares(&mut self, points_mm: &[[f64; 2]]) -> Result<Zone, Error> {
        self.cloud.load(points_mm)?;
        self.lsc()
    }

    /// As the function [`minimum_zone`].
    ///
    /// # Errors
    /// As there.
    pub fn minimum_zone(&mut self, points_mm: &[[f64; 2]]) -> Result<Zone, Error> {
        self.cloud.load(points_mm)?;
        self.lsc()?;
        self.mzc()
    }

    /// As the function [`maximum_inscribed`].
    ///
    /// # Errors
    /// As there.
    pub fn maximum_inscribed(&mut self, points_mm: &[[f64; 2]]) -> Result<Zone, Error> {
        self.cloud.load(points_mm)?;
        self.lsc()?;
        self.mic()
    }

    /// As the function [`minimum_circumscribed`].
    ///
    /// # Errors
    /// As there.
    pub fn minimum_circumscribed(&mut self, points_mm: &[[f64; 2]]) -> Result<Zone, Error> {
        self.cloud.load(points_mm)?;
        Ok(self.mcc())
    }

    fn lsc(&mut self) -> Result<Zone, Error> {
        let center = least_squares::center(&self.cloud, &mut self.polar).ok_or(Error::NoCentre)?;
        self.polar.about(&self.cloud, center);
        Ok(self.zone(center, self.polar.mean()))
    }

    /// Expects `polar` about a centre near the answer.
    fn mzc(&mut self) -> Result<Zone, Error> {
        let fast = zone::center(&self.cloud, &mut self.polar, &mut self.angles);
        let center = match fast {
            Some(zone::Found { center, proven: true }) => center,
            other => search::minimum_zone(&self.cloud, other.map(|found| found.center))
                .ok_or(Error::NoCentre)?,
        };
        self.polar.about(&self.cloud, center);
        Ok(self.zone(center, 0.5 * (self.polar.min + self.polar.max)))
    }

    /// Expects `polar` about a centre near the answer.
    fn mic(&mut self) -> Result<Zone, Error> {
        let center = inscribed::center(&self.cloud, &self.polar, &mut self.lift, &mut self.angles)
            .or_else(|| search::maximum_inscribed(&self.cloud))
            .ok_or(Error::NoCentre)?;
        self.polar.about(&self.cloud, center);
        Ok(self.zone(center, self.polar.min))
    }

    /// The radius of the smallest circle around points of any number, which may lie on a line or coincide: half of the diameter of a
    /// cylinder around the points of a median line.
    ///
    /// ```
    /// use trueaxis_form::circle::Fitter;
    /// let on_a_line = [[0.0, 0.0], [3.0, 4.0], [1.5, 2.0]];
    /// assert_eq!(Fitter::default().enclosing_radius_mm(&on_a_line)?, 2.5);
    /// assert_eq!(Fitter::default().enclosing_radius_mm(&[[7.0, 7.0]])?, 0.0);
    /// # Ok::<(), trueaxis_form::Error>(())
    /// ```
    ///
    /// # Errors
    /// No point, or one that is not finite.
    pub fn enclosing_radius_mm(&mut self, points_mm: &[[f64; 2]]) -> Result<f64, Error> {
        self.cloud.put(points_mm, 1)?;
        Ok(self.mcc().radius_mm)
    }

    fn mcc(&mut self) -> Zone {
        let center = circumscribed::center(&self.cloud);
        self.polar.about(&self.cloud, center);
        self.zone(center, self.polar.max)
    }

    fn zone(&self, center: [f64; 2], radius_mm: f64) -> Zone {
        let origin = self.cloud.origin;
        Zone {
            center_mm: [origin[0] + center[0], origin[1] + center[1]],
            radius_mm,
            inner_mm: self.polar.min,
            outer_mm: self.polar.max,
        }
    }
}

impl Cloud {
    fn load(&mut self, points: &[[f64; 2]]) -> Result<(), Error> {
        self.put(points, 3)?;
        // What the rounding of the coordinates alone can spread.
        let noise = 8.0 * f64::EPSILON * self.origin[0].abs().max(self.origin[1].abs());
        if self.size <= noise.max(1.0 / LARGEST_MM) {
            return Err(Error::Coincident);
        }
        if self.is_line(noise) { Err(Error::Collinear) } else { Ok(()) }
    }

    /// The points about their mean, wherever they are.
    fn put(&mut self, points: &[[f64; 2]], needed: usize) -> Result<(), Error> {
        if points.len() < needed {
            return Err(Error::TooFewPoints { found: points.len(), needed });
        }
        let usable = |p: &[f64; 2]| p[0].abs() <= LARGEST_MM && p[1].abs() <= LARGEST_MM;
        if let Some(index) = points.iter().position(|p| !usable(p)) {
            return Err(Error::NotFinite { index });
        }
        let count = points.len() as f64;
        let sum = points.iter().fold([0.0; 2], |s, p| [s[0] + p[0], s[1] + p[1]]);
        self.origin = [sum[0] / count, sum[1] / count];
        self.x.clear();
        self.y.clear();
        self.x.extend(points.iter().map(|p| p[0] - self.origin[0]));
        self.y.extend(points.iter().map(|p| p[1] - self.origin[1]));
        self.size = self.x.iter().chain(&self.y).fold(0.0, |m, v| f64::max(m, v.abs()));
        Ok(())
    }

    fn len(&self) -> usize {
        self.x.len()
    }

    fn point(&self, i: usize) -> [f64; 2] {
        [self.x[i], self.y[i]]
    }

    /// Σx², Σxy, Σy².
    fn moments(&self) -> [f64; 3] {
        let points = self.x.iter().zip(&self.y);
        points.fold([0.0; 3], |s, (x, y)| [s[0] + x * x, s[1] + x * y, s[2] + y * y])
    }

    fn is_line(&self, noise: f64) -> bool {
        let [xx, xy, yy] = self.moments();
        if xx * yy - xy * xy > 1e-6 * (xx + yy) * (xx + yy) {
            return false;
        }
        // The determinant has lost its digits; the distances from the main direction have not.
        let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
        let away = |(x, y): (&f64, &f64)| (y * cos - x * sin).abs();
        let width = self.x.iter().zip(&self.y).map(away).fold(0.0, f64::max);
        width <= noise.max(1e-12 * self.size)
    }

    fn distance(&self, i: usize, center: [f64; 2]) -> f64 {
        let (x, y) = (self.x[i] - center[0], self.y[i] - center[1]);
        (x * x + y * y).sqrt()
    }

    /// The centre of the circle through three points; `None` if they are on a line.
    fn circumcenter(&self, contacts: [usize; 3]) -> Option<[f64; 2]> {
        let [a, b, c] = contacts.map(|i| self.point(i));
        let square = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
        let (ab, bc, ca) = (square(a, b), square(b, c), square(c, a));
        // The two shorter sides meet at the largest angle: their bisectors cross most squarely.
        if ab >= bc && ab >= ca {
            meet([(c, a), (c, b)])
        } else if bc >= ca {
            meet([(a, b), (a, c)])
        } else {
            meet([(b, a), (b, c)])
        }
    }
}

/// Where the perpendicular bisectors of two pairs meet: equally far from both ends of each.
fn meet(pairs: [([f64; 2], [f64; 2]); 2]) -> Option<[f64; 2]> {
    let [first, second] = pairs;
    // About a point of the first pair, so that short bisectors keep their digits.
    let base = first.0;
    let row = |(p, q): ([f64; 2], [f64; 2])| {
        let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
        let middle = [0.5 * (p[0] + q[0]) - base[0], 0.5 * (p[1] + q[1]) - base[1]];
        (dx, dy, dx * middle[0] + dy * middle[1])
    };
    let ((a, b, e), (c, d, f)) = (row(first), row(second));
    let determinant = a * d - b * c;
    if determinant.abs() <= 1e-14 * (a.hypot(b) * c.hypot(d)) {
        return None;
    }
    let center = [base[0] + (e * d - b * f) / determinant, base[1] + (a * f - e * c) / determinant];
    center.iter().all(|v| v.is_finite()).then_some(center)
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl Polar {
    fn about(&mut self, cloud: &Cloud, center: [f64; 2]) {
        let n = cloud.len();
        self.distance.resize(n, 0.0);
        self.ux.resize(n, 0.0);
        self.uy.resize(n, 0.0);
        let (xs, ys) = (&cloud.x[..n], &cloud.y[..n]);
        let (ds, us, vs) = (&mut self.distance[..n], &mut self.ux[..n], &mut self.uy[..n]);
        for i in 0..n {
            let (x, y) = (xs[i] - center[0], ys[i] - center[1]);
            let d = (x * x + y * y).sqrt();
            // A point on the centre has no direction; 0 lets it pull nowhere.
            let inverse = 1.0 / d.max(f64::MIN_POSITIVE);
            ds[i] = d;
            us[i] = x * inverse;
            vs[i] = y * inverse;
        }
        let fold = |start, pick: fn(f64, f64) -> f64| ds.iter().copied().fold(start, pick);
        self.min = fold(f64::INFINITY, |a, b| if b < a { b } else { a });
        self.max = fold(0.0, |a, b| if b > a { b } else { a });
    }

    fn len(&self) -> usize {
        self.distance.len()
    }

    fn mean(&self) -> f64 {
        self.distance.iter().sum::<f64>() / self.len() as f64
    }

    fn direction(&self, i: usize) -> [f64; 2] {
        [self.ux[i], self.uy[i]]
    }

    /// The point whose direction is nearest to a given one.
    fn farthest_to(&self, to: [f64; 2]) -> usize {
        let mut best = (0, f64::NEG_INFINITY);
        for (i, (x, y)) in self.ux.iter().zip(&self.uy).enumerate() {
            let along = x * to[0] + y * to[1];
            if along > best.1 {
                best = (i, along);
            }
        }
        best.0
    }

    /// The points farthest to +x, +y, −x, −y: one on each side.
    fn quarters(&self) -> [usize; 4] {
        let mut best = [0usize; 4];
        for i in 1..self.len() {
            let (x, y) = (self.ux[i], self.uy[i]);
            if x > self.ux[best[0]] {
                best[0] = i;
            }
            if y > self.uy[best[1]] {
                best[1] = i;
            }
            if x < self.ux[best[2]] {
                best[2] = i;
            }
            if y < self.uy[best[3]] {
                best[3] = i;
            }
        }
        best
    }

    /// An upper bound of half the largest gap: 45° where every octant holds a point, else exact.
    fn half_gap(&self, angles: &mut Vec<f64>) -> HalfGap {
        let mut octants = 0u8;
        for (x, y) in self.ux.iter().zip(&self.uy) {
            let number =
                u8::from(*x < 0.0) | u8::from(*y < 0.0) << 1 | u8::from(x.abs() < y.abs()) << 2;
            octants |= 1 << number;
        }
        if octants == u8::MAX {
            let half = std::f64::consts::FRAC_1_SQRT_2;
            return HalfGap { sin: half, cos: half };
        }
        angles.clear();
        angles.extend(self.ux.iter().zip(&self.uy).map(|(x, y)| y.atan2(*x)));
        angles.sort_unstable_by(f64::total_cmp);
        let last = angles[0] + std::f64::consts::TAU - angles[angles.len() - 1];
        let gap = angles.windows(2).map(|w| w[1] - w[0]).fold(last, f64::max);
        let (sin, cos) = (0.5 * gap).sin_cos();
        HalfGap { sin, cos }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refusals_name_the_reason() {
        let nan = [[0.0, 0.0], [1.0, f64::NAN], [2.0, 0.0]];
        assert_eq!(least_squares(&nan), Err(Error::NotFinite { index: 1 }));
        assert_eq!(minimum_zone(&[[4.0, 5.0]; 9]), Err(Error::Coincident));
        let line: Vec<_> = (0..9).map(|i| [0.1 * f64::from(i), 0.3 * f64::from(i) + 1.0]).collect();
        assert_eq!(maximum_inscribed(&line), Err(Error::Collinear));
        assert_eq!(minimum_circumscribed(&[]), Err(Error::TooFewPoints { found: 0, needed: 3 }));
    }

    /// Whatever its direction and its unit: rounding alone is no circle of kilometres.
    #[test]
    fn law_a_line_is_a_line_at_every_size() {
        for size in [1e-3, 1.0, 1e3, 1e6] {
            for k in 0..20 {
                let (sin, cos) = (0.15 * f64::from(k) + 0.01).sin_cos();
                let on =
                    |i: i32| [size * cos * f64::from(i) / 7.0, size * sin * f64::from(i) / 7.0];
                let line: Vec<_> = (-9..13).map(on).collect();
                assert_eq!(least_squares(&line), Err(Error::Collinear), "{size} {k}");
            }
        }
    }

    /// Four points at 9 mm and four at 11 mm, alternately: ISO 1101 has the two circles, the radius is that half way.
    #[test]
    fn the_radius_of_the_zone_lies_between_its_circles() {
        let h = 11.0 / 2.0_f64.sqrt();
        let inner = [[9.0, 0.0], [0.0, 9.0], [-9.0, 0.0], [0.0, -9.0]];
        let outer = [[h, h], [-h, h], [-h, -h], [h, -h]];
        let points: Vec<[f64; 2]> =
            inner.into_iter().chain(outer).map(|p| [p[0] + 2.0, p[1] - 3.0]).collect();
        let zone = minimum_zone(&points).unwrap();
        assert!((zone.radius_mm - 10.0).abs() < 1e-12, "{zone:?}");
        assert!((zone.inner_mm - 9.0).abs() < 1e-12 && (zone.outer_mm - 11.0).abs() < 1e-12);
    }

    #[test]
    fn a_far_origin_costs_no_digits() {
        // A 3-4-5 circle around (1e6, -2e6): every coordinate is exact.
        let points = [[5.0, 0.0], [3.0, 4.0], [-4.0, 3.0], [0.0, -5.0], [-3.0, -4.0]];
        let far = points.map(|p| [p[0] + 1e6, p[1] - 2e6]);
        let circles = Fitter::default().all(&far).unwrap();
        for zone in [circles.lsc, circles.mzc, circles.mic, circles.mcc] {
            assert!((zone.center_mm[0] - 1e6).abs() < 1e-9, "{zone:?}");
            assert!((zone.radius_mm - 5.0).abs() < 1e-14 && zone.width_mm() < 1e-14, "{zone:?}");
        }
    }
}
