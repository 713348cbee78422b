//! The points of a path that are decided.

use std::f64::consts::TAU;

/// Where the aiming axes stand at the points of a path. The linear axes follow from that and from the tips:
/// [`super::FollowSolver::command`]. A point needs 16 bytes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FollowedPath {
    /// The angles for which the linear axes are placed, rad.
    placed: Vec<[f64; 2]>,
    /// Whole turns from there, each from a point on.
    turns: Vec<(usize, [f64; 2])>,
}

impl FollowedPath {
    /// The number of points.
    pub fn len(&self) -> usize {
        self.placed.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.placed.is_empty()
    }

    pub(super) fn push(&mut self, placed: [f64; 2], turns: [f64; 2]) {
        if self.turns.last().is_none_or(|(_, last)| *last != turns) {
            self.turns.push((self.placed.len(), turns));
        }
        self.placed.push(placed);
    }

    /// The angles of a point as they are placed and as they are turned, rad.
    pub(super) fn angles(&self, point: usize) -> [[f64; 2]; 2] {
        let placed = self.placed[point];
        let after = self.turns.partition_point(|(from, _)| *from <= point);
        let turns = after.checked_sub(1).map_or([0.0; 2], |last| self.turns[last].1);
        [placed, turned(placed, turns)]
    }
}

/// Angles with whole turns added.
pub(super) fn turned(placed: [f64; 2], turns: [f64; 2]) -> [f64; 2] {
    std::array::from_fn(|k| match turns[k] {
        0.0 => placed[k],
        whole => placed[k] + TAU * whole,
    })
}
