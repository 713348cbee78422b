//! Which block of a program is which part of the file.

/// What a block of the program has to do with the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BlockPlace {
    /// The line of the program, from 1.
    pub line: u32,
    /// The stroke.
    pub stroke: u32,
    /// Which part of the stroke it begins at; `None` where it is not the way of the stroke: the
    /// tool comes down to its end after a tool change, or at the beginning.
    pub from: Option<f64>,
    /// Which part of the stroke it ends: 1 is its end.
    pub until: f64,
}

/// A hole that the control drills by its own cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct HolePlace {
    /// The lines of the program from and to, from 1.
    pub lines: [u32; 2],
    /// Which of the holes.
    pub hole: usize,
}

/// Blocks in order of their lines; one that is a whole stroke needs 8 bytes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Places {
    /// The line and the stroke.
    whole: Vec<[u32; 2]>,
    /// Which of them are no whole strokes: their parts.
    parts: Vec<(usize, Option<f64>, f64)>,
}

impl Places {
    pub fn len(&self) -> usize {
        self.whole.len()
    }

    pub fn push(&mut self, place: &BlockPlace) {
        let BlockPlace { line, stroke, from, until } = *place;
        if (from, until) != (Some(0.0), 1.0) {
            self.parts.push((self.whole.len(), from, until));
        }
        self.whole.push([line, stroke]);
    }

    pub fn get(&self, index: usize) -> BlockPlace {
        let [line, stroke] = self.whole[index];
        let (from, until) = match self.parts.binary_search_by_key(&index, |(at, ..)| *at) {
            Ok(at) => (self.parts[at].1, self.parts[at].2),
            Err(_) => (Some(0.0), 1.0),
        };
        BlockPlace { line, stroke, from, until }
    }

    /// The first block that is not before a line, and whether it is this line. Mostly it is one of the first
    /// from `near` on.
    pub fn find(&self, line: u32, near: usize) -> (usize, bool) {
        let is_before = |index: usize| self.whole.get(index).is_some_and(|at| at[0] < line);
        let begins = |index: usize| index.checked_sub(1).is_none_or(is_before);
        let guess = [near.saturating_sub(1), near, near + 1];
        let index = guess
            .into_iter()
            .find(|at| *at <= self.len() && begins(*at) && !is_before(*at))
            .unwrap_or_else(|| self.whole.partition_point(|at| at[0] < line));
        (index, self.whole.get(index).is_some_and(|at| at[0] == line))
    }
}
