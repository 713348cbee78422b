//! The proof for holes that the control drills by its own cycle.

use crate::path::{Drilled, Stand};
use crate::verify::Compare;
use trueaxis_geometry::angle;

/// Nearer to the axis of a hole than this the tool is over it, mm.
const OVER_MM: f64 = 0.05;

impl Compare<'_> {
    /// Takes a place if it belongs to a cycle.
    pub(crate) fn take_drilled(&mut self, line: u32, is: Stand, rapid: bool) -> bool {
        let holes = &self.posted.drilled;
        while holes.get(self.next_hole).is_some_and(|hole| hole.lines[1] < line) {
            self.end_hole();
        }
        let within = holes.get(self.next_hole).is_some_and(|hole| hole.lines[0] <= line);
        if within {
            if self.drilled.is_empty() {
                // Where the tool was before.
                self.drilled.push((self.at, true));
            }
            self.drilled.push((is, rapid));
        }
        within
    }

    /// What the cycle did is that what the file asks for.
    pub(crate) fn end_hole(&mut self) {
        let Some(place) = self.posted.drilled.get(self.next_hole) else { return };
        self.next_hole += 1;
        let hole = &self.posted.path.holes[place.hole];
        let ways = std::mem::take(&mut self.drilled);
        let (line, file_line) = (place.lines[1], self.posted.path.strokes.line(hole.last));
        let off = off_the_hole(hole, &ways);
        let turned = ways.iter().map(|(is, _)| angle(&is.axis, &hole.surface.axis));
        let turned = turned.fold(0.0, f64::max);
        self.found.tip_at_ends.take(off, line, file_line);
        self.found.tip_between.take(off, line, file_line);
        self.found.axis_at_ends.take(turned, line, file_line);
        self.found.axis_between.take(turned, line, file_line);
        self.found.compared += 1;
    }
}

/// The largest of: the distance from the axis of the hole below its retract height; how far the tool goes in rapid
/// traverse below what is drilled already; by how much a peck is deeper than asked; the difference of the bottom;
/// where it ends. mm.
///
/// How high a control lifts the tool between the pecks, how near to the last depth it comes back in rapid
/// traverse, and whether it counts the first peck from the surface or from the clearance, is its own.
fn off_the_hole(hole: &Drilled, ways: &[(Stand, bool)]) -> f64 {
    let (tip, axis, cycle) = (hole.surface.tip, hole.surface.axis, &hole.cycle);
    let height = |is: &Stand| (is.tip - tip).dot(&axis);
    let beside = |is: &Stand| (is.tip - tip - axis * height(is)).norm();
    let (mut off, mut lowest, mut depths) = (0.0_f64, cycle.clearance_mm, Vec::new());
    for pair in ways.windows(2) {
        let [(before, _), (is, rapid)] = [pair[0], pair[1]];
        let (from, to) = (height(&before), height(&is));
        if beside(&before).max(beside(&is)) > OVER_MM {
            // On the way to the hole.
            off = off.max(cycle.retract_mm - from.min(to));
            continue;
        }
        off = off.max(beside(&is));
        if rapid {
            off = off.max(lowest - to);
        } else if to < lowest {
            lowest = to;
            // The end of a peck is where the feed ends; until then it goes deeper.
            match depths.last_mut() {
                Some((depth, open)) if *open => *depth = -to,
                _ => depths.push((-to, true)),
            }
            continue;
        }
        if let Some((_, open)) = depths.last_mut() {
            *open = false;
        }
    }
    let (Some((end, _)), Some((bottom, _))) = (ways.last(), depths.last()) else {
        return f64::INFINITY;
    };
    let [first, further] = cycle.pecks_mm.unwrap_or([f64::INFINITY; 2]);
    let mut before = 0.0;
    for (n, (depth, _)) in depths.iter().enumerate() {
        off = off.max(depth - before - if n == 0 { first } else { further });
        before = *depth;
    }
    if cycle.pecks_mm.is_none() && depths.len() > 1 {
        return f64::INFINITY;
    }
    off = off.max((bottom - cycle.depth_mm).abs());
    off.max((height(end) - cycle.retract_mm).abs()).max(beside(end))
}
