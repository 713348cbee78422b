//! What is kept of the points of a path until it is decided through which of their states the best way leads.
//!
//! Two branches of a machine mostly stay possible to the end of a path: of a point only the angles of its
//! branches are kept, and how its states come from them, which is mostly as at the point before.

#![expect(clippy::cast_possible_truncation, reason = "no memory holds 2^32 points or branches")]

/// How a state comes from a branch, and from which state of the point before the best way leads to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kept {
    pub branch: u32,
    pub before: u32,
    /// Whole turns of the aiming axes.
    pub turns: [i32; 2],
}

/// Points in a row, none of them decided.
#[derive(Default)]
pub(super) struct Undecided {
    /// Angles of the aiming axes, branch by branch.
    angles: Vec<[f64; 2]>,
    /// Where the angles of a point begin.
    begins: Vec<u32>,
    /// Which of the lists of states a point has.
    lists: Vec<u32>,
    /// Where the lists of states end, one after the other.
    ends: Vec<usize>,
    kept: Vec<Kept>,
    /// The states in which a way leads through a point.
    chosen: Vec<u32>,
}

impl Undecided {
    pub fn len(&self) -> usize {
        self.begins.len()
    }

    fn list(&self, list: usize) -> &[Kept] {
        let begin = list.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.kept[begin..self.ends[list]]
    }

    fn states(&self, point: usize) -> &[Kept] {
        self.list(self.lists[point] as usize)
    }

    /// Adds a point.
    pub fn push(&mut self, angles: impl Iterator<Item = [f64; 2]>, states: &[Kept]) {
        self.begins.push(self.angles.len() as u32);
        self.angles.extend(angles);
        let last = self.ends.len().checked_sub(1);
        if last.is_none_or(|last| self.list(last) != states) {
            self.kept.extend_from_slice(states);
            self.ends.push(self.kept.len());
        }
        self.lists.push(self.ends.len() as u32 - 1);
    }

    /// The last point at which all ways to the last point come together, if there is one, and its state.
    pub fn junction(&self, mut alive: Vec<u32>) -> Option<(usize, u32)> {
        for point in (0..self.len()).rev() {
            if let [one] = alive[..] {
                return Some((point, one));
            }
            let states = self.states(point);
            alive.iter_mut().for_each(|state| *state = states[*state as usize].before);
            alive.sort_unstable();
            alive.dedup();
        }
        None
    }

    /// Hands out the points up to one along the best way to a state of it, and forgets them: the angles for
    /// which the linear axes are placed, and the whole turns from there.
    pub fn decide(&mut self, (last, state): (usize, u32), out: &mut dyn FnMut([f64; 2], [i32; 2])) {
        let mut chosen = std::mem::take(&mut self.chosen);
        chosen.clear();
        let mut state = state;
        for point in (0..=last).rev() {
            chosen.push(state);
            state = self.states(point)[state as usize].before;
        }
        for (point, state) in chosen.iter().rev().enumerate() {
            let kept = self.states(point)[*state as usize];
            out(self.angles[self.begins[point] as usize + kept.branch as usize], kept.turns);
        }
        self.chosen = chosen;
        self.forget(last + 1);
    }

    fn forget(&mut self, points: usize) {
        let Some(begin) = self.begins.get(points).copied() else {
            *self = Self::default();
            return;
        };
        self.angles.drain(..begin as usize);
        self.begins.drain(..points);
        self.begins.iter_mut().for_each(|at| *at -= begin);
        self.lists.drain(..points);
        let lists = self.lists[0] as usize;
        if let Some(before) = lists.checked_sub(1) {
            let begin = self.ends[before];
            self.kept.drain(..begin);
            self.ends.drain(..lists);
            self.ends.iter_mut().for_each(|at| *at -= begin);
            self.lists.iter_mut().for_each(|list| *list -= lists as u32);
        }
    }
}
