//! Circles and helices: G2 and G3.

use super::{Run, fault};
use crate::execution::{arcs, mistakes};
use crate::moves::{Arc, Axis, MoveKind, Position};
use crate::text::program::Fault;

impl Run<'_> {
    /// G2 and G3: a circle or helix to a target, by centre or by radius.
    pub(super) fn arc(&mut self, ccw: bool, target: Position, at: usize) -> Result<(), Fault> {
        let plane = self.core.modes.plane;
        self.check_round(plane, at);
        let [first, second, _] = plane.axes();
        let start = [self.frames.position[first], self.frames.position[second]];
        let end = [target[first], target[second]];
        let center_mm = match self.length(b'R') {
            Some(radius) => {
                let rounding_mm = arcs::rounding_mm(radius);
                arcs::by_radius([start, end], radius, ccw, rounding_mm, at)?
            }
            None => self.by_center([start, end], at)?,
        };
        let turns = match self.words.take(b'P') {
            None => 1,
            Some(p) if p >= 1.0 && p.fract() == 0.0 && p < 1e6 => p as u32,
            Some(p) => return Err(mistakes::bad_turns(p, at)),
        };
        // Each further one begins where the last has ended.
        let further = target.minus(&self.frames.position);
        for n in 0..self.arc_repeats(at)? {
            let by = |axis: Axis| f64::from(n) * further[axis];
            let center_mm = [center_mm[0] + by(first), center_mm[1] + by(second)];
            let target = Position(Axis::ALL.map(|axis| target[axis] + by(axis)));
            self.step(MoveKind::Arc(Arc { plane, center_mm, turns, ccw }), target);
        }
        Ok(())
    }

    /// L of HAAS: how often an incremental arc is executed.
    ///
    /// # Source
    /// Haas Automation, "Mill Operator's Manual", single-point thread milling, O60025: `I-0.5 J0 Z0.125 L5 (Thread
    /// cut, repeat 5 times)` after G91. What L does after G90 it does not say.
    fn arc_repeats(&mut self, at: usize) -> Result<u32, Fault> {
        let Some(count) = self.words.look(b'L').filter(|_| self.is_haas()) else { return Ok(1) };
        self.words.take(b'L');
        if count.fract() != 0.0 || !(1.0..1e5).contains(&count) {
            let message = format!("expected a whole number of arcs, found {count}");
            return Err(fault("bad-repeats", at, message, "write L2"));
        }
        if count > 1.0 && !self.core.modes.incremental {
            self.core.left_out("L of G2 or G3 after G90, which repeats arcs after G91,", at);
            return Ok(1);
        }
        Ok(count as u32)
    }

    pub(super) fn by_center(&mut self, ends: [[f64; 2]; 2], at: usize) -> Result<[f64; 2], Fault> {
        let letters = self.core.modes.plane.axes().map(|a| b"IJK"[a as usize]);
        let given = [letters[0], letters[1]].map(|l| self.length(l));
        if given == [None, None] {
            return Err(mistakes::arc_without_centre("write I J K of the plane, or R", at));
        }
        let base = if self.modes.arc_absolute { [0.0; 2] } else { ends[0] };
        let center = [0, 1].map(|i| base[i] + given[i].unwrap_or(0.0));
        let least = 2.0_f64.sqrt() * if self.core.modes.inches { 0.002 * 25.4 } else { 0.02 };
        let allowed_mm = |radius: f64| least.max(0.001 * radius).min(100.0 * least);
        arcs::check_radii(ends, center, allowed_mm, at)?;
        Ok(center)
    }
}
