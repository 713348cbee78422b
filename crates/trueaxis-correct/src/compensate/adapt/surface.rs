//! The nominal surface, as far as points with normals tell it.

use super::table::{SurfacePoint, order_of_points};
use nalgebra::{SMatrix, SVector};
use trueaxis_geometry::Vec3;

/// Points that a place of the surface is made of.
const NEIGHBOURS: usize = 18;
/// Of the polynomial, and how many terms that are.
const DEGREE: usize = 4;
const TERMS: usize = 15;
/// Weight of nothing beside that of the points.
const RIDGE: f64 = 1e-10;
/// A normal turned farther away belongs to another side of the part.
const LEAST_COSINE: f64 = 0.3;
/// Steps to the foot of a point.
const MOST_STEPS: usize = 30;

/// A place on the nominal surface next to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// There.
    pub at_mm: Vec3,
    /// Out of the material.
    pub normal: Vec3,
    /// Of the point above the surface.
    pub height_mm: f64,
    /// From the foot to the nearest given point.
    pub from_nearest_mm: f64,
}

/// Points and normals that stand for a surface.
#[derive(Debug, Clone)]
pub struct NominalSurface {
    points: Vec<(Vec3, Vec3)>,
}

impl NominalSurface {
    /// From the nominal places of a table.
    pub fn of(points: &[SurfacePoint]) -> Self {
        let pair = |i: usize| (points[i].at_mm, points[i].normal);
        Self { points: order_of_points(points).into_iter().map(pair).collect() }
    }

    /// The nearest place of the surface.
    ///
    /// q = x − h·n(q), f(q) = 0                                  docs/model.md eq. 146
    pub fn foot(&self, x: &Vec3) -> Foot {
        let mut at = self.nearest(x).0;
        let mut normal = self.nearest(x).1;
        let mut height = 0.0;
        for _ in 0..MOST_STEPS {
            let (above, n) = self.height(&at);
            height = n.dot(&(x - at)) + above;
            let next = x - n * height;
            let step = (next - at).norm();
            (at, normal) = (next, n);
            if step < 1e-7 {
                break;
            }
        }
        let from_nearest_mm = (self.nearest(&at).0 - at).norm();
        Foot { at_mm: at, normal, height_mm: height, from_nearest_mm }
    }

    fn nearest(&self, x: &Vec3) -> (Vec3, Vec3) {
        let distance = |p: &&(Vec3, Vec3)| (p.0 - x).norm_squared();
        let near = self.points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        near.copied().unwrap_or((*x, Vec3::z()))
    }

    /// Height above the surface and normal near a place: a polynomial over the plane across the
    /// nearest normal, fitted to heights and slopes of the points around.
    fn height(&self, x: &Vec3) -> (f64, Vec3) {
        let up = self.nearest(x).1;
        let mut near: Vec<(f64, &(Vec3, Vec3))> = self
            .points
            .iter()
            .filter(|p| p.1.dot(&up) > LEAST_COSINE)
            .map(|p| ((p.0 - x).norm_squared(), p))
            .collect();
        if near.len() > NEIGHBOURS {
            near.select_nth_unstable_by(NEIGHBOURS, |a, b| a.0.total_cmp(&b.0));
            near.truncate(NEIGHBOURS + 1);
        }
        // Weights fall to zero at the farthest, so that nothing jumps where it changes.
        let farthest = near.iter().fold(0.0_f64, |m, n| m.max(n.0)).max(1e-12) * (1.0 + 1e-9);
        let size = farthest.sqrt();
        let e1 = tangent(&up);
        let e2 = up.cross(&e1);
        let (mut m, mut rhs) = (SMatrix::<f64, TERMS, TERMS>::zeros(), SVector::zeros());
        for (d, (at, normal)) in near {
            let arm = at - x;
            let (u, v) = (e1.dot(&arm) / size, e2.dot(&arm) / size);
            let slope = |e: &Vec3| -normal.dot(e) / normal.dot(&up);
            let rows = [
                (terms(u, v, [0, 0]), up.dot(&arm) / size),
                (terms(u, v, [1, 0]), slope(&e1)),
                (terms(u, v, [0, 1]), slope(&e2)),
            ];
            for (row, value) in rows {
                let w = (1.0 - d / farthest).powi(2);
                // The lower half is all that Cholesky reads; this is most of the work of an adaptation.
                for j in 0..TERMS {
                    let weighted = row[j] * w;
                    rhs[j] += weighted * value;
                    (j..TERMS).for_each(|k| m[(k, j)] += weighted * row[k]);
                }
            }
        }
        // A line of points says little across itself: a little weight keeps the rest at zero.
        let little = RIDGE * m.trace();
        for k in 0..TERMS {
            m[(k, k)] += little;
        }
        let fitted = m.cholesky().map_or_else(SVector::zeros, |c| c.solve(&rhs));
        let normal = (up - e1 * fitted[1] - e2 * fitted[2]).normalize();
        // The height was along `up`.
        (-fitted[0] * size * normal.dot(&up), normal)
    }
}

/// uᵃvᵇ of all degrees to the fourth, or their derivative.
fn terms(u: f64, v: f64, derivative: [i32; 2]) -> SVector<f64, TERMS> {
    let powers = |x: f64, d: i32| match d {
        0 => [1.0, x, x * x, x * x * x, x * x * x * x],
        _ => [0.0, 1.0, 2.0 * x, 3.0 * x * x, 4.0 * x * x * x],
    };
    let (of_u, of_v) = (powers(u, derivative[0]), powers(v, derivative[1]));
    let mut row = SVector::zeros();
    let mut k = 0;
    for degree in 0..=DEGREE {
        for b in 0..=degree {
            row[k] = of_u[degree - b] * of_v[b];
            k += 1;
        }
    }
    row
}

/// A unit vector across another.
pub(super) fn tangent(n: &Vec3) -> Vec3 {
    let other = if n.z.abs() < 0.9 { Vec3::z() } else { Vec3::x() };
    n.cross(&other).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_foot_on_a_sphere_is_on_the_radius() {
        let points: Vec<SurfacePoint> = (0..400)
            .map(|k| {
                let z = 1.0 - 2.0 * (f64::from(k) + 0.5) / 400.0;
                let (r, a) = ((1.0 - z * z).sqrt(), f64::from(k) * 2.399_963_23);
                let normal = Vec3::new(r * a.cos(), r * a.sin(), z);
                let number = f64::from(k);
                SurfacePoint {
                    line: 1,
                    number,
                    at_mm: normal * 20.0,
                    normal,
                    deviation_mm: 0.0,
                    u_mm: None,
                }
            })
            .collect();
        let surface = NominalSurface::of(&points);
        let out = Vec3::new(0.48, -0.6, 0.64);
        let foot = surface.foot(&(out * 24.0));
        assert!((foot.height_mm - 4.0).abs() < 2e-3, "{foot:?}");
        assert!((foot.at_mm - out * 20.0).norm() < 0.02, "{foot:?}");
        assert!(foot.normal.cross(&out).norm() < 2e-3, "{foot:?}");
    }
}
