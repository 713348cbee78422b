//! Strokes of a cutter, and bores.
//!
//! Places have the two coordinates of the plane and the height; a path is that of the centre of the cutter.

use trueaxis_contour::plane::along;

use crate::Point;

/// Strokes of one cycle: more than any program means.
pub const MOST_STROKES: usize = 1_000_000;

/// One stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stroke {
    /// As fast as the machine can, to a place, mm.
    Rapid([f64; 3]),
    /// With the feed of the plane, to a place, mm.
    Line([f64; 3]),
    /// With the feed of the depth, to a place, mm.
    Plunge([f64; 3]),
    /// A circle or helix with the feed of the plane.
    Arc {
        /// Its end, mm.
        to: [f64; 3],
        /// Its centre, mm.
        center: Point,
        /// Counter-clockwise.
        ccw: bool,
        /// The feed of the depth instead: a helix into the material.
        plunges: bool,
    },
}

fn at(p: Point, height: f64) -> [f64; 3] {
    [p[0], p[1], height]
}

/// The heights of a pocket or face, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heights {
    /// Where the tool goes in rapid traverse.
    pub safe_mm: f64,
    /// The surface.
    pub top_mm: f64,
    /// The bottom.
    pub bottom_mm: f64,
    /// The deepest layer; the layers are as deep as each other.
    pub layer_mm: f64,
}

impl Heights {
    /// The heights of the layers, the bottom last; `None` if they are too many.
    pub fn layers(&self) -> Option<Vec<f64>> {
        let depth = self.top_mm - self.bottom_mm;
        let count = if self.layer_mm > 0.0 { (depth / self.layer_mm - 1e-9).ceil() } else { 1.0 };
        if count.is_nan() || count >= 1e5 {
            return None;
        }
        let count = count.max(1.0) as u32;
        let height = |i: u32| self.top_mm - depth * f64::from(i) / f64::from(count);
        Some((1..=count).map(height).collect())
    }
}

/// A hole larger than the tool, by a helix: from the centre out, down, once around at the bottom and back.
///
/// `radius_mm` is that of the path of the centre of the cutter, `pitch_mm` the depth of each turn.
pub fn bore(center: Point, radius_mm: f64, heights: &Heights, ccw: bool) -> Option<Vec<Stroke>> {
    let Heights { safe_mm, bottom_mm, layer_mm, .. } = *heights;
    let (side, other) =
        (along(center, [1.0, 0.0], radius_mm), along(center, [-1.0, 0.0], radius_mm));
    let middle = along(center, [0.5, 0.0], radius_mm);
    let arc = |to: Point, height: f64, about: Point, plunges| Stroke::Arc {
        to: at(to, height),
        center: about,
        ccw,
        plunges,
    };
    let depth = safe_mm - bottom_mm;
    let turns = if layer_mm > 0.0 { (depth / layer_mm - 1e-9).ceil().max(1.0) } else { 1.0 };
    if turns.is_nan() || turns >= 1e5 {
        return None;
    }
    let mut strokes = vec![Stroke::Rapid(at(center, safe_mm)), arc(side, safe_mm, middle, false)];
    let half = depth / (2.0 * turns);
    for i in 0..turns as u32 {
        let height = safe_mm - 2.0 * half * f64::from(i);
        strokes.push(arc(other, height - half, center, true));
        strokes.push(arc(side, height - 2.0 * half, center, true));
    }
    strokes.push(arc(other, bottom_mm, center, false));
    strokes.push(arc(side, bottom_mm, center, false));
    strokes.push(arc(center, bottom_mm, middle, false));
    Some(strokes)
}

/// Radii from the first one on by steps up to the last one, which is among them.
pub fn growing(first_mm: f64, last_mm: f64, step_mm: f64) -> Vec<f64> {
    let mut radii = vec![first_mm];
    let mut radius = first_mm + step_mm;
    while step_mm > 0.0 && radius < last_mm - 1e-9 {
        radii.push(radius);
        radius += step_mm;
    }
    radii.extend((last_mm > first_mm).then_some(last_mm));
    radii
}

/// Circles about a centre at a height: down to it, on a half circle to the first one, and back from the last one.
pub fn circles_about(center: Point, height: f64, radii: &[f64], ccw: bool) -> Vec<Stroke> {
    let place = |x: f64| [center[0] + x, center[1], height];
    let arc = |x: f64, about: f64| {
        let center = [center[0] + about, center[1]];
        Stroke::Arc { to: place(x), center, ccw, plunges: false }
    };
    let mut strokes = vec![Stroke::Plunge(place(0.0))];
    for (i, r) in radii.iter().enumerate() {
        strokes.push(if i == 0 { arc(*r, r / 2.0) } else { Stroke::Line(place(*r)) });
        strokes.extend([arc(-r, 0.0), arc(*r, 0.0)]);
    }
    let out = radii.last().copied().unwrap_or(0.0);
    strokes.push(arc(0.0, out / 2.0));
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEIGHTS: Heights = Heights { safe_mm: 2.0, top_mm: 0.0, bottom_mm: -5.0, layer_mm: 2.0 };

    /// The places at the bottom.
    fn bottom(strokes: &[Stroke]) -> Vec<Point> {
        let place = |s: &Stroke| match s {
            Stroke::Rapid(p) | Stroke::Line(p) | Stroke::Plunge(p) | Stroke::Arc { to: p, .. } => {
                *p
            }
        };
        strokes.iter().map(place).filter(|p| p[2] == -5.0).map(|p| [p[0], p[1]]).collect()
    }

    #[test]
    fn layers_are_alike() {
        let layers = HEIGHTS.layers().unwrap();
        assert!(layers.len() == 3 && (layers[0] + 5.0 / 3.0).abs() < 1e-12 && layers[2] == -5.0);
        assert_eq!(Heights { layer_mm: 1e-9, ..HEIGHTS }.layers(), None);
    }

    #[test]
    fn a_bore_ends_with_a_full_circle_at_its_bottom() {
        let strokes = bore([10.0, 20.0], 4.0, &HEIGHTS, true).unwrap();
        // 7 mm by at most 2 mm a turn: 4 turns of two halves.
        let down =
            strokes.iter().filter(|s| matches!(s, Stroke::Arc { plunges: true, .. })).count();
        assert_eq!(down, 8);
        let last = bottom(&strokes);
        assert_eq!(last, [[14.0, 20.0], [6.0, 20.0], [14.0, 20.0], [10.0, 20.0]]);
    }
}
