//! Features: nominal surfaces and the points on them that are checked.

use std::ops::Range;
use trueaxis_form::{Element, Shape};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;

/// More points than this on one feature are a slip of the unit.
pub(super) const MOST_POINTS: usize = 200_000;

/// The nominal shape of a feature, in the workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Geometry {
    /// A rectangle.
    Plane {
        /// Its middle.
        at_mm: Vec3,
        /// Out of the material, a unit vector.
        normal: Vec3,
        /// Along its first edge, a unit vector.
        along: Vec3,
        /// Lengths of its edges.
        size_mm: [f64; 2],
    },
    /// A cylinder, or a part of it.
    Cylinder {
        /// Where its axis begins.
        at_mm: Vec3,
        /// Along the axis, a unit vector.
        axis: Vec3,
        /// Its radius.
        radius_mm: f64,
        /// Its length.
        length_mm: f64,
        /// Material is outside.
        is_hole: bool,
    },
    /// A truncated cone.
    Cone {
        /// Where its axis begins.
        at_mm: Vec3,
        /// Along the axis, a unit vector.
        axis: Vec3,
        /// Radii at the beginning and at the end.
        radii_mm: [f64; 2],
        /// Its length along the axis.
        length_mm: f64,
        /// Material is outside.
        is_hole: bool,
    },
    /// A part of a sphere about an axis.
    Sphere {
        /// Its centre.
        at_mm: Vec3,
        /// The middle of the part that there is, a unit vector.
        axis: Vec3,
        /// Its radius.
        radius_mm: f64,
        /// From the axis to the edge of that part.
        opening_rad: f64,
        /// Material is outside.
        is_hole: bool,
    },
    /// A table of points with their normals.
    Points,
    /// What the program leaves on a machine without errors, seen through a rectangle; its points are found by the nominal cut.
    Programmed {
        /// The middle of the rectangle.
        at_mm: Vec3,
        /// Towards the eye, a unit vector.
        normal: Vec3,
        /// Along its first edge, a unit vector.
        along: Vec3,
        /// Lengths of its edges.
        size_mm: [f64; 2],
        /// How far beyond the rectangle is looked.
        depth_mm: f64,
    },
}

/// A feature of a part.
#[derive(Debug, Clone, PartialEq)]
pub struct Feature {
    /// Its name.
    pub name: String,
    /// The letter that it has as a datum.
    pub letter: Option<String>,
    /// Its nominal shape.
    pub geometry: Geometry,
    /// Points on it with the normals out of the material.
    pub points: Vec<SurfacePoint>,
    /// Which points make a section across the axis; none on planes and tables.
    pub sections: Vec<Range<usize>>,
    /// How far into the material it is looked; on a thin wall less than half of it.
    pub below_mm: f64,
    /// How far out of it.
    pub above_mm: f64,
}

impl Feature {
    /// Its letter as a datum, else its name.
    pub fn label(&self) -> &str {
        self.letter.as_deref().unwrap_or(&self.name)
    }
}

impl Geometry {
    /// In words.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Plane { .. } => "plane",
            Self::Cylinder { .. } => "cylinder",
            Self::Cone { .. } => "cone",
            Self::Sphere { .. } => "sphere",
            Self::Points => "points",
            Self::Programmed { .. } => "programmed surface",
        }
    }

    /// A point of the axis and its direction, if it has one.
    pub fn axis(&self) -> Option<(Vec3, Vec3)> {
        match *self {
            Self::Cylinder { at_mm, axis, .. } | Self::Cone { at_mm, axis, .. } => {
                Some((at_mm, axis))
            }
            _ => None,
        }
    }

    /// The element of a cylinder or a sphere, from which a search for that of the cut surface begins.
    pub(super) fn shape(&self) -> Option<Shape> {
        let (element, point_mm, direction, radius_mm) = match *self {
            Self::Cylinder { at_mm, axis, radius_mm, .. } => {
                (Element::Cylinder, at_mm, axis, radius_mm)
            }
            Self::Sphere { at_mm, radius_mm, .. } => {
                (Element::Sphere, at_mm, Vec3::zeros(), radius_mm)
            }
            _ => return None,
        };
        Some(Shape { element, point_mm, direction, radius_mm, half_angle_rad: 0.0 })
    }

    /// The normal of a plane, the direction of an axis.
    pub(super) fn direction(&self) -> Option<Vec3> {
        match *self {
            Self::Plane { normal, .. } => Some(normal),
            _ => self.axis().map(|(_, axis)| axis),
        }
    }

    /// How far a point is outside of the material, and the direction in which that grows; none of a table of points.
    pub(super) fn outside(&self, point_mm: &Vec3) -> Option<(f64, Vec3)> {
        let sign = |is_hole: bool| if is_hole { -1.0 } else { 1.0 };
        let unit = |v: Vec3| v / v.norm().max(f64::MIN_POSITIVE);
        match *self {
            Self::Plane { at_mm, normal, .. } => Some((normal.dot(&(point_mm - at_mm)), normal)),
            Self::Cylinder { at_mm, axis, radius_mm, is_hole, .. } => {
                let arm = point_mm - at_mm;
                let out = arm - axis * arm.dot(&axis);
                let sign = sign(is_hole);
                Some((sign * (out.norm() - radius_mm), unit(out) * sign))
            }
            Self::Cone { at_mm, axis, radii_mm, length_mm, is_hole } => {
                let arm = point_mm - at_mm;
                let height = arm.dot(&axis);
                let out = arm - axis * height;
                let rise = radii_mm[1] - radii_mm[0];
                let normal = (unit(out) * length_mm - axis * rise) / length_mm.hypot(rise);
                let radial = out.norm() - radii_mm[0] - rise * height / length_mm;
                let sign = sign(is_hole);
                Some((sign * radial * length_mm / length_mm.hypot(rise), normal * sign))
            }
            Self::Sphere { at_mm, radius_mm, is_hole, .. } => {
                let arm = point_mm - at_mm;
                let sign = sign(is_hole);
                Some((sign * (arm.norm() - radius_mm), unit(arm) * sign))
            }
            Self::Points | Self::Programmed { .. } => None,
        }
    }

    /// The same for each place of a list; not a number where there is none.
    pub(super) fn distances(&self) -> impl Fn(usize, &Vec3) -> (f64, Vec3) + '_ {
        |_, place| self.outside(place).unwrap_or((f64::NAN, Vec3::zeros()))
    }

    /// Points no farther apart than `spacing_mm`, and which of them make a section; half a step from edges, where two surfaces
    /// meet.
    ///
    /// # Errors
    /// In words: too many points.
    pub fn sampled(
        &self,
        spacing_mm: f64,
    ) -> Result<(Vec<SurfacePoint>, Vec<Range<usize>>), String> {
        let rows = self.rows(spacing_mm);
        let count: usize = rows.iter().map(|row| row.count).fold(0, usize::saturating_add);
        if count > MOST_POINTS {
            return Err(format!(
                "a spacing of {spacing_mm} mm makes {count} points, at most {MOST_POINTS} are checked"
            ));
        }
        let (mut points, mut sections) = (Vec::with_capacity(count), Vec::new());
        for row in rows {
            let from = points.len();
            points.extend((0..row.count).map(|k| (row.at)(k)));
            sections.push(from..points.len());
        }
        if self.axis().is_none() {
            sections.clear();
        }
        Ok((points, sections))
    }

    fn rows(&self, spacing_mm: f64) -> Vec<Row> {
        match *self {
            Self::Plane { at_mm, normal, along, size_mm }
            | Self::Programmed { at_mm, normal, along, size_mm, .. } => {
                let across = normal.cross(&along);
                let counts = size_mm.map(|size| steps(size, spacing_mm));
                let offset =
                    move |i: usize, k: usize| size_mm[i] * middle(k, counts[i]) - 0.5 * size_mm[i];
                let row = |j: usize| {
                    let from = at_mm + across * offset(1, j);
                    Row::new(counts[0], move |i| point(from + along * offset(0, i), normal))
                };
                (0..counts[1]).map(row).collect()
            }
            Self::Cylinder { at_mm, axis, radius_mm, length_mm, is_hole } => {
                round(at_mm, axis, [radius_mm; 2], length_mm, (is_hole, spacing_mm))
            }
            Self::Cone { at_mm, axis, radii_mm, length_mm, is_hole } => {
                round(at_mm, axis, radii_mm, length_mm, (is_hole, spacing_mm))
            }
            Self::Sphere { at_mm, axis, radius_mm, opening_rad, is_hole } => {
                let [x, y] = across(&axis);
                let sign = if is_hole { -1.0 } else { 1.0 };
                let count = steps(radius_mm * opening_rad, spacing_mm);
                let row = |j: usize| {
                    let (sin, cos) = (opening_rad * middle(j, count)).sin_cos();
                    let around = turns(radius_mm * sin, spacing_mm);
                    Row::new(around, move |k| {
                        let (s, c) = turn(k, around).sin_cos();
                        let out = axis * cos + (x * c + y * s) * sin;
                        point(at_mm + out * radius_mm, out * sign)
                    })
                };
                (0..count).map(row).collect()
            }
            Self::Points => Vec::new(),
        }
    }
}

/// Points of a row, made one by one so that too many are never made.
struct Row {
    count: usize,
    at: Box<dyn Fn(usize) -> SurfacePoint>,
}

impl Row {
    fn new(count: usize, at: impl Fn(usize) -> SurfacePoint + 'static) -> Self {
        Self { count, at: Box::new(at) }
    }
}

/// Sections of a cylinder or cone.
fn round(
    at_mm: Vec3,
    axis: Vec3,
    radii_mm: [f64; 2],
    length_mm: f64,
    (is_hole, spacing_mm): (bool, f64),
) -> Vec<Row> {
    let [x, y] = across(&axis);
    let sign = if is_hole { -1.0 } else { 1.0 };
    let rise = radii_mm[1] - radii_mm[0];
    let slant = length_mm.hypot(rise);
    let count = steps(slant, spacing_mm).max(2);
    let around = turns(radii_mm[0].max(radii_mm[1]), spacing_mm);
    let row = |j: usize| {
        let along = middle(j, count);
        let radius = radii_mm[0] + rise * along;
        let from = at_mm + axis * (length_mm * along);
        Row::new(around, move |k| {
            let (s, c) = turn(k, around).sin_cos();
            let out = x * c + y * s;
            let normal = (out * length_mm - axis * rise) / slant;
            point(from + out * radius, normal * sign)
        })
    };
    (0..count).map(row).collect()
}

fn point(point_mm: Vec3, normal: Vec3) -> SurfacePoint {
    SurfacePoint { point_mm, normal, axis: normal, line: 0 }
}

/// Two directions across an axis, at right angles to each other.
pub(super) fn across(axis: &Vec3) -> [Vec3; 2] {
    let any = if axis.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
    let x = (any - axis * axis.dot(&any)).normalize();
    [x, axis.cross(&x)]
}

/// As many steps of at most the spacing as a length has.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the quotient is positive, and larger ones are limited"
)]
fn steps(length_mm: f64, spacing_mm: f64) -> usize {
    ((length_mm / spacing_mm).ceil() as usize).clamp(1, MOST_POINTS)
}

/// Points around a circle: no fewer than show its form.
fn turns(radius_mm: f64, spacing_mm: f64) -> usize {
    steps(std::f64::consts::TAU * radius_mm, spacing_mm).max(24)
}

fn middle(step: usize, count: usize) -> f64 {
    (step as f64 + 0.5) / count as f64
}

fn turn(step: usize, count: usize) -> f64 {
    std::f64::consts::TAU * step as f64 / count as f64
}
