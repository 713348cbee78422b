//! Drilling cycles as strokes along the axis that stands on the plane.

use super::{Language, mistakes};
use crate::moves::{Event, Feed, MoveKind, Position, SpindleDirection};
use crate::text::program::Fault;

/// Pecks of one block: more than any program means.
pub(crate) const MOST_PECKS: f64 = 1e6;

/// One thing that a drill does; heights are along its axis, mm.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Stroke {
    /// To a height, as fast as the machine can.
    Rapid(f64),
    /// To a height with feed.
    Linear(f64),
    /// Down to a height and back, in step with the spindle.
    Tap { pitch_mm: f64, bottom: f64 },
    /// The feed from here on, for this hole.
    Feed(Feed),
    /// Waits that many seconds.
    Dwell(f64),
    /// The spindle turns otherwise.
    Turn(SpindleDirection),
    /// What else happens.
    Event(Event),
}

/// A language that drills.
pub(crate) trait Drill<'r>: Language<'r> {
    /// Where the tool is.
    fn place(&mut self) -> &mut Position;

    /// Moves the drill, or waits.
    fn move_drill(&mut self, kind: MoveKind, to: Position, at: usize) -> Result<(), Fault>;

    /// Executes the strokes of a hole where the tool stands; the feed before it is back afterwards.
    fn drill(&mut self, strokes: Vec<Stroke>, at: usize) -> Result<(), Fault> {
        let feed = self.core().modes.feed;
        let done = strokes.into_iter().try_for_each(|stroke| self.stroke(stroke, at));
        self.core().modes.feed = feed;
        done
    }

    fn stroke(&mut self, stroke: Stroke, at: usize) -> Result<(), Fault> {
        let axis = self.core().modes.plane.axes()[2];
        let before = *self.place();
        let at_height = |height| {
            let mut place = before;
            place[axis] = height;
            place
        };
        match stroke {
            Stroke::Rapid(height) => self.move_drill(MoveKind::Rapid, at_height(height), at)?,
            Stroke::Linear(height) => self.move_drill(MoveKind::Linear, at_height(height), at)?,
            Stroke::Tap { pitch_mm, bottom } => {
                self.move_drill(MoveKind::RigidTap { pitch_mm }, at_height(bottom), at)?;
                // The tap is back where it began.
                *self.place() = before;
            }
            Stroke::Feed(feed) => self.core().modes.feed = feed,
            Stroke::Dwell(seconds) => self.move_drill(MoveKind::Dwell { seconds }, before, at)?,
            Stroke::Turn(turning) => self.core().turn_spindle(turning),
            Stroke::Event(event) => self.core().emit(event),
        }
        Ok(())
    }
}

/// A wait, if it lasts.
pub(crate) fn dwell(seconds: f64) -> Option<Stroke> {
    (seconds > 0.0).then_some(Stroke::Dwell(seconds))
}

/// Down by pecks to the bottom; between them what frees the chips at each depth.
pub(crate) fn pecks(
    depths: impl IntoIterator<Item = f64>,
    mut free: impl FnMut(f64, &mut Vec<Stroke>),
) -> Vec<Stroke> {
    let mut strokes = Vec::new();
    let mut depths = depths.into_iter().peekable();
    while let Some(depth) = depths.next() {
        strokes.push(Stroke::Linear(depth));
        if depths.peek().is_some() {
            free(depth, &mut strokes);
        }
    }
    strokes
}

/// Looks whether a block drills no more often than any program means.
pub(crate) fn check_pecks(count: f64, most: f64, at: usize) -> Result<(), Fault> {
    if count <= most { Ok(()) } else { Err(mistakes::too_many_pecks(most, at)) }
}

/// The other way round.
pub(crate) fn reversed(turning: SpindleDirection) -> SpindleDirection {
    match turning {
        SpindleDirection::Clockwise => SpindleDirection::CounterClockwise,
        SpindleDirection::CounterClockwise => SpindleDirection::Clockwise,
        SpindleDirection::Stopped => SpindleDirection::Stopped,
    }
}

/// How far above the last depth the control stops on its rapid way back into a hole: 0.6 mm for
/// holes up to 30 mm, else a fiftieth.
pub(crate) fn stop_above(depth_mm: f64) -> f64 {
    if depth_mm <= 30.0 { 0.6 } else { (depth_mm / 50.0).min(7.0) }
}
