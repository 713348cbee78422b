//! What moves are as elements of a contour.

use trueaxis_contour::Element;
use trueaxis_contour::plane::{Point, along, dot, length, minus};
use trueaxis_contour::radius::centre;

use super::behaviour::{Behaviour, FeedAt};
use crate::moves::{Arc, Axis, Feed, FeedMode, Frame, Move, MoveKind, Plane, Position};

/// By how much a frame scales its plane; `None` if not equally in all directions.
pub(super) fn scale_of(frame: &Frame, plane: Plane) -> Option<f64> {
    let [a, b, _] = plane.axes();
    let stretched = [a, b].map(|axis| {
        let column = frame.linear.map(|row| row[axis as usize]);
        column.iter().map(|x| x * x).sum::<f64>().sqrt()
    });
    let equal = (stretched[0] - stretched[1]).abs() <= 1e-9 * stretched[0];
    (equal && stretched[0] > 0.0).then_some(stretched[0])
}

/// The element of a contour that a move makes in the plane.
pub(in crate::execution) fn element(plane: Plane, start: &Position, m: &Move) -> Option<Element> {
    let [first, second, third] = plane.axes();
    let (from, to) = ([start[first], start[second]], [m.target[first], m.target[second]]);
    match m.kind {
        MoveKind::Rapid | MoveKind::Linear => Some(Element::line(from, to)),
        MoveKind::Arc(arc) if arc.plane == plane => {
            Some(Element::arc(from, to, arc.center_mm, arc.ccw, arc.turns))
        }
        MoveKind::SpatialArc(arc) if arc.normal[third as usize].abs() > 1.0 - 1e-12 => {
            let center = [arc.center_mm[first as usize], arc.center_mm[second as usize]];
            Some(Element::arc(from, to, center, arc.normal[third as usize] > 0.0, arc.turns))
        }
        _ => None,
    }
}

/// An entry on an arc: it leads from the centre of the tool to its place perpendicular to the end of the
/// written arc, where both have the same tangent. With the chord d from the end to the start and the unit
/// vector e from the end to the written centre, its own centre is at the distance d² / (2 e·d) along e.
/// Its path is that of the centre; the element is at the distance of the tool from it.
pub(super) fn entry_arc(
    from: Point,
    to: Point,
    arc: &Arc,
    left_mm: f64,
) -> Option<(Element, Point)> {
    let written = Element::arc(from, to, arc.center_mm, arc.ccw, arc.turns);
    let end = centre(&written.through(to), 1.0, left_mm);
    let inward = minus(arc.center_mm, to);
    let e = [inward[0] / length(inward), inward[1] / length(inward)];
    let d = minus(from, end);
    let distance = dot(d, d) / (2.0 * dot(e, d));
    let sound = distance > 0.0 && distance < 1e9;
    let center = along(end, e, distance);
    sound.then(|| (Element::arc(from, to, center, arc.ccw, arc.turns).through(to), center))
}

/// The feed of the centre of the tool.
pub(super) fn feed_of_centre(
    element: &Element,
    m: &Move,
    (start, axis): (Position, Axis),
    left_mm: f64,
    behaviour: Behaviour,
) -> Feed {
    let value = match (m.feed.mode, *element) {
        (FeedMode::InverseTime, _) => {
            // The time is that of the written move; the corner before it has the same feed.
            let across = m.target[axis] - start[axis];
            let path_mm = element.length_mm().hypot(across);
            return Feed { mode: FeedMode::PerMinute, value: m.feed.value * path_mm };
        }
        (_, Element::Arc { radius_mm, sweep_rad, .. }) if behaviour.feed_at != FeedAt::Centre => {
            let factor = (radius_mm - left_mm * sweep_rad.signum()) / radius_mm;
            let most = if behaviour.feed_at == FeedAt::Inside { 1.0 } else { f64::INFINITY };
            m.feed.value * factor.min(most)
        }
        _ => return m.feed,
    };
    Feed { value, ..m.feed }
}
