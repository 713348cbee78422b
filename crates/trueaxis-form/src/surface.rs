//! Elements as functions of few unknowns in a frame of their own (docs/model.md eq. 222).

use crate::{Element, Shape};
use trueaxis_geometry::{Mat3, Vec3};

/// A frame whose z is the direction of an element.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    pub origin: Vec3,
    /// Columns: x, y, z of the frame.
    pub axes: Mat3,
}

impl Frame {
    pub fn new(origin: Vec3, direction: &Vec3) -> Self {
        let z = direction.try_normalize(0.0).unwrap_or(Vec3::z());
        // The coordinate axis that is least along z gives x.
        let least = z.iamin();
        let mut other = Vec3::zeros();
        other[least] = 1.0;
        let x = other.cross(&z).normalize();
        Self { origin, axes: Mat3::from_columns(&[x, z.cross(&x), z]) }
    }

    pub fn local(&self, point: &Vec3) -> Vec3 {
        self.axes.tr_mul(&(point - self.origin))
    }

    pub fn out_of(&self, local: &Vec3) -> Vec3 {
        self.origin + self.axes * local
    }

    pub fn direction(&self) -> Vec3 {
        self.axes.column(2).into_owned()
    }
}

/// A family g(q; x) of distances; the element is where g is equal to an offset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Family {
    /// x: slopes.
    Plane,
    /// x: centre in the plane.
    Disc,
    /// x: centre.
    Sphere,
    /// x: point and slopes of the axis.
    Axis,
    /// x: the same, and the half angle.
    Cone,
}

/// Most unknowns of a family.
pub(crate) const MOST: usize = 5;

impl Family {
    pub fn of(element: Element) -> Self {
        match element {
            Element::Plane => Self::Plane,
            Element::Circle => Self::Disc,
            Element::Sphere => Self::Sphere,
            Element::Line | Element::Cylinder => Self::Axis,
            Element::Cone => Self::Cone,
        }
    }

    pub fn unknowns(self) -> usize {
        match self {
            Self::Plane | Self::Disc => 2,
            Self::Sphere => 3,
            Self::Axis => 4,
            Self::Cone => 5,
        }
    }

    /// g and its derivatives by x.
    pub fn value(self, q: &Vec3, x: &[f64], gradient: &mut [f64]) -> f64 {
        match self {
            Self::Plane => {
                let s = (1.0 + x[0] * x[0] + x[1] * x[1]).sqrt();
                let g = (q.z - x[0] * q.x - x[1] * q.y) / s;
                gradient[0] = -q.x / s - g * x[0] / (s * s);
                gradient[1] = -q.y / s - g * x[1] / (s * s);
                g
            }
            Self::Disc => {
                let v = [q.x - x[0], q.y - x[1]];
                let g = v[0].hypot(v[1]);
                let inverse = 1.0 / g.max(f64::MIN_POSITIVE);
                gradient[0] = -v[0] * inverse;
                gradient[1] = -v[1] * inverse;
                g
            }
            Self::Sphere => {
                let v = q - Vec3::new(x[0], x[1], x[2]);
                let g = v.norm();
                let inverse = 1.0 / g.max(f64::MIN_POSITIVE);
                (0..3).for_each(|k| gradient[k] = -v[k] * inverse);
                g
            }
            Self::Axis => about_axis(q, x, gradient).0,
            Self::Cone => {
                let (rho, along, along_by) = about_axis(q, x, gradient);
                let (sin, cos) = x[4].sin_cos();
                (0..4).for_each(|k| gradient[k] = gradient[k] * cos - along_by[k] * sin);
                gradient[4] = -rho * sin - along * cos;
                rho * cos - along * sin
            }
        }
    }

    /// A length over which the gradient at a point changes.
    pub fn bend(self, q: &Vec3, x: &[f64]) -> f64 {
        match self {
            Self::Plane | Self::Sphere => 1.0,
            Self::Disc => (q.x - x[0]).hypot(q.y - x[1]),
            Self::Axis | Self::Cone => about_axis(q, x, &mut [0.0; MOST]).0,
        }
    }

    /// The frame in which these unknowns are zero; the half angle of a cone is not in it.
    pub fn moved(self, frame: &Frame, x: &[f64]) -> Frame {
        let tilted = |a: f64, b: f64| frame.axes * Vec3::new(a, b, 1.0);
        match self {
            Self::Plane => {
                // g is measured from the origin, which stays.
                let z = tilted(-x[0], -x[1]);
                Frame::new(frame.origin, &z)
            }
            Self::Disc => Frame { origin: frame.out_of(&Vec3::new(x[0], x[1], 0.0)), ..*frame },
            Self::Sphere => Frame { origin: frame.out_of(&Vec3::new(x[0], x[1], x[2])), ..*frame },
            Self::Axis | Self::Cone => {
                let origin = frame.out_of(&Vec3::new(x[0], x[1], 0.0));
                Frame::new(origin, &tilted(x[2], x[3]))
            }
        }
    }
}

/// Distance from the axis with its gradient, position along it with its gradient.
fn about_axis(q: &Vec3, x: &[f64], gradient: &mut [f64]) -> (f64, f64, [f64; 4]) {
    let s = (1.0 + x[2] * x[2] + x[3] * x[3]).sqrt();
    let d = Vec3::new(x[2], x[3], 1.0) / s;
    let v = Vec3::new(q.x - x[0], q.y - x[1], q.z);
    let along = v.dot(&d);
    let w = v - d * along;
    let rho = w.norm();
    let u = w / rho.max(f64::MIN_POSITIVE);
    gradient[0] = -u.x;
    gradient[1] = -u.y;
    gradient[2] = -along * u.x / s;
    gradient[3] = -along * u.y / s;
    let by_slope = |v: f64, a: f64| v / s - along * a / (s * s);
    (rho, along, [-d.x, -d.y, by_slope(v.x, x[2]), by_slope(v.y, x[3])])
}

/// The one of two opposite directions whose largest component is positive.
pub(crate) fn upright(direction: Vec3) -> Vec3 {
    direction * direction[direction.iamax()].signum()
}

/// An element of a family at x = 0 of a frame (`half_angle`: of a cone).
pub(crate) struct Place {
    pub frame: Frame,
    pub offset: f64,
    pub half_angle: f64,
}

impl Place {
    /// As a shape, with its point next to a middle.
    pub fn shape(&self, element: Element, middle: &Vec3) -> Shape {
        let Self { frame, offset, half_angle } = *self;
        let z = frame.direction();
        let along = (middle - frame.origin).dot(&z);
        let foot = frame.origin + z * along;
        let shape = |point_mm, direction, radius_mm| Shape {
            element,
            point_mm,
            direction,
            radius_mm,
            half_angle_rad: half_angle,
        };
        match element {
            Element::Plane => shape(middle - z * (along - offset), z, 0.0),
            Element::Line => shape(foot, upright(z), 0.0),
            Element::Circle => shape(frame.origin, z, offset),
            Element::Sphere => shape(frame.origin, Vec3::zeros(), offset),
            Element::Cylinder => shape(foot, upright(z), offset),
            Element::Cone => {
                // ρ cos ψ − h sin ψ = offset: the radius at h.
                let radius = (offset + along * half_angle.sin()) / half_angle.cos();
                let mut cone = shape(foot, z, radius);
                if half_angle < 0.0 {
                    (cone.direction, cone.half_angle_rad) = (-z, -half_angle);
                }
                cone
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_are_the_slopes_of_the_values() {
        let q = Vec3::new(0.7, -0.4, 0.3);
        let x = [0.02, -0.05, 0.1, 0.2, 0.3];
        for family in [Family::Plane, Family::Disc, Family::Sphere, Family::Axis, Family::Cone] {
            let mut gradient = [0.0; MOST];
            family.value(&q, &x, &mut gradient);
            for k in 0..family.unknowns() {
                let at = |h: f64| {
                    let mut moved = x;
                    moved[k] += h;
                    family.value(&q, &moved, &mut [0.0; MOST])
                };
                let slope = (at(1e-5) - at(-1e-5)) / 2e-5;
                assert!((slope - gradient[k]).abs() < 1e-9, "{family:?} {k}: {slope} {gradient:?}");
            }
        }
    }

    #[test]
    fn a_moved_frame_has_the_same_values() {
        let frame = Frame::new(Vec3::new(1.0, 2.0, 3.0), &Vec3::new(0.3, 0.2, 0.9));
        let (p, x) = (Vec3::new(1.4, 2.5, 2.2), [0.02, -0.05, 0.1, 0.2, 0.3]);
        for family in [Family::Plane, Family::Disc, Family::Sphere, Family::Axis, Family::Cone] {
            let before = family.value(&frame.local(&p), &x, &mut [0.0; MOST]);
            let moved = family.moved(&frame, &x);
            let after =
                family.value(&moved.local(&p), &[0.0, 0.0, 0.0, 0.0, 0.3], &mut [0.0; MOST]);
            assert!((before - after).abs() < 1e-14, "{family:?}");
        }
    }
}
