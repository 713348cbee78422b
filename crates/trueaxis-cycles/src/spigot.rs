//! Spigots: once around in each layer, from outside the blank.

use crate::Point;
use crate::mill::{Heights, MOST_STROKES, Stroke};
use crate::outline::Outline;

/// A spigot; the outline is that of the path of the centre of the cutter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spigot {
    /// The centre, mm.
    pub center: Point,
    /// The path of the centre of the cutter.
    pub outline: Outline,
    /// How far the start is off that path, along the first axis, mm.
    pub start_mm: f64,
    /// Counter-clockwise.
    pub ccw: bool,
}

impl Spigot {
    /// Where the cutter stands before and after each layer, mm.
    pub fn start(&self) -> Point {
        let begin = self.outline.begin();
        self.outline.place(self.center, [begin[0] + self.start_mm, begin[1]])
    }

    /// From the start down, on a half circle to the spigot, around it and on a half circle back, in layers.
    pub fn strokes(&self, heights: &Heights) -> Option<Vec<Stroke>> {
        let start = self.start();
        let at = |height: f64| [start[0], start[1], height];
        let mut strokes = vec![Stroke::Rapid(at(heights.safe_mm))];
        for height in heights.layers()? {
            strokes.push(Stroke::Plunge(at(height)));
            let leads = self.outline.leads(self.center, self.start_mm / 2.0, false, self.ccw);
            for (i, lead) in leads.into_iter().enumerate() {
                let to = [lead.end[0], lead.end[1], height];
                let (center, ccw) = (lead.center, lead.ccw);
                strokes.push(Stroke::Arc { to, center, ccw, plunges: false });
                if i == 0 {
                    self.outline.around(self.center, height, self.ccw, &mut strokes);
                }
            }
            if strokes.len() > MOST_STROKES {
                return None;
            }
        }
        strokes.push(Stroke::Rapid(at(heights.safe_mm)));
        Some(strokes)
    }
}
