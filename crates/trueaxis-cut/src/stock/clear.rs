//! Lines that a cutter cannot have reached since it was last seen from them.
//!
//! Between two poses no point of the space moves by more, as seen from the cutter, than the tip moves and the axis turns times how far the point is
//! from the tip. A line whose material was 3 mm off a cutter is not met before the cutter moved by 3 mm.

use super::{SLACK_MM, Step};
use crate::Cutter;
use trueaxis_geometry::Vec3;

/// How far a cutter moved since the first of some steps, as seen from any place of the stock.
#[derive(Debug, Clone, Copy)]
pub(super) struct Travel {
    /// Which of the cutters of these steps it is.
    cutter: usize,
    way_mm: f64,
}

/// What each step adds to the way of its cutter, all of them in order; and how many cutters there are.
pub(super) fn travels(steps: &[Step<'_>], [low, high]: &[Vec3; 2]) -> (Vec<Travel>, usize) {
    let mut last: Vec<(&Cutter, &Step<'_>, f64)> = Vec::new();
    let travels = steps.iter().map(|step| {
        let known = last.iter().position(|(cutter, ..)| std::ptr::eq(*cutter, step.cutter));
        let Some(cutter) = known else {
            last.push((step.cutter, step, 0.0));
            return Travel { cutter: last.len() - 1, way_mm: 0.0 };
        };
        let (_, before, way_mm) = &mut last[cutter];
        let (from, to) = (&before.pose, &step.pose);
        let farthest = (low - to.tip_mm).abs().sup(&(high - to.tip_mm).abs());
        *way_mm +=
            (to.tip_mm - from.tip_mm).norm() + farthest.norm() * (to.axis - from.axis).norm();
        *before = step;
        Travel { cutter, way_mm: *way_mm }
    });
    let travels = travels.collect();
    (travels, last.len())
}

/// Up to which way of each cutter each line of a row is clear of it.
pub(super) struct Clear {
    in_row: usize,
    cutters: usize,
    /// Empty until the first line that is; then by cutter and line.
    until_mm: Vec<f64>,
}

impl Clear {
    pub fn new(in_row: usize, cutters: usize) -> Self {
        Self { in_row, cutters, until_mm: Vec::new() }
    }

    /// Whether the material of line `i` is clear of the cutter.
    pub fn is(&self, i: usize, travel: &Travel) -> bool {
        let until_mm = self.until_mm.get(travel.cutter * self.in_row + i);
        until_mm.is_some_and(|until_mm| travel.way_mm < *until_mm)
    }

    /// The material of line `i` is at least so far from the cutter.
    pub fn note(&mut self, i: usize, travel: &Travel, distance_mm: f64) {
        if distance_mm <= SLACK_MM {
            return;
        }
        if self.until_mm.is_empty() {
            self.until_mm = vec![f64::MIN; self.cutters * self.in_row];
        }
        self.until_mm[travel.cutter * self.in_row + i] = travel.way_mm + distance_mm - SLACK_MM;
    }
}
