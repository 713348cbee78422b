//! Units of a QIF file: each length in mm, each angle in rad.

use super::document::{Reader, Reason, child, elements, fixed, name, numbers, shown, text_of};
use roxmltree::Node;
use std::collections::BTreeMap;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

/// Lengths beyond this are a slip of the unit. Unit: mm.
const LONGEST_MM: f64 = 1e7;

/// The units that a file defines.
#[derive(Debug, Clone)]
pub(super) struct Units {
    /// Of lengths without a unit of their own in the model and its features. Unit: mm.
    model_mm: f64,
    /// The same in characteristics. Unit: mm.
    drawing_mm: f64,
    lengths_mm: BTreeMap<String, f64>,
    angle_rad: f64,
    angles_rad: BTreeMap<String, f64>,
    /// Lengths of the model and its features are divided by it.
    scale: f64,
}

/// To which part of a file a length belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum In {
    Model,
    Drawing,
}

impl Units {
    pub fn read(reader: &Reader<'_, '_>, problems: &mut Diagnostics) -> Option<Self> {
        let found = Self::of(reader);
        match found {
            Ok(Some(units)) => Some(units),
            Ok(None) => {
                let message = "the file does not state its unit of length".to_owned();
                let hint = "expected <FileUnits><PrimaryUnits><LinearUnit>";
                problems.error("missing-unit", Place::whole(reader.file), message, hint);
                None
            }
            Err(reason) => {
                let (code, at) = reason.fault.unwrap_or(("unknown-unit", 0));
                let hint = "expected <SIUnitName>meter</SIUnitName> with a positive <Factor>";
                problems.error(code, reader.place_at(at), reason.text, hint);
                None
            }
        }
    }

    fn of(reader: &Reader<'_, '_>) -> Result<Option<Self>, Reason> {
        let root = reader.document.root_element();
        let Some(units) = child(root, "FileUnits") else { return Ok(None) };
        let (mut lengths_mm, mut angles_rad) = (BTreeMap::new(), BTreeMap::new());
        let (mut model, mut drawing, mut angle_rad) = (None, None, 1.0);
        for group in elements(units) {
            let is_primary = name(group) == "PrimaryUnits";
            for unit in elements(group) {
                match name(unit) {
                    "LinearUnit" | "PMILinearUnit" => {
                        let mm = 1e3 * factor(unit, &["meter", "metre"])?;
                        define(&mut lengths_mm, unit, mm)?;
                        match (is_primary, name(unit)) {
                            (true, "LinearUnit") => model = Some(mm),
                            (true, _) => drawing = Some(mm),
                            _ => {}
                        }
                    }
                    "AngularUnit" | "PMIAngularUnit" => {
                        let rad = factor(unit, &["radian"])?;
                        define(&mut angles_rad, unit, rad)?;
                        if is_primary && name(unit) == "AngularUnit" {
                            angle_rad = rad;
                        }
                    }
                    _ => {}
                }
            }
        }
        let Some(model_mm) = model else { return Ok(None) };
        let drawing_mm = drawing.unwrap_or(model_mm);
        let header = child(root, "Product").and_then(|p| child(p, "Header"));
        let scale = match header.and_then(|h| child(h, "ScaleCoefficient")) {
            None => 1.0,
            Some(node) => fixed::<1>(node)?[0],
        };
        if !(1e-6..=1e6).contains(&scale) {
            let node = header.unwrap_or(root);
            let message = format!("a scale of the model of {scale} is not possible");
            return Err(Reason::fault("unknown-unit", node, message));
        }
        Ok(Some(Self { model_mm, drawing_mm, lengths_mm, angle_rad, angles_rad, scale }))
    }

    /// How many mm one unit of an element is.
    fn mm(&self, node: Node<'_, '_>, part: In) -> Result<f64, Reason> {
        let unit_mm = match node.attribute("linearUnit") {
            Some(unit) => *self.lengths_mm.get(unit.trim()).ok_or_else(|| {
                let message = format!("the file does not define the unit `{}`", shown(unit));
                Reason::fault("unknown-unit", node, message)
            })?,
            None if part == In::Model => self.model_mm,
            None => self.drawing_mm,
        };
        // ISO 23952: the scale is of the product and its features, not of what the drawing asks.
        Ok(if part == In::Model { unit_mm / self.scale } else { unit_mm })
    }

    /// The length in an element. Unit: mm.
    pub fn length(&self, node: Node<'_, '_>, part: In) -> Result<f64, Reason> {
        possible(node, fixed::<1>(node)?[0] * self.mm(node, part)?)
    }

    /// The length in a child, if there is one. Unit: mm.
    pub fn length_of(
        &self,
        node: Node<'_, '_>,
        key: &str,
        part: In,
    ) -> Result<Option<f64>, Reason> {
        child(node, key).map(|n| self.length(n, part)).transpose()
    }

    /// The same, of a length that must be positive. Unit: mm.
    pub fn positive_of(
        &self,
        node: Node<'_, '_>,
        key: &str,
        part: In,
    ) -> Result<Option<f64>, Reason> {
        let Some(found) = child(node, key) else { return Ok(None) };
        let value_mm = self.length(found, part)?;
        if value_mm > 0.0 {
            return Ok(Some(value_mm));
        }
        let message = format!("{key} is {value_mm} mm, expected a positive length");
        Err(Reason::fault("not-positive", found, message))
    }

    /// A place of the model. Unit: mm.
    pub fn point(&self, node: Node<'_, '_>) -> Result<Vec3, Reason> {
        let at = Vec3::from(fixed::<3>(node)?) * self.mm(node, In::Model)?;
        possible(node, at.norm())?;
        Ok(at)
    }

    /// The place in a child that must be there. Unit: mm.
    pub fn point_of(&self, node: Node<'_, '_>, key: &str) -> Result<Vec3, Reason> {
        let missing = || Reason::fault("missing-value", node, format!("it has no {key}"));
        self.point(child(node, key).ok_or_else(missing)?)
    }

    /// Places one after another. Unit: mm.
    pub fn points(&self, node: Node<'_, '_>) -> Result<Vec<Vec3>, Reason> {
        let (found, mm) = (numbers(node)?, self.mm(node, In::Model)?);
        Ok(found.chunks_exact(3).map(|c| Vec3::new(c[0], c[1], c[2]) * mm).collect())
    }

    fn rad(&self, node: Node<'_, '_>) -> Result<f64, Reason> {
        match node.attribute("angularUnit") {
            None => Ok(self.angle_rad),
            Some(unit) => self.angles_rad.get(unit.trim()).copied().ok_or_else(|| {
                let message = format!("the file does not define the unit `{}`", shown(unit));
                Reason::fault("unknown-unit", node, message)
            }),
        }
    }

    /// Angles in a child, if there is one. Unit: rad.
    pub fn angles_of<const N: usize>(
        &self,
        node: Node<'_, '_>,
        key: &str,
    ) -> Result<Option<[f64; N]>, Reason> {
        let Some(found) = child(node, key) else { return Ok(None) };
        let rad = self.rad(found)?;
        Ok(Some(fixed::<N>(found)?.map(|a| a * rad)))
    }
}

fn possible(node: Node<'_, '_>, value_mm: f64) -> Result<f64, Reason> {
    if value_mm.abs() <= LONGEST_MM {
        return Ok(value_mm);
    }
    let message = format!("{} is {value_mm:e} mm, which no part has", name(node));
    Err(Reason::fault("not-a-number", node, message))
}

/// How many SI units a unit is.
fn factor(unit: Node<'_, '_>, si: &[&str]) -> Result<f64, Reason> {
    let refuse = |text: String| Err(Reason::fault("unknown-unit", unit, text));
    match text_of(unit, "SIUnitName") {
        Some(base) if si.contains(&&*base) => {}
        Some(base) => {
            return refuse(format!("a {} by `{}`, expected {}", name(unit), shown(&base), si[0]));
        }
        // Nothing says then of what the unit is a multiple: an inch would be read as a metre.
        None => return refuse(format!("a {} without its SIUnitName, {}", name(unit), si[0])),
    }
    // Without a conversion the unit is the SI unit itself.
    let Some(conversion) = child(unit, "UnitConversion") else { return Ok(1.0) };
    let offset = match child(conversion, "Offset") {
        Some(node) => fixed::<1>(node)?[0],
        None => 0.0,
    };
    let factor = match child(conversion, "Factor") {
        Some(node) => fixed::<1>(node)?[0],
        None => return refuse("a conversion of a unit without its Factor".to_owned()),
    };
    if offset != 0.0 || !(factor > 0.0 && factor < 1e6) {
        return refuse(format!("a unit of {factor} {} with offset {offset}", si[0]));
    }
    Ok(factor)
}

/// Names a unit; the same name for two is ambiguous.
fn define(named: &mut BTreeMap<String, f64>, unit: Node<'_, '_>, value: f64) -> Result<(), Reason> {
    let Some(key) = text_of(unit, "UnitName") else { return Ok(()) };
    match named.insert(key.clone(), value) {
        Some(other) if (other / value - 1.0).abs() > 1e-9 => {
            let message = format!("the unit `{}` is defined twice", shown(&key));
            Err(Reason::fault("unknown-unit", unit, message))
        }
        _ => Ok(()),
    }
}
