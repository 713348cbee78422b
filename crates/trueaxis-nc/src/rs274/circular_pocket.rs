//! G12 and G13 of HAAS: circular pockets.

use super::{Run, fault};
use crate::execution::milling::Mill;
use crate::execution::mistakes;
use crate::moves::{MoveKind, Plane};
use crate::text::program::Fault;
use trueaxis_cycles::mill::{circles_about, growing};

/// Circles and rounds of one block: more than any program means.
const MOST: f64 = 1e4;

impl Run<'_> {
    /// G12 (clockwise) and G13 I K Q Z D F L: down to Z, on a half circle to the circle of the radius I, around it, then
    /// around circles that grow by Q up to K, and on a half circle back to the centre, where the tool stays in depth; L
    /// times, with G91 deeper by Z each time. The circles are smaller by the radius of D.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`. The way from circle to circle is ours.
    pub(super) fn circular_pocket(&mut self, ccw: bool, at: usize) -> Result<(), Fault> {
        let name = if ccw { "G13" } else { "G12" };
        if self.core.has_radius() {
            return Err(mistakes::cycle_on_contour(name, at));
        }
        let [first, last, step] = [b'I', b'K', b'Q'].map(|letter| self.length(letter));
        let rounds = self.words.take(b'L').unwrap_or(1.0);
        let written = self.words.take(b'D');
        let [x, y, third] = self.core.modes.plane.axes();
        let depth = self.axis_word(third);
        let over = [x, y].map(|axis| self.axis_word(axis));
        if self.core.modes.plane != Plane::Xy {
            self.core.left_out(&format!("{name} outside G17"), at);
            return Ok(());
        }
        self.core.modes.check_feed(at)?;
        let tool = self.radius_of(written, at)?;
        let hint = "state the radius of D in a set-up file (--setup), or write D0 for the path of the centre";
        let Some(tool) = tool else {
            self.core.not_applied(&format!("{name} without the radius of D"), at, hint);
            return Ok(());
        };
        let Some(radii) = circles(first, last, step, tool, at)? else {
            let subject = format!("{name} with a circle that is smaller than the tool");
            self.core.not_applied(&subject, at, "check I and D");
            return Ok(());
        };
        if rounds < 1.0 || rounds * radii.len() as f64 > MOST * 10.0 {
            let message = format!("expected a number of rounds in L, found {rounds}");
            return Err(fault("bad-repeats", at, message, "write L2; check Q too"));
        }
        let incremental = self.core.modes.incremental;
        let mut center = self.frames.position;
        for (axis, word) in [x, y].into_iter().zip(over) {
            let base = if incremental { center[axis] } else { 0.0 };
            center[axis] = word.map_or(center[axis], |w| base + w);
        }
        if center != self.frames.position {
            self.step(MoveKind::Rapid, center);
        }
        let feed = self.core.modes.feed;
        for _ in 0..rounds as u32 {
            let now = self.frames.position[third];
            let base = if incremental { now } else { 0.0 };
            let height = depth.map_or(now, |z| base + z);
            let strokes = circles_about([center[x], center[y]], height, &radii, ccw);
            self.mill(&strokes, [feed, feed], at)?;
        }
        Ok(())
    }
}

/// The radii of the path of the centre of the tool; `None` if the tool does not fit.
fn circles(
    first: Option<f64>,
    last: Option<f64>,
    step: Option<f64>,
    tool: f64,
    at: usize,
) -> Result<Option<Vec<f64>>, Fault> {
    let Some(first) = first else {
        let message = "G12 and G13 need I, the radius of the first circle";
        return Err(fault("missing-value", at, message, "write I10"));
    };
    let circles = match (last, step.map(f64::abs)) {
        (Some(last), Some(step)) if step > 0.0 && (last - first) / step < MOST => {
            growing(first, last, step)
        }
        (Some(_), _) => {
            let message = "K needs Q, the step from circle to circle, above 0 and not too small";
            return Err(fault("missing-value", at, message, "write Q2"));
        }
        (None, _) => vec![first],
    };
    let radii: Vec<f64> = circles.into_iter().map(|radius| radius - tool).collect();
    Ok((radii[0] > 0.0).then_some(radii))
}
