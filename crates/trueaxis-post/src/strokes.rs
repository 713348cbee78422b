//! The strokes of a whole file in little memory.

use crate::path::{Stand, Stroke, Way};

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

    pub fn iter(&self) -> impl Iterator<Item = Stroke> {
        (0..self.len()).map(|index| self.get(index))
    }
}
