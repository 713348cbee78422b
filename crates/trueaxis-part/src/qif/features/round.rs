//! Cylinders, cones and spheres.

use super::super::document::{Reader, Reason, child, direction};
use super::super::text::millimetres;
use super::super::topology::{Face, SAME_MM};
use super::super::units::{In, Units};
use super::{Form, Read, faces, is_hole};
use roxmltree::Node;
use std::f64::consts::{FRAC_PI_2, TAU};
use trueaxis_geometry::Vec3;

/// A vertex farther than this from a surface of revolution belongs to another one. Unit: mm.
const OFF_SURFACE_MM: f64 = 0.01;
/// A turn that lacks less than this is a whole one. Unit: rad.
const WHOLE_RAD: f64 = 1e-3;

/// `CylinderFeatureNominal`: an axis that begins at a point, and the diameter of its definition.
pub(in super::super) fn cylinder<'d>(
    reader: &Reader<'d, '_>,
    units: &Units,
    node: Node<'d, '_>,
    definition: Node<'d, '_>,
) -> Result<Read, Reason> {
    whole_turn(units, node)?;
    let is_hole = is_hole(definition)?;
    let (at_mm, axis) = axis_of(units, node)?;
    let diameter_mm = units.positive_of(definition, "Diameter", In::Model)?;
    let stated_mm = units.positive_of(definition, "Length", In::Model)?;
    let (faces, mut notes) = faces(reader, units, node);
    let radius = |_: f64| diameter_mm.map(|d| 0.5 * d);
    let heights = heights(&faces, &at_mm, &axis, &radius);
    let mut from_mm = 0.0;
    let length_mm = match (&heights[..], stated_mm) {
        ([low, high], stated) => {
            from_mm = *low;
            let length_mm = high - low;
            if let Some(stated) = stated.filter(|s| (s - length_mm).abs() > SAME_MM) {
                let stated = millimetres(stated);
                notes.push(format!("length by its faces; the feature states {stated} mm"));
            }
            Some(length_mm)
        }
        (_, Some(stated)) => {
            if heights.len() > 2 {
                let ends = listed(&heights);
                notes.push(format!(
                    "its faces end at {ends} mm along the axis: is all of it there?"
                ));
            }
            Some(stated)
        }
        (_, None) => {
            notes.push(unknown_length(&heights));
            None
        }
    };
    if diameter_mm.is_none() {
        notes.push("diameter: the file does not state it".to_owned());
    }
    let at_mm = at_mm + axis * from_mm;
    Ok((Form::Cylinder { is_hole, at_mm, axis, diameter_mm, length_mm }, notes))
}

/// `ConeFeatureNominal`: the diameter at the point of its axis, which points to where it is wider.
pub(in super::super) fn cone<'d>(
    reader: &Reader<'d, '_>,
    units: &Units,
    node: Node<'d, '_>,
    definition: Node<'d, '_>,
) -> Result<Read, Reason> {
    whole_turn(units, node)?;
    let is_hole = is_hole(definition)?;
    let (at_mm, axis) = axis_of(units, node)?;
    let missing = |key: &str| {
        Reason::fault("missing-value", definition, format!("its definition has no {key}"))
    };
    let diameter_mm =
        units.length_of(definition, "Diameter", In::Model)?.ok_or_else(|| missing("Diameter"))?;
    let half = units.angles_of::<1>(definition, "HalfAngle")?.map(|[a]| a);
    let full = units.angles_of::<1>(definition, "FullAngle")?.map(|[a]| 0.5 * a);
    let half_rad = half.or(full).ok_or_else(|| missing("HalfAngle"))?;
    if !(half_rad > 0.0 && half_rad < FRAC_PI_2) || diameter_mm < -SAME_MM {
        let message = format!(
            "a cone of {} mm and {:.3}° from its axis is not possible",
            millimetres(diameter_mm),
            half_rad.to_degrees()
        );
        return Err(Reason::fault("not-positive", definition, message));
    }
    let slope = 2.0 * half_rad.tan();
    let diameter_at = |height: f64| diameter_mm + slope * height;
    let (faces, mut notes) = faces(reader, units, node);
    let heights = heights(&faces, &at_mm, &axis, &|h| Some(0.5 * diameter_at(h)));
    let large = units.length_of(definition, "LargeEndDistance", In::Model)?;
    let small = units.length_of(definition, "SmallEndDistance", In::Model)?;
    let ends = match (&heights[..], large) {
        ([low, high], _) => Some([*low, *high]),
        // Without a small end it is pointed.
        (_, Some(large)) => Some([small.unwrap_or(-diameter_mm / slope), large]),
        _ => {
            notes.push(unknown_length(&heights));
            notes.push("diameters: at both ends".to_owned());
            None
        }
    };
    let Some([low, high]) = ends else {
        let form = Form::Cone { is_hole, at_mm, axis, diameters_mm: None, length_mm: None };
        return Ok((form, notes));
    };
    let diameters = [diameter_at(low), diameter_at(high)];
    if high - low < SAME_MM || diameters[0] < -SAME_MM {
        let message =
            format!("its ends at {} and {} mm make no cone", millimetres(low), millimetres(high));
        return Err(Reason::fault("not-positive", definition, message));
    }
    let diameters_mm = Some(diameters.map(|d| d.max(0.0)));
    let (at_mm, length_mm) = (at_mm + axis * low, Some(high - low));
    Ok((Form::Cone { is_hole, at_mm, axis, diameters_mm, length_mm }, notes))
}

/// `SphereFeatureNominal`: of its sweep only a cap about the pole is the shape that a part file has.
pub(in super::super) fn sphere<'d>(
    _: &Reader<'d, '_>,
    units: &Units,
    node: Node<'d, '_>,
    definition: Node<'d, '_>,
) -> Result<Read, Reason> {
    let is_hole = is_hole(definition)?;
    let at_mm = units.point_of(node, "Location")?;
    let diameter_mm = units.positive_of(definition, "Diameter", In::Model)?;
    let mut notes = Vec::new();
    if diameter_mm.is_none() {
        notes.push("diameter: the file does not state it".to_owned());
    }
    let cap = match child(node, "LatitudeLongitudeSweep") {
        Some(sweep) => cap(units, sweep)?,
        None => None,
    };
    if cap.is_none() {
        let note = "axis, opening: the middle of the part that there is, and from it to the edge";
        notes.push(note.to_owned());
    }
    let (axis, opening_rad) = cap.unzip();
    Ok((Form::Sphere { is_hole, at_mm, axis, diameter_mm, opening_rad }, notes))
}

fn cap(units: &Units, sweep: Node<'_, '_>) -> Result<Option<(Vec3, f64)>, Reason> {
    let pole = direction(sweep, "DirNorthPole")?;
    let latitude = units.angles_of::<2>(sweep, "DomainLatitude")?;
    let longitude = units.angles_of::<2>(sweep, "DomainLongitude")?;
    let (Some([south, north]), Some([west, east])) = (latitude, longitude) else {
        return Ok(None);
    };
    if (east - west).abs() < TAU - WHOLE_RAD {
        return Ok(None);
    }
    Ok(match (FRAC_PI_2 - north < WHOLE_RAD, south + FRAC_PI_2 < WHOLE_RAD) {
        (true, false) => Some((pole, FRAC_PI_2 - south)),
        (false, true) => Some((-pole, north + FRAC_PI_2)),
        _ => None,
    })
}

fn axis_of(units: &Units, node: Node<'_, '_>) -> Result<(Vec3, Vec3), Reason> {
    let missing = || Reason::fault("missing-value", node, "it has no Axis");
    let axis = child(node, "Axis").ok_or_else(missing)?;
    Ok((units.point_of(axis, "AxisPoint")?, direction(axis, "Direction")?))
}

/// A part file has cylinders and cones all around only.
fn whole_turn(units: &Units, node: Node<'_, '_>) -> Result<(), Reason> {
    let Some(sweep) = child(node, "Sweep") else { return Ok(()) };
    match units.angles_of::<2>(sweep, "DomainAngle")? {
        Some([from, to]) if (to - from).abs() < TAU - WHOLE_RAD => {
            let degrees = (to - from).abs().to_degrees();
            Err(Reason::plain(format!("it is there for {degrees:.1}° of a turn only")))
        }
        _ => Ok(()),
    }
}

/// Where the vertices of its faces lie along the axis, each once; a face with a vertex off the surface is another one.
fn heights(
    faces: &[Face],
    at_mm: &Vec3,
    axis: &Vec3,
    radius_mm: &dyn Fn(f64) -> Option<f64>,
) -> Vec<f64> {
    let height = |p: Vec3| (p - at_mm).dot(axis);
    let is_on = |p: Vec3| {
        let off = (p - at_mm - axis * height(p)).norm();
        radius_mm(height(p)).is_some_and(|r| (off - r).abs() < OFF_SURFACE_MM)
    };
    let of_it = faces.iter().filter(|f| f.corners().all(is_on));
    let mut heights: Vec<f64> = of_it.flat_map(Face::corners).map(height).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|a, b| (*a - *b).abs() < SAME_MM);
    heights
}

fn unknown_length(heights: &[f64]) -> String {
    match heights.is_empty() {
        true => "length: the file does not state it".to_owned(),
        false => format!("length: its faces end at {} mm along the axis", listed(heights)),
    }
}

fn listed(heights: &[f64]) -> String {
    let shown: Vec<String> = heights.iter().take(6).map(|h| millimetres(*h)).collect();
    shown.join(", ")
}
