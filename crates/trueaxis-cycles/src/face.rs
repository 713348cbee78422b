//! Faces milled in parallel strokes.

use crate::Point;
use crate::mill::{Heights, MOST_STROKES, Stroke};

/// A rectangular face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// The corner where it begins, mm.
    pub corner: Point,
    /// From there along its own two axes, with signs, mm.
    pub size_mm: Point,
    /// The direction of its first axis, degrees.
    pub angle_deg: f64,
    /// The radius of the cutter, mm.
    pub cutter_mm: f64,
    /// The largest distance from stroke to stroke, mm.
    pub step_mm: f64,
    /// How far the cutter goes off the face at the ends of a stroke, mm.
    pub over_mm: f64,
    /// How far the last stroke goes further than it needs to, mm.
    pub over_across_mm: f64,
    /// The strokes are along the second axis.
    pub along_second: bool,
    /// Every second stroke goes back.
    pub back_and_forth: bool,
    /// The edges that the cutter must not cross: of each axis at its negative and at its positive side.
    pub walls: [[bool; 2]; 2],
}

impl Face {
    /// An axis of the face: its direction, its length, and the walls where it begins and ends.
    fn axis(&self, i: usize) -> (f64, f64, [bool; 2]) {
        let [low, high] = self.walls[i];
        match self.size_mm[i] < 0.0 {
            true => (-1.0, -self.size_mm[i], [high, low]),
            false => (1.0, self.size_mm[i], [low, high]),
        }
    }

    /// Where the strokes are across the face.
    fn lines(&self, length: f64, walls: [bool; 2]) -> Option<Vec<f64>> {
        let r = self.cutter_mm;
        let step = self.step_mm.min(2.0 * r);
        let last = match walls[1] {
            true => length - r,
            false => (length - r + self.over_across_mm).max(if walls[0] { r } else { step - r }),
        };
        let first = if walls[0] { r } else { (step - r).min(last) };
        if step.is_nan() || step <= 0.0 || first > last + 1e-9 {
            return None;
        }
        let gaps = ((last - first) / step - 1e-9).ceil();
        if gaps >= 1e4 {
            return None;
        }
        let gaps = gaps.max(0.0) as u32;
        let place = |i: u32| first + (last - first) * f64::from(i) / f64::from(gaps.max(1));
        Some((0..=gaps).map(place).collect())
    }

    /// The strokes of all layers, from above the first one; `None` if the cutter is too large or they are endless.
    pub fn strokes(&self, heights: &Heights) -> Option<Vec<Stroke>> {
        let (i, j) = if self.along_second { (1, 0) } else { (0, 1) };
        let ((along, length, ends), (across, width, sides)) = (self.axis(i), self.axis(j));
        let lines = self.lines(width, sides)?;
        let past = |wall: bool| if wall { -self.cutter_mm } else { self.cutter_mm + self.over_mm };
        let ends = [-past(ends[0]), length + past(ends[1])];
        if ends[0] > ends[1] {
            return None;
        }
        let (sin, cos) = self.angle_deg.to_radians().sin_cos();
        let place = |end: usize, line: usize, height: f64| {
            let mut p = [0.0; 2];
            (p[i], p[j]) = (along * ends[end], across * lines[line]);
            let x = self.corner[0] + p[0] * cos - p[1] * sin;
            [x, self.corner[1] + p[0] * sin + p[1] * cos, height]
        };
        let mut strokes = Vec::new();
        for height in heights.layers()? {
            for line in 0..lines.len() {
                let back = usize::from(self.back_and_forth && line % 2 == 1);
                if line == 0 || !self.back_and_forth {
                    strokes.push(Stroke::Rapid(place(back, line, heights.safe_mm)));
                    strokes.push(Stroke::Plunge(place(back, line, height)));
                } else {
                    strokes.push(Stroke::Line(place(back, line, height)));
                }
                strokes.push(Stroke::Line(place(1 - back, line, height)));
                if !self.back_and_forth || line + 1 == lines.len() {
                    strokes.push(Stroke::Rapid(place(1 - back, line, heights.safe_mm)));
                }
                if strokes.len() > MOST_STROKES {
                    return None;
                }
            }
        }
        Some(strokes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_by_hand() {
        let face = Face {
            corner: [0.0, 0.0],
            size_mm: [50.0, -30.0],
            angle_deg: 0.0,
            cutter_mm: 10.0,
            step_mm: 12.0,
            over_mm: 5.0,
            over_across_mm: 0.0,
            along_second: false,
            back_and_forth: true,
            walls: [[false; 2]; 2],
        };
        let heights = Heights { safe_mm: 2.0, top_mm: 0.0, bottom_mm: -5.0, layer_mm: 9.0 };
        // Lines at 2, 11 and 20 from the corner: the last cutter edge is at 30.
        let [a, b] = [-15.0, 65.0];
        let wanted = [
            Stroke::Rapid([a, -2.0, 2.0]),
            Stroke::Plunge([a, -2.0, -5.0]),
            Stroke::Line([b, -2.0, -5.0]),
            Stroke::Line([b, -11.0, -5.0]),
            Stroke::Line([a, -11.0, -5.0]),
            Stroke::Line([a, -20.0, -5.0]),
            Stroke::Line([b, -20.0, -5.0]),
            Stroke::Rapid([b, -20.0, 2.0]),
        ];
        assert_eq!(face.strokes(&heights).unwrap(), wanted);
        let between = Face { walls: [[false; 2], [true, true]], size_mm: [50.0, 19.0], ..face };
        assert_eq!(between.strokes(&heights), None);
    }
}
