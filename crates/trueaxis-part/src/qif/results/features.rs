//! Features: definitions, nominals and items.

use super::ids::{Ids, Of};
use super::xml::{Xml, decimal};
use crate::part::{Feature, Geometry, Part, across};
use std::f64::consts::{FRAC_PI_2, TAU};
use trueaxis_geometry::Vec3;

pub(super) fn write(xml: &mut Xml, part: &Part, ids: &Ids<'_>) {
    let count = part.features.len().to_string();
    xml.open("Features", &[]);
    xml.open("FeatureDefinitions", &[("n", &count)]);
    for (index, feature) in part.features.iter().enumerate() {
        let id = ids.feature(index, Of::Definition);
        definition(xml, &feature.geometry, id);
    }
    xml.close();
    xml.open("FeatureNominals", &[("n", &count)]);
    for (index, feature) in part.features.iter().enumerate() {
        nominal(xml, feature, index, ids);
    }
    xml.close();
    xml.open("FeatureItems", &[("n", &count)]);
    for (index, feature) in part.features.iter().enumerate() {
        let id = ids.feature(index, Of::Item).to_string();
        xml.open(&format!("{}FeatureItem", stem(&feature.geometry)), &[("id", &id)]);
        xml.id("FeatureNominalId", ids.feature(index, Of::Nominal));
        xml.leaf("FeatureName", &[], &feature.name);
        xml.open("DeterminationMode", &[]);
        // From points on it, not set to a place.
        xml.leaf("Checked", &[], "");
        xml.close();
        xml.close();
    }
    xml.close();
    xml.close();
}

/// The kind of a feature as the names of its elements begin.
fn stem(geometry: &Geometry) -> &'static str {
    match geometry {
        Geometry::Plane { .. } => "Plane",
        Geometry::Cylinder { .. } => "Cylinder",
        Geometry::Cone { .. } => "Cone",
        Geometry::Sphere { .. } => "Sphere",
        Geometry::Torus { .. } => "Torus",
        Geometry::Slot { .. } => "OppositeParallelPlanes",
        Geometry::Points => "PointDefinedSurface",
        Geometry::Programmed { .. } => "OtherSurface",
    }
}

fn definition(xml: &mut Xml, geometry: &Geometry, id: usize) {
    let (name, id) = (format!("{}FeatureDefinition", stem(geometry)), id.to_string());
    let side = |is_hole: bool| if is_hole { "INTERNAL" } else { "EXTERNAL" };
    let is_hole = match *geometry {
        Geometry::Plane { .. } | Geometry::Points | Geometry::Programmed { .. } => {
            xml.leaf(&name, &[("id", &id)], "");
            return;
        }
        Geometry::Cylinder { is_hole, .. }
        | Geometry::Cone { is_hole, .. }
        | Geometry::Sphere { is_hole, .. }
        | Geometry::Torus { is_hole, .. }
        | Geometry::Slot { is_hole, .. } => is_hole,
    };
    xml.open(&name, &[("id", &id)]);
    xml.leaf("InternalExternal", &[], side(is_hole));
    match *geometry {
        Geometry::Cylinder { radius_mm, length_mm, .. } => {
            xml.decimal("Diameter", 2.0 * radius_mm);
            xml.decimal("Length", length_mm);
        }
        Geometry::Cone { radii_mm: [one, other], length_mm, .. } => {
            let small_mm = one.min(other);
            xml.decimal("Diameter", 2.0 * small_mm);
            xml.decimal("HalfAngle", (other - one).abs().atan2(length_mm));
            xml.decimal("LargeEndDistance", length_mm);
            // Without this element it is pointed.
            if small_mm > 0.0 {
                xml.decimal("SmallEndDistance", 0.0);
            }
        }
        Geometry::Sphere { radius_mm, .. } => xml.decimal("Diameter", 2.0 * radius_mm),
        Geometry::Torus { ring_mm, radius_mm, .. } => {
            xml.decimal("MinorDiameter", 2.0 * radius_mm);
            xml.decimal("MajorDiameter", 2.0 * ring_mm);
        }
        Geometry::Slot { size_mm: [length_mm, depth_mm], width_mm, .. } => {
            xml.decimal("Width", width_mm);
            xml.decimal("Length", length_mm);
            xml.open("EndType", &[]);
            // A part file does not say how a slot ends.
            xml.leaf("SlotEndEnum", &[], "UNDEFINED");
            xml.close();
            xml.decimal("Depth", depth_mm);
        }
        Geometry::Plane { .. } | Geometry::Points | Geometry::Programmed { .. } => {}
    }
    xml.close();
}

fn nominal(xml: &mut Xml, feature: &Feature, index: usize, ids: &Ids<'_>) {
    let id = ids.feature(index, Of::Nominal).to_string();
    xml.open(&format!("{}FeatureNominal", stem(&feature.geometry)), &[("id", &id)]);
    if matches!(feature.geometry, Geometry::Programmed { .. }) {
        xml.attribute("surface", "what the NC program leaves on a machine without errors");
    }
    xml.leaf("Name", &[], &feature.name);
    xml.id("FeatureDefinitionId", ids.feature(index, Of::Definition));
    match feature.geometry {
        Geometry::Plane { at_mm, normal, along, size_mm } => {
            xml.vector("Location", &at_mm);
            xml.vector("Normal", &normal);
            rectangle(xml, &at_mm, [&along, &normal.cross(&along)], size_mm);
        }
        Geometry::Cylinder { at_mm, axis, .. } => axis_of(xml, &at_mm, &axis),
        // The axis of QIF points to where the cone is wider.
        Geometry::Cone { at_mm, axis, radii_mm, length_mm, .. } => {
            match radii_mm[0] <= radii_mm[1] {
                true => axis_of(xml, &at_mm, &axis),
                false => axis_of(xml, &(at_mm + axis * length_mm), &-axis),
            }
        }
        Geometry::Sphere { at_mm, axis, opening_rad, .. } => {
            xml.vector("Location", &at_mm);
            // A cap about the north pole.
            sweep(xml, &axis, [FRAC_PI_2 - opening_rad, FRAC_PI_2], true);
        }
        Geometry::Torus { at_mm, axis, section_rad, .. } => {
            xml.vector("Location", &at_mm);
            xml.vector("AxisVector", &axis);
            sweep(xml, &axis, section_rad, false);
        }
        Geometry::Slot { at_mm, across, along, .. } => {
            xml.open("CenterPlane", &[]);
            xml.vector("Point", &at_mm);
            xml.vector("Normal", &across);
            xml.close();
            xml.vector("LengthVector", &along);
        }
        Geometry::Points => points(xml, feature, index, ids),
        Geometry::Programmed { .. } => {}
    }
    xml.close();
}

fn rectangle(xml: &mut Xml, at_mm: &Vec3, edges: [&Vec3; 2], size_mm: [f64; 2]) {
    let corner_mm = at_mm - 0.5 * (edges[0] * size_mm[0] + edges[1] * size_mm[1]);
    xml.open("Rectangle", &[]);
    xml.decimal("Length", size_mm[0]);
    xml.vector("CornerPoint", &corner_mm);
    xml.decimal("Width", size_mm[1]);
    xml.vector("WidthDirection", edges[1]);
    xml.vector("LengthDirection", edges[0]);
    xml.close();
}

fn axis_of(xml: &mut Xml, at_mm: &Vec3, axis: &Vec3) {
    xml.open("Axis", &[]);
    xml.vector("AxisPoint", at_mm);
    xml.vector("Direction", axis);
    xml.close();
}

/// All around an axis, from one latitude to another.
fn sweep(xml: &mut Xml, axis: &Vec3, latitude_rad: [f64; 2], has_pole: bool) {
    let pair = |pair: [f64; 2]| pair.map(decimal).join(" ");
    xml.open("LatitudeLongitudeSweep", &[]);
    xml.vector("DirMeridianPrime", &across(axis)[0]);
    xml.leaf("DomainLatitude", &[], &pair(latitude_rad));
    xml.leaf("DomainLongitude", &[], &pair([0.0, TAU]));
    // A torus states its axis itself.
    if has_pole {
        xml.vector("DirNorthPole", axis);
    }
    xml.close();
}

fn points(xml: &mut Xml, feature: &Feature, index: usize, ids: &Ids<'_>) {
    xml.open("DefiningPoints", &[("n", &feature.points.len().to_string())]);
    for (row, point) in feature.points.iter().enumerate() {
        xml.open("DefiningPoint", &[("id", &ids.point(index, row).to_string())]);
        xml.vector("Point", &point.point_mm);
        xml.vector("Normal", &point.normal);
        xml.id("SequenceNumber", row + 1);
        xml.close();
    }
    xml.close();
}
