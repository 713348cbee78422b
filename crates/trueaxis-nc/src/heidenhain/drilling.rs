//! The drilling cycles as moves: 200 to 209, 240, 241 and the old 1, 2 and 17.

use std::collections::BTreeMap;

use super::{Run, fault};
use crate::execution::drilling::{Drill, Stroke, dwell, pecks, reversed, stop_above};
use crate::execution::mistakes;
use crate::moves::{Event, Feed, FeedMode, MoveKind, Position};
use crate::text::program::Fault;

/// Pecks of one hole: more than any program means.
const MOST_PECKS: usize = 100_000;

/// Parameters of these cycles that are not moved.
const LEFT_OUT: [(u32, &str); 3] = [
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
    /// The feed of the program, which a wait keeps.
    modal: Feed,
    /// Feed on the way out to the clearance; without one the way out is rapid.
    feed_out: Option<Feed>,
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
    pub(super) fn drill_hole(
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
            if values.get(&q).is_some_and(|v| *v != 0.0) && !old && (q, number) != (379, 241) {
                self.core.left_out(&format!("Q{q} of cycle {number}: {what}"), at);
            }
        }
        let rigid = matches!(number, 17 | 207 | 209);
        if !rigid && hole.feed.value <= 0.0 || rigid && hole.pitch == 0.0 {
            let message = format!("cycle {number} has no feed or pitch");
            return Err(fault("zero-feed", at, message, "state the feed or pitch of the cycle"));
        }
        let height = self.frames.position[self.along()];
        let mut strokes = vec![Stroke::Feed(hole.feed)];
        strokes.extend((height != hole.start).then_some(Stroke::Rapid(hole.start)));
        match number {
            201 | 202 => strokes.extend(self.bore(&hole, at)),
            2 | 206 => strokes.extend(self.tap(&hole)),
            241 => strokes.extend(self.drill_single_lip(&hole, values)),
            17 | 207 | 209 => {
                let feed = Feed { mode: FeedMode::PerRevolution, value: hole.pitch.abs() };
                let tap = Stroke::Tap { pitch_mm: hole.pitch, bottom: hole.bottom };
                strokes.extend([Stroke::Feed(feed), tap, Stroke::Feed(hole.feed)]);
            }
            _ => {
                let depths = hole.depths();
                strokes.extend(hole.pecks(&depths));
                if depths.last() != Some(&hole.bottom) {
                    self.drill(strokes, at)?;
                    return Err(mistakes::too_many_pecks(MOST_PECKS as f64, at));
                }
                strokes.extend(hole.wait(hole.dwell_bottom));
            }
        }
        let tapped = matches!(number, 2 | 206 | 17 | 207 | 209);
        if let Some(out) = hole.feed_out.filter(|_| !tapped) {
            strokes.extend([Stroke::Feed(out), Stroke::Linear(hole.start)]);
        }
        let end = if tapped || hole.feed_out.is_some() { hole.start } else { hole.bottom };
        strokes.extend((end != hole.clear).then_some(Stroke::Rapid(hole.clear)));
        self.drill(strokes, at)?;
        self.tangent = None;
        Ok(())
    }

    fn per_minute(&self, value: f64) -> Feed {
        let scale = self.core.modes.unit_of_klartext_feed();
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
        let surface = start - value(1).abs() * mm;
        Hole {
            number,
            surface,
            start,
            bottom: surface + depth,
            clear: start,
            feed: self.per_minute(feed),
            feed_out: None,
            modal: self.core.modes.feed,
            peck,
            decrement: 0.0,
            least_peck: peck,
            stop_above: stop_above(depth.abs()),
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
        let feed_out = self.feed_out(number, values.get(&208).copied(), feed);
        let peck = if matches!(number, 200 | 203 | 205) { value(202).abs() * mm } else { 0.0 };
        Hole {
            number,
            surface,
            start: surface + clearance,
            bottom: surface + value(201) * mm,
            clear: surface + clearance.max(value(204) * mm),
            feed,
            feed_out,
            modal: self.core.modes.feed,
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

    /// Q208: 0 is the feed of the way down, FMAX is rapid. Old programs have no Q208 in 203 and 205: they retract
    /// with rapid.
    fn feed_out(&self, number: u32, q208: Option<f64>, down: Feed) -> Option<Feed> {
        match (number, q208) {
            (203 | 205, None) => None,
            (201..=203 | 205 | 241, Some(feed)) if feed >= 99_999.0 => None,
            (201..=203 | 205 | 241, Some(feed)) if feed > 0.0 => Some(self.per_minute(feed)),
            (201..=203 | 205 | 241, _) => Some(down),
            _ => None,
        }
    }

    /// Reaming and boring: in and out with feed; the lift-off of 202 is not moved.
    fn bore(&mut self, hole: &Hole, at: usize) -> Vec<Stroke> {
        let mut strokes = vec![Stroke::Linear(hole.bottom)];
        strokes.extend(hole.wait(hole.dwell_bottom));
        if hole.number == 202 {
            let angle_deg = hole.angle_deg;
            strokes.push(Stroke::Event(Event::SpindleOrient { angle_deg }));
            self.core.left_out("the lift-off from the wall in cycle 202", at);
        }
        strokes
    }

    /// 241: with Q253 to the deepened starting point Q379, with Q206 to the bottom, with Q208 out again.
    fn drill_single_lip(&self, hole: &Hole, values: &BTreeMap<u32, f64>) -> Vec<Stroke> {
        let value = |q: u32| values.get(&q).copied().unwrap_or(0.0);
        let mut strokes = Vec::new();
        let begin = hole.surface - value(379).abs() * self.core.modes.unit_mm();
        if begin < hole.surface && begin > hole.bottom && value(253) > 0.0 {
            let pre = self.per_minute(value(253));
            strokes.extend([Stroke::Feed(pre), Stroke::Linear(begin), Stroke::Feed(hole.feed)]);
        }
        strokes.push(Stroke::Linear(hole.bottom));
        strokes.extend(hole.wait(hole.dwell_bottom));
        strokes
    }

    /// Tapping with a floating chuck: the spindle reverses at the bottom.
    fn tap(&self, hole: &Hole) -> Vec<Stroke> {
        let turning = self.core.modes.turning;
        let mut strokes = vec![Stroke::Linear(hole.bottom), Stroke::Turn(reversed(turning))];
        strokes.extend(hole.wait(hole.dwell_bottom));
        strokes.extend([Stroke::Linear(hole.start), Stroke::Turn(turning)]);
        strokes
    }
}

impl Hole {
    fn wait(&self, seconds: f64) -> impl Iterator<Item = Stroke> + use<> {
        let (modal, feed) = (Stroke::Feed(self.modal), Stroke::Feed(self.feed));
        dwell(seconds).into_iter().flat_map(move |wait| [modal.clone(), wait, feed.clone()])
    }

    /// The depths of the pecks; without the bottom where they would never reach it.
    fn depths(&self) -> Vec<f64> {
        let mut depth = if self.peck > 0.0 { self.surface - self.peck } else { self.bottom };
        let (mut step, mut depths) = (self.peck, Vec::new());
        while depths.len() < MOST_PECKS {
            if depth <= self.bottom + 1e-9 {
                depths.push(self.bottom);
                break;
            }
            depths.push(depth);
            step = (step - self.decrement).max(self.least_peck);
            if step <= 0.0 {
                break;
            }
            depth -= step;
        }
        depths
    }

    /// Between the pecks out to the clearance, or back a little to break the chip.
    fn pecks(&self, depths: &[f64]) -> Vec<Stroke> {
        let mut broken = 0;
        pecks(depths.iter().copied(), |depth, strokes| {
            if broken < self.chips && self.chip > 0.0 {
                broken += 1;
                strokes.push(Stroke::Linear(depth + self.chip));
                return;
            }
            broken = 0;
            strokes.push(Stroke::Rapid(self.start));
            strokes.extend(self.wait(self.dwell_top));
            let above = (depth + self.stop_above).min(self.start);
            strokes.extend((above != self.start).then_some(Stroke::Rapid(above)));
        })
    }
}

impl<'r> Drill<'r> for Run<'r> {
    fn place(&mut self) -> &mut Position {
        &mut self.frames.position
    }

    fn move_drill(&mut self, kind: MoveKind, to: Position, at: usize) -> Result<(), Fault> {
        match kind {
            MoveKind::Dwell { seconds } => self.dwell(seconds, at),
            _ => self.step(kind, to, at),
        }
    }
}
