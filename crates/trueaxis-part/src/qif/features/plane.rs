//! A plane, its rectangle and its openings.

use super::super::document::{Reader, Reason, child, direction};
use super::super::text::millimetres;
use super::super::topology::{Curve, Face, Loop, Rectangle, around, forward, rectangle};
use super::super::units::{In, Units};
use super::{Form, Opening, Read, faces};
use roxmltree::Node;
use trueaxis_geometry::Vec3;

/// A face whose vertices lie farther from the plane of its feature is another one. Unit: mm.
const OFF_PLANE_MM: f64 = 0.01;

/// So many of the longest sides of a border are tried.
const MOST_SIDES: usize = 50;

/// `PlaneFeatureNominal`: a point, a normal, and the border of its face.
pub(in super::super) fn read<'d>(
    reader: &Reader<'d, '_>,
    units: &Units,
    node: Node<'d, '_>,
    _: Node<'d, '_>,
) -> Result<Read, Reason> {
    let at_mm = units.point_of(node, "Location")?;
    let normal = direction(node, "Normal")?;
    let (mut faces, mut notes) = faces(reader, units, node);
    let is_on = |p: Vec3| (p - at_mm).dot(&normal).abs() < OFF_PLANE_MM;
    if faces.iter().any(|f| !f.corners().all(is_on)) {
        notes.push("its face lies outside of its plane and is not used".to_owned());
        faces.clear();
    }
    let mut plane = Plane { at_mm, normal, along: None, size_mm: None, openings: Vec::new() };
    match &faces[..] {
        [] => plane.without_face(units, node, &mut notes)?,
        [face] => plane.of_face(face, &mut notes),
        _ => plane.of_many(&faces, &mut notes),
    }
    let against = |f: &Face| f.normal.is_some_and(|n| n.dot(&normal) < 0.0);
    let is_against = faces.iter().any(against);
    if is_against {
        notes.push(format!(
            "normal: the feature has {}, its face the opposite; write the one out of the material",
            super::super::text::unit_vector(&normal)
        ));
    }
    let normal = (!is_against).then_some(normal);
    let Plane { at_mm, along, size_mm, openings, .. } = plane;
    Ok((Form::Plane { at_mm, normal, along, size_mm, openings }, notes))
}

struct Plane {
    at_mm: Vec3,
    normal: Vec3,
    along: Option<Vec3>,
    size_mm: Option<[f64; 2]>,
    openings: Vec<Opening>,
}

impl Plane {
    fn is(&mut self, found: Rectangle) {
        (self.at_mm, self.along, self.size_mm) =
            (found.at_mm, Some(found.along), Some(found.size_mm));
    }

    /// What is known of a border that is no rectangle: the middle of what is around it.
    fn is_around(
        &mut self,
        corners: &[Vec3],
        along: Option<Vec3>,
        what: &str,
        notes: &mut Vec<String>,
    ) {
        let along = along.unwrap_or_else(|| any_along(&self.normal));
        let Some(found) = around(corners, &self.normal, &along) else { return };
        (self.at_mm, self.along) = (found.at_mm, Some(forward(found.along)));
        let [first, second] = found.size_mm.map(millimetres);
        notes.push(format!(
            "size: {what}; its corners fill {first} {second} mm, write the rectangle of it to check"
        ));
    }

    fn of_face(&mut self, face: &Face, notes: &mut Vec<String>) {
        let Some(outer) = &face.outer else {
            notes.push(format!("size: face {} has no border in the file", face.id));
            return;
        };
        match outer.rectangle() {
            Some(found) => self.is(found),
            None => {
                let corners: Vec<Vec3> = outer.edges.iter().map(|e| e.from_mm).collect();
                let along = self.best_side(outer, &corners).or(face.along);
                let what = format!("face {} is no rectangle", face.id);
                self.is_around(&corners, along, &what, notes);
            }
        }
        for inner in &face.inner {
            let opening = match (inner.circle(), inner.rectangle(), self.along) {
                (Some((at_mm, diameter_mm)), ..) => Opening::Round { at_mm, diameter_mm },
                (None, Some(found), Some(along)) if is_along(&found, &along) => {
                    let size_mm = match found.along.dot(&along).abs() > 0.5 {
                        true => found.size_mm,
                        false => [found.size_mm[1], found.size_mm[0]],
                    };
                    Opening::Rectangle { at_mm: found.at_mm, size_mm }
                }
                _ => self.unknown_opening(inner),
            };
            self.openings.push(opening);
        }
    }

    /// The straight side along which the rectangle around a border is smallest.
    fn best_side(&self, outer: &Loop, corners: &[Vec3]) -> Option<Vec3> {
        let straight = outer.edges.iter().filter(|e| e.curve == Curve::Straight);
        let mut sides: Vec<Vec3> = straight.map(|e| e.to_mm - e.from_mm).collect();
        sides.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        let area = |side: &Vec3| {
            let found = around(corners, &self.normal, side);
            found.map_or(f64::MAX, |r| r.size_mm[0] * r.size_mm[1])
        };
        // The first of equal ones, which is the longest.
        let all = sides.into_iter().take(MOST_SIDES).map(|side| (area(&side), side));
        let smaller = |best: (f64, Vec3), next: (f64, Vec3)| {
            if next.0 < best.0 * (1.0 - 1e-9) { next } else { best }
        };
        all.reduce(smaller).map(|(_, side)| side)
    }

    /// An opening that is neither round nor a rectangle along the edges of the plane.
    fn unknown_opening(&self, inner: &Loop) -> Opening {
        let corners: Vec<Vec3> = inner.edges.iter().map(|e| e.from_mm).collect();
        let along = self.along.unwrap_or_else(|| any_along(&self.normal));
        let found = around(&corners, &self.normal, &along);
        let Some(Rectangle { at_mm, size_mm, .. }) = found else {
            let note = format!("loop {} has no corners", inner.id);
            return Opening::Unknown { at_mm: self.at_mm, note };
        };
        let [first, second] = size_mm.map(millimetres);
        let note = format!(
            "size, or diameter: loop {} is no rectangle; its corners fill {first} {second} mm",
            inner.id
        );
        Opening::Unknown { at_mm, note }
    }

    fn of_many(&mut self, faces: &[Face], notes: &mut Vec<String>) {
        let corners: Vec<Vec3> = faces.iter().flat_map(Face::corners).collect();
        let what = format!("it has {} faces", faces.len());
        self.is_around(&corners, faces.iter().find_map(|f| f.along), &what, notes);
    }

    /// The border that the feature itself states.
    fn without_face(
        &mut self,
        units: &Units,
        node: Node<'_, '_>,
        notes: &mut Vec<String>,
    ) -> Result<(), Reason> {
        if let Some(stated) = child(node, "Rectangle") {
            if let Some(found) = stated_rectangle(units, stated)? {
                self.is(found);
                return Ok(());
            }
            notes.push("size: its Rectangle has no right angle or no size".to_owned());
            return Ok(());
        }
        if let Some(stated) = child(node, "PolyLine") {
            let mut corners = units.points(stated)?;
            if corners.len() > 1 && (corners[0] - corners[corners.len() - 1]).norm() < 1e-3 {
                corners.pop();
            }
            match rectangle(&corners) {
                Some(found) => self.is(found),
                None => self.is_around(&corners, None, "its border is no rectangle", notes),
            }
            return Ok(());
        }
        let what = match child(node, "Circle") {
            Some(_) => "size: the plane is round; write the rectangle of it to check",
            None => {
                "size: the file does not state it; `at` is a point of the plane, move it to the middle"
            }
        };
        notes.push(what.to_owned());
        Ok(())
    }
}

/// A direction in a plane, that of X where it can be.
pub(super) fn any_along(normal: &Vec3) -> Vec3 {
    let x = Vec3::x() - normal * normal.x;
    if x.norm() > 0.5 { x } else { Vec3::y() - normal * normal.y }
}

pub(super) fn is_along(found: &Rectangle, along: &Vec3) -> bool {
    let cosine = found.along.dot(along).abs();
    let is_across = cosine < 1e-5;
    is_across || cosine > 1.0 - 1e-10
}

/// `Rectangle`: a corner, two directions and their lengths.
fn stated_rectangle(units: &Units, node: Node<'_, '_>) -> Result<Option<Rectangle>, Reason> {
    let corner = units.point_of(node, "CornerPoint")?;
    let directions = [direction(node, "LengthDirection")?, direction(node, "WidthDirection")?];
    let length = units.positive_of(node, "Length", In::Model)?;
    let width = units.positive_of(node, "Width", In::Model)?;
    let (Some(length), Some(width)) = (length, width) else { return Ok(None) };
    let [first, second] = [directions[0] * length, directions[1] * width];
    Ok(rectangle(&[corner, corner + first, corner + first + second, corner + second]))
}
