//! What the uncertainty of points makes of an element and of its form deviation (docs/model.md eq. 234 to 238).

use crate::chebyshev::{Distances, ends};
use crate::surface::{Family, Frame};
use crate::{Criterion, Element, Fitted, Reference};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use trueaxis_geometry::statistics::{SplitMix64, chi_square_above, student_above};
use trueaxis_geometry::{Mat3, Vec3};

/// Coverage probability of U: that of k = 2.
const COVERED: f64 = 0.9545;
/// The scatter is larger than the stated uncertainty if that happens by chance less often than this.
const BY_CHANCE: f64 = 0.01;
/// Draws of noise for the form deviation.
const DRAWS: usize = 400;
/// The points have noise already; the draws add as much again. The mean of a largest value is convex in the size of the
/// noise, so that the step from 0 to 1 is at most 1/(√2 − 1) of that from 1 to √2.
const FIRST_NOISE: f64 = 1.0 + std::f64::consts::SQRT_2;
/// More points are thinned for the draws; those near the ends are kept.
const MOST_POINTS: usize = 2000;

/// Where the standard uncertainty of a point comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// It was stated, and the scatter does not contradict it.
    Stated,
    /// The scatter about least squares; none was stated.
    Scatter,
    /// The scatter, which is larger than what was stated: form deviations are in it.
    LargerScatter,
    /// The differences of neighbouring points of a profile.
    Neighbours,
}

/// The standard uncertainty of a point in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointUncertainty {
    /// The standard uncertainty, mm.
    pub u_mm: f64,
    /// Where it comes from.
    pub source: Source,
    /// k of U = k·u: 2, or of Student's distribution. Unit: 1.
    pub coverage: f64,
}

/// Standard uncertainties of the values of the least-squares element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncertainty {
    /// Of a point, by which they are computed.
    pub of_point: PointUncertainty,
    /// Of a point along the normal of a circle, if its plane was fitted.
    pub of_axial: Option<PointUncertainty>,
    /// Of the point of the element.
    pub point_mm: [f64; 3],
    /// Of the components of the direction. Unit: 1.
    pub direction: [f64; 3],
    /// Of the radius.
    pub radius_mm: f64,
    /// Of the half angle.
    pub half_angle_rad: f64,
}

/// What noise of the points does to a form deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormNoise {
    /// Standard deviation of the form deviation.
    pub u_mm: f64,
    /// By how much noise has changed it on average, at most; as a rule it is larger.
    pub bias_mm: f64,
}

impl FormNoise {
    /// U = k u + bias: the form deviation is not corrected for what noise adds to it.
    ///
    /// # Source
    /// JCGM 100 (GUM) F.2.4.5.
    pub fn expanded_mm(&self, coverage: f64) -> f64 {
        coverage * self.u_mm + self.bias_mm
    }
}

/// k of U for these degrees of freedom.
pub fn coverage_factor(degrees_of_freedom: usize) -> f64 {
    student_two_sided(1.0 - COVERED, degrees_of_freedom)
}

/// The value that |t| exceeds with this probability, exact for whole degrees of freedom.
pub(crate) fn student_two_sided(probability: f64, degrees_of_freedom: usize) -> f64 {
    if degrees_of_freedom > 300 {
        return student_above(0.5 * probability, degrees_of_freedom as f64);
    }
    let (mut low, mut high) = (0.0, 1e12_f64);
    for _ in 0..200 {
        let middle =
            if low > 1.0 { (low * high).sqrt() } else { 0.5 * (low + high.min(4.0 * low + 1.0)) };
        if within(middle, degrees_of_freedom.max(1)) < 1.0 - probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The probability of |t| below a value (Abramowitz and Stegun 26.7.3 and 26.7.4).
fn within(t: f64, n: usize) -> f64 {
    let (sin, cos) = (t / (n as f64).sqrt()).atan().sin_cos();
    let is_odd = n % 2 == 1;
    let (mut term, mut sum, mut k) = if is_odd { (cos, 0.0, 3.0) } else { (1.0, 0.0, 2.0) };
    let terms = if is_odd { (n - 1) / 2 } else { n / 2 };
    for _ in 0..terms {
        sum += term;
        term *= cos * cos * (k - 1.0) / k;
        k += 2.0;
    }
    let angle = (t / (n as f64).sqrt()).atan();
    if is_odd { (angle + sin * sum) * 2.0 / std::f64::consts::PI } else { sin * sum }
}

/// The standard uncertainty of a point by what is stated and by the scatter; `None` if there is neither.
fn of_point(stated_mm: Option<f64>, scatter_mm: f64, degrees: usize) -> Option<PointUncertainty> {
    let stated = |u_mm| PointUncertainty { u_mm, source: Source::Stated, coverage: 2.0 };
    let scatter = |source| {
        let coverage = coverage_factor(degrees);
        PointUncertainty { u_mm: scatter_mm, source, coverage }
    };
    match stated_mm {
        Some(u) if degrees == 0 => Some(stated(u)),
        Some(u) => {
            let nu = degrees as f64;
            let larger = nu * scatter_mm * scatter_mm > u * u * chi_square_above(BY_CHANCE, nu);
            Some(if larger { scatter(Source::LargerScatter) } else { stated(u) })
        }
        None => (degrees > 0).then(|| scatter(Source::Scatter)),
    }
}

/// The noise of the values of a profile in their order, from second differences: smooth form deviations are not in it;
/// `None` for fewer than 8 values.
///
/// # Source
/// von Neumann 1941 for first differences; the second ones have six times the variance of a value.
pub fn noise_of_neighbours(values_mm: &[f64]) -> Option<PointUncertainty> {
    let n = values_mm.len();
    if n < 8 {
        return None;
    }
    let squares: f64 = values_mm.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).powi(2)).sum();
    let u_mm = (squares / (6.0 * (n as f64 - 2.0))).sqrt();
    // Neighbouring differences share their points: about half of them count (35/18).
    let coverage = coverage_factor((n - 2) / 2);
    Some(PointUncertainty { u_mm, source: Source::Neighbours, coverage })
}

impl Fitted {
    /// Standard uncertainties of the values, from that of a point (mm) or from the scatter of the points; `None` if
    /// there is neither.
    pub fn uncertainty(&self, stated_mm: Option<f64>) -> Option<Uncertainty> {
        let radial = of_point(stated_mm, self.residual_deviation_mm, self.degrees_of_freedom)?;
        let axial = self.axial_deviation_mm.and_then(|(s, n)| of_point(stated_mm, s, n));
        let s = &self.sensitivity;
        let along = axial.unwrap_or(radial).u_mm;
        let root = |m: Mat3| -> [f64; 3] { std::array::from_fn(|k| m[(k, k)].max(0.0).sqrt()) };
        let known_plane = self.element == Element::Circle && axial.is_none();
        let axial_point = if known_plane { Mat3::zeros() } else { s.axial_point * along * along };
        Some(Uncertainty {
            of_point: radial,
            of_axial: axial,
            point_mm: root(s.point * radial.u_mm * radial.u_mm + axial_point),
            direction: root(s.direction * along * along),
            radius_mm: s.radius * radial.u_mm,
            half_angle_rad: s.half_angle_rad_per_mm * radial.u_mm,
        })
    }

    /// What noise of every point with this standard deviation does to the form deviation of each reference: 400 draws
    /// with a fixed seed, linear about the contact points.
    pub fn form_noise(&self, points_mm: &[Vec3], u_mm: f64) -> Vec<(Criterion, FormNoise)> {
        let noise = |r: &Reference| (r.criterion, self.noise_of(r, points_mm, u_mm));
        self.references.iter().map(noise).collect()
    }

    /// The frame of a reference in units of the size.
    fn place(&self, reference: &Reference) -> (Frame, f64) {
        let shape = &reference.shape;
        let origin = (shape.point_mm - self.middle_mm) / self.size_mm;
        let frame = match (self.element, self.normal) {
            (Element::Sphere, _) => Frame { origin, axes: Mat3::identity() },
            (Element::Line, Some(normal)) => {
                let x = shape.direction;
                Frame { origin, axes: Mat3::from_columns(&[x, normal, x.cross(&normal)]) }
            }
            _ => Frame::new(origin, &shape.direction),
        };
        (frame, shape.half_angle_rad)
    }

    /// The family of distances of the references.
    pub(crate) fn family(&self) -> Family {
        match (self.element, self.normal) {
            (Element::Line, Some(_)) => Family::Plane,
            (element, _) => Family::of(element),
        }
    }

    /// Unknowns of the family that change the distances: across a profile only one slope does.
    pub(crate) fn slopes(&self) -> usize {
        if self.normal.is_some() { 1 } else { self.family().unknowns() }
    }

    /// Distances of the points about a reference, in units of the size.
    pub(crate) fn distances(&self, reference: &Reference, points_mm: &[Vec3]) -> Distances {
        let (frame, half_angle) = self.place(reference);
        let points = points_mm.iter().map(|p| (p - self.middle_mm) / self.size_mm);
        Distances::about(self.family(), &frame, half_angle, &points.collect::<Vec<_>>())
    }

    fn noise_of(&self, reference: &Reference, points_mm: &[Vec3], u_mm: f64) -> FormNoise {
        let u = u_mm / self.size_mm;
        if u <= 0.0 {
            return FormNoise { u_mm: 0.0, bias_mm: 0.0 };
        }
        let near = self.near_the_ends(reference, points_mm, u);
        let here = self.distances(reference, &near);
        let is_space_line = self.element == Element::Line && self.normal.is_none();
        let scale = if is_space_line { 2.0 } else { 1.0 };
        let drawn = match reference.criterion {
            Criterion::LeastSquares => Drawn::LeastSquares(self.projection(&here, is_space_line)),
            _ if is_space_line => Drawn::Contacts(Criterion::MinimumCircumscribed),
            criterion => Drawn::Contacts(criterion),
        };
        let (low, high) = here.range();
        let value = if is_space_line { high } else { high - low };
        // From the smallest distance to the largest: the order of the points does not matter.
        let mut order: Vec<usize> = (0..here.values.len()).collect();
        order.sort_by(|a, b| here.values[*a].total_cmp(&here.values[*b]));
        let mut random = SplitMix64::new(235);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..DRAWS {
            let mut errors = vec![0.0; order.len()];
            order.iter().for_each(|i| errors[*i] = u * normal(&mut random));
            let d = drawn.form(self.family(), &here, errors, u, is_space_line) - value;
            (sum, squares) = (sum + d, squares + d * d);
        }
        let n = DRAWS as f64;
        let bias = sum / n;
        let deviation = ((squares / n - bias * bias) * n / (n - 1.0)).max(0.0).sqrt();
        let size = scale * self.size_mm;
        let mut bias = FIRST_NOISE * bias.abs();
        if here.values.len() < points_mm.len() {
            // Of thinned points the draws miss the largest noise: the mean of the largest of n is below √(2 ln n) at either end.
            let all = 2.0 * (points_mm.len() as f64).ln();
            bias = bias.max(if is_space_line { 1.0 } else { 2.0 } * u * all.sqrt());
        }
        FormNoise { u_mm: deviation * size, bias_mm: bias * size }
    }

    /// Points that noise can bring to an end of the zone, and some of all.
    fn near_the_ends(&self, reference: &Reference, points_mm: &[Vec3], u: f64) -> Vec<Vec3> {
        let n = points_mm.len();
        if n <= MOST_POINTS {
            return points_mm.to_vec();
        }
        let here = self.distances(reference, points_mm);
        let (low, high) = here.range();
        let is_near = |v: f64| v < low + 8.0 * u || v > high - 8.0 * u;
        let near: Vec<usize> = (0..n).filter(|i| is_near(here.values[*i])).collect();
        let thin = |step: usize, all: Vec<usize>| all.into_iter().step_by(step.max(1));
        let near = thin(near.len().div_ceil(MOST_POINTS), near);
        let some = thin(n.div_ceil(300), (0..n).collect());
        let mut kept: Vec<usize> = near.chain(some).collect();
        let ends = [low, high].map(|e| here.values.iter().position(|v| *v == e));
        kept.extend(ends.into_iter().flatten());
        kept.extend(reference.contacts.iter().map(|c| c.index));
        kept.sort_unstable();
        kept.dedup();
        kept.into_iter().map(|i| points_mm[i]).collect()
    }

    /// Orthonormal columns of what least squares follows.
    fn projection(&self, here: &Distances, is_space_line: bool) -> DMatrix<f64> {
        let k = self.slopes();
        if is_space_line || here.values.len() < k + 1 {
            return DMatrix::zeros(here.values.len(), 0);
        }
        DMatrix::from_fn(
            here.values.len(),
            k + 1,
            |i, c| {
                if c < k { here.slopes[i][c] } else { 1.0 }
            },
        )
        .qr()
        .q()
    }
}

/// How a form deviation follows noise.
enum Drawn {
    LeastSquares(DMatrix<f64>),
    Contacts(Criterion),
}

impl Drawn {
    fn form(
        &self,
        family: Family,
        here: &Distances,
        errors: Vec<f64>,
        u: f64,
        is_space_line: bool,
    ) -> f64 {
        match self {
            Self::LeastSquares(q) => {
                let e = DVector::from_vec(errors);
                let rest = if q.ncols() > 0 { &e - q * q.tr_mul(&e) } else { e };
                let start = (f64::INFINITY, f64::NEG_INFINITY);
                let all = here.values.iter().zip(rest.iter()).map(|(v, e)| v + e);
                let (low, high) = all.fold(start, |(l, h), v| (l.min(v), h.max(v)));
                if is_space_line { high } else { high - low }
            }
            Self::Contacts(criterion) => {
                let values = here.values.iter().zip(&errors).map(|(v, e)| v + e).collect();
                let noisy = Distances { values, slopes: here.slopes.clone() };
                let best = noisy.linear(family.unknowns(), *criterion, 60.0 * u);
                let (low, high) = noisy.range();
                match (best, criterion) {
                    (None, _) if is_space_line => high,
                    (None, _) => high - low,
                    (Some(best), Criterion::MinimumZone) => best.objective(ends(*criterion)),
                    (Some(best), _) if is_space_line => best.ends[0],
                    (Some(best), _) => {
                        // The range about the circumscribed or inscribed element.
                        let there = noisy.values.iter().zip(&noisy.slopes).map(|(v, s)| {
                            v + s.iter().zip(&best.step).map(|(s, d)| s * d).sum::<f64>()
                        });
                        let start = (f64::INFINITY, f64::NEG_INFINITY);
                        let (low, high) = there.fold(start, |(l, h), v| (l.min(v), h.max(v)));
                        high - low
                    }
                }
            }
        }
    }
}

/// A standard-normal number (Box and Muller).
fn normal(random: &mut SplitMix64) -> f64 {
    let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
    radius * (TAU * random.unit()).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coverage_factors_of_the_gum() {
        // JCGM 100, table G.2, p = 95.45 %.
        for (degrees, k) in [(1, 13.97), (2, 4.53), (3, 3.31), (5, 2.65), (10, 2.28), (50, 2.05)] {
            assert!((coverage_factor(degrees) - k).abs() < 0.006, "{degrees}");
        }
        assert!((coverage_factor(100_000) - 2.0).abs() < 1e-3);
    }
}
