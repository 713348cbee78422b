//! Common datums, A-B of ISO 5459: several features that are one datum together, at their nominal places to each other.
//!
//! Docs/model.md eq. 324.

use super::{DatumFrame, Motion, Surface, held};
use crate::Error;
use crate::part::Geometry;
use trueaxis_form::Criterion;
use trueaxis_form::placed::place;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::Pose;

impl DatumFrame {
    /// How a common datum moves the frame.
    pub(super) fn common(&self, members: &[&Surface<'_>]) -> Result<Motion, Error> {
        let mut places_mm = Vec::new();
        let mut owners = Vec::new();
        let mut own_mm = Vec::new();
        for surface in members {
            places_mm.extend(self.seen(&surface.places_mm));
            owners.resize(places_mm.len(), own_mm.len());
            own_mm.push(surface.own_mm()?);
        }
        let surfaces: Vec<[Vec3; 2]> = members.iter().flat_map(|s| held(s.feature)).collect();
        let free = self.free.moving(&surfaces);
        let outside = |i: usize, point: &Vec3| {
            let owner = owners[i];
            let found = members[owner].feature.geometry.outside(point);
            let (distance, gradient) = found.unwrap_or((f64::NAN, Vec3::zeros()));
            (distance - own_mm[owner], gradient)
        };
        let Some(normal) = facing(members) else {
            return Ok(place(&places_mm, &free, &outside, Criterion::MinimumCircumscribed)?.motion);
        };
        if self.free.has_shift(&normal) {
            // Planes that face one way are one plane: its minimum zone, outside of the material.
            let zone = place(&places_mm, &free, &outside, Criterion::MinimumZone)?;
            return Ok(zone.motion * Pose::shift(normal * zone.high_mm));
        }
        let count = places_mm.len();
        let both: Vec<Vec3> = places_mm.iter().chain(&places_mm).copied().collect();
        let either = |i: usize, point: &Vec3| {
            let (value, gradient) = outside(i % count, point);
            if i < count { (value, gradient) } else { (-value, -gradient) }
        };
        Ok(place(&both, &free, &either, Criterion::MinimumCircumscribed)?.motion)
    }
}

/// The normal of planes that all face one way.
fn facing(members: &[&Surface<'_>]) -> Option<Vec3> {
    let normal = |s: &&Surface<'_>| match s.feature.geometry {
        Geometry::Plane { normal, .. } => Some(normal),
        _ => None,
    };
    let first = members.first().and_then(normal)?;
    let is_same = |s: &&Surface<'_>| normal(s).is_some_and(|n| (n - first).norm() < 1e-6);
    members.iter().all(is_same).then_some(first)
}

impl Surface<'_> {
    /// How far its own element alone lies outside of the nominal surface: what its size has to do with, which is free.
    fn own_mm(&self) -> Result<f64, Error> {
        Ok(match self.feature.geometry {
            Geometry::Cylinder { radius_mm, is_hole, .. }
            | Geometry::Sphere { radius_mm, is_hole, .. } => {
                let larger_mm = self.datum()?.radius_mm - radius_mm;
                if is_hole { -larger_mm } else { larger_mm }
            }
            Geometry::Slot { .. } => {
                let free = super::all_degrees(std::slice::from_ref(self.feature));
                let geometry = self.feature.geometry;
                let free = free.moving(&held(self.feature));
                let criterion = Criterion::MinimumCircumscribed;
                place(&self.places_mm, &free, &geometry.distances(), criterion)?.high_mm
            }
            _ => 0.0,
        })
    }
}
