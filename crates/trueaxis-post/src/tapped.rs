//! The proof for threads: what is read back turns and moves as the thread of the file.

use crate::Posted;
use crate::verify::Largest;
use trueaxis_motion::{Batch, Observer};
use trueaxis_nc::moves::{Event, FeedMode, Move, MoveKind, SpindleDirection};
use trueaxis_nc::{Control, Step};
use trueaxis_writer::Thread;

/// Speeds that differ by less are the same, 1/min.
const SAME_SPEED: f64 = 0.01;

/// One way along the axis in step with the spindle: its pitch in mm, and how the spindle turned.
type Way = (f64, SpindleDirection);

/// Follows spindle and moves of a program.
pub(crate) struct Tapped<'p> {
    posted: &'p Posted,
    control: Control,
    turning: SpindleDirection,
    speed: f64,
    /// The present hole, and its ways so far.
    next: usize,
    ways: Vec<Way>,
    /// The largest error of the lead over the depth of a thread, mm.
    pub lead: Largest,
}

impl<'p> Tapped<'p> {
    pub fn with(posted: &'p Posted, control: Control) -> Self {
        Self {
            posted,
            control,
            turning: SpindleDirection::Stopped,
            speed: 0.0,
            next: 0,
            ways: Vec::new(),
            lead: Largest::default(),
        }
    }

    /// What comes in a line, of the hole that the line belongs to.
    fn take(&mut self, m: &Move) {
        let line = m.origin.line;
        while self.posted.drilled.get(self.next).is_some_and(|hole| hole.lines[1] < line) {
            self.end_hole();
        }
        let within = self.posted.drilled.get(self.next).is_some_and(|hole| hole.lines[0] <= line);
        if within {
            self.ways.extend(self.way(m));
        }
    }

    fn way(&self, m: &Move) -> Option<Way> {
        let wrong_speed =
            |thread: &Thread| (self.speed - thread.speed_per_minute).abs() > SAME_SPEED;
        let hole = &self.posted.path.holes[self.posted.drilled[self.next].hole];
        let is_wrong = hole.thread.as_ref().is_none_or(wrong_speed);
        let pitch = |value: f64| if is_wrong { f64::NAN } else { value };
        match (m.kind, m.feed.mode) {
            // Its sense is that of the spindle on LinuxCNC, elsewhere the sign of the pitch.
            (MoveKind::RigidTap { pitch_mm }, _) if self.control == Control::LinuxCnc => {
                Some((pitch(pitch_mm), self.turning))
            }
            (MoveKind::RigidTap { pitch_mm }, _) => {
                let left = pitch_mm < 0.0;
                Some((pitch(pitch_mm.abs()), sense(left)))
            }
            (MoveKind::Linear, FeedMode::PerMinute) => {
                Some((pitch(m.feed.value / self.speed), self.turning))
            }
            (MoveKind::Linear, FeedMode::PerRevolution) => {
                Some((pitch(m.feed.value), self.turning))
            }
            (MoveKind::Linear, FeedMode::InverseTime) => Some((f64::NAN, self.turning)),
            _ => None,
        }
    }

    /// Into the thread as it turns and out again the other way round; a synchronised move does both.
    fn end_hole(&mut self) {
        let Some(place) = self.posted.drilled.get(self.next) else { return };
        self.next += 1;
        let ways = std::mem::take(&mut self.ways);
        let hole = &self.posted.path.holes[place.hole];
        let Some(thread) = hole.thread else { return };
        let (into, out) = (sense(thread.left_hand), sense(!thread.left_hand));
        let by_cycle = matches!(self.control, Control::Fanuc | Control::Haas);
        let turns: Vec<SpindleDirection> = ways.iter().map(|(_, turning)| *turning).collect();
        let wanted = if by_cycle { vec![into, out] } else { vec![into] };
        let off = |pitch: f64| match (pitch - thread.pitch_mm).abs() {
            off if off.is_nan() => f64::INFINITY,
            off => off * (hole.cycle.depth_mm + hole.cycle.clearance_mm) / thread.pitch_mm,
        };
        let lead = match turns == wanted {
            true => ways.iter().map(|(pitch, _)| off(*pitch)).fold(0.0, f64::max),
            false => f64::INFINITY,
        };
        self.lead.take(lead, place.lines[1], self.posted.path.strokes.line(hole.last));
    }

    /// Every thread is compared, even where the program ended before it.
    pub fn end(mut self) -> Largest {
        while self.next < self.posted.drilled.len() {
            self.end_hole();
        }
        self.lead
    }
}

/// How the spindle turns into a thread.
fn sense(left_hand: bool) -> SpindleDirection {
    match left_hand {
        true => SpindleDirection::CounterClockwise,
        false => SpindleDirection::Clockwise,
    }
}

impl Observer for Tapped<'_> {
    fn path(&mut self, _: &Batch<'_>) {}

    fn step(&mut self, step: &Step) {
        match step {
            Step::Event(Event::Spindle(turning), _) => self.turning = *turning,
            Step::Event(Event::SpindleSpeed(speed), _) => self.speed = *speed,
            Step::Event(Event::ToolChange(_), _) => self.turning = SpindleDirection::Stopped,
            Step::Move(m) => self.take(m),
            Step::Event(..) => {}
        }
    }
}
