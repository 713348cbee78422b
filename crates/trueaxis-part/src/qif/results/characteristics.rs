//! Characteristics: definitions with their tolerances, nominals, items, and what was found.

use super::Found;
use super::ids::{Ids, Of};
use super::xml::{Xml, decimal};
use crate::part::{Characteristic, Datum, Geometry, Kind, Limits, Part};
use crate::tolerance::Outcome;

pub(super) fn write(xml: &mut Xml, part: &Part, ids: &Ids<'_>) {
    let count = part.characteristics.len().to_string();
    xml.open("Characteristics", &[]);
    xml.id("FormalStandardId", ids.standard());
    xml.open("CharacteristicDefinitions", &[("n", &count)]);
    for (index, asked) in part.characteristics.iter().enumerate() {
        definition(xml, part, asked, index, ids);
    }
    xml.close();
    xml.open("CharacteristicNominals", &[("n", &count)]);
    for (index, asked) in part.characteristics.iter().enumerate() {
        nominal(xml, part, asked, index, ids);
    }
    xml.close();
    xml.open("CharacteristicItems", &[("n", &count)]);
    for (index, asked) in part.characteristics.iter().enumerate() {
        let id = ids.characteristic(index, Of::Item).to_string();
        xml.open(&format!("{}CharacteristicItem", stem(asked.kind)), &[("id", &id)]);
        xml.leaf("Name", &[], &asked.name);
        xml.ids("FeatureItemIds", &of(asked, Of::Item, ids));
        xml.id("CharacteristicNominalId", ids.characteristic(index, Of::Nominal));
        xml.close();
    }
    xml.close();
    xml.close();
}

/// What was found, in the place of what was measured.
pub(super) fn measurements(xml: &mut Xml, part: &Part, found: &[Found], ids: &Ids<'_>) {
    let count = part.characteristics.len().to_string();
    xml.open("CharacteristicMeasurements", &[("n", &count)]);
    for (index, (asked, found)) in part.characteristics.iter().zip(found).enumerate() {
        let id = ids.characteristic(index, Of::Measurement).to_string();
        xml.open(&format!("{}CharacteristicMeasurement", stem(asked.kind)), &[("id", &id)]);
        if asked.features.len() > 1 && asked.kind != Kind::Position {
            let text = "predicted; of the feature that is nearest to its limit";
            xml.leaf("Description", &[], text);
        } else {
            xml.leaf("Description", &[], "predicted");
        }
        xml.open("Status", &[]);
        xml.leaf("CharacteristicStatusEnum", &[], status(found.outcome));
        xml.close();
        xml.id("CharacteristicItemId", ids.characteristic(index, Of::Item));
        // Of a size QIF has the size itself, a part file its deviation.
        let value_mm = size_mm(part, asked).unwrap_or(0.0) + found.value_mm;
        // The standard asks for both attributes or none.
        let doubt = [("combinedUncertainty", &decimal(found.u_mm)[..]), ("meanError", "0")];
        xml.leaf("Value", &doubt, &decimal(value_mm));
        xml.close();
    }
    xml.close();
}

fn status(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Pass => "PASS",
        Outcome::Fail => "FAIL",
        Outcome::Undecided => "INDETERMINATE",
    }
}

/// The kind of a characteristic as the names of its elements begin.
fn stem(kind: Kind) -> &'static str {
    match kind {
        Kind::Flatness => "Flatness",
        Kind::Straightness | Kind::LineStraightness => "Straightness",
        Kind::Roundness => "Circularity",
        Kind::Cylindricity => "Cylindricity",
        Kind::Diameter => "Diameter",
        Kind::Width => "Width",
        Kind::Profile => "SurfaceProfile",
        Kind::LineProfile => "LineProfile",
        Kind::Angularity => "Angularity",
        Kind::Parallelism => "Parallelism",
        Kind::Perpendicularity => "Perpendicularity",
        Kind::Position => "Position",
        Kind::Symmetry => "Symmetry",
        Kind::Coaxiality => "Coaxiality",
        Kind::CircularRunOut => "CircularRunout",
        Kind::TotalRunOut => "TotalRunout",
    }
}

fn of(asked: &Characteristic, of: Of, ids: &Ids<'_>) -> Vec<usize> {
    asked.features.iter().map(|feature| ids.feature(*feature, of)).collect()
}

/// The nominal size that a size is asked of.
fn size_mm(part: &Part, asked: &Characteristic) -> Option<f64> {
    match part.features[*asked.features.first()?].geometry {
        Geometry::Cylinder { radius_mm, .. } if asked.kind == Kind::Diameter => {
            Some(2.0 * radius_mm)
        }
        Geometry::Slot { width_mm, .. } if asked.kind == Kind::Width => Some(width_mm),
        _ => None,
    }
}

fn definition(xml: &mut Xml, part: &Part, asked: &Characteristic, index: usize, ids: &Ids<'_>) {
    let id = ids.characteristic(index, Of::Definition).to_string();
    let (kind, is_pattern) = (asked.kind, asked.features.len() > 1);
    xml.open(&format!("{}CharacteristicDefinition", stem(kind)), &[("id", &id)]);
    let from_zero = (kind.is_located() && asked.datums.is_empty())
        .then_some("counts from the zero that was set");
    // QIF has a length for it, and no side.
    let side = asked.projected_mm.map(|mm| match mm > 0.0 {
        true => "its zone is projected beyond the end of the axis",
        false => "its zone is projected beyond the beginning of the axis",
    });
    let said: Vec<&str> = from_zero.into_iter().chain(side).collect();
    if !said.is_empty() {
        xml.leaf("Description", &[], &said.join("; "));
    }
    match is_pattern {
        // ISO 5458: all zones move together.
        true if kind == Kind::Position => xml.leaf("CommonZone", &[], "true"),
        true if !kind.is_size() => xml.leaf("SeparateZone", &[], "true"),
        _ => {}
    }
    match asked.limits {
        Limits::Zone { tolerance_mm } => xml.decimal("ToleranceValue", tolerance_mm),
        Limits::Size { low_mm, high_mm } => {
            xml.open("DimensionModifiers", &[]);
            // The least-squares size, ISO 14405-1.
            xml.leaf("DeterminationModifier", &[], "GG");
            xml.close();
            xml.open("Tolerance", &[]);
            xml.decimal("MaxValue", high_mm);
            xml.decimal("MinValue", low_mm);
            xml.leaf("DefinedAsLimit", &[], "false");
            xml.close();
        }
    }
    if let Some(frame) = ids.frame_of(asked) {
        xml.id("DatumReferenceFrameId", frame);
    }
    if kind.is_oriented() || kind == Kind::Position {
        xml.leaf("MaterialCondition", &[], "NONE");
    }
    if let Some(shape) = zone(part, asked) {
        xml.open("ZoneShape", &[]);
        xml.leaf(shape, &[], "");
        xml.close();
    }
    if let Some(projected_mm) = asked.projected_mm {
        xml.decimal("ProjectedToleranceZoneValue", projected_mm.abs());
    }
    xml.close();
}

/// The shape of the zone that was evaluated, of the kinds that may have more than one.
fn zone(part: &Part, asked: &Characteristic) -> Option<&'static str> {
    let has_axis = |index: usize| part.features[index].geometry.axis().is_some();
    let is_axis = asked.features.first().is_some_and(|index| has_axis(*index));
    let datum_has_axis = |datum: &Datum| datum.features.iter().any(|f| has_axis(*f));
    let is_across = match &asked.datums[..] {
        // By ISO 1101 an axis lies between planes along a plane, or across an axis.
        [datum] if asked.kind == Kind::Parallelism => !datum_has_axis(datum),
        [datum] if asked.kind == Kind::Perpendicularity => datum_has_axis(datum),
        _ => false,
    };
    match asked.kind {
        Kind::Straightness | Kind::Coaxiality => Some("DiametricalZone"),
        Kind::Position if is_axis => Some("DiametricalZone"),
        Kind::Position | Kind::LineStraightness => Some("NonDiametricalZone"),
        _ if !asked.kind.is_oriented() => None,
        _ if is_axis && !is_across => Some("DiametricalZone"),
        _ => Some("PlanarZone"),
    }
}

fn nominal(xml: &mut Xml, part: &Part, asked: &Characteristic, index: usize, ids: &Ids<'_>) {
    let id = ids.characteristic(index, Of::Nominal).to_string();
    xml.open(&format!("{}CharacteristicNominal", stem(asked.kind)), &[("id", &id)]);
    xml.id("CharacteristicDefinitionId", ids.characteristic(index, Of::Definition));
    xml.ids("FeatureNominalIds", &of(asked, Of::Nominal, ids));
    xml.leaf("Name", &[], &asked.name);
    if let Some(size_mm) = size_mm(part, asked) {
        xml.decimal("TargetValue", size_mm);
    }
    let first = asked.features.first().map(|index| part.features[*index].geometry);
    if let Some(across) =
        first.and_then(|g| g.across_rows()).filter(|_| asked.kind == Kind::LineProfile)
    {
        // Across the plane in which its lines lie.
        xml.vector("Vector", &across);
    }
    xml.close();
}
