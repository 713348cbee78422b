use super::{Run, fault};
use crate::execution::arcs::by_radius;
use crate::moves::{Arc, MoveKind, Position};
use crate::text::program::Fault;

impl Run<'_> {
    /// G2 and G3: a circle or helix to a target, by centre or by radius.
    pub(super) fn arc(&mut self, ccw: bool, target: Position, at: usize) -> Result<(), Fault> {
        let plane = self.modes.plane;
        self.check_round(plane, at);
        let [first, second, _] = plane.axes();
        let start = [self.frames.position[first], self.frames.position[second]];
        let end = [target[first], target[second]];
        let center_mm = match self.length(b'R') {
            Some(radius) => by_radius(start, end, radius, ccw, at)?,
            None => self.by_center(start, end, at)?,
        };
        let turns = match self.words.take(b'P') {
            None => 1,
            Some(p) if p >= 1.0 && p.fract() == 0.0 && p < 1e6 => p as u32,
            Some(p) => {
                let message = format!("P{p} is not a number of turns");
                return Err(fault("bad-turns", at, message, "write a whole number from 1 on"));
            }
        };
        self.step(MoveKind::Arc(Arc { plane, center_mm, turns, ccw }), target);
        Ok(())
    }

    fn by_center(&mut self, start: [f64; 2], end: [f64; 2], at: usize) -> Result<[f64; 2], Fault> {
        let letters = self.modes.plane.axes().map(|a| b"IJK"[a as usize]);
        let given = [letters[0], letters[1]].map(|l| self.length(l));
        if given == [None, None] {
            let message = "neither the centre nor the radius of the arc is given".to_owned();
            let hint = "write I J K of the plane, or R";
            return Err(fault("arc-without-centre", at, message, hint));
        }
        let base = if self.modes.arc_absolute { [0.0; 2] } else { start };
        let center = [0, 1].map(|i| base[i] + given[i].unwrap_or(0.0));
        let radius = |p: [f64; 2]| (p[0] - center[0]).hypot(p[1] - center[1]);
        let (from, to) = (radius(start), radius(end));
        if from <= 0.0 || to <= 0.0 {
            let message = "the radius of the arc is zero".to_owned();
            return Err(fault("arc-does-not-fit", at, message, "check I, J and K"));
        }
        let least = 2.0_f64.sqrt() * if self.modes.inches { 0.002 * 25.4 } else { 0.02 };
        let (gap, relative) = ((from - to).abs(), (from - to).abs() / from.max(to));
        if gap > 100.0 * least || gap > least && relative > 0.001 {
            let message = format!(
                "the arc does not fit: radius {from:.4} mm at its start, {to:.4} mm at its end"
            );
            let hint = "check I, J, K and whether they are incremental (G91.1) or absolute (G90.1)";
            return Err(fault("arc-does-not-fit", at, message, hint));
        }
        Ok(center)
    }
}
