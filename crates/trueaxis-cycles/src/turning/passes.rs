//! The passes of roughing, seen with the first coordinate along and the second one out.

use trueaxis_contour::plane::{Point, length, minus};

use super::stretch::{SAME_MM, Stretch};
use super::{Pockets, Roughing, TurnMove, TurningError};

/// Passes of one cycle.
pub(super) const MOST_PASSES: usize = 20_000;

/// Heights that differ by less are one height, mm.
const LEVEL_MM: f64 = 1e-9;

/// All moves for a way in and a profile at its distance.
pub(super) fn roughing(path: &[Stretch], how: &Roughing) -> Result<Vec<TurnMove>, TurningError> {
    let start = path[0].from;
    let mut divided = rising_or_falling(&path[..1]);
    let way_in = divided.len();
    divided.extend(rising_or_falling(&path[1..]));
    if let Some(last) = path.last().filter(|last| last.to[1] < start[1] - LEVEL_MM) {
        // The end is as far out as the start.
        divided.push(Stretch::line(last.to, [last.to[0], start[1]]));
    }
    let top = if how.pockets == Pockets::Only { f64::NEG_INFINITY } else { start[1] };
    let (moves, place) = (Vec::new(), [f64::NAN; 2]);
    let mut walk = Walk { path: divided, way_in, how, moves, place, top, passes: 0 };
    walk.go(start, true, None);
    walk.all()?;
    Ok(walk.moves)
}

/// Arcs divided where they are farthest in or out.
fn rising_or_falling(path: &[Stretch]) -> Vec<Stretch> {
    let mut parts = Vec::new();
    for stretch in path {
        let mut rest = *stretch;
        let mut turns: Vec<Point> =
            [-1.0, 1.0].iter().filter_map(|side| stretch.passes([0.0, *side], 1e-6)).collect();
        turns.sort_by(|a, b| stretch.part(*a).total_cmp(&stretch.part(*b)));
        for p in turns {
            parts.push(rest.until(p));
            rest = rest.after(p);
        }
        parts.push(rest);
    }
    parts
}

struct Walk<'r> {
    path: Vec<Stretch>,
    /// So many stretches are the way in.
    way_in: usize,
    how: &'r Roughing,
    moves: Vec<TurnMove>,
    place: Point,
    /// The height from which the passes are counted.
    top: f64,
    passes: usize,
}

impl Walk<'_> {
    fn go(&mut self, to: Point, rapid: bool, arc: Option<(Point, bool)>) {
        if length(minus(to, self.place)) < SAME_MM {
            return;
        }
        self.place = to;
        self.moves.push(TurnMove { to, rapid, arc });
    }

    /// Along a stretch: to the profile it is rapid where it falls straight.
    fn follow(&mut self, stretch: &Stretch, way_in: bool) {
        let rapid = way_in && stretch.arc.is_none() && stretch.to[1] < stretch.from[1];
        self.go(stretch.to, rapid, stretch.arc);
    }

    fn all(&mut self) -> Result<(), TurningError> {
        // The path has stopped falling once: where it falls again, there is a pocket.
        let mut pocket = false;
        let mut index = 0;
        while let Some(stretch) = self.path.get(index).copied() {
            let falls = stretch.to[1] < stretch.from[1] - LEVEL_MM;
            let way_in = index < self.way_in;
            pocket |= !falls;
            match self.how.pockets {
                Pockets::Cut if falls => self.layers(index, stretch, way_in)?,
                Pockets::Left if falls && !pocket => self.layers(index, stretch, way_in)?,
                Pockets::Left if falls => match self.pass_over(index, stretch) {
                    Some(next) => index = next,
                    // The control ends the cycle here.
                    None => return Ok(()),
                },
                Pockets::Only if falls && pocket => self.pocket(index, stretch)?,
                _ => self.follow(&stretch, way_in),
            }
            index += 1;
        }
        Ok(())
    }

    /// Passes wherever a falling stretch goes below the next height.
    fn layers(&mut self, index: usize, stretch: Stretch, way_in: bool) -> Result<(), TurningError> {
        let [from, to] = [stretch.from[1], stretch.to[1]];
        let step = self.how.step_mm;
        let first = ((self.top - from - LEVEL_MM) / step).ceil().max(0.0);
        if (from - to) / step > MOST_PASSES as f64 {
            return Err(TurningError::TooMany);
        }
        let mut rest = stretch;
        for n in 0_u32.. {
            let height = self.top - (first + f64::from(n)) * step;
            if height <= to + LEVEL_MM {
                break;
            }
            let p = if height >= from - LEVEL_MM { stretch.from } else { rest.at_height(height) };
            self.follow(&rest.until(p), way_in);
            rest = rest.after(p);
            self.pass(index, p, way_in)?;
        }
        self.follow(&rest, way_in);
        Ok(())
    }

    /// One pass from a point of the path to the profile, off it, and back to the point.
    fn pass(&mut self, index: usize, p: Point, way_in: bool) -> Result<(), TurningError> {
        self.passes += 1;
        if self.passes > MOST_PASSES {
            return Err(TurningError::TooMany);
        }
        let Some((_, end)) = self.met(index, p[1]) else { return Ok(()) };
        let along = (end[0] - p[0]).abs();
        let given = self.how.retract_mm;
        let off = if (0.0..along / 2.0).contains(&given) { given } else { along / 2.0 };
        self.go(end, false, None);
        self.go([end[0] - off, p[1] + off], true, None);
        self.go([p[0] + off, p[1] + off], true, None);
        self.go(p, way_in, None);
        Ok(())
    }

    /// Where the path after a falling stretch comes up to a height again: stretch and point.
    fn met(&self, index: usize, height: f64) -> Option<(usize, Point)> {
        let rest = self.path.iter().enumerate().skip(index + 1);
        let mut up = rest.filter(|(_, s)| s.to[1] >= height - LEVEL_MM);
        let (n, stretch) = up.next()?;
        let reached = stretch.to[1] < height + LEVEL_MM;
        Some((n, if reached { [stretch.to[0], height] } else { stretch.at_height(height) }))
    }

    /// From the edge of a pocket straight to its far side; the stretch on which the path goes on is left shortened.
    fn pass_over(&mut self, index: usize, stretch: Stretch) -> Option<usize> {
        let (next, end) = self.met(index, stretch.from[1])?;
        self.go(end, false, None);
        let rest = self.path[next].after(end);
        if !rest.is_empty() {
            self.follow(&rest, false);
        }
        Some(next)
    }

    /// The passes of a pocket are counted from its edge, those of a pocket in a pocket from the outer edge.
    fn pocket(&mut self, index: usize, stretch: Stretch) -> Result<(), TurningError> {
        let edge = stretch.from[1];
        if edge > self.top + LEVEL_MM {
            // From an arc the control goes on, from a line it does not come to an end.
            if stretch.arc.is_none() && self.met(index, edge).is_none() {
                return Err(TurningError::Open);
            }
            self.top = edge;
        }
        self.layers(index, stretch, false)
    }
}
