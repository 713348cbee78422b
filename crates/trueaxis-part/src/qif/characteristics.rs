//! Characteristics of a QIF file as those of a part file. What a definition has beyond what is understood is a reason to
//! leave it out: a drawing is never read as less than it asks.

use super::datums::{material, only};
use super::document::{
    Reader, Reason, child, content, direction, elements, in_words, listed, name, shown, text_of,
};
use super::features::Form;
use super::text::millimetres;
use super::units::{In, Units};
use crate::part::Kind;
use roxmltree::Node;
use std::collections::BTreeMap;
use trueaxis_geometry::Vec3;

/// Of a definition, what is evaluated or changes nothing.
const DEFINITION: [&str; 16] = [
    "Attributes",
    "Name",
    "Description",
    "CharacteristicDesignator",
    "ToleranceValue",
    // The same value in the other unit of the drawing.
    "ToleranceDualValue",
    "Tolerance",
    // Refused by name but for the least-squares size.
    "DimensionModifiers",
    "DatumReferenceFrameId",
    "MaterialCondition",
    "SizeCharacteristicDefinitionId",
    "ZoneShape",
    "Extent",
    // Independency is how all is judged here, and each feature has a zone of its own.
    "Independency",
    "SeparateZone",
    // Refused by name.
    "NonTolerance",
];
/// The same of a characteristic nominal.
const NOMINAL: [&str; 12] = [
    "Attributes",
    "CharacteristicDefinitionId",
    "FeatureNominalIds",
    "EntityInternalIds",
    "EntityExternalIds",
    "Name",
    "Description",
    "UUID",
    "CharacteristicDesignator",
    "TargetValue",
    "TargetDualValue",
    "Angle",
];
/// The same of the limits of a size.
const TOLERANCE: [&str; 7] = [
    "Attributes",
    "MaxValue",
    "MinValue",
    "MaxDualValue",
    "MinDualValue",
    "DefinedAsLimit",
    // Refused by name.
    "DefinitionId",
];
/// Directions that differ by less are one. Unit: rad.
const SAME_RAD: f64 = 1e-6;
/// A diameter of the drawing farther than this share from that of the feature is of another one.
const OTHER_SIZE: f64 = 0.05;

/// What is asked, before it is asked of a feature.
#[derive(Debug, Clone)]
pub(super) struct Demand {
    pub kind: Kind,
    zone: Option<Zone>,
    /// Of a line profile, across the planes of its lines.
    across: Option<Vec3>,
    pub limits: Limits,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Zone {
    Diameter,
    Width,
    Sphere,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Limits {
    Zone {
        tolerance_mm: f64,
    },
    /// Limits, and the nominal size from which they count; limits of the size itself have none.
    Size {
        low_mm: f64,
        high_mm: f64,
        are_sizes: bool,
        target_mm: Option<f64>,
    },
}

/// The kind of a characteristic: `Flatness` of `FlatnessCharacteristicNominal`.
pub(super) fn stem<'d>(node: Node<'d, '_>) -> &'d str {
    name(node).trim_end_matches("CharacteristicNominal")
}

fn kind_of(stem: &str) -> Option<Kind> {
    Some(match stem {
        "Flatness" => Kind::Flatness,
        "Straightness" => Kind::Straightness,
        "Circularity" => Kind::Roundness,
        "Cylindricity" => Kind::Cylindricity,
        "Diameter" => Kind::Diameter,
        "Width" => Kind::Width,
        "Symmetry" => Kind::Symmetry,
        "SurfaceProfile" => Kind::Profile,
        "LineProfile" => Kind::LineProfile,
        "Angularity" => Kind::Angularity,
        "Parallelism" => Kind::Parallelism,
        "Perpendicularity" => Kind::Perpendicularity,
        "Position" => Kind::Position,
        "Coaxiality" | "Concentricity" => Kind::Coaxiality,
        "CircularRunout" => Kind::CircularRunOut,
        "TotalRunout" => Kind::TotalRunOut,
        _ => return None,
    })
}

/// The definition of a characteristic.
pub(super) fn definition<'d, 't>(
    reader: &Reader<'d, 't>,
    nominal: Node<'d, 't>,
) -> Result<Node<'d, 't>, Reason> {
    let found = reader.needed(nominal, "CharacteristicDefinitionId", "CharacteristicDefinition")?;
    if name(found) == format!("{}CharacteristicDefinition", stem(nominal)) {
        return Ok(found);
    }
    let message = format!("its definition is a {}", name(found));
    Err(Reason::fault("bad-reference", nominal, message))
}

/// What a characteristic nominal asks, by its definition.
pub(super) fn read<'d>(
    units: &Units,
    nominal: Node<'d, '_>,
    definition: Node<'d, '_>,
) -> Result<Demand, Reason> {
    let Some(kind) = kind_of(stem(nominal)) else {
        return Err(Reason::plain(format!("{} is not evaluated", in_words(stem(nominal)))));
    };
    if child(definition, "NonTolerance").is_some() {
        return Err(Reason::plain("it has no tolerance"));
    }
    if let Some(text) = material(definition, "MaterialCondition") {
        return Err(Reason::plain(text));
    }
    only(definition, &DEFINITION, "its definition")?;
    let across = match kind {
        Kind::LineProfile => {
            only(nominal, &[&NOMINAL[..], &["Vector"]].concat(), "it")?;
            Some(direction(nominal, "Vector")?)
        }
        _ => {
            only(nominal, &NOMINAL, "it")?;
            None
        }
    };
    let is_profile = matches!(kind, Kind::Profile | Kind::LineProfile);
    let target_mm = is_profile.then(|| units.length_of(nominal, "TargetValue", In::Drawing));
    if target_mm.transpose()?.flatten().is_some_and(|mm| mm != 0.0) {
        return Err(Reason::plain("its profile is meant beside the nominal surface"));
    }
    let extent = child(definition, "Extent").map(|e| text_of(e, "ExtentEnum"));
    if let Some(extent) = extent.filter(|e| e.as_deref() != Some("UNDEFINED")) {
        let extent = extent.unwrap_or_else(|| "of its own".to_owned());
        return Err(Reason::plain(format!("its extent is {}", shown(&extent))));
    }
    let zone = match child(definition, "ZoneShape").and_then(|z| elements(z).next()) {
        None => None,
        Some(shape) => match name(shape) {
            "DiametricalZone" => Some(Zone::Diameter),
            "PlanarZone" | "NonDiametricalZone" => Some(Zone::Width),
            "SphericalZone" => Some(Zone::Sphere),
            other => return Err(Reason::plain(format!("its zone is a {}", in_words(other)))),
        },
    };
    // Between two lines: the lines of the surface are meant, not the axis.
    let kind = match zone {
        Some(Zone::Width) if kind == Kind::Straightness => Kind::LineStraightness,
        _ => kind,
    };
    let limits = match kind {
        Kind::Diameter | Kind::Width => size(units, nominal, definition)?,
        _ => match units.positive_of(definition, "ToleranceValue", In::Drawing)? {
            Some(tolerance_mm) => Limits::Zone { tolerance_mm },
            None => return Err(Reason::plain("its definition has no tolerance value")),
        },
    };
    Ok(Demand { kind, zone, across, limits })
}

fn size(units: &Units, nominal: Node<'_, '_>, definition: Node<'_, '_>) -> Result<Limits, Reason> {
    let Some(tolerance) = child(definition, "Tolerance") else {
        return Err(Reason::plain("its definition has no limits"));
    };
    if child(tolerance, "DefinitionId").is_some() {
        return Err(Reason::plain("its limits are those of a general definition"));
    }
    only(tolerance, &TOLERANCE, "its tolerance")?;
    if let Some(modifiers) = child(definition, "DimensionModifiers") {
        let asked = elements(modifiers).map(|m| content(m).trim().to_owned());
        if let Some(other) = asked.into_iter().find(|m| m != "GG") {
            return Err(Reason::plain(format!("its size is asked with {}, not GG", shown(&other))));
        }
    }
    let high = units.length_of(tolerance, "MaxValue", In::Drawing)?;
    let low = units.length_of(tolerance, "MinValue", In::Drawing)?;
    let (Some(low_mm), Some(high_mm)) = (low, high) else {
        return Err(Reason::plain("it has one limit only"));
    };
    let are_sizes = match text_of(tolerance, "DefinedAsLimit").as_deref() {
        Some("true" | "1") => true,
        Some("false" | "0") => false,
        _ => {
            let message = "the file does not say whether its limits are sizes or deviations";
            return Err(Reason::fault("missing-value", tolerance, message));
        }
    };
    if low_mm >= high_mm {
        let [low, high] = [low_mm, high_mm].map(millimetres);
        let message = format!("its limits are {low} and {high} mm");
        return Err(Reason::fault("bad-limits", tolerance, message));
    }
    let target_mm = units.positive_of(nominal, "TargetValue", In::Drawing)?;
    Ok(Limits::Size { low_mm, high_mm, are_sizes, target_mm })
}

impl Demand {
    /// Whether the zone of the drawing is the one that is evaluated for this feature and these datums.
    pub fn check(&self, of: &Form, datums: &[&Form]) -> Result<(), Reason> {
        let kind = self.kind;
        let refuse = |text: &str| Err(Reason::plain(text));
        if datums.is_empty() && kind.is_located() {
            return refuse(
                "without datums its zone has no place: here it would count from the zero that was set",
            );
        }
        if datums.is_empty() && kind.needs_datum() {
            return refuse("it names no datum");
        }
        if self.across.is_some_and(|across| {
            of.across_lines().is_none_or(|own| own.cross(&across).norm() > SAME_RAD)
        }) {
            return refuse(
                "its lines are not those around an axis, or along the first edge of a plane",
            );
        }
        if kind == Kind::LineStraightness && !of.has_axis() {
            return refuse("of a face it does not say which lines are meant");
        }
        let due = match kind {
            Kind::LineStraightness => Zone::Width,
            Kind::Straightness | Kind::Coaxiality => Zone::Diameter,
            Kind::Position if of.has_axis() => Zone::Diameter,
            Kind::Position => Zone::Width,
            _ if !kind.is_oriented() => return Ok(()),
            _ if of.is_flat() => Zone::Width,
            // Of an axis a cylinder, unless one plane alone fixes one direction of it only.
            Kind::Parallelism if datums.len() == 1 && datums[0].is_flat() => Zone::Width,
            Kind::Perpendicularity if datums.len() == 1 && !datums[0].is_flat() => Zone::Width,
            _ => Zone::Diameter,
        };
        match self.zone {
            Some(zone) if zone == due => Ok(()),
            None => refuse("its definition has no shape of the zone"),
            Some(Zone::Sphere) => refuse("its zone is a sphere"),
            Some(Zone::Width) => {
                refuse("its zone lies between planes, here it would be a cylinder")
            }
            Some(Zone::Diameter) => {
                refuse("its zone is a cylinder, here it would lie between planes")
            }
        }
    }

    /// The limits for a feature, counted from its own diameter, and what is to be said about them.
    pub fn limits_of(&self, of: &Form) -> Result<(Limits, Option<String>), Reason> {
        let Limits::Size { low_mm, high_mm, are_sizes, target_mm } = self.limits else {
            return Ok((self.limits.clone(), None));
        };
        let own_mm = match of {
            Form::Cylinder { diameter_mm, .. } if self.kind == Kind::Diameter => *diameter_mm,
            Form::Slot { width_mm, .. } if self.kind == Kind::Width => *width_mm,
            _ if self.kind == Kind::Width => {
                return Err(Reason::plain("a width is evaluated of opposite parallel planes only"));
            }
            _ => return Err(Reason::plain("a diameter is evaluated of a cylinder only")),
        };
        let Some(own_mm) = own_mm else {
            return Err(Reason::plain("the file does not state the size of its feature"));
        };
        let target_mm = target_mm.unwrap_or(own_mm);
        if (target_mm - own_mm).abs() > OTHER_SIZE * own_mm {
            let message = format!(
                "the drawing has {} mm, its feature {} mm",
                millimetres(target_mm),
                millimetres(own_mm)
            );
            return Err(Reason::plain(message));
        }
        let from_mm = if are_sizes { 0.0 } else { target_mm };
        let (low_mm, high_mm) = (low_mm + from_mm - own_mm, high_mm + from_mm - own_mm);
        // Rounding of the export moves nothing.
        let differs = (target_mm - own_mm).abs() > 1e-6;
        let note = differs.then(|| {
            let [drawn, own] = [target_mm, own_mm].map(millimetres);
            format!(
                "the drawing has {drawn} mm, the model {own} mm: limits about that of the model"
            )
        });
        let limits = Limits::Size { low_mm, high_mm, are_sizes: false, target_mm: None };
        Ok((limits, note))
    }
}

/// Plans name the features of a characteristic in its items: references to feature nominals, and a name.
pub(super) struct Items<'d, 't> {
    by_nominal: BTreeMap<String, Node<'d, 't>>,
}

impl<'d, 't> Items<'d, 't> {
    pub fn of(reader: &Reader<'d, 't>) -> Self {
        let items = reader.ending("CharacteristicItem");
        let keyed = items.filter_map(|n| Some((text_of(n, "CharacteristicNominalId")?, n)));
        Self { by_nominal: keyed.collect() }
    }

    /// References to the features of a characteristic.
    pub fn features(
        &self,
        reader: &Reader<'d, 't>,
        nominal: Node<'d, 't>,
    ) -> Result<Vec<Node<'d, 't>>, Reason> {
        let own = listed(nominal, "FeatureNominalIds");
        if !own.is_empty() {
            return Ok(own);
        }
        let Some(item) = self.item(nominal) else { return Ok(own) };
        let nominal_of = |reference: Node<'d, 't>| {
            let item = reader.target(reference, "FeatureItem")?;
            let missing = || Reason::fault("bad-reference", item, "it has no FeatureNominalId");
            child(item, "FeatureNominalId").ok_or_else(missing)
        };
        listed(item, "FeatureItemIds").into_iter().map(nominal_of).collect()
    }

    /// The name of a characteristic; a number of the drawing alone says what it is of.
    pub fn name(&self, nominal: Node<'d, 't>) -> Option<String> {
        let designator =
            |n: Node<'_, '_>| text_of(child(n, "CharacteristicDesignator")?, "Designator");
        let item = self.item(nominal);
        let found = text_of(nominal, "Name")
            .or_else(|| item.and_then(|i| text_of(i, "Name")))
            .or_else(|| designator(nominal))?;
        let found = shown(&found);
        if found.chars().any(char::is_alphabetic) {
            return Some(found);
        }
        let kind =
            kind_of(stem(nominal)).map_or_else(|| in_words(stem(nominal)), |k| k.name().to_owned());
        Some(format!("{found}: {kind}"))
    }

    fn item(&self, nominal: Node<'d, 't>) -> Option<Node<'d, 't>> {
        self.by_nominal.get(nominal.attribute("id")?.trim()).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By ISO 1101 an axis stands in a cylinder on a plane and along an axis; between planes it lies along a plane and across an axis.
    #[test]
    fn the_zone_of_an_axis_follows_its_datum() {
        let at_mm = Vec3::zeros();
        let (axis, diameter_mm, length_mm) = (Vec3::z(), Some(10.0), Some(10.0));
        let bore = Form::Cylinder { is_hole: true, at_mm, axis, diameter_mm, length_mm };
        let normal = Some(Vec3::z());
        let plane = Form::Plane { at_mm, normal, along: None, size_mm: None, openings: Vec::new() };
        let is_read = |kind: Kind, zone: Zone, datums: &[&Form]| {
            let limits = Limits::Zone { tolerance_mm: 0.01 };
            Demand { kind, zone: Some(zone), across: None, limits }.check(&bore, datums).is_ok()
        };
        for (kind, datums, due) in [
            (Kind::Perpendicularity, &[&plane][..], Zone::Diameter),
            (Kind::Parallelism, &[&bore][..], Zone::Diameter),
            (Kind::Parallelism, &[&plane][..], Zone::Width),
            (Kind::Perpendicularity, &[&bore][..], Zone::Width),
            (Kind::Parallelism, &[&plane, &bore][..], Zone::Diameter),
            (Kind::Angularity, &[&plane][..], Zone::Diameter),
        ] {
            for zone in [Zone::Diameter, Zone::Width, Zone::Sphere] {
                assert_eq!(is_read(kind, zone, datums), zone == due, "{kind:?} {zone:?}");
            }
        }
    }
}
