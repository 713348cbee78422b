//! Slots and tongues: two planes that face each other, or away from each other.

use super::super::document::{Reader, Reason, child, direction};
use super::super::text::millimetres;
use super::super::topology::{Face, Loop, Rectangle, around, forward};
use super::super::units::{In, Units};
use super::plane::{any_along, is_along};
use super::{Form, Read, faces, is_hole};
use roxmltree::Node;
use trueaxis_geometry::Vec3;

/// A face whose vertices lie farther from a side of the feature is another one. Unit: mm.
const OFF_SIDE_MM: f64 = 0.01;

/// `OppositeParallelPlanesFeatureNominal`: the plane in the middle, midway between the ends; where its faces lie along the depth only they say.
pub(in super::super) fn read<'d>(
    reader: &Reader<'d, '_>,
    units: &Units,
    node: Node<'d, '_>,
    definition: Node<'d, '_>,
) -> Result<Read, Reason> {
    let is_hole = is_hole(definition)?;
    let missing = || Reason::fault("missing-value", node, "it has no CenterPlane");
    let middle = child(node, "CenterPlane").ok_or_else(missing)?;
    let (at_mm, across) = (units.point_of(middle, "Point")?, direction(middle, "Normal")?);
    let stated = child(node, "LengthVector").map(|_| direction(node, "LengthVector"));
    let along = stated.transpose()?;
    let width_mm = units.positive_of(definition, "Width", In::Model)?;
    let (faces, mut notes) = faces(reader, units, node);
    let mut slot = Slot { at_mm, across, along, size_mm: None };
    let sides = width_mm.and_then(|width_mm| sides(&faces, &at_mm, &(across * (0.5 * width_mm))));
    match sides {
        Some(sides) => {
            // Those of a slot look to each other, those of a tongue away from each other.
            let out = if is_hole { -across } else { across };
            let against = |faces: &[&Face], out: Vec3| {
                faces.iter().filter_map(|f| f.normal).any(|n| n.dot(&out) < 0.0)
            };
            if against(&sides[0], out) || against(&sides[1], -out) {
                notes.push("its faces look the other way: is it a slot or a tongue?".to_owned());
            }
            slot.between(&sides, &mut notes);
        }
        None => {
            if !faces.is_empty() {
                notes.push("its faces are not its two sides and are not used".to_owned());
            }
            slot.without_faces(units, definition, &mut notes)?;
        }
    }
    if width_mm.is_none() {
        notes.push("width: the file does not state it".to_owned());
    }
    let Slot { at_mm, along, size_mm, .. } = slot;
    Ok((Form::Slot { is_hole, at_mm, across, along, width_mm, size_mm }, notes))
}

struct Slot {
    at_mm: Vec3,
    across: Vec3,
    along: Option<Vec3>,
    size_mm: Option<[f64; 2]>,
}

/// The faces on the one side and on the other, if all are on one of them and none of the sides is empty.
fn sides<'f>(faces: &'f [Face], at_mm: &Vec3, half_mm: &Vec3) -> Option<[Vec<&'f Face>; 2]> {
    let across = half_mm.normalize();
    let on = |side: f64| {
        let is_on = move |p: Vec3| (p - at_mm - half_mm * side).dot(&across).abs() < OFF_SIDE_MM;
        let is_of = move |f: &&Face| f.outer.is_some() && f.corners().all(is_on);
        faces.iter().filter(is_of).collect::<Vec<_>>()
    };
    let [one, other] = [1.0, -1.0].map(on);
    let is_all = one.len() + other.len() == faces.len() && !one.is_empty() && !other.is_empty();
    is_all.then_some([one, other])
}

impl Slot {
    /// What both sides have: points are checked in pairs that face each other.
    fn between(&mut self, sides: &[Vec<&Face>; 2], notes: &mut Vec<String>) {
        let rectangle = |faces: &Vec<&Face>| match faces[..] {
            [face] => face.outer.as_ref().and_then(Loop::rectangle),
            _ => None,
        };
        let both = [rectangle(&sides[0]), rectangle(&sides[1])];
        let own = both.iter().flatten().map(|r| r.along).next();
        let along = self.along.or(own).unwrap_or_else(|| any_along(&self.across));
        let of = |faces: &Vec<&Face>| {
            let corners: Vec<Vec3> = faces.iter().flat_map(|f| f.corners()).collect();
            around(&corners, &self.across, &along)
        };
        let (Some(one), Some(other)) = (of(&sides[0]), of(&sides[1])) else { return };
        let along = one.along;
        let edges = [along, self.across.cross(&along)];
        // Along each edge from the larger beginning to the smaller end.
        let common = [0, 1].map(|k| {
            let ends = |r: &Rectangle| {
                let middle = r.at_mm.dot(&edges[k]);
                [middle - 0.5 * r.size_mm[k], middle + 0.5 * r.size_mm[k]]
            };
            let ([a, b], [c, d]) = (ends(&one), ends(&other));
            [a.max(c), b.min(d)]
        });
        if common.iter().any(|[from, to]| from >= to) {
            notes.push("size: its sides do not face each other".to_owned());
            return;
        }
        let height = self.at_mm.dot(&self.across);
        let middles = common.iter().zip(edges).map(|([from, to], e)| e * (0.5 * (from + to)));
        self.at_mm = middles.fold(self.across * height, |sum, part| sum + part);
        self.along = Some(forward(along));
        let size_mm = common.map(|[from, to]| to - from);
        let is_exact = both.iter().all(|r| r.is_some_and(|r| is_along(&r, &along)));
        if is_exact {
            self.size_mm = Some(size_mm);
        } else {
            let [first, second] = size_mm.map(millimetres);
            notes.push(format!(
                "size: its sides are no rectangles; their corners fill {first} {second} mm, write the rectangle to check"
            ));
        }
    }

    /// The lengths that the feature itself states; where along the depth its point lies it does not.
    fn without_faces(
        &mut self,
        units: &Units,
        definition: Node<'_, '_>,
        notes: &mut Vec<String>,
    ) -> Result<(), Reason> {
        let length_mm = units.positive_of(definition, "Length", In::Model)?;
        let depth_mm = units.positive_of(definition, "Depth", In::Model)?;
        let stated =
            |name: &str, mm: Option<f64>| mm.map(|mm| format!("{name} {} mm", millimetres(mm)));
        let known: Vec<String> = [stated("length", length_mm), stated("depth", depth_mm)]
            .into_iter()
            .flatten()
            .collect();
        notes.push(match known.is_empty() {
            true => "size: the file does not state it; move `at` to the middle".to_owned(),
            false => format!(
                "size: the file states {}, not where along the depth its point lies; move `at` to the middle",
                known.join(", ")
            ),
        });
        Ok(())
    }
}
