//! Cycle 262: thread milling.

use super::Run;
use super::milling::{Milled, Passes};
use trueaxis_cycles::thread_mill::ThreadMill;

impl Run<'_> {
    /// Q335 diameter, Q239 pitch, Q355 threads per step: 0 the cutter has teeth for the whole thread, 1 a helix over the
    /// whole depth, more in steps of as many pitches. Q253 is the feed in depth, Q207 on the helices.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`. The half circles to the thread and away are ours.
    pub(super) fn threaded(&self, cycle: &Milled<'_>) -> Option<Passes> {
        let teeth = cycle.value(355);
        let radius_mm = cycle.length(335).abs() / 2.0 - cycle.tool_mm;
        if !(0.0..1000.0).contains(&teeth) || radius_mm <= 0.0 {
            return None;
        }
        let thread = ThreadMill {
            center: self.here(),
            radius_mm,
            pitch_mm: cycle.length(239),
            teeth: teeth as u32,
            // Climb milling with M3 goes counter-clockwise within a hole.
            ccw: cycle.value(351) >= 0.0,
        };
        let strokes = thread.strokes(&cycle.heights(0))?;
        Some(vec![(strokes, [cycle.feed(207, 0), cycle.feed(253, 207)])])
    }
}
