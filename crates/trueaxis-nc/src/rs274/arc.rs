//! Circles and helices: G2 and G3.

use super::Run;
use crate::execution::{arcs, mistakes};
use crate::moves::{Arc, MoveKind, Position};
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
        self.step(MoveKind::Arc(Arc { plane, center_mm, turns, ccw }), target);
        Ok(())
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
