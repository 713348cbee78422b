//! What a cutter sweeps, by the distance of points from its path: independent of how the path is made.

use trueaxis_contour::Element;
use trueaxis_cycles::Point;
use trueaxis_cycles::mill::Stroke;

/// A piece of the path of the centre, with the heights of its ends.
pub struct Piece {
    pub element: Element,
    pub heights: [f64; 2],
    pub rapid: bool,
}

/// The pieces of strokes that begin at a place.
pub fn pieces(strokes: &[Stroke], begin: [f64; 3]) -> Vec<Piece> {
    let mut place = begin;
    let mut found = Vec::new();
    for stroke in strokes {
        let from = [place[0], place[1]];
        let (to, element) = match *stroke {
            Stroke::Rapid(to) | Stroke::Line(to) | Stroke::Plunge(to) => {
                (to, Element::line(from, [to[0], to[1]]))
            }
            Stroke::Arc { to, center, ccw, .. } => {
                let radius = |p: Point| (p[0] - center[0]).hypot(p[1] - center[1]);
                assert!((radius(from) - radius([to[0], to[1]])).abs() < 1e-9, "{stroke:?}");
                (to, Element::arc(from, [to[0], to[1]], center, ccw, 1))
            }
        };
        let rapid = matches!(stroke, Stroke::Rapid(_));
        found.push(Piece { element, heights: [place[2], to[2]], rapid });
        place = to;
    }
    found
}

/// The distance of a point from an element, mm.
pub fn distance(element: &Element, p: Point) -> f64 {
    let to = |q: Point| (p[0] - q[0]).hypot(p[1] - q[1]);
    match *element {
        Element::Line { from, to: end } => {
            let d = [end[0] - from[0], end[1] - from[1]];
            let square = d[0] * d[0] + d[1] * d[1];
            let part = ((p[0] - from[0]) * d[0] + (p[1] - from[1]) * d[1]) / square.max(1e-300);
            let part = part.clamp(0.0, 1.0);
            to([from[0] + part * d[0], from[1] + part * d[1]])
        }
        Element::Arc { center, radius_mm, start_rad, sweep_rad } => {
            let angle = (p[1] - center[1]).atan2(p[0] - center[0]);
            let turned =
                (sweep_rad.signum() * (angle - start_rad)).rem_euclid(std::f64::consts::TAU);
            if turned <= sweep_rad.abs() {
                (to(center) - radius_mm).abs()
            } else {
                to(element.point(0.0)).min(to(element.point(1.0)))
            }
        }
    }
}

/// The distance of a point from all that is cut at a height, mm.
pub fn distance_at(pieces: &[Piece], height: f64, p: Point) -> f64 {
    let here = |piece: &&Piece| piece.heights.iter().all(|h| (h - height).abs() < 1e-9);
    let cut = pieces.iter().filter(here).filter(|piece| !piece.rapid);
    cut.map(|piece| distance(&piece.element, p)).fold(f64::INFINITY, f64::min)
}

/// Points along the pieces that reach below a height.
pub fn places_below(pieces: &[Piece], height: f64) -> Vec<Point> {
    let deep = pieces.iter().filter(|p| p.heights.iter().any(|h| *h < height - 1e-9));
    deep.flat_map(|p| (0..=16).map(|i| p.element.point(f64::from(i) / 16.0))).collect()
}
