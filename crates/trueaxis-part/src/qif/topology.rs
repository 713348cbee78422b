//! Faces of the model: their edges, and the rectangles and circles that these make.

use super::document::{Reader, Reason, child, elements, is_set, listed, name};
use super::units::{In, Units};
use roxmltree::Node;
use trueaxis_geometry::Vec3;

/// Places of a model that lie nearer to each other are one. Unit: mm.
pub(super) const SAME_MM: f64 = 1e-3;
/// Directions of a model that differ by less are the same. Unit: rad.
const SAME_RAD: f64 = 1e-5;

/// A face with its loops.
#[derive(Debug, Clone)]
pub(super) struct Face {
    pub id: String,
    /// Its border, where the file gives it.
    pub outer: Option<Loop>,
    pub inner: Vec<Loop>,
    /// Out of the material, of a plane.
    pub normal: Option<Vec3>,
    /// A direction of a plane's own.
    pub along: Option<Vec3>,
}

/// Edges around a face or around an opening in it.
#[derive(Debug, Clone)]
pub(super) struct Loop {
    pub id: String,
    pub edges: Vec<Edge>,
}

/// An edge in the direction of its loop.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    pub from_mm: Vec3,
    pub to_mm: Vec3,
    pub curve: Curve,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Curve {
    Straight,
    Arc { centre_mm: Vec3, radius_mm: f64 },
    Other,
}

/// A rectangle in a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    pub at_mm: Vec3,
    pub along: Vec3,
    pub size_mm: [f64; 2],
}

impl Face {
    /// Its vertices.
    pub fn corners(&self) -> impl Iterator<Item = Vec3> {
        let edges = self.outer.iter().chain(&self.inner).flat_map(|l| &l.edges);
        edges.flat_map(|e| [e.from_mm, e.to_mm])
    }

    /// A face of the model with its loops.
    pub fn read<'d>(
        reader: &Reader<'d, '_>,
        units: &Units,
        node: Node<'d, '_>,
    ) -> Result<Self, Reason> {
        let loops = listed(node, "LoopIds");
        let mut read = Vec::new();
        for reference in &loops {
            let found = reader.target(*reference, "Loop")?;
            read.push((found, Loop::read(reader, units, found)?));
        }
        // The loop that says so is the border, else the first one, unless the face has none.
        let says_outer = |n: Node<'_, '_>| n.attribute("form") == Some("OUTER");
        let has_none = matches!(node.attribute("hasOuter"), Some("0" | "false"));
        let outer = match read.iter().position(|(n, _)| says_outer(*n)) {
            Some(index) => Some(index),
            None if has_none || read.is_empty() => None,
            None => Some(0),
        };
        let outer = outer.map(|index| read.remove(index).1);
        let inner = read.into_iter().map(|(_, l)| l).collect();
        let (normal, along) = plane_of(reader, node)?.unzip();
        let id = node.attribute("id").unwrap_or_default().to_owned();
        Ok(Self { id, outer, inner, normal, along })
    }
}

/// The normal out of the material and the first direction of a face in a plane.
fn plane_of<'d>(
    reader: &Reader<'d, '_>,
    face: Node<'d, '_>,
) -> Result<Option<(Vec3, Vec3)>, Reason> {
    let Some(surface) = reader.follow(face, "Surface", "")? else { return Ok(None) };
    let core = child(surface, "Plane23Core");
    // A transformation turns the directions of the surface, not the vertices of the face.
    let (Some(core), None) = (core, child(surface, "Transform")) else { return Ok(None) };
    let first = super::document::direction(core, "DirU")?;
    let second = super::document::direction(core, "DirV")?;
    let sign = if is_set(face, "turned") { -1.0 } else { 1.0 };
    Ok((first.cross(&second) * sign).try_normalize(1e-6).map(|normal| (normal, first)))
}

impl Loop {
    fn read<'d>(
        reader: &Reader<'d, '_>,
        units: &Units,
        node: Node<'d, '_>,
    ) -> Result<Self, Reason> {
        let mut edges = Vec::new();
        let Some(list) = child(node, "CoEdges") else {
            return Err(Reason::plain("a loop of a mesh"));
        };
        for coedge in elements(list).filter(|n| name(*n) == "CoEdge") {
            let Some(oriented) = child(coedge, "EdgeOriented") else { continue };
            reader.spend(node, 1)?;
            edges.push(Edge::read(reader, units, oriented)?);
        }
        Ok(Self { id: node.attribute("id").unwrap_or_default().to_owned(), edges })
    }

    /// The corners of a loop of straight edges that closes, without those in the middle of a side.
    fn polygon(&self) -> Option<Vec<Vec3>> {
        let is_straight = |e: &Edge| e.curve == Curve::Straight;
        (self.is_closed() && self.edges.iter().all(is_straight))
            .then(|| self.edges.iter().map(|e| e.from_mm).collect())
    }

    /// Whether each edge begins where the one before ends.
    fn is_closed(&self) -> bool {
        let next = self.edges.iter().cycle().skip(1);
        self.edges.iter().zip(next).all(|(a, b)| (a.to_mm - b.from_mm).norm() < SAME_MM)
    }

    /// The rectangle that the loop is.
    pub fn rectangle(&self) -> Option<Rectangle> {
        rectangle(&self.polygon()?)
    }

    /// Centre and diameter of the circle that the loop is.
    pub fn circle(&self) -> Option<(Vec3, f64)> {
        let Curve::Arc { centre_mm, radius_mm } = self.edges.first()?.curve else { return None };
        let is_of_it = |e: &Edge| match e.curve {
            Curve::Arc { centre_mm: c, radius_mm: r } => {
                (c - centre_mm).norm() < SAME_MM && (r - radius_mm).abs() < SAME_MM
            }
            _ => false,
        };
        let is_one = self.is_closed() && self.edges.iter().all(is_of_it);
        is_one.then_some((centre_mm, 2.0 * radius_mm))
    }
}

impl Edge {
    fn read<'d>(
        reader: &Reader<'d, '_>,
        units: &Units,
        oriented: Node<'d, '_>,
    ) -> Result<Self, Reason> {
        let edge = reader.target(child(oriented, "Id").unwrap_or(oriented), "Edge")?;
        let end = |key: &str| {
            let vertex = reader.needed(edge, key, "Vertex")?;
            units.point_of(reader.needed(vertex, "Point", "Point")?, "XYZ")
        };
        let (mut from_mm, mut to_mm) = (end("VertexBeg")?, end("VertexEnd")?);
        let curve = match reader.follow(edge, "Curve", "")? {
            Some(curve) => Curve::read(reader, units, curve, [from_mm, to_mm])?,
            None => Curve::Other,
        };
        if is_set(oriented, "turned") {
            std::mem::swap(&mut from_mm, &mut to_mm);
        }
        Ok(Self { from_mm, to_mm, curve })
    }
}

impl Curve {
    fn read(
        reader: &Reader<'_, '_>,
        units: &Units,
        node: Node<'_, '_>,
        ends: [Vec3; 2],
    ) -> Result<Self, Reason> {
        let Some(core) = elements(node).find(|n| name(*n).ends_with("Core")) else {
            return Ok(Self::Other);
        };
        if child(node, "Transform").is_some() {
            return Ok(Self::Other);
        }
        Ok(match name(core) {
            "Segment13Core" => Self::Straight,
            "ArcCircular13Core" => {
                let centre_mm = units.point_of(core, "Center")?;
                match units.length_of(core, "Radius", In::Model)? {
                    Some(radius_mm) if radius_mm > 0.0 => Self::Arc { centre_mm, radius_mm },
                    _ => Self::Other,
                }
            }
            // A spline lies within its control points: where they are on a line, it is straight.
            "Nurbs13Core" => {
                let Some(node) = child(core, "CPs") else { return Ok(Self::Other) };
                let points = units.points(node)?;
                reader.spend(node, points.len())?;
                if on_a_line(&points, ends) { Self::Straight } else { Self::Other }
            }
            _ => Self::Other,
        })
    }
}

fn on_a_line(points: &[Vec3], [from, to]: [Vec3; 2]) -> bool {
    let Some(along) = (to - from).try_normalize(SAME_MM) else { return false };
    let off = |p: &Vec3| {
        let arm = p - from;
        (arm - along * arm.dot(&along)).norm()
    };
    !points.is_empty() && points.iter().all(|p| off(p) < 0.1 * SAME_MM)
}

/// The rectangle of these corners, the longer edge first.
pub(super) fn rectangle(corners: &[Vec3]) -> Option<Rectangle> {
    let count = corners.len();
    let side = |k: usize| (corners[(k + 1) % count] - corners[k % count]).try_normalize(SAME_MM);
    let mut sharp = Vec::new();
    for (k, corner) in corners.iter().enumerate() {
        let (before, after) = (side(k + count - 1)?, side(k)?);
        if before.cross(&after).norm() > SAME_RAD {
            sharp.push(*corner);
        } else if before.dot(&after) < 0.0 {
            return None;
        }
    }
    let [a, b, c, d] = sharp[..] else { return None };
    let (first, second) = (b - a, c - b);
    let is_right = first.normalize().dot(&second.normalize()).abs() < SAME_RAD;
    if !is_right || (a + c - b - d).norm() > SAME_MM {
        return None;
    }
    let at_mm = (a + b + c + d) * 0.25;
    let (lengths, along) = match first.norm() >= second.norm() * (1.0 - 1e-9) {
        true => ([first.norm(), second.norm()], first.normalize()),
        false => ([second.norm(), first.norm()], second.normalize()),
    };
    Some(Rectangle { at_mm, along: forward(along), size_mm: lengths })
}

/// A direction or its opposite, so that its largest component is positive.
pub(super) fn forward(direction: Vec3) -> Vec3 {
    if direction[direction.iamax()] < 0.0 { -direction } else { direction }
}

/// The rectangle around places in a plane, along a direction.
pub(super) fn around(places: &[Vec3], normal: &Vec3, along: &Vec3) -> Option<Rectangle> {
    let along = (along - normal * normal.dot(along)).try_normalize(1e-6)?;
    let across = normal.cross(&along);
    let first = places.first()?;
    let range = |direction: &Vec3| {
        let heights = places.iter().map(|p| (p - first).dot(direction));
        heights.fold((f64::MAX, f64::MIN), |(low, high), h| (low.min(h), high.max(h)))
    };
    let ((low, high), (left, right)) = (range(&along), range(&across));
    let at_mm = first + along * (0.5 * (low + high)) + across * (0.5 * (left + right));
    Some(Rectangle { at_mm, along, size_mm: [high - low, right - left] })
}
