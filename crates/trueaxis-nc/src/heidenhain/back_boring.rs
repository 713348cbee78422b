//! Cycle 204: a counterbore from below through a hole.

use std::collections::BTreeMap;

use super::Run;
use crate::execution::{check_feed, mistakes};
use crate::moves::{Event, Feed, FeedMode, MoveKind, Position};
use crate::text::program::Fault;

impl Run<'_> {
    /// Q249 depth of the counterbore upwards, Q250 thickness of the material, Q251 by how much the edge is off the
    /// centre, Q252 from the lower end of the tool to its edge, Q253 the feed in the hole, Q254 the feed of the
    /// counterbore, Q255 the wait, Q214 the direction aside (1 and 3: the first axis, negative and positive; 2 and 4: the
    /// second), Q336 the angle of the spindle. The length of the tool counts to its lower end.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`.
    pub(super) fn bore_back(
        &mut self,
        values: &BTreeMap<u32, f64>,
        at: usize,
    ) -> Result<(), Fault> {
        if self.core.has_radius() {
            return Err(mistakes::cycle_on_contour("cycle 204", at));
        }
        let mm = self.core.modes.unit_mm();
        let value = |q: u32| values.get(&q).copied().unwrap_or(0.0);
        let length = |q: u32| value(q) * mm;
        let [first, second, along] = self.core.modes.plane.axes();
        let (axis, sign) = match value(214) {
            1.0 => (first, -1.0),
            2.0 => (second, -1.0),
            3.0 => (first, 1.0),
            4.0 => (second, 1.0),
            d => {
                let subject = format!("cycle 204 with Q214={d}");
                self.core.not_applied(&subject, at, "state the direction aside: Q214=1 to 4");
                return Ok(());
            }
        };
        if value(249) <= 0.0 {
            return Err(mistakes::missing_depth(at));
        }
        let unit = self.core.modes.unit_of_klartext_feed();
        let feed = |q: u32| Feed { mode: FeedMode::PerMinute, value: value(q) * unit };
        for q in [253, 254] {
            check_feed(&feed(q), at)?;
        }
        let (surface, clear) = (length(203), length(200).abs());
        let edge = surface - length(250).abs();
        let (below, end) = (edge - clear - length(252), edge + length(249) - length(252));
        let center = self.frames.position;
        let off = sign * length(251).abs();
        let aside = |place: &Position| {
            let mut aside = *place;
            aside[axis] = place[axis] + off;
            aside
        };
        let up = |height: f64| {
            let mut p = center;
            p[along] = height;
            p
        };
        let (over, under) = (up(surface + clear), up(below));
        let orient = Event::SpindleOrient { angle_deg: value(336) };
        let turning = Event::Spindle(self.core.modes.turning);
        let modal = self.core.modes.feed;
        self.step(MoveKind::Rapid, over, at)?;
        self.core.emit(orient.clone());
        self.step(MoveKind::Rapid, aside(&over), at)?;
        self.core.modes.feed = feed(253);
        self.step(MoveKind::Linear, aside(&under), at)?;
        self.step(MoveKind::Linear, under, at)?;
        self.core.emit(turning.clone());
        self.core.modes.feed = feed(254);
        self.step(MoveKind::Linear, up(end), at)?;
        self.core.modes.feed = modal;
        if value(255) > 0.0 {
            self.dwell(value(255), at)?;
        }
        self.core.modes.feed = feed(253);
        self.step(MoveKind::Linear, under, at)?;
        self.core.emit(orient);
        self.step(MoveKind::Linear, aside(&under), at)?;
        self.step(MoveKind::Linear, aside(&over), at)?;
        self.core.modes.feed = modal;
        self.step(MoveKind::Rapid, over, at)?;
        self.core.emit(turning);
        let high = surface + clear.max(length(204));
        if high != surface + clear {
            self.step(MoveKind::Rapid, up(high), at)?;
        }
        self.tangent = None;
        Ok(())
    }
}
