//! Pockets cleared in layers from the inside out, and their walls and floors finished.
//!
//! In each layer the cutter goes along the middle line, then around on outlines at equal distances to the wall.
//! A point between two of them with sharp corners, at the distance s, is at most 0.586 s from the nearer one
//! (s (2 - √2), at the corner), so that a cutter of radius r leaves nothing for s up to 1.7 r.

use crate::Point;
use crate::mill::{Heights, MOST_STROKES, Stroke};
use crate::outline::Outline;

/// The widest step that leaves nothing at sharp corners, radii of the cutter.
const WIDEST_STEP: f64 = 1.7;

/// How the cutter gets down into the material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Insert {
    /// Straight and as fast as the machine can: the place is drilled.
    Rapid,
    /// Straight with feed.
    Straight,
    /// On a helix about the centre.
    Helix {
        /// Its radius, mm; smaller where the pocket is.
        radius_mm: f64,
        /// The depth of a turn, mm.
        pitch_mm: f64,
    },
    /// To and fro along the longer axis.
    Ramp {
        /// The steepest angle, degrees.
        angle_deg: f64,
    },
}

/// A pocket; the outline is that of the path of the centre of the cutter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pocket {
    /// The centre, mm.
    pub center: Point,
    /// The outermost path of the centre of the cutter.
    pub outline: Outline,
    /// The radius of the cutter, mm.
    pub cutter_mm: f64,
    /// The largest distance from ring to ring, mm.
    pub step_mm: f64,
    /// How the cutter gets into the material.
    pub insert: Insert,
    /// Counter-clockwise.
    pub ccw: bool,
}

fn at(p: Point, height: f64) -> [f64; 3] {
    [p[0], p[1], height]
}

impl Pocket {
    /// The way to the centre above the pocket, all layers, and up again; `None` for endless ones.
    pub fn strokes(&self, heights: &Heights) -> Option<Vec<Stroke>> {
        let mut strokes = vec![Stroke::Rapid(at(self.center, heights.safe_mm))];
        let mut above = heights.safe_mm;
        for height in heights.layers()? {
            self.insertion(above, height, &mut strokes)?;
            self.layer(height, &mut strokes)?;
            above = height;
            if strokes.len() > MOST_STROKES {
                return None;
            }
        }
        strokes.push(Stroke::Rapid(at(self.center, heights.safe_mm)));
        Some(strokes)
    }

    /// The wall alone, in layers, with a quarter circle to it and away from it.
    pub fn wall(&self, heights: &Heights) -> Option<Vec<Stroke>> {
        let mut strokes = vec![Stroke::Rapid(at(self.center, heights.safe_mm))];
        let radius_mm = self.cutter_mm.min(self.outline.narrow_mm());
        for height in heights.layers()? {
            strokes.push(Stroke::Plunge(at(self.center, height)));
            let leads = self.outline.leads(self.center, radius_mm, true, self.ccw);
            strokes.push(Stroke::Line(at(leads[0].begin, height)));
            for (i, lead) in leads.iter().enumerate() {
                let (to, center) = (at(lead.end, height), lead.center);
                if radius_mm > 1e-9 {
                    strokes.push(Stroke::Arc { to, center, ccw: lead.ccw, plunges: false });
                }
                if i == 0 {
                    self.outline.around(self.center, height, self.ccw, &mut strokes);
                }
            }
            strokes.push(Stroke::Line(at(self.center, height)));
            if strokes.len() > MOST_STROKES {
                return None;
            }
        }
        strokes.push(Stroke::Rapid(at(self.center, heights.safe_mm)));
        Some(strokes)
    }

    /// A round pocket by helices from the inside out, each down to the floor, once around there and up; or its
    /// wall alone, by the outermost of them. A turn is at most as deep as a layer. `None` for other outlines too.
    pub fn helices(&self, heights: &Heights, wall_only: bool) -> Option<Vec<Stroke>> {
        let Outline::Circle { radius_mm } = self.outline else { return None };
        let step = self.step_mm.min(WIDEST_STEP * self.cutter_mm);
        // The innermost circle leaves no pillar.
        let first = radius_mm.min(self.cutter_mm);
        let gaps = if radius_mm > first + 1e-9 { whole((radius_mm - first) / step)? } else { 0 };
        if step.is_nan() || step <= 0.0 || gaps >= 10_000 {
            return None;
        }
        let (depth, layers) = (heights.safe_mm - heights.bottom_mm, heights.layers()?.len());
        let pitch = (heights.top_mm - heights.bottom_mm) / layers as f64;
        let halves = 2 * if pitch > 0.0 { whole(depth / pitch)? } else { 1 };
        let mut strokes = vec![Stroke::Rapid(at(self.center, heights.safe_mm))];
        for i in if wall_only { gaps..=gaps } else { 0..=gaps } {
            let part = if gaps > 0 { f64::from(i) / f64::from(gaps) } else { 1.0 };
            let r = if gaps > 0 { first + (radius_mm - first) * part } else { radius_mm };
            let side = |k: u32, height: f64| {
                let x = if k.is_multiple_of(2) { r } else { -r };
                at([self.center[0] + x, self.center[1]], height)
            };
            strokes.push(Stroke::Rapid(side(0, heights.safe_mm)));
            for k in 1..=halves + 2 {
                let part = (f64::from(k) / f64::from(halves)).min(1.0);
                let to = side(k, heights.safe_mm - depth * part);
                let (center, ccw) = (self.center, self.ccw);
                strokes.push(Stroke::Arc { to, center, ccw, plunges: false });
            }
            // Off the wall before the way up.
            strokes.push(Stroke::Line(at(self.center, heights.bottom_mm)));
            strokes.push(Stroke::Rapid(at(self.center, heights.safe_mm)));
            if strokes.len() > MOST_STROKES {
                return None;
            }
        }
        Some(strokes)
    }

    /// The floor alone, from a height above the material that is there.
    pub fn floor(&self, heights: &Heights) -> Option<Vec<Stroke>> {
        let above = heights.top_mm.max(heights.bottom_mm).min(heights.safe_mm);
        let mut strokes = vec![
            Stroke::Rapid(at(self.center, heights.safe_mm)),
            Stroke::Rapid(at(self.center, above)),
        ];
        self.insertion(above, heights.bottom_mm, &mut strokes)?;
        self.layer(heights.bottom_mm, &mut strokes)?;
        strokes.push(Stroke::Rapid(at(self.center, heights.safe_mm)));
        Some(strokes)
    }

    /// Down at the centre.
    fn insertion(&self, above: f64, height: f64, strokes: &mut Vec<Stroke>) -> Option<()> {
        let depth = above - height;
        let down = Stroke::Plunge(at(self.center, height));
        match self.insert {
            Insert::Rapid => strokes.push(Stroke::Rapid(at(self.center, height))),
            Insert::Helix { radius_mm, pitch_mm } if pitch_mm > 0.0 && depth > 0.0 => {
                let r = radius_mm.min(self.outline.narrow_mm());
                if r <= 1e-9 {
                    strokes.push(down);
                    return Some(());
                }
                let turns = whole(depth / pitch_mm)?;
                let side = |i: u32, height: f64| {
                    let x = if i.is_multiple_of(2) { r } else { -r };
                    at(self.outline.place(self.center, [x, 0.0]), height)
                };
                strokes.push(Stroke::Plunge(side(0, above)));
                // Two halves for each turn, and once around at the depth.
                for i in 1..=2 * turns + 2 {
                    let part = (f64::from(i) / f64::from(2 * turns)).min(1.0);
                    let to = side(i, above - depth * part);
                    let (center, ccw) = (self.center, self.ccw);
                    strokes.push(Stroke::Arc { to, center, ccw, plunges: i <= 2 * turns });
                }
                strokes.push(Stroke::Line(at(self.center, height)));
            }
            Insert::Ramp { angle_deg } if angle_deg > 0.0 && angle_deg < 90.0 && depth > 0.0 => {
                let [far, _] = self.outline.long();
                let length = 4.0 * far[0].hypot(far[1]);
                if length <= 1e-9 {
                    strokes.push(down);
                    return Some(());
                }
                let rounds = whole(depth / (length * angle_deg.to_radians().tan()))?;
                let ends = [far, [-far[0], -far[1]], [0.0; 2]];
                let ends = ends.map(|p| self.outline.place(self.center, p));
                for i in 0..rounds {
                    for (end, part) in ends.iter().zip([0.25, 0.75, 1.0]) {
                        let part = (f64::from(i) + part) / f64::from(rounds);
                        strokes.push(Stroke::Plunge(at(*end, above - depth * part)));
                    }
                }
                // Once more, level: the slopes of the last round remain otherwise.
                strokes.extend(ends.map(|end| Stroke::Line(at(end, height))));
            }
            _ => strokes.push(down),
        }
        Some(())
    }

    /// The middle line and the rings, from the centre and back to it.
    fn layer(&self, height: f64, strokes: &mut Vec<Stroke>) -> Option<()> {
        let narrow = self.outline.narrow_mm();
        let step = self.step_mm.min(WIDEST_STEP * self.cutter_mm);
        if step.is_nan() || step <= 0.0 {
            return None;
        }
        let rings = whole(narrow / step).filter(|n| *n < 10_000)?;
        let [_, half] = self.outline.long();
        if half != [0.0; 2] {
            for end in [half, [-half[0], -half[1]]] {
                strokes.push(Stroke::Line(at(self.outline.place(self.center, end), height)));
            }
        }
        for i in 1..=rings {
            let by = narrow * (1.0 - f64::from(i) / f64::from(rings));
            let Some(ring) = self.outline.inside(by).filter(|_| narrow > 1e-9) else { continue };
            let begin = ring.place(self.center, ring.begin());
            strokes.push(Stroke::Line(at(begin, height)));
            ring.around(self.center, height, self.ccw, strokes);
        }
        strokes.push(Stroke::Line(at(self.center, height)));
        Some(())
    }
}

/// The smallest whole number, 1 or more, that is not below a quotient; `None` if it is endless.
fn whole(quotient: f64) -> Option<u32> {
    let count = (quotient - 1e-9).ceil().max(1.0);
    (count < 1e5).then_some(count as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_helix_ends_with_a_circle_and_a_ramp_level() {
        let pocket = Pocket {
            center: [10.0, 0.0],
            outline: Outline::Circle { radius_mm: 9.0 },
            cutter_mm: 5.0,
            step_mm: 4.5,
            insert: Insert::Helix { radius_mm: 2.0, pitch_mm: 3.0 },
            ccw: true,
        };
        let heights = Heights { safe_mm: 1.0, top_mm: 0.0, bottom_mm: -5.0, layer_mm: 9.0 };
        let strokes = pocket.strokes(&heights).unwrap();
        // 6 mm in two turns of 3: from X12 down, two halves each, then the circle.
        assert_eq!(strokes[1], Stroke::Plunge([12.0, 0.0, 1.0]));
        let half = |to, plunges| Stroke::Arc { to, center: [10.0, 0.0], ccw: true, plunges };
        assert_eq!(strokes[2], half([8.0, 0.0, -0.5], true));
        assert_eq!(strokes[5], half([12.0, 0.0, -5.0], true));
        assert_eq!(strokes[6..8], [half([8.0, 0.0, -5.0], false), half([12.0, 0.0, -5.0], false)]);
        let ramp = Pocket { insert: Insert::Ramp { angle_deg: 45.0 }, ..pocket };
        let strokes = ramp.strokes(&heights).unwrap();
        // 9 along and 1.5 down would be 36 to 6: less than 45 degrees in one round.
        assert_eq!(strokes[1], Stroke::Plunge([19.0, 0.0, -0.5]));
        assert_eq!(strokes[3], Stroke::Plunge([10.0, 0.0, -5.0]));
        assert_eq!(strokes[4], Stroke::Line([19.0, 0.0, -5.0]));
    }

    #[test]
    fn endless_pockets_are_none() {
        let pocket = Pocket {
            center: [0.0; 2],
            outline: Outline::Circle { radius_mm: 1e6 },
            cutter_mm: 5.0,
            step_mm: 1e-3,
            insert: Insert::Straight,
            ccw: true,
        };
        let heights = Heights { safe_mm: 1.0, top_mm: 0.0, bottom_mm: -5.0, layer_mm: 9.0 };
        assert_eq!(pocket.strokes(&heights), None);
        let nothing = Pocket { step_mm: 0.0, ..pocket };
        assert_eq!(nothing.strokes(&heights), None);
    }
}
