//! Datum systems, ISO 5459: the nominal part laid on the datum features as they were cut, first, second, third.
//!
//! ```text
//! nominal frame ──first datum: its minimum zone, its largest inscribed cylinder …──> three to five degrees held
//!               ──second, with what the first leaves free──> ──third──> Motion: from the nominal frame to that of the datums
//! ```
//!
//! Docs/model.md eq. 248, 249 and 324.

mod several;

use super::feature::across;
use super::values::{Surface, unfit};
use super::{Datum, Feature, Geometry};
use crate::Error;
use trueaxis_form::circle::Fitter;
use trueaxis_form::placed::{Freedom, Motion, Twist, place};
use trueaxis_form::{Criterion, Element, Shape};
use trueaxis_geometry::frame::{Point, Pose, rotation};
use trueaxis_geometry::{Mat3, Vec3};

/// The frame of a datum system, and the motions that it leaves free.
#[derive(Debug, Clone)]
pub(super) struct DatumFrame {
    /// From the nominal frame.
    pub motion: Motion,
    pub free: Freedom,
}

/// What a part may do before its datums hold it.
pub(super) fn all_degrees(features: &[Feature]) -> Freedom {
    let points = || features.iter().flat_map(|f| &f.points).map(|p| p.point_mm);
    let low = points().fold(Vec3::repeat(f64::MAX), |a, b| a.inf(&b));
    let high = points().fold(Vec3::repeat(f64::MIN), |a, b| a.sup(&b));
    Freedom::all(0.5 * (low + high), (high - low).norm().max(1e-3))
}

/// Places and normals that hold a feature, or are held for it.
pub(super) fn held(feature: &Feature) -> Vec<[Vec3; 2]> {
    feature.points.iter().map(|p| [p.point_mm, p.normal]).collect()
}

/// In words what a motion does, the larger part of it.
pub(super) fn described(twist: &Twist) -> String {
    let (name, along) = match twist.turn.norm() > 1e-6 {
        true => ("a turn about", twist.turn.normalize()),
        false => ("a shift along", twist.way.normalize()),
    };
    let clean = |c: f64| if c.abs() < 5e-4 { 0.0 } else { c };
    format!("{name} ({:.3}, {:.3}, {:.3})", clean(along.x), clean(along.y), clean(along.z))
}

impl DatumFrame {
    /// The zero that was set; nothing is free.
    pub fn of_zero() -> Self {
        let free = Freedom::all(Vec3::zeros(), 1.0).none();
        Self { motion: Motion::identity(), free }
    }

    /// On the datum features as they were cut, in their order.
    pub fn on(surfaces: &[Surface<'_>], datums: &[Datum], free: Freedom) -> Result<Self, Error> {
        let mut frame = Self { motion: Motion::identity(), free };
        for (rank, datum) in datums.iter().enumerate() {
            let members: Vec<&Surface<'_>> = datum.features.iter().map(|f| &surfaces[*f]).collect();
            let step = match members[..] {
                [surface] if rank == 0 && surface.feature.geometry.median().is_none() => {
                    surface.first()?
                }
                [surface] => frame.next(surface)?,
                _ => frame.common(&members)?,
            };
            frame.motion = frame.motion * step;
            let all: Vec<[Vec3; 2]> = members.iter().flat_map(|s| held(s.feature)).collect();
            frame.free = frame.free.held_by(&all);
        }
        Ok(frame)
    }

    /// Places as the datums see them.
    pub fn seen(&self, places_mm: &[Vec3]) -> Vec<Vec3> {
        let back = self.motion.inverse();
        places_mm.iter().map(|p| (back * Point::from_vector(*p)).vector()).collect()
    }

    /// How a datum of lower rank moves the frame.
    fn next(&self, surface: &Surface<'_>) -> Result<Motion, Error> {
        let places = self.seen(&surface.places_mm);
        let geometry = surface.feature.geometry;
        let free = self.free.moving(&held(surface.feature));
        let outside = geometry.distances();
        match geometry {
            Geometry::Plane { normal, .. } if self.free.has_shift(&normal) => {
                let zone = place(&places, &free, &outside, Criterion::MinimumZone)?;
                // Outside of the material, touching it.
                Ok(zone.motion * Pose::shift(normal * zone.high_mm))
            }
            Geometry::Plane { .. } => {
                // Without a shift along its normal: the least largest distance on either side.
                let both: Vec<Vec3> = places.iter().chain(&places).copied().collect();
                let count = places.len();
                let either = |i: usize, p: &Vec3| {
                    let (value, gradient) = outside(i, p);
                    if i < count { (value, gradient) } else { (-value, -gradient) }
                };
                Ok(place(&both, &free, &either, Criterion::MinimumCircumscribed)?.motion)
            }
            Geometry::Cylinder { at_mm, axis, is_hole, .. } => {
                let shifts = across(&axis);
                let turns = self.free.twists().iter().any(|t| t.turn.cross(&axis).norm() > 1e-9);
                if turns || !shifts.iter().all(|s| self.free.has_shift(s)) {
                    return Ok(
                        place(&places, &free, &outside, Criterion::MinimumCircumscribed)?.motion
                    );
                }
                // Its direction is held: a circle in the plane across it.
                let flat: Vec<[f64; 2]> =
                    places.iter().map(|p| shifts.map(|s| s.dot(&(p - at_mm)))).collect();
                let mut fitter = Fitter::default();
                let circle = match is_hole {
                    true => fitter.maximum_inscribed(&flat)?,
                    false => fitter.minimum_circumscribed(&flat)?,
                };
                let [u, v] = circle.center_mm;
                Ok(Pose::shift(shifts[0] * u + shifts[1] * v))
            }
            // The widest that fits into a slot, the narrowest that fits about a tongue.
            Geometry::Sphere { .. } | Geometry::Slot { .. } => {
                Ok(place(&places, &free, &outside, Criterion::MinimumCircumscribed)?.motion)
            }
            _ => Err(no_datum()),
        }
    }
}

/// The element of a datum alone; of a common datum that of its first feature, as the others let it lie.
pub(super) fn associated(
    surfaces: &[Surface<'_>],
    datum: &Datum,
    features: &[Feature],
) -> Result<Shape, Error> {
    if let Some(one) = datum.single() {
        return surfaces[one].datum();
    }
    let free = all_degrees(features);
    let motion = DatumFrame::on(surfaces, std::slice::from_ref(datum), free)?.motion;
    let geometry = surfaces[datum.features[0]].feature.geometry;
    let (element, at, direction) = match geometry.median().unwrap_or(geometry) {
        Geometry::Plane { at_mm, normal, .. } => (Element::Plane, at_mm, normal),
        Geometry::Cylinder { at_mm, axis, .. } => (Element::Line, at_mm, axis),
        _ => return Err(no_datum()),
    };
    let point_mm = (motion * Point::from_vector(at)).vector();
    let direction = motion.linear() * direction;
    Ok(Shape { element, point_mm, direction, radius_mm: 0.0, half_angle_rad: 0.0 })
}

fn no_datum() -> Error {
    unfit("a datum that is neither a plane, a slot, a cylinder nor a sphere")
}

impl Surface<'_> {
    /// The associated element, ISO 5459: the plane of the minimum zone, the axis of the largest inscribed cylinder of a hole,
    /// of the smallest circumscribed one of a shaft.
    pub(super) fn datum(&self) -> Result<Shape, Error> {
        if let Some(found) = self.datum.get() {
            return Ok(*found);
        }
        if let Some(Geometry::Plane { at_mm, normal, .. }) = self.feature.geometry.median() {
            let free = all_degrees(std::slice::from_ref(self.feature));
            let motion = DatumFrame { motion: Motion::identity(), free }.next(self)?;
            let point_mm = (motion * Point::from_vector(at_mm)).vector();
            let direction = motion.linear() * normal;
            let found = Shape {
                element: Element::Plane,
                point_mm,
                direction,
                radius_mm: 0.0,
                half_angle_rad: 0.0,
            };
            return Ok(*self.datum.get_or_init(|| found));
        }
        if matches!(self.feature.geometry, Geometry::Plane { .. }) {
            let found = self.minimum_zone()?.shape;
            return Ok(*self.datum.get_or_init(|| found));
        }
        let (kind, criterion) = match self.feature.geometry {
            Geometry::Cylinder { is_hole: true, .. } => {
                (Element::Cylinder, Criterion::MaximumInscribed)
            }
            Geometry::Cylinder { .. } => (Element::Cylinder, Criterion::MinimumCircumscribed),
            Geometry::Sphere { is_hole: true, .. } => {
                (Element::Sphere, Criterion::MaximumInscribed)
            }
            Geometry::Sphere { .. } => (Element::Sphere, Criterion::MinimumCircumscribed),
            _ => return Err(no_datum()),
        };
        let found = self.element(kind, criterion)?.shape;
        Ok(*self.datum.get_or_init(|| found))
    }

    /// How the first datum moves the frame: by the smallest turn and by a shift.
    fn first(&self) -> Result<Motion, Error> {
        let found = self.datum()?;
        let onto = |nominal: &Vec3| {
            let sign = if found.direction.dot(nominal) < 0.0 { -1.0 } else { 1.0 };
            let cross = nominal.cross(&(found.direction * sign));
            let (sin, cos) = (cross.norm(), found.direction.dot(nominal) * sign);
            match sin > 0.0 {
                true => rotation(cross / sin, sin.atan2(cos)),
                false => Mat3::identity(),
            }
        };
        // Turned about the place of the nominal feature, then shifted.
        let about = |turn: Mat3, at: &Vec3, shift: Vec3| Pose::new(turn, at + shift - turn * at);
        Ok(match self.feature.geometry {
            Geometry::Plane { at_mm, normal, .. } => {
                let turn = onto(&normal);
                let normal = turn * normal;
                let outermost = self
                    .places_mm
                    .iter()
                    .map(|p| normal.dot(&(p - at_mm)))
                    .fold(f64::MIN, f64::max);
                about(turn, &at_mm, normal * outermost)
            }
            Geometry::Cylinder { at_mm, axis, length_mm, .. } => {
                let turn = onto(&axis);
                let middle = at_mm + axis * (0.5 * length_mm);
                let axis = turn * axis;
                let arm = found.point_mm - middle;
                about(turn, &middle, arm - axis * arm.dot(&axis))
            }
            Geometry::Sphere { at_mm, .. } => Pose::shift(found.point_mm - at_mm),
            _ => return Err(no_datum()),
        })
    }
}
