//! Features of a QIF file as features of a part file.

mod plane;
mod round;
mod slot;

use super::document::{Reader, Reason, child, in_words, listed, name, text_of};
use super::topology::Face;
use super::units::Units;
use roxmltree::Node;
use trueaxis_geometry::Vec3;

/// More features than this in a group name each other again and again.
const MOST_OF_A_GROUP: usize = 2_000;

/// A feature as far as the file states it; none is a value that the file does not state.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Form {
    Plane {
        at_mm: Vec3,
        normal: Option<Vec3>,
        along: Option<Vec3>,
        size_mm: Option<[f64; 2]>,
        openings: Vec<Opening>,
    },
    Cylinder {
        is_hole: bool,
        at_mm: Vec3,
        axis: Vec3,
        diameter_mm: Option<f64>,
        length_mm: Option<f64>,
    },
    Cone {
        is_hole: bool,
        at_mm: Vec3,
        axis: Vec3,
        diameters_mm: Option<[f64; 2]>,
        length_mm: Option<f64>,
    },
    Sphere {
        is_hole: bool,
        at_mm: Vec3,
        axis: Option<Vec3>,
        diameter_mm: Option<f64>,
        opening_rad: Option<f64>,
    },
    Slot {
        is_hole: bool,
        at_mm: Vec3,
        across: Vec3,
        along: Option<Vec3>,
        width_mm: Option<f64>,
        size_mm: Option<[f64; 2]>,
    },
}

/// Where a plane is not.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Opening {
    Round { at_mm: Vec3, diameter_mm: f64 },
    Rectangle { at_mm: Vec3, size_mm: [f64; 2] },
    Unknown { at_mm: Vec3, note: String },
}

/// A feature and the name of the group that it was named by.
pub(super) type Single<'d, 't> = (Node<'d, 't>, Option<String>);

/// A form and what its line says about it.
pub(super) type Read = (Form, Vec<String>);

impl Form {
    /// A plane, or two with one in their middle.
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::Plane { .. } | Self::Slot { .. })
    }

    pub fn has_axis(&self) -> bool {
        matches!(self, Self::Cylinder { .. } | Self::Cone { .. })
    }

    /// Across the planes of the lines that are checked: those around an axis, those along the first edge of a plane.
    pub fn across_lines(&self) -> Option<Vec3> {
        match self {
            Self::Cylinder { axis, .. } | Self::Cone { axis, .. } => Some(*axis),
            Self::Plane { normal, along, .. } => Some(normal.as_ref()?.cross(along.as_ref()?)),
            Self::Slot { across, along, .. } => Some(across.cross(along.as_ref()?)),
            Self::Sphere { .. } => None,
        }
    }
}

/// The kind of a feature: `Plane` of `PlaneFeatureNominal`.
pub(super) fn stem<'d>(node: Node<'d, '_>) -> &'d str {
    name(node).trim_end_matches("FeatureNominal")
}

/// Why a feature of its kind is not in a part file.
pub(super) fn unfit(node: Node<'_, '_>) -> Option<Reason> {
    let kind = stem(node);
    let is_known =
        ["Plane", "Cylinder", "Cone", "Sphere", "OppositeParallelPlanes"].contains(&kind);
    let message = format!("a feature `{}` is no shape of a part file", in_words(kind));
    (!is_known).then(|| Reason::plain(message))
}

/// A feature by itself.
pub(super) fn read<'d>(
    reader: &Reader<'d, '_>,
    units: &Units,
    node: Node<'d, '_>,
) -> Result<Read, Reason> {
    let reader_of = match stem(node) {
        "Plane" => plane::read,
        "Cylinder" => round::cylinder,
        "Cone" => round::cone,
        "Sphere" => round::sphere,
        "OppositeParallelPlanes" => slot::read,
        _ => return Err(unfit(node).unwrap_or_else(|| Reason::plain("it is not read"))),
    };
    if child(node, "Constructed").is_some() {
        return Err(Reason::plain("it is constructed from other features"));
    }
    let definition = reader.needed(node, "FeatureDefinitionId", "FeatureDefinition")?;
    let expected = format!("{}FeatureDefinition", stem(node));
    if name(definition) != expected {
        let message = format!("its definition is a {}", name(definition));
        return Err(Reason::fault("bad-reference", node, message));
    }
    let (form, mut notes) = reader_of(reader, units, node, definition)?;
    if child(node, "SubstituteFeatureAlgorithm").is_some() {
        notes.push("the fitting that the file names for it is not used".to_owned());
    }
    Ok((form, notes))
}

/// The faces of the model that a feature is, and what could not be read of them.
fn faces<'d>(
    reader: &Reader<'d, '_>,
    units: &Units,
    node: Node<'d, '_>,
) -> (Vec<Face>, Vec<String>) {
    let (mut faces, mut notes) = (Vec::new(), Vec::new());
    for reference in listed(node, "EntityInternalIds") {
        let face = reader.target(reference, "Face").and_then(|n| Face::read(reader, units, n));
        match face {
            Ok(face) => faces.push(face),
            Err(reason) => notes.push(format!("its face is not read: {}", reason.text)),
        }
    }
    (faces, notes)
}

/// INTERNAL is a hole, EXTERNAL a boss.
fn is_hole(definition: Node<'_, '_>) -> Result<bool, Reason> {
    match text_of(definition, "InternalExternal").as_deref() {
        Some("INTERNAL") => Ok(true),
        Some("EXTERNAL") => Ok(false),
        _ => {
            let message = "the file does not say whether it is INTERNAL or EXTERNAL";
            Err(Reason::fault("missing-value", definition, message))
        }
    }
}

/// A feature nominal; that of a pattern ends with its kind, such as `PatternFeatureCircleNominal`.
fn nominal<'d, 't>(
    reader: &Reader<'d, 't>,
    reference: Node<'d, 't>,
) -> Result<Node<'d, 't>, Reason> {
    let found = reader.target(reference, "Nominal")?;
    if name(found).contains("Feature") {
        return Ok(found);
    }
    let message = format!("a {} is no feature", name(found));
    Err(Reason::fault("bad-reference", reference, message))
}

/// Adds the features that a reference means to others.
pub(super) fn extend<'d, 't>(
    all: &mut Vec<Single<'d, 't>>,
    reader: &Reader<'d, 't>,
    reference: Node<'d, 't>,
) -> Result<(), Reason> {
    all.extend(singles(reader, reference)?);
    if all.len() <= MOST_OF_A_GROUP {
        return Ok(());
    }
    let message = format!("it names more than {MOST_OF_A_GROUP} features");
    Err(Reason::fault("too-large", reference, message))
}

/// The features that a reference means: itself, or those of a group or pattern, with the name of the group.
fn singles<'d, 't>(
    reader: &Reader<'d, 't>,
    reference: Node<'d, 't>,
) -> Result<Vec<Single<'d, 't>>, Reason> {
    let mut found = Vec::new();
    let mut groups = Vec::new();
    let mut open = vec![(reference, None)];
    while let Some((reference, group)) = open.pop() {
        let node = nominal(reader, reference)?;
        let members = listed(node, "FeatureNominalIds");
        if members.is_empty() {
            found.push((node, group));
        } else {
            if groups.contains(&node.id()) {
                let id = node.attribute("id").unwrap_or_default();
                let message = format!("the group {id} contains itself, or is named twice");
                return Err(Reason::fault("bad-reference", node, message));
            }
            groups.push(node.id());
            let group = text_of(node, "Name").or(group);
            // The last one is taken first: the order of the file remains.
            open.extend(members.into_iter().rev().map(|m| (m, group.clone())));
        }
        if found.len() + open.len() > MOST_OF_A_GROUP {
            let message = format!("it stands for more than {MOST_OF_A_GROUP} features");
            return Err(Reason::fault("too-large", node, message));
        }
    }
    Ok(found)
}
