//! Slots along an arc, cleared from the middle line out.

use trueaxis_contour::plane::along;

use crate::Point;
use crate::mill::{Heights, MOST_STROKES, Stroke};

/// A slot along an arc; the width is that of the path of the centre of the cutter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcSlot {
    /// The centre of the arc, mm.
    pub center: Point,
    /// The radius of the middle line, mm.
    pub radius_mm: f64,
    /// The direction of its start from the centre, degrees.
    pub start_deg: f64,
    /// The angle of the middle line, counter-clockwise positive, degrees.
    pub sweep_deg: f64,
    /// How far the path goes to both sides of the middle line, mm.
    pub half_mm: f64,
    /// The radius of the cutter, mm.
    pub cutter_mm: f64,
    /// The largest distance from ring to ring, mm.
    pub step_mm: f64,
    /// Counter-clockwise around the slot.
    pub ccw: bool,
}

impl ArcSlot {
    fn place(&self, part: f64, radius: f64) -> Point {
        let (sin, cos) = (self.start_deg + part * self.sweep_deg).to_radians().sin_cos();
        along(self.center, [cos, sin], radius)
    }

    /// The layers of the slot; `None` for endless ones, and where the inside of the arc closes.
    pub fn strokes(&self, heights: &Heights) -> Option<Vec<Stroke>> {
        let step = self.step_mm.min(2.0 * self.cutter_mm);
        let rings = (self.half_mm / step - 1e-9).ceil();
        let fits = step > 0.0 && rings < 1e4 && self.half_mm < self.radius_mm;
        if !fits || self.sweep_deg == 0.0 || self.sweep_deg.abs() > 360.0 {
            return None;
        }
        let begin = self.place(0.0, self.radius_mm);
        let at = |p: Point, height: f64| [p[0], p[1], height];
        let mut strokes = vec![Stroke::Rapid(at(begin, heights.safe_mm))];
        for height in heights.layers()? {
            strokes.push(Stroke::Plunge(at(begin, height)));
            self.arc(self.radius_mm, true, height, &mut strokes);
            self.arc(self.radius_mm, false, height, &mut strokes);
            for i in 1..=rings.max(0.0) as u32 {
                self.ring(self.half_mm * f64::from(i) / rings, height, &mut strokes);
            }
            strokes.push(Stroke::Line(at(begin, height)));
            if strokes.len() > MOST_STROKES {
                return None;
            }
        }
        strokes.push(Stroke::Rapid(at(begin, heights.safe_mm)));
        Some(strokes)
    }

    /// Along the arc at a radius in two halves, from its start or from its end.
    fn arc(&self, radius: f64, forward: bool, height: f64, strokes: &mut Vec<Stroke>) {
        for part in [0.5, 1.0] {
            let p = self.place(if forward { part } else { 1.0 - part }, radius);
            let ccw = (self.sweep_deg > 0.0) == forward;
            let center = self.center;
            strokes.push(Stroke::Arc { to: [p[0], p[1], height], center, ccw, plunges: false });
        }
    }

    /// Once around at a distance from the middle line.
    fn ring(&self, by: f64, height: f64, strokes: &mut Vec<Stroke>) {
        // Counter-clockwise around a counter-clockwise arc: out on the outer side, back on the inner one.
        let outer_first = (self.sweep_deg > 0.0) == self.ccw;
        let (mut side, mut other) = (self.radius_mm + by, self.radius_mm - by);
        if !outer_first {
            std::mem::swap(&mut side, &mut other);
        }
        let first = self.place(0.0, side);
        strokes.push(Stroke::Line([first[0], first[1], height]));
        for (part, from, onto) in [(1.0, side, other), (0.0, other, side)] {
            self.arc(from, part > 0.5, height, strokes);
            let p = self.place(part, onto);
            let (to, center) = ([p[0], p[1], height], self.place(part, self.radius_mm));
            strokes.push(Stroke::Arc { to, center, ccw: self.ccw, plunges: false });
        }
    }
}
