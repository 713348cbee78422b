//! The same feature at another place.

use super::{Feature, Geometry};
use trueaxis_form::placed::Motion;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::Point;
use trueaxis_geometry::surface::SurfacePoint;

impl Feature {
    /// Moved rigidly, with its points.
    pub(in crate::part) fn moved(&self, motion: &Motion) -> Self {
        let point = |p: &SurfacePoint| SurfacePoint {
            point_mm: place(motion, p.point_mm),
            normal: motion.linear() * p.normal,
            axis: motion.linear() * p.axis,
            line: p.line,
        };
        Self {
            geometry: self.geometry.moved(motion),
            points: self.points.iter().map(point).collect(),
            ..self.clone()
        }
    }
}

fn place(motion: &Motion, at: Vec3) -> Vec3 {
    (*motion * Point::from_vector(at)).vector()
}

impl Geometry {
    fn moved(&self, motion: &Motion) -> Self {
        let mut moved = *self;
        match &mut moved {
            Self::Plane { at_mm, normal, along, .. }
            | Self::Programmed { at_mm, normal, along, .. }
            | Self::Slot { at_mm, across: normal, along, .. } => {
                *at_mm = place(motion, *at_mm);
                *normal = motion.linear() * *normal;
                *along = motion.linear() * *along;
            }
            Self::Cylinder { at_mm, axis, .. }
            | Self::Cone { at_mm, axis, .. }
            | Self::Sphere { at_mm, axis, .. }
            | Self::Torus { at_mm, axis, .. } => {
                *at_mm = place(motion, *at_mm);
                *axis = motion.linear() * *axis;
            }
            Self::Points => {}
        }
        moved
    }
}
