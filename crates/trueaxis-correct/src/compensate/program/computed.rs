//! Computed words: the program goes on computing them, and the correction is added.
//!
//! ```text
//!     SINUMERIK         X=R1+5        X=(R1+5)+0.012        X=-R1     X=(-R1)+0.012
//!     FANUC, LinuxCNC   X[#1+5.]      X[[#1+5.]+0.012]      X-#1      X-[#1-0.012]
//!     HEIDENHAIN        L X+Q121      FN 1: QL499 = +Q121 + +0.012
//!                                     L X+QL499
//! ```
//!
//! The words of the next blocks may rest on such a place: an axis that they do not name is corrected by an
//! increment, so that with other parameters it does not go back to where it was in this run.

use super::block::{Block, Put};
use super::number::{Of, Unit};
use super::refuse::refusal;
use super::words::{Word, Words};
use rayon::prelude::*;
use std::ops::Range;
use trueaxis_motion::axis_path::Fault;
use trueaxis_nc::moves::{Axis, AxisSet, CompensationSide, Event, Move};
use trueaxis_nc::{Control, Program};

/// All axes.
const ALL: AxisSet = AxisSet(0b1_1111_1111);

/// Brackets in each other that FANUC allows.
///
/// # Source
/// FANUC 16/18-C, operator's manual for lathes, section 16.3 (page 287): five levels, those of functions
/// included; alarm 118 beyond.
const FANUC_BRACKETS: usize = 5;

/// Local parameters of Klartext, QL0 to QL499: those of a program are not seen by any other.
///
/// # Source
/// HEIDENHAIN TNC 640 (34059x-02), Klartext manual 5/2013, section 9.1 (page 279).
const LOCALS: u16 = 500;

/// Parameters for the words of one block.
const LOCALS_OF_BLOCK: usize = 12;

/// A computed part of a block.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    text: Range<usize>,
    /// In the unit of the program.
    value: f64,
}

/// What the present block computes, and what places of the axes rest on computed values.
#[derive(Debug, Default)]
pub(super) struct Computed {
    parts: Vec<Part>,
    /// Something in the block is computed, or it only steers the execution.
    any: bool,
    steers: bool,
    /// The block changed the frame.
    frame: bool,
    /// The block made a move.
    moved: bool,
    klartext: bool,
    /// A centre or a pole was computed, which Klartext has in a block of its own.
    pole: bool,
    resting: AxisSet,
    feed: bool,
    on_contour: bool,
    transformed: bool,
}

impl Computed {
    pub fn of(control: Control) -> Self {
        Self { klartext: control == Control::Heidenhain, ..Self::default() }
    }

    /// The execution goes on; parts of subprograms have no text here.
    pub fn follow(&mut self, event: &Event, source: &[u8], in_main: bool) {
        match event {
            Event::Block { .. } => {
                // What was computed without a move may have been a centre.
                let alone = !self.parts.is_empty() && !self.moved && !self.steers;
                self.pole |= alone && self.klartext;
                self.parts.clear();
                (self.any, self.steers) = (false, false);
                (self.frame, self.moved) = (false, false);
            }
            Event::Computed { text, value } => {
                self.any = true;
                self.steers |= value.is_none();
                if let Some(value) = value.filter(|_| in_main) {
                    let before = source.get(..text.start).unwrap_or_default().iter().rev();
                    let address = before.copied().find(|b| !matches!(b, b' ' | b'='));
                    self.feed |= address.is_some_and(|b| b.eq_ignore_ascii_case(&b'F'));
                    self.parts.push(Part { text: text.clone(), value });
                }
                self.frame_rests();
            }
            Event::Frame(_)
            | Event::WorkOffset { .. }
            | Event::Shift(_)
            | Event::DynamicOffset(_)
            | Event::ToolLength(_)
            | Event::ToolChange(_) => {
                self.frame = true;
                self.frame_rests();
            }
            Event::ToolCentre(on) | Event::TiltedPlane(on) => {
                (self.frame, self.transformed) = (true, *on);
                self.frame_rests();
            }
            Event::Compensation { side, .. } => self.on_contour = *side != CompensationSide::Off,
            _ => {}
        }
    }

    /// In another frame all coordinates of the present place are others.
    fn frame_rests(&mut self) {
        if self.frame && (self.any || self.resting != AxisSet::default()) {
            self.resting = ALL;
        }
    }

    /// The block has made a move; its words are known in the main program.
    pub fn moved(&mut self, m: &Move, words: Option<&Words>, incremental: bool) {
        self.moved = true;
        self.feed &= words.is_none_or(|w| w.feed.as_ref().is_none_or(|f| f.value.is_none()));
        let elsewhere = words.is_none_or(|w| w.machine.is_some() || w.reference);
        for axis in Axis::ALL.into_iter().filter(|axis| m.named.contains(*axis)) {
            let word = words.and_then(|w| w.axes[axis as usize].as_ref());
            let is_plain = word.is_some_and(|w| w.value.is_some() && !w.computed);
            let counts = word.is_some_and(|w| w.is_increment(incremental));
            if !is_plain && self.any {
                self.resting = self.resting.with(axis);
            } else if is_plain && !counts && !elsewhere {
                self.resting.0 &= !(1 << axis as u16);
            }
        }
        if m.direction.is_some() {
            let computed = words.is_none_or(|w| w.vector.iter().flatten().any(|w| w.computed));
            self.resting.0 = match computed && self.any {
                true => self.resting.0 | AxisSet::ROTARY.0,
                false => self.resting.0 & !AxisSet::ROTARY.0,
            };
        }
    }

    /// The words with the values of what is computed.
    pub fn evaluate(&self, words: &mut Words, source: &[u8], unit: Unit) {
        if words.torn {
            return;
        }
        let mut last = words.behind_axes;
        for part in &self.parts {
            let text = trimmed(source, &part.text);
            let mut put = |word: &mut Option<Word>, scale: f64| {
                let belongs = |w: &&mut Word| w.all.start < text.start && text.start <= w.all.end;
                if let Some(word) = word.as_mut().filter(belongs) {
                    word.all.end = word.all.end.max(text.end);
                    last = last.max(Some(word.all.end));
                    (word.number, word.computed) = (text.clone(), true);
                    word.value = Some(part.value * scale);
                }
            };
            for axis in Axis::ALL {
                let scale = if axis.is_rotary() { 1.0 } else { unit.mm() };
                put(&mut words.axes[axis as usize], scale);
            }
            words.vector.iter_mut().for_each(|word| put(word, 1.0));
        }
        words.behind_axes = last;
        words.end = words.end.max(last.unwrap_or(0));
    }

    /// Whether a part of the block stands in a range.
    fn is_in(&self, range: &Range<usize>) -> bool {
        self.parts.iter().any(|part| range.start <= part.text.start && part.text.start <= range.end)
    }

    /// Whether words of the axes, of the tool axis or of a circle are computed.
    pub fn is_in_words(&self, words: &Words) -> bool {
        let mut all = words.axes.iter().chain(&words.vector).flatten();
        all.any(|word| word.computed || word.value.is_none())
            || words.circle_words.iter().any(|range| self.is_in(range))
    }

    /// What a block rests on.
    pub fn of_block(&self, words: &Words) -> Resting {
        let circle = words.circle_words.iter().any(|range| self.is_in(range));
        Resting {
            axes: self.resting,
            circle,
            pole: self.pole,
            feed: self.feed,
            on_contour: self.on_contour,
            transformed: self.transformed,
        }
    }
}

/// What of a block rests on computed values.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Resting {
    /// The places of these axes before it.
    axes: AxisSet,
    /// Centre, radius or another word of its circle.
    pub circle: bool,
    /// A centre in a block of its own.
    pole: bool,
    /// The feed that is in force.
    pub feed: bool,
    on_contour: bool,
    transformed: bool,
}

fn trimmed(source: &[u8], text: &Range<usize>) -> Range<usize> {
    let mut range = text.start..text.end.min(source.len());
    while range.end > range.start && source[range.end - 1].is_ascii_whitespace() {
        range.end -= 1;
    }
    range
}

/// Local parameters that a program of Klartext does not use, the highest first.
pub(super) fn free_locals(source: &[u8], control: Control) -> Vec<u16> {
    if control != Control::Heidenhain {
        return Vec::new();
    }
    let mut used = [false; LOCALS as usize];
    let is_local = |at: usize| source.get(at + 1).is_some_and(|b| b.eq_ignore_ascii_case(&b'L'));
    let is_named = any_at(source, |b| b.eq_ignore_ascii_case(&b'Q'), is_local);
    let searched = if is_named { source } else { &[] };
    let named = searched.windows(2).enumerate().filter(|(_, two)| two.eq_ignore_ascii_case(b"QL"));
    for (at, _) in named {
        let digits = source[at + 2..].iter().take_while(|b| b.is_ascii_digit());
        let digits: String = digits.map(|b| char::from(*b)).collect();
        if let Some(used) = digits.parse().ok().and_then(|n: usize| used.get_mut(n)) {
            *used = true;
        }
    }
    let free = (0..LOCALS).rev().filter(|n| !used[usize::from(*n)]);
    free.take(LOCALS_OF_BLOCK).collect()
}

/// Bytes that one task looks through.
const SCANNED: usize = 1 << 20;

/// Whether a program may compute a word: blocks are reported for these, which takes time.
pub(super) fn may_compute(program: &Program) -> bool {
    let may = computes_in(program.source(), program.dialect().control);
    // From here on the text is read line after line.
    program.pass(0..program.source().len());
    may
}

fn computes_in(source: &[u8], control: Control) -> bool {
    match control {
        Control::Fanuc | Control::Haas | Control::LinuxCnc => {
            let computes = |part: &[u8]| part.iter().any(|b| matches!(b, b'#' | b'['));
            source.par_chunks(SCANNED).any(computes)
        }
        Control::Heidenhain => {
            let names = |at: usize| {
                let next = source.get(at + 1).map_or(0, u8::to_ascii_uppercase);
                next.is_ascii_digit() || matches!(next, b'L' | b'R')
            };
            any_at(source, |b| matches!(b, b'Q' | b'q'), names)
        }
        Control::Sinumerik840d => {
            any_at(source, |b| b == b'=', |at| !is_plain_number(&source[at + 1..]))
        }
    }
}

/// Whether there is a place with such a byte of which something holds.
pub(super) fn any_at(
    source: &[u8],
    is_one: impl Fn(u8) -> bool + Sync,
    holds: impl Fn(usize) -> bool + Sync,
) -> bool {
    source.par_chunks(SCANNED).enumerate().any(|(part, bytes)| {
        let first = part * SCANNED;
        bytes.iter().enumerate().any(|(i, b)| is_one(*b) && holds(first + i))
    })
}

/// Whether a text begins with a number that nothing computes with.
fn is_plain_number(text: &[u8]) -> bool {
    let is = |part: &[u8], of: &[u8]| part.first().is_some_and(|b| of.contains(b));
    let text = text.trim_ascii_start();
    let number = if is(text, b"+-") { &text[1..] } else { text };
    let end = number.iter().position(|b| !b.is_ascii_digit() && *b != b'.');
    let end = end.unwrap_or(number.len());
    let rest = number[end..].trim_ascii_start();
    let operator = ["DIV", "MOD", "EX", "B_", "AND", "OR", "XOR"];
    let named = |name: &&str| {
        rest.get(..name.len()).is_some_and(|b| b.eq_ignore_ascii_case(name.as_bytes()))
    };
    end > 0 && !is(rest, b"+-*/<>=[(") && !operator.iter().any(named)
}

/// A computed word that was corrected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expression {
    /// The line of the program as it was.
    pub line: u32,
    /// The expression as it was.
    pub was: String,
    /// What stands for it now; in Klartext the calculation in the block before.
    pub is: String,
}

impl Block<'_> {
    /// Writes a number into a word; where the word is computed, adds what is missing.
    pub(super) fn put_number(&mut self, word: &Word, value: f64, of: Of) -> Result<(), Fault> {
        let (true, Some(old)) = (word.computed, word.value) else {
            let (grid, control) = (self.grid, self.control);
            self.edits.put_with(word.number.clone(), |text| grid.write(text, value, of, control));
            return Ok(());
        };
        let by = value - old;
        let Some(digits) = self.grid.difference(by, of) else { return Ok(()) };
        let was = String::from_utf8_lossy(&self.source[word.number.clone()]).into_owned();
        let (text, is) = match self.control {
            Control::Sinumerik840d => {
                let text = sum(&was, by, &digits);
                (text.clone(), text)
            }
            Control::Fanuc | Control::Haas | Control::LinuxCnc => {
                let point = self.control != Control::LinuxCnc && !digits.contains('.');
                let digits = if point { format!("{digits}.") } else { digits };
                let text = bracketed(&was, by, &digits);
                if self.control != Control::LinuxCnc && depth(&text) > FANUC_BRACKETS {
                    let why = "has as many brackets in each other as the control allows";
                    return Err(self.not_added(&was, why));
                }
                (text.clone(), text)
            }
            Control::Heidenhain => {
                let Some(local) = self.locals.get(self.before.len()) else {
                    return Err(self.not_added(&was, "needs a free QL parameter"));
                };
                let plus = if was.starts_with(['+', '-']) { "" } else { "+" };
                let line = format!("FN 1: QL{local} = {plus}{was} + {}{digits}", sign(by));
                let skip = if self.words.skip.is_some() { "/ " } else { "" };
                self.before.push(format!("{skip}{line}"));
                (format!("+QL{local}"), line)
            }
        };
        self.edits.put(word.number.clone(), &text);
        self.expressions.push(Expression { line: self.m.origin.line, was, is });
        Ok(())
    }

    /// Blocks that rest on computed values have one point: more would go where this run went.
    pub(super) fn is_one_point(&self) -> Result<(), Fault> {
        let straightened = self.is_circle() && self.arc.is_none();
        if self.pieces == 1 && !straightened {
            return Ok(());
        }
        let words = self.words.axes.iter().chain(&self.words.vector).flatten();
        let named = self.m.named.0 & self.resting.axes.0 != 0;
        let circle = straightened && (self.resting.circle || self.resting.pole);
        let computed = words.into_iter().any(|w| w.computed || w.value.is_none());
        if !(computed || named || circle) {
            return Ok(());
        }
        let message = "the block is computed, or begins where one led that is, and the correction needs \
                       further points on its way";
        Err(self.unrolls(message.to_owned()))
    }

    /// A word for an axis that the block does not name, where its place rests on computed values.
    pub(super) fn increment(&self, axis: Axis, by: f64, of: Of) -> Result<Option<Put>, Fault> {
        const INCREMENTS: [&str; 9] = ["IX", "IY", "IZ", "IA", "IB", "IC", "IU", "IV", "IW"];
        const LETTERS: [&str; 9] = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];
        let index = axis as usize;
        if self.incremental || !self.resting.axes.contains(axis) {
            return Ok(None);
        }
        let Some(digits) = self.grid.difference(by, of) else { return Ok(None) };
        let minus = if by < 0.0 { "-" } else { "" };
        let letters = LETTERS[index];
        Ok(Some(match self.control {
            Control::Sinumerik840d => Put { letters, text: format!("=IC({minus}{digits})") },
            Control::Heidenhain => {
                Put { letters: INCREMENTS[index], text: format!("{}{digits}", sign(by)) }
            }
            // The place where the block before ended; with radius compensation not that of the contour.
            Control::LinuxCnc if !self.resting.on_contour => {
                Put { letters, text: format!("[#{}{}{digits}]", 5420 + index, sign(by)) }
            }
            // The numbers of rotary axes are those of the machine.
            Control::Fanuc | Control::Haas
                if !self.resting.on_contour && !self.resting.transformed && index < 3 =>
            {
                let point = if digits.contains('.') { "" } else { "." };
                Put { letters, text: format!("[#{}{}{digits}{point}]", 5001 + index, sign(by)) }
            }
            Control::LinuxCnc | Control::Fanuc | Control::Haas => {
                let message = format!(
                    "a block before computes {axis}, and {axis} would have to be corrected without a word"
                );
                return Err(self.unrolls(message));
            }
        }))
    }

    fn not_added(&self, was: &str, why: &str) -> Fault {
        self.unrolls(format!("no correction can be added to {was}: it {why}"))
    }

    fn unrolls(&self, message: String) -> Fault {
        let hint = "write a number instead, or name all axes in the block";
        refusal(self.m.origin, "computed-coordinate", message, hint)
    }
}

fn sign(by: f64) -> char {
    if by < 0.0 { '-' } else { '+' }
}

/// Expression and correction of SINUMERIK.
fn sum(was: &str, by: f64, digits: &str) -> String {
    let is_name = was.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
    match is_name || is_in_brackets(was) {
        true => format!("{was}{}{digits}", sign(by)),
        false => format!("({was}){}{digits}", sign(by)),
    }
}

/// Whether the first bracket of a text is closed by its last character.
fn is_in_brackets(text: &str) -> bool {
    let mut depth = 0_i32;
    let closed = text.bytes().position(|byte| {
        depth += i32::from(byte == b'(') - i32::from(byte == b')');
        depth <= 0
    });
    text.starts_with('(') && closed == Some(text.len() - 1)
}

/// Expression and correction of FANUC and LinuxCNC. A sign stays where it is, so that the correction
/// changes its own.
fn bracketed(was: &str, by: f64, digits: &str) -> String {
    let inner = was.trim_start_matches(['-', '+', ' ']);
    let front = &was[..was.len() - inner.len()];
    let turned = front.bytes().filter(|b| *b == b'-').count() % 2 == 1;
    let sign = sign(if turned { -by } else { by });
    format!("{front}[{inner}{sign}{digits}]")
}

/// How deep brackets are in each other.
fn depth(text: &str) -> usize {
    let (mut now, mut most) = (0_usize, 0);
    for byte in text.bytes() {
        match byte {
            b'[' => now += 1,
            b']' => now = now.saturating_sub(1),
            _ => {}
        }
        most = most.max(now);
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_computes_is_seen_on_both_sides_of_a_border_of_tasks() {
        let computing = [
            (Control::Fanuc, &b"X#1"[..]),
            (Control::LinuxCnc, b"X[1]"),
            (Control::Heidenhain, b"LX+q1"),
            (Control::Heidenhain, b"LX+QL1"),
            (Control::Sinumerik840d, b"X=R1"),
        ];
        for (control, words) in computing {
            for before in [0, SCANNED - 4, SCANNED - 3, SCANNED - 2, SCANNED - 1, SCANNED] {
                let mut source = vec![b' '; before];
                assert!(!computes_in(&source, control));
                source.extend_from_slice(words);
                assert!(computes_in(&source, control), "{control:?} {before}");
            }
        }
        assert!(!computes_in(b"N1 X=1.5 A3=-0.2\n", Control::Sinumerik840d));
        assert!(!computes_in(b"CALL PGM Q\nQ", Control::Heidenhain));
    }

    #[test]
    fn free_locals_are_those_that_no_line_names() {
        let free = free_locals(
            b"QL499 = 3\nql498=1\nFN 0: QL07\nQL99999999999999999999\nQQL12 QL",
            Control::Heidenhain,
        );
        assert_eq!(free.len(), LOCALS_OF_BLOCK);
        assert!([499, 498, 7, 12].iter().all(|n| !free.contains(n)));
        assert!(free_locals(b"", Control::Fanuc).is_empty());
    }
}
