//! The place of a pattern as a whole, ISO 5458; of the middle of a slot alone.

use super::Geometry;
use super::datum::{DatumFrame, held};
use super::values::{Surface, unfit};
use crate::Error;
use trueaxis_form::Criterion;
use trueaxis_form::placed::place;
use trueaxis_geometry::Vec3;

/// Twice the largest distance of an axis or a plane of a pattern from its nominal place, where what the datums leave free moves all zones
/// together to where that is least.
pub(super) fn position(
    members: &[&Surface<'_>],
    projected_mm: Option<f64>,
    frame: &DatumFrame,
) -> Result<f64, Error> {
    let mut places_mm = Vec::new();
    let mut zones = Vec::new();
    for surface in members {
        let (zone, found) = surface.zone(projected_mm)?;
        // Planes have two sides.
        let sides: &[f64] = if matches!(zone, Zone::Plane { .. }) { &[1.0, -1.0] } else { &[1.0] };
        for side in sides {
            places_mm.extend_from_slice(&found);
            zones.resize(places_mm.len(), (zone, *side));
        }
    }
    let surfaces: Vec<[Vec3; 2]> = members.iter().flat_map(|s| held(s.feature)).collect();
    let free = frame.free.moving(&surfaces);
    let distance = |i: usize, point: &Vec3| {
        let (zone, side) = zones[i];
        let (value, gradient) = zone.off(point);
        (side * value, gradient * side)
    };
    let seen = frame.seen(&places_mm);
    let placed = place(&seen, &free, &distance, Criterion::MinimumCircumscribed)?;
    Ok(2.0 * placed.high_mm)
}

/// What a member is to lie on.
#[derive(Debug, Clone, Copy)]
enum Zone {
    Axis { at_mm: Vec3, axis: Vec3 },
    Plane { at_mm: Vec3, normal: Vec3 },
}

impl Zone {
    /// The distance of a point, of a plane with its sign, and where it grows.
    fn off(&self, point: &Vec3) -> (f64, Vec3) {
        match self {
            Self::Axis { at_mm, axis } => {
                let arm = point - at_mm;
                let out = arm - axis * arm.dot(axis);
                (out.norm(), out.try_normalize(0.0).unwrap_or(Vec3::zeros()))
            }
            Self::Plane { at_mm, normal } => (normal.dot(&(point - at_mm)), *normal),
        }
    }
}

impl Surface<'_> {
    fn zone(&self, projected_mm: Option<f64>) -> Result<(Zone, Vec<Vec3>), Error> {
        if let Some((at_mm, axis)) = self.feature.geometry.axis() {
            return Ok((Zone::Axis { at_mm, axis }, self.axis_line(projected_mm)?));
        }
        match self.flat() {
            (Geometry::Plane { at_mm, normal, .. }, places) => {
                Ok((Zone::Plane { at_mm, normal }, places.into_owned()))
            }
            _ => Err(unfit("the position of what has no direction")),
        }
    }
}
