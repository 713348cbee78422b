//! `[[model]]`: the solid models of the bodies, each with the placement of its coordinate system.

use super::{positive, read_pose, read_vector_mm};
use crate::chain::{ChainBody, Link};
use crate::models::{Model, Shape, ToolSegment};
use trueaxis_input::{Dimension, Item, QuantityError, Section, Unit, parse_quantity};

const SHAPES: &str = "write one of: stl = \"models/ram.stl\", box = \"400 200 100 mm\", \
    cylinder = \
                      { diameter = \"80 mm\", length = \"120 mm\" }, cone = { base, top, length }, \
                      prism = { outline, length }";
/// An outline is checked against itself corner by corner; more belongs into an STL file.
const MOST_CORNERS: usize = 200;

/// Reads every `[[model]]` of the machine file.
pub(super) fn read_models(root: &Section<'_>, bodies: &[ChainBody]) -> Vec<Model> {
    let mut models: Vec<Model> = Vec::new();
    let Some(items) = root.get("model").and_then(|item| item.list()) else {
        return models;
    };
    for item in items {
        let Some(Some(model)) = item.section("model", |s| read_model(s, bodies, &models)) else {
            continue;
        };
        models.push(model);
    }
    models
}

fn read_model(section: &Section<'_>, bodies: &[ChainBody], before: &[Model]) -> Option<Model> {
    let node = section.require("body", &node_hint(bodies)).and_then(|i| read_node(&i, bodies));
    let placement = section.get("placement").map_or(Some(Link::identity()), |i| read_pose(&i));
    let shape = read_shape(section);
    let given = section.get("name");
    let name = given.and_then(|i| i.text());
    let (node, placement, shape) = (node?, placement?, shape?);
    let name = name.map_or_else(|| numbered(node, bodies, before), str::to_owned);
    if before.iter().any(|m| m.name == name) {
        let message = format!("two models are called `{name}`");
        let hint = "give each model its own name; reports refer to it";
        match given {
            Some(item) => item.error("duplicate-model", message, hint),
            None => section.error("duplicate-model", message, hint),
        }
    }
    Some(Model { name, body: node, placement, shape })
}

/// Jiang et al. number the models of a node: `X 1`, `X 2`.
fn numbered(node: Option<usize>, bodies: &[ChainBody], before: &[Model]) -> String {
    let letter = node.map_or_else(|| "b".to_owned(), |i| bodies[i].name.to_string());
    let count = before.iter().filter(|m| m.body == node).count();
    format!("{letter} {}", count + 1)
}

fn node_hint(bodies: &[ChainBody]) -> String {
    let names: Vec<String> = bodies.iter().map(|b| b.name.to_string()).collect();
    format!("write the body that carries the model: b (bed), {}", names.join(", "))
}

fn read_node(item: &Item<'_>, bodies: &[ChainBody]) -> Option<Option<usize>> {
    let text = item.text()?;
    if text == "b" {
        return Some(None);
    }
    let found = bodies.iter().position(|b| b.name.to_string() == text);
    if found.is_none() {
        let message = format!("the chain has no body `{text}`");
        item.error("unknown-body", message, &node_hint(bodies));
    }
    found.map(Some)
}

/// The one shape that a section describes: `stl`, `box`, `cylinder`, `cone` or `prism`.
pub fn read_shape(section: &Section<'_>) -> Option<Shape> {
    let stl = section.get("stl");
    let cuboid = section.get("box");
    let cylinder = section.get("cylinder");
    let cone = section.get("cone");
    let prism = section.get("prism");
    let unit = section.get("unit");
    let all = [&stl, &cuboid, &cylinder, &cone, &prism];
    let count = all.iter().filter(|shape| shape.is_some()).count();
    if count != 1 {
        let code = if count == 0 { "missing-key" } else { "two-shapes" };
        section.error(code, format!("a model needs exactly one shape, found {count}"), SHAPES);
        return None;
    }
    if let (Some(unit), None) = (&unit, &stl) {
        unit.error("no-effect", "`unit` applies to STL files only".into(), "remove the entry");
    }
    if let Some(item) = stl {
        return read_stl(&item, unit.as_ref());
    }
    if let Some(item) = cuboid {
        return read_box(&item);
    }
    let about_z = |item: Item<'_>, key: &str, reader: fn(&Section<'_>) -> Option<Shape>| {
        item.section(&section.path(key), reader).flatten()
    };
    if let Some(item) = cylinder {
        return about_z(item, "cylinder", read_cylinder);
    }
    if let Some(item) = cone {
        return about_z(item, "cone", read_cone);
    }
    prism.and_then(|item| about_z(item, "prism", read_prism))
}

const OTHER_FORMS: &str = "save the model as STL from the CAD system, in mm and in the coordinate system of the model, or \
     describe it by box, cylinder, cone or prism";

/// The name of a form of models that is not STL, by the ending of the file.
fn other_form(path: &str) -> Option<&'static str> {
    let ending = path.rsplit_once('.')?.1.to_ascii_lowercase();
    match ending.as_str() {
        "igs" | "iges" => Some("IGES"),
        "stp" | "step" => Some("STEP"),
        "obj" => Some("OBJ"),
        "3mf" => Some("3MF"),
        "wrl" => Some("VRML"),
        _ => None,
    }
}

fn read_stl(item: &Item<'_>, unit: Option<&Item<'_>>) -> Option<Shape> {
    let path = item.text()?;
    if path.trim().is_empty() {
        item.error("empty-path", "the path of the STL file is empty".into(), SHAPES);
        return None;
    }
    if let Some(form) = other_form(path) {
        let message = format!("{form} files are not read: a model is an STL file or a simple body");
        item.error("model-form", message, OTHER_FORMS);
        return None;
    }
    let unit_mm = match unit {
        None => 1.0,
        Some(item) => match Unit::find(item.text()?, Dimension::Length) {
            Ok(unit) => unit.to_inner(1.0),
            Err(e) => {
                item.error(e.code(), e.to_string(), &e.hint());
                return None;
            }
        },
    };
    Some(Shape::Stl { path: path.to_owned(), unit_mm })
}

fn read_box(item: &Item<'_>) -> Option<Shape> {
    let size_mm = read_vector_mm(item)?;
    if size_mm.iter().any(|edge| *edge <= 0.0) {
        item.error("not-positive", "the edges of a box must be above zero".into(), SHAPES);
        return None;
    }
    Some(Shape::Box { size_mm })
}

fn required(section: &Section<'_>, key: &str) -> Option<f64> {
    section.require(key, "write a length above zero, such as \"80 mm\"");
    positive(section, key, Dimension::Length)
}

fn read_cylinder(section: &Section<'_>) -> Option<Shape> {
    let (diameter, length) = (required(section, "diameter"), required(section, "length"));
    let (diameter_mm, length_mm) = (diameter?, length?);
    Some(Shape::Cone { base_diameter_mm: diameter_mm, top_diameter_mm: diameter_mm, length_mm })
}

fn read_cone(section: &Section<'_>) -> Option<Shape> {
    let hint = "write the diameter at this end, such as \"80 mm\", or \"0 mm\" for a point";
    let diameter = |key| {
        let item = section.require(key, hint)?;
        let value = item.quantity(Dimension::Length)?;
        if value < 0.0 {
            item.error("not-positive", format!("`{key}` must not be below zero"), hint);
            return None;
        }
        Some(value)
    };
    let (base, top, length) = (diameter("base"), diameter("top"), required(section, "length"));
    let (base_diameter_mm, top_diameter_mm, length_mm) = (base?, top?, length?);
    if base_diameter_mm == 0.0 && top_diameter_mm == 0.0 {
        section.error(
            "not-positive",
            "one of the two diameters of a cone must be above zero".into(),
            hint,
        );
        return None;
    }
    Some(Shape::Cone { base_diameter_mm, top_diameter_mm, length_mm })
}

fn read_prism(section: &Section<'_>) -> Option<Shape> {
    let hint = "write the corners in order: outline = [\"0 0 mm\", \"100 0 mm\", \"0 50 mm\"]";
    let length = required(section, "length");
    let item = section.require("outline", hint)?;
    let corners: Vec<_> = item.list()?.iter().map(read_corner).collect();
    let outline_mm = corners.into_iter().collect::<Option<Vec<_>>>()?;
    if !(3..=MOST_CORNERS).contains(&outline_mm.len()) {
        let message = format!("an outline needs 3 to {MOST_CORNERS} corners");
        item.error("bad-outline", message, hint);
        return None;
    }
    if crosses_itself(&outline_mm) {
        let message = "the outline crosses or touches itself".to_owned();
        item.error("bad-outline", message, "write each corner once, in order around the outline");
        return None;
    }
    Some(Shape::Prism { outline_mm, length_mm: length? })
}

fn read_corner(item: &Item<'_>) -> Option<[f64; 2]> {
    let words: Vec<&str> = item.text()?.split_whitespace().collect();
    let refuse = |message: String| {
        item.error("bad-outline", message, "write a corner as \"100 50 mm\"");
        None
    };
    let [x, y, unit] = words[..] else {
        return refuse("a corner needs two lengths and their unit".into());
    };
    let number = |word: &str| {
        let unit = Unit::find(unit, Dimension::Length)?;
        parse_quantity(word, Dimension::Ratio).and_then(|v| unit.checked(v))
    };
    let corner: Result<[f64; 2], QuantityError> = number(x).and_then(|x| Ok([x, number(y)?]));
    corner.map_or_else(|e| refuse(e.to_string()), Some)
}

/// Whether two edges that are not neighbours meet, or neighbours fold back onto each other.
fn crosses_itself(outline: &[[f64; 2]]) -> bool {
    let n = outline.len();
    let edge = |i: usize| (outline[i], outline[(i + 1) % n]);
    (0..n).any(|i| {
        let (a, b) = edge(i);
        let (_, next) = edge((i + 1) % n);
        let folds = turn(a, b, next) == 0.0 && dot(a, b, next) <= 0.0;
        let meets = |k: usize| {
            let apart = k != i && (k + 1) % n != i && (i + 1) % n != k;
            apart && segments_meet((a, b), edge(k))
        };
        a == b || folds || (0..n).any(meets)
    })
}

/// Twice the area of the triangle: above zero for a left turn.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// `(b − a)·(c − b)`.
fn dot(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1])
}

type Edge = ([f64; 2], [f64; 2]);

fn segments_meet((a, b): Edge, (c, d): Edge) -> bool {
    let overlap = |i: usize| a[i].min(b[i]) <= c[i].max(d[i]) && c[i].min(d[i]) <= a[i].max(b[i]);
    let across = |a, b, c, d| turn(a, b, c) * turn(a, b, d) <= 0.0;
    overlap(0) && overlap(1) && across(a, b, c, d) && across(c, d, a, b)
}

/// `shape = [["10 mm", "60 mm"], ["50 mm", "40 mm"]]`: diameter and length, from the tip upwards.
pub fn read_tool_shape(section: &Section<'_>) -> Option<Vec<ToolSegment>> {
    let hint = "write diameter and length of each segment from the tip upwards: [[\"10 mm\", \"60 \
        mm\"], …]";
    let item = section.get("shape")?;
    let read = |item: &Item<'_>| {
        let pair = item.list()?;
        let [diameter, length] = &pair[..] else {
            item.error("bad-tool", "a segment needs a diameter and a length".into(), hint);
            return None;
        };
        let length_of = |item: &Item<'_>| {
            let value = item.quantity(Dimension::Length)?;
            if value <= 0.0 {
                item.error(
                    "not-positive",
                    "diameter and length of a segment must be above zero".into(),
                    hint,
                );
                return None;
            }
            Some(value)
        };
        let (diameter, length) = (length_of(diameter), length_of(length));
        Some(ToolSegment { diameter_mm: diameter?, length_mm: length? })
    };
    let segments: Vec<_> = item.list()?.iter().map(read).collect();
    if segments.is_empty() {
        item.error("bad-tool", "the shape of the tool has no segment".into(), hint);
    }
    segments.into_iter().collect()
}

/// Warns where the diameter of a tool is not that of the first cylinder of its shape, the cutter.
pub fn compare_with_shape(section: &Section<'_>, diameter_mm: Option<f64>, shape: &[ToolSegment]) {
    const SAME_MM: f64 = 1e-6;
    let (Some(diameter), Some(first)) = (diameter_mm, shape.first()) else { return };
    if (diameter - first.diameter_mm).abs() > SAME_MM {
        let message = format!(
            "the tool has a diameter of {diameter} mm, and its shape begins with one of {} mm",
            first.diameter_mm
        );
        let hint = "`diameter` cuts and is compensated, `shape` is what collides: the first cylinder is the cutter";
        section.warn("diameter-not-of-shape", message, hint);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_that_cross_are_seen() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        let spike = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 2.0]];
        assert!(!crosses_itself(&square));
        assert!(crosses_itself(&bow));
        assert!(crosses_itself(&spike));
    }
}
