//! Holes as drilling cycles of the control.

use crate::axes::Leg;
use crate::circles::UPRIGHT_RAD;
use crate::cut::Node;
use crate::feed::feed_of;
use crate::path::{Drilled, SAME_MM, Stand};
use crate::write::Post;
use crate::{Fault, FeedRule, HolePlace};
use trueaxis_geometry::Vec3;
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Coordinates, Feed, FeedMode};
use trueaxis_writer::{Block, Hole, TipWords};

impl Post<'_> {
    /// Whether drilling cycles mean to the control what they mean here.
    fn has_cycles(&self) -> bool {
        let options = self.options;
        !options.lines_only
            && options.feed != FeedRule::InverseTime
            && match (options.tip_words, options.control) {
                (Some(TipWords::Length), _) => true,
                (None, _) => self.coordinates == Coordinates::Program,
                // The others do not drill with tool-centre point, or their manuals do not say it.
                (Some(TipWords::Angles), Control::Sinumerik840d | Control::LinuxCnc) => true,
                (Some(_), _) => false,
            }
    }

    /// Drills the hole that begins with a stroke by a cycle; its last stroke, if there is one.
    pub(crate) fn drill(
        &mut self,
        leg: &Leg<'_>,
        index: usize,
        at: &Node,
    ) -> Result<Option<usize>, Fault> {
        let path = self.path;
        let number = path.holes.partition_point(|hole| hole.last < index);
        let Some(drilled) = path.holes.get(number).filter(|hole| hole.begin <= index) else {
            return Ok(None);
        };
        let inside = drilled.last < leg.end();
        let line = path.strokes.line(index);
        let hole = (inside && self.has_cycles()).then(|| self.cycle(drilled, leg, at)).flatten();
        let Some(hole) = hole else {
            // A thread cannot be cut by lines.
            return match drilled.thread.filter(|_| index >= drilled.down) {
                Some(_) => Err(no_cycle(line)),
                None => Ok(None),
            };
        };
        for k in index..=drilled.last {
            self.cutter.inside(&leg.command(path, k), line)?;
        }
        let first_line = self.line + 1;
        if index == drilled.begin && self.goes_on(drilled, &hole, at) {
            self.block(&Block::NextHole(hole.place_mm), line)?;
        } else if index == drilled.down {
            self.end_holes()?;
            self.events(index)?;
            let above = Node { stand: path.strokes.to(drilled.last), ..*at };
            if (above.stand.tip - at.stand.tip).norm() > SAME_MM {
                let above = self.end_of(leg, drilled.last);
                self.go(&above, None, None, line)?;
            }
            self.block(&Block::Hole(&hole), line)?;
        } else {
            return Ok(None);
        }
        self.hole = Some(hole);
        self.drilled.push(HolePlace { lines: [first_line, self.line], hole: number });
        self.blocks += 1;
        Ok(Some(drilled.last))
    }

    /// The cycle that is on ends.
    pub(crate) fn end_holes(&mut self) -> Result<(), Fault> {
        match self.hole.take() {
            None => Ok(()),
            Some(_) => self.block(&Block::HolesEnd, 0),
        }
    }

    /// Whether the hole is one more of the cycle that is on, and the tool comes straight from the last one.
    fn goes_on(&self, drilled: &Drilled, hole: &Hole, at: &Node) -> bool {
        let path = self.path;
        let events = path.events.partition_point(|(stroke, _)| *stroke < drilled.begin);
        let undisturbed = path.events.get(events).is_none_or(|(stroke, _)| *stroke > drilled.down);
        let Some(before) = &self.hole else { return false };
        let retracted = path.strokes.to(drilled.last);
        let level = (at.stand.tip - retracted.tip).dot(&retracted.axis).abs() < SAME_MM;
        let crosses = drilled.down == drilled.begin + 1 && before.place_mm != hole.place_mm;
        undisturbed && level && crosses && before.is_like(hole)
    }

    /// The cycle for a hole, with the digits of the program; none where the tool does not stand along Z of the
    /// program, or where no cycle of the control does the same.
    fn cycle(&self, drilled: &Drilled, leg: &Leg<'_>, at: &Node) -> Option<Hole> {
        let Drilled { surface: Stand { tip, axis }, cycle, .. } = drilled;
        let ends = [drilled.down.max(leg.first), drilled.last];
        let still = |k: usize| self.stands(&at.command, &self.end_of(leg, k).command);
        let up = self.direction_of(*tip, *axis, &at.command)? - Vec3::z();
        let [first, further] = cycle.pecks_mm.unwrap_or([cycle.depth_mm; 2]);
        let heights = cycle.depth_mm > 0.0
            && cycle.clearance_mm >= 0.0
            && cycle.retract_mm >= cycle.clearance_mm - SAME_MM;
        let even = first > 0.0 && (first >= cycle.depth_mm || first == further);
        if cycle.feeds_out && drilled.thread.is_none()
            || up.norm() > UPRIGHT_RAD
            || !ends.into_iter().all(still)
            || !heights
            || !even
        {
            return None;
        }
        let words = self.words_at(*tip, &at.command)?;
        let scale = 10_f64.powi(i32::from(self.options.decimals.linear));
        let round = |mm: f64| (mm * scale).round_ties_even() / scale;
        let hole = Hole {
            place_mm: [round(words.x), round(words.y)],
            surface_mm: round(words.z),
            clearance_mm: round(words.z + cycle.clearance_mm),
            bottom_mm: round(words.z - cycle.depth_mm),
            retract_mm: round(words.z + cycle.retract_mm),
            peck_mm: (first < cycle.depth_mm).then_some(first),
            dwell_s: cycle.dwell_s,
            feed: match drilled.thread {
                Some(_) => Feed { mode: FeedMode::PerMinute, value: drilled.feed },
                None => self.feed_of_drilling(drilled, at),
            },
            thread: drilled.thread,
        };
        hole.is_possible(self.options.control).then_some(hole)
    }

    fn feed_of_drilling(&self, drilled: &Drilled, at: &Node) -> Feed {
        let node = |height: f64| {
            let Stand { tip, axis } = drilled.surface;
            let stand = Stand { tip: tip + axis * height, axis };
            let mut command = at.command;
            // It has been placed before.
            let _ = self.control.place(stand.tip, &mut command);
            Node { stand, command, ..*at }
        };
        let (above, bottom) = (node(drilled.cycle.clearance_mm), node(-drilled.cycle.depth_mm));
        feed_of(self.machine, self.options, &above, &bottom, drilled.feed)
    }
}

fn no_cycle(line: u32) -> Fault {
    Fault {
        line,
        code: "thread-needs-cycle",
        message: "the control has no tapping cycle for this thread in such a program".into(),
        hint: "give --tcp length, without --lines-only and inverse time; the tool along Z of the program",
    }
}
