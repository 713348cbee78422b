//! A shorter cut for lines of straight moves.

use trueaxis_blocks::digits::short_number;

use super::{Activation, Run};
use crate::execution::straight::{Measure, line_after_line, read_line};
use crate::moves::{AxisSet, FeedMode, Move, MoveKind, Origin, Position};
use crate::rs274::code::Motion;

impl Run<'_> {
    /// Executes the lines of straight moves that come next, and nothing else: lines of G0 or G1 (or
    /// nothing, where that lasts), axis words with plain numbers, F and N.
    pub(super) fn straight_lines(&mut self, source: &[u8]) {
        let Some(&Activation { program, at, line, .. }) = self.stack.last() else { return };
        let modes = &self.modes;
        let lasting = matches!(modes.motion, Some(Motion::Rapid | Motion::Linear));
        let special = modes.vectors
            || modes.data_input
            || !modes.macros.is_empty()
            || modes.transforms.polar.is_some()
            || modes.dynamic.is_on()
            || modes.length_due != Position::default()
            || !self.core.is_direct()
            || self.core.modes.feed.mode == FeedMode::InverseTime;
        if !lasting || special {
            return;
        }
        let unit_mm = self.core.modes.unit_mm();
        let measure = Measure {
            unit_mm,
            x_mm: if self.core.modes.diameter { unit_mm / 2.0 } else { unit_mm },
            feed: unit_mm,
            incremental: self.core.modes.incremental,
            zero: 0.0,
        };
        let origin = Origin { program: program as u32, line };
        let (at, line) = line_after_line(self, at, origin, |run, at, origin| {
            run.straight_line(&measure, source, at, origin)
        });
        if let Some(frame) = self.stack.last_mut() {
            (frame.at, frame.line) = (at, line);
        }
    }

    #[inline(always)]
    fn straight_line(
        &mut self,
        measure: &Measure,
        source: &[u8],
        start: usize,
        origin: Origin,
    ) -> Option<usize> {
        let (mut code, mut number) = (None, None);
        let line = read_line(measure, source, start, &self.frames.position, |byte, at| {
            let (value, after) = short_number(source, at)?;
            match byte {
                b'G' | b'g' if code.is_none() && (value == 0.0 || value == 1.0) => {
                    code = Some(if value == 1.0 { Motion::Linear } else { Motion::Rapid });
                }
                b'N' | b'n' => number = Some(value),
                _ => return None,
            }
            Some(after)
        })?;
        let named = AxisSet(line.named);
        let motion = code.or(self.modes.motion).filter(|_| !self.core.turns_alone(named))?;
        let feed = line.feed.unwrap_or(self.core.modes.feed.value);
        let linear = motion == Motion::Linear;
        if linear && line.named != 0 && feed <= 0.0 {
            return None;
        }
        self.core.modes.feed.value = feed;
        if code.is_some() {
            (self.modes.motion, self.modes.base) = (Some(motion), motion);
        }
        if let Some(number) = number {
            self.modes.last[1] = number;
        }
        if line.named != 0 {
            let kind = if linear { MoveKind::Linear } else { MoveKind::Rapid };
            let target = Position(line.target);
            self.frames.position = target;
            let step = Move::plain(kind, target, named, self.core.modes.feed, origin);
            self.core.emit_move(step);
        }
        Some(line.end)
    }
}
