//! What was found and done on the way through the program.

use super::block::Block;
use super::computed::Expression;
use super::correct::Corrected;
use super::length::OtherLength;
use super::stand::{Sample, Stand};
use std::collections::BTreeMap;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_nc::moves::Axis;

/// Places at which uncertainties are evaluated.
const PLACES: usize = 100;

/// The largest correction of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LargestCorrection {
    /// With its sign. Unit: mm or rad.
    pub value: f64,
    /// The line of the block.
    pub line: u32,
    /// How near the end of the travel the axis comes; infinite without one. Unit: mm or rad.
    pub to_travel_end: f64,
    /// The line where it does.
    pub nearest_line: u32,
}

/// A line leads to the same places again, mm and rad.
const SAME_MM: f64 = 1e-6;
const SAME_RAD: f64 = 1e-9;

/// Additions that are listed.
const MOST_ADDITIONS: usize = 1000;

/// What was done, in numbers.
#[derive(Debug, Clone, Default)]
pub struct Found {
    /// Blocks that move the tool and were examined.
    pub blocks: u64,
    /// Blocks that became several.
    pub split: u64,
    /// What all blocks became.
    pub pieces: u64,
    /// Circles that became straight pieces.
    pub circles: u64,
    /// Words that blocks did not have: how many, and the first with line and axis.
    pub words_added: u64,
    /// The first of them: line and axis.
    pub additions: Vec<(u32, Axis)>,
    /// Computed words that were corrected: how many, and the first of them.
    pub expressions_corrected: u64,
    /// The first of them.
    pub expressions: Vec<Expression>,
    /// Blocks in which only the rotary axes moved, with a new F so that they take the same time.
    pub feeds_changed: u64,
    /// Places where an axis reverses by less than its reversal error, or by rounding alone.
    pub undecided: u64,
    /// Cuts that begin where no corrected word leads, by their lines: the proof leaves their ways out.
    pub begins_elsewhere: Vec<u32>,
    /// The first cut in which the control counts with another length than that of the tool.
    pub(super) other_length: Option<OtherLength>,
    /// Blocks that stay as they are, by reason.
    pub left: BTreeMap<&'static str, u64>,
    /// Places where the tool axis keeps its deviation, by reason.
    pub axis_left: BTreeMap<String, u64>,
    /// Of each axis of the machine.
    pub largest: Vec<LargestCorrection>,
    /// The largest relative change of the path length of the tool tip in a block. Unit: 1.
    pub length_change: f64,
    /// The block with the largest correction of the tip: nominal and corrected axis positions.
    pub worst: Option<(u32, Command, Command)>,
    worst_mm: f64,
    kinds: Vec<(AxisKind, Travel)>,
    /// Some places of the program, evenly over it.
    pub(super) places: Vec<Command>,
    stride: u64,
    seen: u64,
    pub(super) wants: Vec<Want>,
    /// A line led to other places when it was executed again: the proof tells whether that does harm.
    pub(super) led_elsewhere: bool,
    /// The stands of each line when it was executed first: from one up to before the other.
    led: Vec<[u32; 2]>,
    pub(super) stands: Vec<Stand>,
}

/// Where the tool shall go in a piece of the written program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Want {
    /// The line of the program as it was.
    pub line: u32,
    /// Which of the lines that it became; the highest bit is set where only its end counts.
    piece: u32,
    /// Its stands, the beginning first.
    pub from: u32,
    pub to: u32,
}

impl Want {
    const END_ONLY: u32 = 1 << 31;

    pub fn of(line: u32, piece: u32, end_only: bool) -> Self {
        let bit = if end_only { Self::END_ONLY } else { 0 };
        Self { line, piece: piece | bit, from: 0, to: 0 }
    }

    /// Which of the lines that its line became.
    pub fn piece(&self) -> u32 {
        self.piece & !Self::END_ONLY
    }

    /// Whether only its end counts.
    pub fn is_end_only(&self) -> bool {
        self.piece & Self::END_ONLY != 0
    }
}

impl Found {
    pub(super) fn of(machine: &Machine) -> Self {
        let kinds: Vec<_> = machine.axes().iter().map(|a| (a.kind, a.travel)).collect();
        let none = LargestCorrection { to_travel_end: f64::INFINITY, ..Default::default() };
        Self { largest: vec![none; kinds.len()], kinds, ..Self::default() }
    }

    pub(super) fn leave(&mut self, why: &'static str) {
        *self.left.entry(why).or_default() += 1;
    }

    /// A place of a line was corrected.
    pub(super) fn correct(&mut self, (nominal, line): (&Command, u32), done: &Corrected) {
        self.sample(nominal);
        let mut linear = 0.0_f64;
        let places = done.command.iter().zip(nominal);
        for (i, ((to, was), &(kind, travel))) in places.zip(&self.kinds).enumerate() {
            let by = to - was;
            let largest = &mut self.largest[i];
            if by.abs() > largest.value.abs() {
                (largest.value, largest.line) = (by, line);
            }
            if kind == AxisKind::Linear {
                linear = linear.hypot(by);
            }
            if let Travel::Between(low, high) = travel {
                let near = (to - low).min(high - to);
                if near < largest.to_travel_end {
                    (largest.to_travel_end, largest.nearest_line) = (near, line);
                }
            }
        }
        if linear > self.worst_mm || self.worst.is_none() {
            self.worst_mm = linear;
            self.worst = Some((line, *nominal, done.command));
        }
        self.undecided += u64::from(done.undecided);
        if let Some(why) = done.left {
            *self.axis_left.entry(why.to_string()).or_default() += 1;
        }
    }

    /// A block was written.
    pub(super) fn note(
        &mut self,
        block: &Block<'_>,
        circle_gone: bool,
        feed_changed: bool,
        samples: &[Sample],
    ) {
        self.blocks += 1;
        self.split += u64::from(block.pieces > 1);
        self.pieces += block.pieces as u64;
        self.words_added += block.added.len() as u64;
        let room = MOST_ADDITIONS.saturating_sub(self.additions.len());
        self.additions
            .extend(block.added.iter().take(room).map(|axis| (block.m.origin.line, *axis)));
        self.expressions_corrected += block.expressions.len() as u64;
        let room = MOST_ADDITIONS.saturating_sub(self.expressions.len());
        self.expressions.extend(block.expressions.iter().take(room).cloned());
        self.feeds_changed += u64::from(feed_changed);
        self.circles += u64::from(circle_gone);
        // How much longer the path of the tool tip has become.
        let length = |of: &dyn Fn(&Sample) -> Vec3| -> f64 {
            samples.windows(2).map(|w| (of(&w[1]) - of(&w[0])).norm()).sum()
        };
        let (before, after) = (length(&|s| s.wanted.tip), length(&|s| s.believed.tip));
        if before > 1.0 && (after / before - 1.0).abs() > self.length_change.abs() {
            self.length_change = after / before - 1.0;
        }
    }

    /// Every so manieth place, so that there are never many.
    fn sample(&mut self, command: &Command) {
        if self.seen.is_multiple_of(self.stride.max(1)) {
            self.places.push(*command);
        }
        self.seen += 1;
        if self.places.len() >= 2 * PLACES {
            self.stride = 2 * self.stride.max(1);
            let mut keep = false;
            self.places.retain(|_| {
                keep = !keep;
                keep
            });
        }
    }

    /// Whether a line leads as it did before.
    pub(super) fn leads_as_before(&self, line: u32, samples: &[Sample], end_only: bool) -> bool {
        let before = self.led.get(line as usize).filter(|[from, to]| from < to);
        let (Some([from, to]), [first, .., last]) = (before, samples) else {
            return true;
        };
        let same = |stand: u32, sample: &Sample| {
            let [tip, axis] = sample.wanted.from(&self.stands[stand as usize]);
            tip < SAME_MM && axis < SAME_RAD
        };
        same(to - 1, last) && (end_only || to - from == 1 || same(*from, first))
    }

    /// The program is written: what only the walk asks for goes.
    pub(super) fn end(&mut self) {
        self.led = Vec::new();
    }

    /// The program is proved: where its pieces lead is not asked any more.
    pub(super) fn forget(&mut self) {
        (self.wants, self.stands) = (Vec::new(), Vec::new());
    }

    /// A line was executed; its pieces begin with this one.
    pub(super) fn executed(&mut self, line: u32, first: usize) {
        let index = line as usize;
        if self.led.len() <= index {
            self.led.resize(index + 1, [0; 2]);
        }
        if self.led[index] == [0; 2] {
            let from = self.wants.get(first).map_or(self.stands.len() as u32, |want| want.from);
            self.led[index] = [from, self.stands.len() as u32];
        }
    }

    /// Stands of a piece; those of one line follow each other.
    pub(super) fn want(&mut self, want: Want, stands: impl ExactSizeIterator<Item = Stand>) {
        let same = |w: &&mut Want| w.line == want.line && w.piece() == want.piece();
        if let Some(last) = self.wants.last_mut().filter(same) {
            self.stands.extend(stands.skip(1));
            last.to = self.stands.len() as u32;
            return;
        }
        // Of a rapid move only the end counts.
        let skip = if want.is_end_only() { stands.len() - 1 } else { 0 };
        let mut stands = stands.skip(skip).peekable();
        // A piece mostly begins where the one before it ends: that stand is kept once.
        let begins = !want.is_end_only() && stands.peek() == self.stands.last();
        let from = self.stands.len() as u32 - u32::from(begins);
        self.stands.extend(stands.skip(usize::from(begins)));
        self.wants.push(Want { from, to: self.stands.len() as u32, ..want });
    }
}
