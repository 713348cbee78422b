//! The drilling cycles as moves: 200 to 209, 240 and the old 1, 2 and 17.

use std::collections::BTreeMap;

use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::{Event, Feed, FeedMode, MoveKind, Turning};
use crate::text::program::Fault;

/// Pecks of one hole: more than any program means.
const MOST_PECKS: u32 = 100_000;

/// Parameters of these cycles that are not moved.
const LEFT_OUT: [(u32, &str); 4] = [
    (343, "the depth by diameter"),
    (379, "the deepened starting point"),
    (257, "the chip breaking"),
    (395, "the depth to the edge of the tip"),
];

/// One hole along the tool axis; lengths in mm.
struct Hole {
    number: u32,
    /// The surface of the workpiece.
    surface: f64,
    /// The set-up clearance above the surface, where drilling begins.
    start: f64,
    bottom: f64,
    /// Where the tool is left.
    clear: f64,
    feed: Feed,
    /// Feed on the way out; the same as in where none is given.
    feed_out: Feed,
    peck: f64,
    /// How much each peck is shorter than the one before, and the shortest.
    decrement: f64,
    least_peck: f64,
    /// How far above the last depth the rapid way back down ends.
    stop_above: f64,
    /// Chips that are broken before the tool leaves the hole, and by how much.
    chips: u32,
    chip: f64,
    dwell_top: f64,
    dwell_bottom: f64,
    pitch: f64,
    angle_deg: f64,
}

impl Run<'_> {
    /// Drills where the tool stands.
    pub(super) fn drill(
        &mut self,
        number: u32,
        values: &BTreeMap<u32, f64>,
        at: usize,
    ) -> Result<(), Fault> {
        let old = number < 100;
        let hole = if old { self.old_hole(number, values) } else { self.new_hole(number, values) };
        if hole.bottom >= hole.start {
            return Err(mistakes::missing_depth(at));
        }
        for (q, what) in LEFT_OUT {
            if values.get(&q).is_some_and(|v| *v != 0.0) && !old {
                self.core.left_out(&format!("Q{q} of cycle {number}: {what}"), at);
            }
        }
        let rigid = matches!(number, 17 | 207 | 209);
        if !rigid && hole.feed.value <= 0.0 || rigid && hole.pitch == 0.0 {
            let message = format!("cycle {number} has no feed or pitch");
            return Err(fault("zero-feed", at, message, "give the feed or pitch of the cycle"));
        }
        if self.frames.position[self.along()] != hole.start {
            self.go(MoveKind::Rapid, hole.start, hole.feed, at)?;
        }
        match number {
            201 | 202 => self.bore(&hole, at)?,
            2 | 206 => self.tap(&hole, at)?,
            17 | 207 | 209 => {
                let kind = MoveKind::RigidTap { pitch_mm: hole.pitch };
                let feed = Feed { mode: FeedMode::PerRevolution, value: hole.pitch.abs() };
                self.go(kind, hole.bottom, feed, at)?;
                // The tool comes back by itself.
                let along = self.along();
                self.frames.position[along] = hole.start;
            }
            _ => self.peck(&hole, at)?,
        }
        if self.frames.position[self.along()] != hole.clear {
            self.go(MoveKind::Rapid, hole.clear, hole.feed, at)?;
        }
        self.tangent = None;
        Ok(())
    }

    fn per_minute(&self, value: f64) -> Feed {
        let scale = if self.core.modes.inches { 2.54 } else { 1.0 };
        Feed { mode: FeedMode::PerMinute, value: value * scale }
    }

    /// Cycles 1, 2 and 17 begin where the tool stands: the clearance above the surface.
    fn old_hole(&self, number: u32, values: &BTreeMap<u32, f64>) -> Hole {
        let mm = self.core.modes.unit_mm();
        let value = |n: u32| values.get(&n).copied().unwrap_or(0.0);
        let start = self.frames.position[self.along()];
        let depth = value(2) * mm;
        let (peck, dwell, feed, pitch) = match number {
            1 => (value(3).abs() * mm, value(4), value(5), 0.0),
            2 => (0.0, value(3), value(4), 0.0),
            _ => (0.0, 0.0, 0.0, value(3) * mm),
        };
        let total = depth.abs();
        let surface = start - value(1).abs() * mm;
        Hole {
            number,
            surface,
            start,
            bottom: surface + depth,
            clear: start,
            feed: self.per_minute(feed),
            feed_out: self.per_minute(feed),
            peck,
            decrement: 0.0,
            least_peck: peck,
            // The stop of cycle 1 as its manual gives it: 0.6 mm, depth/50 beyond 30 mm, up to 7 mm.
            stop_above: if total <= 30.0 { 0.6 } else { (total / 50.0).min(7.0) },
            chips: 0,
            chip: 0.0,
            dwell_top: 0.0,
            dwell_bottom: dwell,
            pitch,
            angle_deg: 0.0,
        }
    }

    fn new_hole(&mut self, number: u32, values: &BTreeMap<u32, f64>) -> Hole {
        let mm = self.core.modes.unit_mm();
        let value = |q: u32| values.get(&q).copied().unwrap_or(0.0);
        let (surface, clearance) = (value(203) * mm, value(200).abs() * mm);
        let feed = self.per_minute(value(206));
        let out = if value(208) > 0.0 { self.per_minute(value(208)) } else { feed };
        let peck = if matches!(number, 200 | 203 | 205) { value(202).abs() * mm } else { 0.0 };
        Hole {
            number,
            surface,
            start: surface + clearance,
            bottom: surface + value(201) * mm,
            clear: surface + clearance.max(value(204) * mm),
            feed,
            feed_out: out,
            peck,
            decrement: if number == 200 { 0.0 } else { value(212).abs() * mm },
            least_peck: value(205).abs() * mm,
            stop_above: if number == 205 { value(258).abs() * mm } else { clearance },
            chips: if number == 203 { value(213).clamp(0.0, 1000.0) as u32 } else { 0 },
            chip: value(256).abs() * mm,
            dwell_top: value(210).max(0.0),
            dwell_bottom: value(211).max(0.0),
            pitch: value(239) * mm,
            angle_deg: value(336),
        }
    }

    fn go(&mut self, kind: MoveKind, depth: f64, feed: Feed, at: usize) -> Result<(), Fault> {
        let mut target = self.frames.position;
        target[self.along()] = depth;
        let before = std::mem::replace(&mut self.core.modes.feed, feed);
        let done = self.step(kind, target, at);
        self.core.modes.feed = before;
        done
    }

    fn wait(&mut self, seconds: f64, at: usize) -> Result<(), Fault> {
        if seconds > 0.0 { self.dwell(seconds, at) } else { Ok(()) }
    }

    /// Down by pecks; between them out to the clearance, or back a little to break the chip.
    fn peck(&mut self, hole: &Hole, at: usize) -> Result<(), Fault> {
        let top = hole.start;
        let mut depth = if hole.peck > 0.0 { hole.surface - hole.peck } else { hole.bottom };
        let mut step = hole.peck;
        let mut broken = 0;
        for _ in 0..MOST_PECKS {
            if depth <= hole.bottom + 1e-9 {
                self.go(MoveKind::Linear, hole.bottom, hole.feed, at)?;
                return self.wait(hole.dwell_bottom, at);
            }
            self.go(MoveKind::Linear, depth, hole.feed, at)?;
            if broken < hole.chips && hole.chip > 0.0 {
                broken += 1;
                self.go(MoveKind::Linear, depth + hole.chip, hole.feed, at)?;
            } else {
                broken = 0;
                self.go(MoveKind::Rapid, top, hole.feed, at)?;
                self.wait(hole.dwell_top, at)?;
                let above = (depth + hole.stop_above).min(top);
                if above != top {
                    self.go(MoveKind::Rapid, above, hole.feed, at)?;
                }
            }
            step = (step - hole.decrement).max(hole.least_peck);
            if step <= 0.0 {
                break;
            }
            depth -= step;
        }
        let message = format!("the hole takes more than {MOST_PECKS} pecks");
        Err(fault("too-many-pecks", at, message, "check the plunging depth"))
    }

    /// Reaming and boring: in and out with feed; the lift-off of 202 is not moved.
    fn bore(&mut self, hole: &Hole, at: usize) -> Result<(), Fault> {
        self.go(MoveKind::Linear, hole.bottom, hole.feed, at)?;
        self.wait(hole.dwell_bottom, at)?;
        if hole.number == 202 {
            self.core.emit(Event::SpindleOrient { angle_deg: hole.angle_deg });
            self.core.left_out("the lift-off from the wall in cycle 202", at);
        }
        self.go(MoveKind::Linear, hole.start, hole.feed_out, at)
    }

    /// Tapping with a floating chuck: the spindle turns round at the bottom.
    fn tap(&mut self, hole: &Hole, at: usize) -> Result<(), Fault> {
        let turning = self.core.modes.turning;
        let back = match turning {
            Turning::Clockwise => Turning::CounterClockwise,
            Turning::CounterClockwise => Turning::Clockwise,
            Turning::Stopped => Turning::Stopped,
        };
        self.go(MoveKind::Linear, hole.bottom, hole.feed, at)?;
        self.core.turn_spindle(back);
        self.wait(hole.dwell_bottom, at)?;
        self.go(MoveKind::Linear, hole.start, hole.feed, at)?;
        self.core.turn_spindle(turning);
        Ok(())
    }
}
