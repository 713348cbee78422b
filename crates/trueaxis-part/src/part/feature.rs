//! Features: nominal surfaces and the points on them that are checked.

mod moved;
mod sampled;

pub use sampled::{Extraction, Sampled};

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
    /// A part of a ring of round section: a rounding, a ball groove.
    Torus {
        /// The centre.
        at_mm: Vec3,
        /// Its axis, a unit vector.
        axis: Vec3,
        /// From the axis to the middle of the section.
        ring_mm: f64,
        /// Radius of the section.
        radius_mm: f64,
        /// Where the section begins and ends: 0 away from the axis, 90° along it.
        section_rad: [f64; 2],
        /// Material is outside of the section.
        is_hole: bool,
    },
    /// Two parallel planes that face each other, of a slot, or away from each other, of a tongue.
    Slot {
        /// Its middle.
        at_mm: Vec3,
        /// From one face to the other, a unit vector.
        across: Vec3,
        /// Along its first edge, a unit vector.
        along: Vec3,
        /// Lengths of the edges of its faces.
        size_mm: [f64; 2],
        /// From face to face.
        width_mm: f64,
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
    /// The name of the pattern that it belongs to.
    pub pattern: Option<String>,
    /// Its nominal shape.
    pub geometry: Geometry,
    /// It is the outside of a thread in the material: only its axis is judged.
    pub is_thread: bool,
    /// Points on it with the normals out of the material.
    pub points: Vec<SurfacePoint>,
    /// Which points remain with every second row, with the other rows, with every second point of each row, and with the others; of a
    /// table with every second point and with the others.
    pub is_kept: Vec<[bool; 4]>,
    /// Which points make a row, of what has an axis a section across it; none of a table, nor of a helix.
    pub sections: Vec<Range<usize>>,
    /// How far into the material it is looked; on a thin wall less than half of it.
    pub below_mm: f64,
    /// How far out of it.
    pub above_mm: f64,
}

impl Feature {
    /// With half of its rows (0, 1), or with half of the points of each (2, 3).
    pub(super) fn thinned(&self, way: usize) -> Self {
        let is_there: Vec<bool> = self.is_kept.iter().map(|kept| kept[way]).collect();
        let points = self.points.iter().zip(&is_there).filter(|(_, is)| **is).map(|(p, _)| *p);
        let points: Vec<SurfacePoint> = points.collect();
        Self {
            sections: sampled::kept_rows(&self.sections, &is_there),
            is_kept: vec![[true; 4]; points.len()],
            points,
            ..self.clone()
        }
    }

    /// Its shape in words.
    pub fn shape_name(&self) -> &'static str {
        if self.is_thread { "thread" } else { self.geometry.name() }
    }

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
            Self::Torus { .. } => "torus",
            Self::Slot { is_hole: true, .. } => "slot",
            Self::Slot { .. } => "tongue",
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
            Self::Slot { across, .. } => Some(across),
            _ => self.axis().map(|(_, axis)| axis),
        }
    }

    /// The normal of the planes in which its rows lie, each with the normals of its points.
    pub(crate) fn across_rows(&self) -> Option<Vec3> {
        match *self {
            Self::Plane { normal, along, .. } | Self::Programmed { normal, along, .. } => {
                Some(normal.cross(&along))
            }
            Self::Slot { across, along, .. } => Some(across.cross(&along)),
            _ => self.axis().map(|(_, axis)| axis),
        }
    }

    /// The plane in the middle between the faces of a slot or a tongue.
    pub(super) fn median(&self) -> Option<Self> {
        match *self {
            Self::Slot { at_mm, across, along, size_mm, .. } => {
                Some(Self::Plane { at_mm, normal: across, along, size_mm })
            }
            _ => None,
        }
    }

    /// Whether it is a plane, or has one in its middle.
    pub(super) fn is_flat(&self) -> bool {
        matches!(self, Self::Plane { .. } | Self::Slot { .. })
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
            Self::Torus { at_mm, axis, ring_mm, radius_mm, is_hole, .. } => {
                let arm = point_mm - at_mm;
                let height = arm.dot(&axis);
                let out = arm - axis * height;
                // From the middle of the section to the point.
                let from = arm - unit(out) * ring_mm;
                let sign = sign(is_hole);
                Some((sign * (from.norm() - radius_mm), unit(from) * sign))
            }
            Self::Slot { at_mm, across, width_mm, is_hole, .. } => {
                let off = across.dot(&(point_mm - at_mm));
                let sign = sign(is_hole);
                Some((sign * (off.abs() - 0.5 * width_mm), across * (sign * off.signum())))
            }
            Self::Points | Self::Programmed { .. } => None,
        }
    }

    /// The same for each place of a list; not a number where there is none.
    pub(super) fn distances(&self) -> impl Fn(usize, &Vec3) -> (f64, Vec3) + '_ {
        |_, place| self.outside(place).unwrap_or((f64::NAN, Vec3::zeros()))
    }
}

/// Two directions across an axis, at right angles to each other.
pub(crate) fn across(axis: &Vec3) -> [Vec3; 2] {
    let any = if axis.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
    let x = (any - axis * axis.dot(&any)).normalize();
    [x, axis.cross(&x)]
}
