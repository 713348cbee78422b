//! How much of the picture each node of the path carries.
//!
//! Of every 64 consecutive pieces of the path, of every 64 such stretches, and so on, the one line
//! between their ends is refined at the node that is farthest from it until none is left out (Ramer;
//! Douglas and Peucker); then the same with stretches that begin half a stretch later, since a corner
//! where two stretches meet is seen by neither. So no path takes longer than a few passes over it. How
//! far the omitted nodes lie from what is drawn is measured when it is drawn.

use super::columns::{Columns, RAPID};
use trueaxis_geometry::Vec3;

/// Pieces of a stretch.
const STRETCH: usize = 64;
/// A deviation as large as the largest counts as so much of the size of the path: pictures draw it
/// enlarged, about so long.
const SHOWN: f64 = 0.05;
/// A change between feed and rapid counts as so much of the size of the path.
const CHANGE: f64 = 0.01;

/// The detail of every node, mm; the higher, the sooner it must be drawn.
pub(super) fn details(columns: &Columns) -> Vec<f32> {
    let count = columns.len();
    let mut refine = Refine::of(columns);
    let mut step = 1;
    while step < count {
        let ends: Vec<usize> = (0..count).step_by(step).chain([count - 1]).collect();
        for first in [0, STRETCH / 2] {
            for from in (first..ends.len()).step_by(STRETCH) {
                refine.refine(&ends[from..(from + STRETCH + 1).min(ends.len())]);
            }
        }
        step *= STRETCH;
    }
    for i in 1..count {
        if (columns.flags[i] ^ columns.flags[i - 1]) & RAPID != 0 {
            let change = (CHANGE * refine.size_mm) as f32;
            refine.detail[i - 1] = refine.detail[i - 1].max(change);
        }
    }
    refine.detail
}

struct Refine<'c> {
    columns: &'c Columns,
    size_mm: f64,
    /// mm of the picture for a µm of deviation.
    enlarged: f64,
    detail: Vec<f32>,
    open: Vec<(usize, usize)>,
}

impl<'c> Refine<'c> {
    fn of(columns: &'c Columns) -> Self {
        let tips = || columns.tip_mm.iter().map(|tip| Vec3::from(*tip));
        let first = tips().next().unwrap_or_default();
        let (low, high) = tips().fold((first, first), |(l, h), p| (l.inf(&p), h.sup(&p)));
        let most_um = (0..columns.len()).map(|i| columns.off(i)).fold(0.0, f32::max);
        let size_mm = (high - low).norm();
        Self {
            columns,
            size_mm,
            enlarged: if most_um > 0.0 { SHOWN * size_mm / f64::from(most_um) } else { 0.0 },
            detail: vec![0.0; columns.len()],
            open: Vec::new(),
        }
    }

    /// Refines the line between the ends of a stretch.
    fn refine(&mut self, nodes: &[usize]) {
        self.open.push((0, nodes.len() - 1));
        while let Some((from, to)) = self.open.pop() {
            let far = |k: usize| (self.offset(nodes[from], nodes[to], nodes[k]) as f32, k);
            let inner = (from + 1..to).map(far);
            let Some((far, k)) = inner.max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
            if far > 0.0 {
                self.detail[nodes[k]] = self.detail[nodes[k]].max(far);
                self.open.extend([(from, k), (k, to)]);
            }
        }
    }

    /// How far a node is from the line between two others, in the picture.
    fn offset(&self, from: usize, to: usize, i: usize) -> f64 {
        let tip = |k: usize| Vec3::from(self.columns.tip_mm[k]);
        let off = |k: usize| Vec3::from(self.columns.off_um[k].map(f64::from));
        let (beside_mm, part) = from_piece(tip(i), tip(from), tip(to));
        let uneven = off(i) - (off(from) + (off(to) - off(from)) * part);
        beside_mm.max(self.enlarged * uneven.norm())
    }
}

/// The distance of a point from the piece of a line, and at which part of the piece it is nearest.
pub(super) fn from_piece(point: Vec3, from: Vec3, to: Vec3) -> (f64, f64) {
    let (move_by, off) = (to - from, point - from);
    let square = move_by.norm_squared();
    let part = if square > 0.0 { (off.dot(&move_by) / square).clamp(0.0, 1.0) } else { 0.0 };
    ((off - move_by * part).norm(), part)
}
