//! Cycle 254: slots along an arc.

use super::Run;
use super::milling::{Milled, Passes};
use trueaxis_cycles::mill::{Heights, MOST_STROKES};
use trueaxis_cycles::slot::ArcSlot;

impl Run<'_> {
    /// Q219 width, Q375 diameter of the middle line about Q216 and Q217 (Q367=0), Q376 the direction of the start, Q248
    /// the angle of a slot, Q377 slots at steps of Q378; allowances and Q215 as in the other cycles, but the wall is
    /// finished by the rings of the floor.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`.
    pub(super) fn arc_slots(&self, cycle: &Milled<'_>) -> Option<Passes> {
        let (tool, side, floor) = (cycle.tool_mm, cycle.length(368), cycle.length(369));
        let count = cycle.value(377).max(1.0);
        if count > 1000.0 {
            return None;
        }
        let deep = cycle.feed(206, 0);
        let kind = cycle.value(215);
        let heights = cycle.heights(202);
        let mut passes = Passes::new();
        for i in 0..count as u32 {
            let slot = |left: f64| {
                let half_mm = cycle.length(219).abs() / 2.0 - tool - left;
                (half_mm >= 0.0).then_some(ArcSlot {
                    center: [cycle.length(216), cycle.length(217)],
                    radius_mm: cycle.length(375).abs() / 2.0,
                    start_deg: cycle.value(376) + f64::from(i) * cycle.value(378),
                    sweep_deg: cycle.value(248),
                    half_mm,
                    cutter_mm: tool,
                    step_mm: tool,
                    ccw: cycle.value(351) >= 0.0,
                })
            };
            if kind <= 1.0 {
                let bottom_mm = (heights.bottom_mm + floor).min(heights.top_mm);
                let strokes = slot(side)?.strokes(&Heights { bottom_mm, ..heights })?;
                passes.push((strokes, [cycle.feed(207, 0), deep]));
            }
            if kind != 1.0 && (side > 0.0 || floor > 0.0) {
                let layer_mm = cycle.length(338).abs();
                let strokes = slot(0.0)?.strokes(&Heights { layer_mm, ..heights })?;
                passes.push((strokes, [cycle.feed(385, 207), deep]));
            }
            if passes.iter().map(|(strokes, _)| strokes.len()).sum::<usize>() > MOST_STROKES {
                return None;
            }
        }
        Some(passes)
    }
}
