//! The thread of a tapping cycle: pitch, hand and speed, where the hole is.

use super::Builder;
use trueaxis_cl::{ClCycle, ClPoint, ClTap, SAME_PITCH};
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Feed, FeedMode, SpindleDirection};
use trueaxis_writer::Thread;

/// No tap has a greater pitch, mm.
const MOST_PITCH_MM: f64 = 25.4;

impl Builder<'_> {
    /// Pitch, hand and speed; none where the file does not say them, which is reported.
    pub(super) fn thread(
        &mut self,
        (cycle, tap): (&ClCycle, &ClTap),
        point: &ClPoint,
        line: u32,
    ) -> Option<Thread> {
        let (turning, _) = self.spindle;
        let turns = turning.filter(|turning| *turning != SpindleDirection::Stopped);
        let (Some(turning), true) = (turns, self.speed > 0.0) else {
            let message = "a thread is tapped, but the spindle does not turn at a known speed";
            let hint = "write SPINDL/RPM,400,CLW before it, or CCLW for a left-hand thread";
            return self.refuse("tap-without-spindle", line, message.to_owned(), hint);
        };
        let pitch_mm = match (tap.pitch_mm, cycle.feed.or(point.feed)) {
            (Some(pitch), _) => pitch,
            (None, Some(Feed { mode: FeedMode::PerRevolution, value })) => value,
            (None, Some(feed)) => feed.value / self.speed,
            (None, None) => {
                let message = "the pitch of the thread is not known".to_owned();
                return self.refuse("no-pitch", line, message, PITCH_HINT);
            }
        };
        if !(pitch_mm > 0.0 && pitch_mm <= MOST_PITCH_MM) {
            let message = format!("a thread with a pitch of {pitch_mm:.4} mm is not tapped");
            return self.refuse("no-pitch", line, message, PITCH_HINT);
        }
        self.check_feed(cycle, pitch_mm, line)?;
        let of_feed = tap.pitch_mm.is_none() && cycle.feed.is_none();
        if of_feed && point.feed.is_some_and(|feed| feed.mode == FeedMode::PerMinute) {
            self.warn_of_feed(pitch_mm, line);
        }
        self.tapped = true;
        Some(Thread {
            pitch_mm,
            left_hand: turning == SpindleDirection::CounterClockwise,
            speed_per_minute: self.speed,
        })
    }

    /// A feed per minute of the cycle is pitch times speed.
    fn check_feed(&mut self, cycle: &ClCycle, pitch_mm: f64, line: u32) -> Option<()> {
        let wanted = pitch_mm * self.speed;
        let stated = cycle.feed.filter(|feed| feed.mode == FeedMode::PerMinute);
        if let Some(feed) = stated.filter(|f| (f.value - wanted).abs() > SAME_PITCH * wanted) {
            let message = format!(
                "the feed {} mm/min is not the pitch {pitch_mm} mm times {} 1/min, {wanted} mm/min",
                feed.value, self.speed
            );
            return self.refuse("contradicting-pitch", line, message, PITCH_HINT);
        }
        Some(())
    }

    /// The feed of FEDRAT may have been meant for other cuts.
    fn warn_of_feed(&mut self, pitch_mm: f64, line: u32) {
        if !std::mem::replace(&mut self.told_pitch, true) {
            let speed = self.speed;
            let message = format!(
                "the cycle states no pitch: FEDRAT at {speed} 1/min makes {pitch_mm:.6} mm"
            );
            self.problems.warn("pitch-of-feed", self.place(line), message, PITCH_HINT);
        }
    }

    /// Rigid tapping leaves the spindle stopped (FANUC and Haas after G80, HEIDENHAIN after cycle 207): before other
    /// cuts it is started again.
    pub(super) fn after_tapping(&mut self) {
        let taps = self.cycle.is_some_and(|cycle| cycle.tap.is_some());
        if self.tapped && !taps {
            self.tapped = false;
            let stops = matches!(
                self.options.control,
                Control::Fanuc | Control::Haas | Control::Heidenhain
            );
            let turns = self.spindle.0.is_some_and(|now| now != SpindleDirection::Stopped);
            self.spindle.1 |= stops && turns;
        }
    }

    fn refuse<T>(
        &mut self,
        code: &'static str,
        line: u32,
        message: String,
        hint: &str,
    ) -> Option<T> {
        if !self.refused.contains(&code) {
            self.refused.push(code);
            self.problems.error(code, self.place(line), message, hint);
        }
        None
    }
}

const PITCH_HINT: &str = "state it in the cycle, such as CYCLE/TAP,FEDTO,10,MMPR,1.25,RAPTO,3";
