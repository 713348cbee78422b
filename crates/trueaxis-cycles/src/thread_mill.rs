//! Threads by milling: helices with the pitch of the thread.
//!
//! The tooth stays in its groove: its height and the angle φ of the centre of the cutter about the thread belong
//! together, z = z₀ ± P φ / 2π, also on the half circles to the thread and away from it. These go from the centre of the
//! thread to its path, by which φ changes by a quarter turn (the angle at the circumference is half of that at the
//! centre), so that the height changes by P / 4.

use crate::Point;
use crate::mill::{Heights, MOST_STROKES, Stroke};

/// An inner thread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThreadMill {
    /// The centre, mm.
    pub center: Point,
    /// The radius of the path of the centre of the cutter, mm.
    pub radius_mm: f64,
    /// The pitch, positive for a right-hand thread, mm.
    pub pitch_mm: f64,
    /// How many turns the cutter has teeth for: 0 all, 1 one (a helix over the whole depth), more by steps. Unit: 1.
    pub teeth: u32,
    /// Counter-clockwise.
    pub ccw: bool,
}

impl ThreadMill {
    /// From the centre above the thread and back there; `None` for endless ones.
    pub fn strokes(&self, heights: &Heights) -> Option<Vec<Stroke>> {
        let pitch = self.pitch_mm.abs();
        let depth = heights.top_mm - heights.bottom_mm;
        let count = |length: f64| {
            let count = (depth / length - 1e-9).ceil().max(1.0);
            (count < 1e4).then_some(count as u32)
        };
        if pitch <= 0.0 || pitch.is_nan() {
            return None;
        }
        // A right-hand thread rises counter-clockwise.
        let up = (self.pitch_mm > 0.0) == self.ccw;
        let (passes, turns) = match self.teeth {
            0 => (1, 1),
            1 => (1, count(pitch)?),
            teeth => (count(pitch * f64::from(teeth))?, 1),
        };
        let high = |height: f64| [self.center[0], self.center[1], height];
        let mut strokes = vec![Stroke::Rapid(high(heights.safe_mm))];
        for i in 0..passes {
            // Upwards from the bottom on, downwards towards it.
            let step = if up { i } else { passes - 1 - i };
            let low = heights.bottom_mm + f64::from(step * self.teeth) * pitch;
            let top = low + f64::from(turns) * pitch;
            let (from, to) = if up { (low, top) } else { (top, low) };
            let quarter = if up { pitch / 4.0 } else { -pitch / 4.0 };
            strokes.push(Stroke::Plunge(high(from - quarter)));
            self.helix(from, to, turns, quarter, &mut strokes);
            if strokes.len() > MOST_STROKES {
                return None;
            }
        }
        strokes.push(Stroke::Rapid(high(heights.safe_mm)));
        Some(strokes)
    }

    fn helix(&self, from: f64, to: f64, turns: u32, quarter: f64, strokes: &mut Vec<Stroke>) {
        let r = self.radius_mm;
        let place = |x: f64, height: f64| [self.center[0] + x, self.center[1], height];
        let arc = |to: [f64; 3], center: Point| {
            let ccw = self.ccw;
            Stroke::Arc { to, center, ccw, plunges: false }
        };
        let middle = [self.center[0] + r / 2.0, self.center[1]];
        strokes.push(arc(place(r, from), middle));
        let halves = 2 * turns;
        for k in 1..=halves {
            let x = if k % 2 == 0 { r } else { -r };
            let part = f64::from(k) / f64::from(halves);
            strokes.push(arc(place(x, from + (to - from) * part), self.center));
        }
        strokes.push(arc(place(0.0, to + quarter), middle));
    }
}
