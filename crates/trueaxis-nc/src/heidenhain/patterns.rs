//! Cycles 220 and 221: the last drilling cycle at the holes of a pattern.

use std::collections::BTreeMap;

use super::cycles::Cycle;
use super::{Run, fault};
use crate::moves::MoveKind;
use crate::text::program::Fault;
use trueaxis_cycles::Point;
use trueaxis_cycles::pattern::{Circle, Grid, MOST_HOLES};

impl Run<'_> {
    /// Cycle 220 (circle) or 221 (rows, every second one backwards), which call the cycle before them at once.
    ///
    /// # Source
    /// User's manual "Cycle programming" of TNC 620 and iTNC 530, cycles 220 and 221: Q200, Q203 and Q204 of the
    /// pattern are in force; with Q301=0 the tool stays at the set-up clearance between the holes.
    pub(super) fn hole_pattern(
        &mut self,
        number: u32,
        values: &BTreeMap<u32, f64>,
        at: usize,
    ) -> Result<(), Fault> {
        let cycle = match &self.cycle {
            Some(Cycle::Drilling(cycle, own)) if *cycle >= 200 => Some((*cycle, own.clone())),
            _ => None,
        };
        let Some((cycle, mut own)) = cycle else {
            self.core
                .left_out(&format!("the pattern of cycle {number} without a cycle before it"), at);
            return Ok(());
        };
        own.extend([200, 203, 204].into_iter().filter_map(|q| Some((q, *values.get(&q)?))));
        let holes = self.holes(number, values, at)?;
        let mm = self.core.modes.unit_mm();
        let of = |q: u32| own.get(&q).copied().unwrap_or(0.0) * mm;
        let clear = of(203) + of(200).abs().max(of(204));
        let [first, second, along] = self.core.modes.plane.axes();
        if self.frames.position[along] < clear {
            let mut up = self.frames.position;
            up[along] = clear;
            self.step(MoveKind::Rapid, up, at)?;
        }
        let mut between = own.clone();
        if values.get(&301) == Some(&0.0) {
            between.insert(204, 0.0);
        }
        for (i, hole) in holes.iter().enumerate() {
            let mut over = self.frames.position;
            (over[first], over[second]) = (hole[0], hole[1]);
            self.step(MoveKind::Rapid, over, at)?;
            let last = i + 1 == holes.len();
            self.machine_hole(cycle, if last { &own } else { &between }, at)?;
        }
        Ok(())
    }

    fn holes(
        &self,
        number: u32,
        values: &BTreeMap<u32, f64>,
        at: usize,
    ) -> Result<Vec<Point>, Fault> {
        let mm = self.core.modes.unit_mm();
        let value = |q: u32| values.get(&q).copied().unwrap_or(0.0);
        let count = |q: u32| match value(q) {
            n if (1.0..=f64::from(MOST_HOLES)).contains(&n) => Ok(n as u32),
            n => {
                let message = format!("expected a number of holes in Q{q}, found {n}");
                Err(fault("bad-repeats", at, message, "write for example Q241=+8"))
            }
        };
        if number == 221 {
            return Ok(Grid {
                from: [value(225) * mm, value(226) * mm],
                angle_deg: value(224),
                spacing_mm: [value(237) * mm, value(238) * mm],
                counts: [count(242)?, count(243)?],
            }
            .holes());
        }
        let (count, start_deg, whole) = (count(241)?, value(245), value(246) - value(245));
        let gaps = if (whole.abs() - 360.0).abs() < 1e-9 { count } else { (count - 1).max(1) };
        let step_deg = if value(247) == 0.0 { whole / f64::from(gaps) } else { value(247) };
        let radius_mm = value(244).abs() * mm / 2.0;
        Ok(Circle {
            center: [value(216) * mm, value(217) * mm],
            radius_mm,
            start_deg,
            step_deg,
            count,
        }
        .holes())
    }
}
