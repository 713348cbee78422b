//! Milling cycles where the tool stands: 208 bore milling, 251 rectangular and 252 circular pocket.

use std::collections::BTreeMap;

use super::Run;
use crate::execution::milling::Mill;
use crate::execution::mistakes;
use crate::moves::{Feed, FeedMode, MoveKind};
use crate::text::program::Fault;
use trueaxis_cycles::mill::{Heights, RectanglePocket, Stroke, bore, round_pocket};

/// The cycles of this file.
pub(super) const MILLING: [u32; 3] = [208, 251, 252];

impl Run<'_> {
    /// A drilling or milling cycle where the tool stands.
    pub(super) fn machine_hole(
        &mut self,
        number: u32,
        values: &BTreeMap<u32, f64>,
        at: usize,
    ) -> Result<(), Fault> {
        if MILLING.contains(&number) {
            return self.mill_hole(number, values, at);
        }
        self.drill_hole(number, values, at)
    }

    /// The path of the centre of the cutter: pockets from the inside out in layers of at most Q202, bores by a
    /// helix with at most Q334 for each turn. The tool plunges straight; what Q366 chooses instead, and a
    /// separate finish, are reported.
    ///
    /// # Source
    /// User's manual "Cycle programming" of TNC 620: cycles 208, 251 and 252. The step from ring to ring is
    /// Q370 times the radius of the tool, made even; the way from ring to ring is not described there.
    fn mill_hole(
        &mut self,
        number: u32,
        values: &BTreeMap<u32, f64>,
        at: usize,
    ) -> Result<(), Fault> {
        let mm = self.core.modes.unit_mm();
        let value = |q: u32| values.get(&q).copied().unwrap_or(0.0);
        let Some(tool) = self.modes.tool_radius_mm.filter(|r| *r > 0.0) else {
            let subject = format!("cycle {number} without the radius of the tool");
            self.core.not_applied(&subject, at, "state the radius: TOOL DEF 1 L+80 R+5");
            return Ok(());
        };
        let surface = value(203) * mm;
        let heights = Heights {
            safe_mm: surface + value(200).abs() * mm,
            top_mm: surface,
            bottom_mm: surface + (value(201) + value(369)) * mm,
            layer_mm: value(if number == 208 { 334 } else { 202 }).abs() * mm,
        };
        let scale = if self.core.modes.inches { 2.54 } else { 1.0 };
        let feed = |v: f64| Feed { mode: FeedMode::PerMinute, value: v * scale };
        let deep = feed(value(206));
        let flat = if number == 208 { deep } else { feed(value(207)) };
        if heights.bottom_mm >= heights.top_mm {
            return Err(mistakes::missing_depth(at));
        }
        for feed in [flat, deep] {
            crate::execution::check_feed(&feed, at)?;
        }
        self.report_left_out(number, values, at);
        let strokes = self.strokes(number, values, tool, &heights);
        let Some(strokes) = strokes else {
            let subject =
                format!("cycle {number} that is smaller than the tool or has endless steps");
            self.core.not_applied(&subject, at, "check the size, the tool and the infeeds");
            return Ok(());
        };
        let clear = surface + value(200).abs().max(value(204)) * mm;
        let mut place = self.frames.position;
        place[self.along()] = heights.safe_mm;
        if self.frames.position[self.along()] != heights.safe_mm {
            self.step(MoveKind::Rapid, place, at)?;
        }
        self.mill(&strokes, [flat, deep], at)?;
        let mut up = self.frames.position;
        up[self.along()] = clear;
        self.step(MoveKind::Rapid, up, at)?;
        self.tangent = None;
        Ok(())
    }

    fn report_left_out(&mut self, number: u32, values: &BTreeMap<u32, f64>, at: usize) {
        if number == 208 {
            return;
        }
        let left_out = [
            (215, "the separate roughing and finishing"),
            (366, "the helix or ramp into the material"),
            (367, "the position of the pocket"),
        ];
        for (q, what) in left_out {
            if values.get(&q).is_some_and(|v| *v != 0.0) {
                self.core.left_out(&format!("Q{q} of cycle {number}: {what}"), at);
            }
        }
    }

    fn strokes(
        &self,
        number: u32,
        values: &BTreeMap<u32, f64>,
        tool: f64,
        heights: &Heights,
    ) -> Option<Vec<Stroke>> {
        let mm = self.core.modes.unit_mm();
        let value = |q: u32| values.get(&q).copied().unwrap_or(0.0);
        let [first, second, _] = self.core.modes.plane.axes();
        let center = [self.frames.position[first], self.frames.position[second]];
        // Climb milling with M3 goes counter-clockwise within a pocket.
        let ccw = value(351) >= 0.0;
        let overlap = value(370);
        let step = tool * if overlap > 0.0 { overlap } else { 1.0 };
        let inside = |size: f64| size.abs() * mm / 2.0 - tool - value(368) * mm;
        match number {
            208 => {
                let radius = inside(value(335));
                (radius > 0.0).then(|| bore(center, radius, heights, ccw))?
            }
            252 => {
                let radius = inside(value(223));
                (radius > 0.0).then(|| round_pocket(center, radius, step, heights, ccw))?
            }
            _ => {
                let half_mm = [inside(value(218)), inside(value(219))];
                let corner_mm = (value(220).abs() * mm - tool).max(0.0);
                let pocket = RectanglePocket { center, half_mm, corner_mm, angle_deg: value(224) };
                (half_mm[0] > 0.0 && half_mm[1] > 0.0)
                    .then(|| pocket.strokes(step, heights, ccw))?
            }
        }
    }
}
