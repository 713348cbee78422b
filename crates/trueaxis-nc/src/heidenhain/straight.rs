//! A shorter cut for lines with `L`.

use trueaxis_blocks::digits::short_number;

use super::{Activation, Run};
use crate::execution::straight::{Line, Measure, line_after_line, read_line};
use crate::moves::turns::unit;
use crate::moves::{AxisSet, CompensationSide, Feed, FeedMode, Move, MoveKind, Origin, Position};

impl Run<'_> {
    /// Executes the lines with `L` that come next, and nothing else: axis words with plain numbers, F or FMAX,
    /// and R0.
    ///
    /// RND and CHF change the move before them, so each line is executed once it is known that another
    /// line with `L` follows; the last one is left to the general way.
    pub(super) fn straight_lines(&mut self, source: &[u8]) {
        let Some(&Activation { program, at, line, .. }) = self.stack.last() else { return };
        let Some(mut words) = after_l(source, at) else { return };
        let modes = &self.modes;
        let special = modes.side != CompensationSide::Off
            || modes.space_angles
            || modes.per_revolution
            || modes.cycle_everywhere
            || self.core.settings.report_blocks
            || !self.core.is_direct();
        if special {
            return;
        }
        let unit_mm = self.core.modes.unit_mm();
        let measure = Measure {
            unit_mm,
            x_mm: unit_mm,
            feed: self.core.modes.unit_of_klartext_feed(),
            incremental: false,
            zero: -0.0,
        };
        let mut before = None;
        let origin = Origin { program: program as u32, line };
        let (at, line) = line_after_line(self, at, origin, |run, _, origin| {
            let (line, rapid) = read_words(&measure, source, words, &run.frames.position)?;
            let next = after_l(source, line.end)?;
            let from = run.frames.position;
            run.straight_move(&line, rapid, origin)?;
            (words, before) = (next, Some(from));
            Some(line.end)
        });
        if let Some(active) = self.stack.last_mut() {
            (active.at, active.line) = (at, line);
        }
        if let Some(before) = before {
            let target = self.frames.position;
            self.tangent = unit(std::array::from_fn(|i| target.0[i] - before.0[i]));
        }
    }

    /// Makes the move of a line; `None` and no effect where a word is to be objected to.
    #[inline(always)]
    fn straight_move(&mut self, line: &Line, rapid: bool, origin: Origin) -> Option<()> {
        let feed = match line.feed {
            Some(value) => Feed { mode: FeedMode::PerMinute, value },
            None => self.core.modes.feed,
        };
        let in_range = line.target.iter().all(|v| v.abs() < 1e9) && feed.value.abs() < 1e9;
        let named = AxisSet(line.named);
        let is_elsewhere =
            self.modes.shortest && named.has_rotary() || self.core.turns_alone(named);
        if line.named == 0 || !in_range || !rapid && feed.value <= 0.0 || is_elsewhere {
            return None;
        }
        self.core.modes.feed = feed;
        if named.has_rotary() {
            self.direction = None;
        }
        self.frames.position = Position(line.target);
        let mut target = self.frames.position;
        for (place, turned) in target.0[3..].iter_mut().zip(&self.turned) {
            *place += turned;
        }
        let kind = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
        self.core.emit_move(Move::plain(kind, target, named, feed, origin));
        Some(())
    }
}

/// The words of a line after its `L`, and whether it has FMAX.
#[inline(always)]
fn read_words(
    measure: &Measure,
    source: &[u8],
    start: usize,
    from: &Position,
) -> Option<(Line, bool)> {
    let (mut rapid, mut on_path) = (false, false);
    let line = read_line(measure, source, start, from, |byte, at| match byte {
        b'\t' => Some(at),
        b'F' | b'f' if !rapid => {
            let (word, rest) = source.get(at..)?.split_first_chunk::<3>()?;
            rapid = word.eq_ignore_ascii_case(b"MAX") && !rest.first()?.is_ascii_alphabetic();
            rapid.then_some(at + 3)
        }
        b'R' | b'r' if !on_path && source.get(at)?.is_ascii_digit() => {
            let (value, after) = short_number(source, at)?;
            on_path = value == 0.0;
            on_path.then_some(after)
        }
        _ => None,
    })?;
    (!rapid || line.feed.is_none()).then_some((line, rapid))
}

/// The byte after the `L` of a line that begins here, with or without a number.
#[inline(always)]
fn after_l(source: &[u8], start: usize) -> Option<usize> {
    let run = |from: usize, belongs: fn(u8) -> bool| {
        let rest = source.get(from..)?;
        Some(from + rest.iter().position(|b| !belongs(*b))?)
    };
    let blank = |b: u8| matches!(b, b' ' | b'\t');
    let number = run(start, blank)?;
    let word = run(run(number, |b| b.is_ascii_digit())?, blank)?;
    let begins = matches!(source[word], b'L' | b'l') && blank(*source.get(word + 1)?);
    begins.then_some(word + 1)
}
