//! The nominal shapes of the part file.

use super::positive;
use crate::part::Geometry;
use crate::part::feature::across;
use std::f64::consts::{PI, TAU};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Dimension, Section};

/// Their keys.
pub(super) const SHAPES: [&str; 15] = [
    "plane",
    "cylinder",
    "hole",
    "thread",
    "cone",
    "conical_hole",
    "sphere",
    "hollow_sphere",
    "torus",
    "hollow_torus",
    "slot",
    "tongue",
    "points",
    "mesh",
    "programmed",
];

/// Some 40 points along the longer side, 48 around.
pub(super) fn usual_spacing(geometry: &Geometry) -> f64 {
    // There are 48 points around at least; sections stand twice as far apart.
    let round = |radius_mm: f64| PI * radius_mm / 12.0;
    match geometry {
        Geometry::Plane { size_mm: [a, b], .. }
        | Geometry::Slot { size_mm: [a, b], .. }
        | Geometry::Programmed { size_mm: [a, b], .. } => 0.025 * a.max(*b),
        Geometry::Cylinder { radius_mm, .. } => round(*radius_mm),
        Geometry::Cone { radii_mm, .. } => round(radii_mm[0].max(radii_mm[1])),
        Geometry::Sphere { radius_mm, opening_rad, .. } => 0.1 * radius_mm * opening_rad,
        Geometry::Torus { ring_mm, radius_mm, .. } => {
            (PI * ring_mm / 18.0).min(PI * radius_mm / 12.0)
        }
        Geometry::Points => 1.0,
    }
}

pub(super) fn read_geometry(section: &Section<'_>, kind: &str) -> Option<Geometry> {
    let at_mm = section
        .require("at", "a place in the workpiece frame: at = \"0 0 0 mm\"")
        .and_then(|i| i.lengths())
        .map(Vec3::from);
    let unit = |key: &str, hint: &str| {
        section.require(key, hint).and_then(|i| i.direction()).map(Vec3::from)
    };
    let size = |key: &str, hint: &str| section.require(key, hint).and_then(|i| positive(&i, key));
    let is_hole =
        kind.contains("hole") || kind.contains("hollow") || matches!(kind, "slot" | "thread");
    let axis_hint = "along the axis from `at` on: axis = \"0 0 1\"";
    let diameter = || size("diameter", "diameter = \"30 mm\"");
    match kind {
        "plane" => {
            let (normal, along, size_mm) =
                read_rectangle(section, "normal", "out of the material")?;
            Some(Geometry::Plane { at_mm: at_mm?, normal, along, size_mm })
        }
        "programmed" => {
            let depth = size("depth", "how far beyond the rectangle: depth = \"20 mm\"");
            let (normal, along, size_mm) = read_rectangle(section, "normal", "towards the eye")?;
            let depth_mm = depth?;
            Some(Geometry::Programmed { at_mm: at_mm?, normal, along, size_mm, depth_mm })
        }
        "cylinder" | "hole" | "thread" => {
            let axis = unit("axis", axis_hint);
            let diameter = diameter();
            let length = size("length", "along the axis: length = \"20 mm\"");
            Some(Geometry::Cylinder {
                at_mm: at_mm?,
                axis: axis?,
                radius_mm: 0.5 * diameter?,
                length_mm: length?,
                is_hole,
            })
        }
        "cone" | "conical_hole" => {
            let axis = unit("axis", axis_hint);
            let diameters = section
                .require("diameters", "at both ends: diameters = \"30 20 mm\"")
                .and_then(|i| i.lengths::<2>());
            let length = size("length", "along the axis: length = \"20 mm\"");
            let radii_mm = diameters?.map(|d| 0.5 * d);
            if radii_mm.iter().any(|r| *r < 0.0) || radii_mm[0].max(radii_mm[1]) <= 0.0 {
                section.error(
                    "not-positive",
                    "`diameters` must be positive".into(),
                    "one of them may be 0",
                );
                return None;
            }
            Some(Geometry::Cone {
                at_mm: at_mm?,
                axis: axis?,
                radii_mm,
                length_mm: length?,
                is_hole,
            })
        }
        "torus" | "hollow_torus" => read_torus(section, (at_mm, unit("axis", axis_hint)), is_hole),
        "slot" | "tongue" => {
            let width = size("width", "from face to face: width = \"12 mm\"");
            let (across, along, size_mm) =
                read_rectangle(section, "across", "from one face to the other")?;
            let (at_mm, width_mm) = (at_mm?, width?);
            Some(Geometry::Slot { at_mm, across, along, size_mm, width_mm, is_hole })
        }
        _ => {
            let axis = unit("axis", "the middle of the part that there is: axis = \"0 0 1\"");
            let diameter = diameter();
            let hint = "from the axis to the edge: opening = \"60 deg\"";
            let opening =
                section.require("opening", hint).and_then(|i| i.quantity(Dimension::Angle));
            let opening_rad = opening?;
            if !(opening_rad > 0.0 && opening_rad <= PI) {
                section.error("bad-angle", "`opening` must be from 0 to 180 deg".into(), hint);
                return None;
            }
            let radius_mm = 0.5 * diameter?;
            Some(Geometry::Sphere { at_mm: at_mm?, axis: axis?, radius_mm, opening_rad, is_hole })
        }
    }
}

/// A ring whose section is a part of a circle: `ring`, `diameter`, `section`.
fn read_torus(
    section: &Section<'_>,
    (at_mm, axis): (Option<Vec3>, Option<Vec3>),
    is_hole: bool,
) -> Option<Geometry> {
    let size = |key: &str, hint: &str| section.require(key, hint).and_then(|i| positive(&i, key));
    let ring = size("ring", "diameter of the middle of the section: ring = \"40 mm\"");
    let diameter = size("diameter", "of the section: diameter = \"6 mm\"");
    let hint = "where the section begins and ends, 0 away from the axis, 90° along it: section = [\"0 deg\", \"90 deg\"]";
    let item = section.require("section", hint);
    let ends = item.as_ref().and_then(|item| {
        let list = item.list()?;
        let ends: Vec<Option<f64>> = list.iter().map(|i| i.quantity(Dimension::Angle)).collect();
        match ends[..] {
            [Some(from), Some(to)] if from < to && to - from <= TAU + 1e-9 => Some([from, to]),
            _ => {
                let message = "`section` is an angle and a larger one, a turn at most".to_owned();
                item.error("bad-angle", message, hint);
                None
            }
        }
    });
    let (ring_mm, radius_mm) = (0.5 * ring?, 0.5 * diameter?);
    let section_rad = ends?;
    if ring_mm <= radius_mm {
        let message = "the section of the torus reaches over its axis".to_owned();
        section.error("not-positive", message, "`ring` larger than `diameter`");
        return None;
    }
    let (at_mm, axis) = (at_mm?, axis?);
    Some(Geometry::Torus { at_mm, axis, ring_mm, radius_mm, section_rad, is_hole })
}

/// A direction of three digits is as exact as this.
const OUT_OF_PLANE_DEG: f64 = 0.1;

/// A direction (`normal`, `across`), `along` and `size`.
fn read_rectangle(section: &Section<'_>, key: &str, is: &str) -> Option<(Vec3, Vec3, [f64; 2])> {
    let normal = section
        .require(key, &format!("{is}: {key} = \"0 0 1\""))
        .and_then(|i| i.direction())
        .map(Vec3::from);
    let along = match section.get("along") {
        Some(item) => item.direction().map(Vec3::from).map(Some),
        None => Some(None),
    };
    let hint = "along its edges: size = \"80 60 mm\"";
    let size = section.require("size", hint).and_then(|i| i.lengths::<2>());
    let (normal, along, size_mm) = (normal?, along?, size?);
    if size_mm.iter().any(|s| *s <= 0.0) {
        section.error("not-positive", "`size` must be positive".into(), "two lengths of edges");
        return None;
    }
    let along = match along {
        None => across(&normal)[0],
        Some(along) => {
            let within = along - normal * normal.dot(&along);
            if within.norm() < 0.9 {
                let message = "`along` does not lie in the plane".to_owned();
                let hint = &format!("a direction at right angles to `{key}`");
                section.error("bad-direction", message, hint);
                return None;
            }
            let off_deg = along.dot(&normal).abs().asin().to_degrees();
            if off_deg > OUT_OF_PLANE_DEG {
                let message = format!(
                    "`along` is {off_deg:.2} deg out of the plane; its direction in the plane counts"
                );
                let hint = &format!("a direction at right angles to `{key}`");
                section.warn("bad-direction", message, hint);
            }
            within.normalize()
        }
    };
    Some((normal, along, size_mm))
}
