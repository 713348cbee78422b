//! The strokes of a whole file in little memory.

use crate::path::{Stand, Stroke, Way};
use std::ops::Range;

/// What changes from stroke to stroke seldom.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mode {
    rapid: bool,
    feed: f64,
    /// The line less the number of the stroke.
    line: i64,
}

/// Strokes by their number; each needs the 48 bytes of its end.
#[derive(Debug, Clone, Default)]
pub(crate) struct Strokes {
    ends: Vec<Stand>,
    /// Each from a stroke on.
    modes: Vec<(usize, Mode)>,
    /// The ways that are no lines.
    arcs: Vec<(usize, Way)>,
}

impl Strokes {
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    pub fn reserve(&mut self, strokes: usize) {
        self.ends.reserve(strokes);
    }

    pub fn push(&mut self, stroke: &Stroke) {
        let Stroke { to, way, rapid, feed, line } = *stroke;
        let index = self.ends.len();
        let mode = Mode { rapid, feed, line: i64::from(line) - index as i64 };
        if self.modes.last().is_none_or(|(_, last)| *last != mode) {
            self.modes.push((index, mode));
        }
        if way != Way::Line {
            self.arcs.push((index, way));
        }
        self.ends.push(to);
    }

    /// Appends strokes of another list.
    pub fn push_all(&mut self, others: &Self, range: Range<usize>) {
        let shift = self.ends.len() as i64 - range.start as i64;
        let before = others.modes.partition_point(|(from, _)| *from <= range.start);
        for (from, mode) in &others.modes[before.saturating_sub(1)..] {
            if *from >= range.end || range.is_empty() {
                break;
            }
            let index = (range.start.max(*from) as i64 + shift) as usize;
            let mode = Mode { line: mode.line - shift, ..*mode };
            if self.modes.last().is_none_or(|(_, last)| *last != mode) {
                self.modes.push((index, mode));
            }
        }
        let arcs = others.arcs.iter().filter(|(at, _)| range.contains(at));
        self.arcs.extend(arcs.map(|(at, way)| ((*at as i64 + shift) as usize, *way)));
        self.ends.extend_from_slice(&others.ends[range]);
    }

    /// Where a stroke ends.
    pub fn to(&self, index: usize) -> Stand {
        self.ends[index]
    }

    pub fn last_to(&self) -> Option<Stand> {
        self.ends.last().copied()
    }

    /// All ends.
    pub fn ends(&self) -> &[Stand] {
        &self.ends
    }

    /// All ends, to turn their tool axes.
    pub fn ends_mut(&mut self) -> &mut [Stand] {
        &mut self.ends
    }

    pub fn line(&self, index: usize) -> u32 {
        let (line, _, _) = self.mode(index);
        line
    }

    fn mode(&self, index: usize) -> (u32, bool, f64) {
        let after = self.modes.partition_point(|(from, _)| *from <= index);
        let mode = after.checked_sub(1).map(|at| self.modes[at].1);
        mode.map_or((0, true, 0.0), |m| ((m.line + index as i64) as u32, m.rapid, m.feed))
    }

    pub fn get(&self, index: usize) -> Stroke {
        let (line, rapid, feed) = self.mode(index);
        let way = match self.arcs.binary_search_by_key(&index, |(at, _)| *at) {
            Ok(at) => self.arcs[at].1,
            Err(_) => Way::Line,
        };
        Stroke { to: self.ends[index], way, rapid, feed, line }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_geometry::Vec3;

    /// Strokes in pieces from another list are those pushed one by one; with feeds, lines and arcs that change.
    #[test]
    fn law_strokes_of_another_list_are_those_pushed_one_by_one() {
        let arc = Way::Arc { center: Vec3::zeros(), normal: Vec3::z(), angle_rad: 1.0 };
        let mut all = Strokes::default();
        for i in 0..60_u32 {
            let to = Stand { tip: Vec3::repeat(f64::from(i)), axis: Vec3::z() };
            let way = if i % 7 == 3 { arc } else { Way::Line };
            let (rapid, feed) = (i % 20 < 2, f64::from(i / 9));
            all.push(&Stroke { to, way, rapid, feed, line: i + i / 11 });
        }
        for first in 0..60 {
            for last in first..=60 {
                let (mut pieces, mut single) = (Strokes::default(), Strokes::default());
                for range in [0..first.min(5), first..last, 40..40, last / 2..last] {
                    pieces.push_all(&all, range.clone());
                    range.for_each(|i| single.push(&all.get(i)));
                }
                let list = |s: &Strokes| (0..s.len()).map(|i| s.get(i)).collect::<Vec<Stroke>>();
                assert_eq!(list(&pieces), list(&single));
                assert_eq!(pieces.modes, single.modes);
            }
        }
    }
}
