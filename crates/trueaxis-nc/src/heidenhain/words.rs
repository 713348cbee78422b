//! The words of a path block: axes, feed, compensation, M functions with their own words.

use super::line::Cursor;
use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::{Axis, AxisSet, CompensationSide, Position};
use crate::text::program::Fault;

/// Addresses that may touch what follows, as in `FQ1` or `Xnan`; longer ones first.
const ADDRESSES: [&str; 38] = [
    "CCA", "IPA", "IPR", "LEN", "SPA", "SPB", "SPC", "DL", "DR", "FU", "FZ", "IA", "IB", "IC",
    "IU", "IV", "IW", "IX", "IY", "IZ", "NX", "NY", "NZ", "PA", "PR", "TX", "TY", "TZ", "A", "B",
    "C", "F", "R", "S", "X", "Y", "Z", "L",
];

/// The addresses of one letter.
const SINGLE: [&str; 10] = ["X", "Y", "Z", "A", "B", "C", "F", "R", "S", "L"];

/// A coordinate as it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Coordinate {
    pub value: f64,
    pub incremental: bool,
}

impl Coordinate {
    /// Where it lies, counted from the present place if it is an increment.
    pub fn from(self, now: f64) -> f64 {
        if self.incremental { now + self.value } else { self.value }
    }
}

/// What F says in this block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FeedWord {
    Rapid,
    OfTool,
    PerMinute(f64),
    PerRevolution(f64),
    PerTooth(f64),
}

/// An M function with the words that belong to it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FunctionCall {
    pub number: u32,
    pub at: usize,
    pub value: Option<f64>,
    pub feed: Option<f64>,
    pub axes: AxisSet,
}

/// The words of one block; lengths in mm.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Words {
    pub axes: [Option<Coordinate>; 9],
    pub normal: [Option<f64>; 3],
    pub tool: [Option<f64>; 3],
    pub radius: Option<Coordinate>,
    pub angle: Option<Coordinate>,
    pub arc_radius: Option<f64>,
    pub ccw: Option<bool>,
    pub side: Option<CompensationSide>,
    pub length: Option<f64>,
    pub sweep: Option<f64>,
    pub feed: Option<FeedWord>,
    pub functions: Vec<FunctionCall>,
    /// Where the first word stands.
    pub at: usize,
}

impl Words {
    pub fn has_axis(&self) -> bool {
        self.axes.iter().any(Option::is_some)
    }

    pub fn named(&self) -> AxisSet {
        let given = Axis::ALL.into_iter().filter(|a| self.axes[*a as usize].is_some());
        given.fold(AxisSet::default(), AxisSet::with)
    }

    /// Nothing but axis words may stand in some blocks.
    pub fn only_axes(&self, allowed: &[Axis]) -> Result<(), Fault> {
        let axes = Self { axes: self.axes, at: self.at, ..Self::default() };
        let foreign =
            Axis::ALL.into_iter().any(|a| self.named().contains(a) && !allowed.contains(&a));
        if !foreign && *self == axes {
            return Ok(());
        }
        let message = "a word of this block has no effect";
        Err(fault("unused-word", self.at, message, "only axis words are possible here"))
    }

    /// Nothing but M functions may stand in others.
    pub fn only_functions(&self) -> Result<(), Fault> {
        let functions = self.functions.clone();
        if *self == (Self { functions, at: self.at, ..Self::default() }) {
            return Ok(());
        }
        let message = "a word of this block has no effect";
        Err(fault("unused-word", self.at, message, "only M functions are possible here"))
    }

    pub fn calls(&self, number: u32) -> bool {
        self.functions.iter().any(|f| f.number == number)
    }

    /// The place that the axis words name, the present place for the others.
    pub fn target(&self, now: &Position) -> Position {
        let mut target = *now;
        for axis in Axis::ALL {
            if let Some(coordinate) = self.axes[axis as usize] {
                target[axis] = coordinate.from(now[axis]);
            }
        }
        target
    }
}

/// Separates an address from a parameter or `nan` that touches it.
pub(super) fn split_address(c: &mut Cursor<'_>) -> Option<&'static str> {
    let letters = c.letters();
    if let [letter] = letters {
        // One letter is the usual case.
        let found = SINGLE.iter().find(|a| a.as_bytes()[0] == letter.to_ascii_uppercase())?;
        c.take_letters(1);
        return Some(found);
    }
    for address in ADDRESSES {
        let count = address.len();
        if letters.len() < count || !letters[..count].eq_ignore_ascii_case(address.as_bytes()) {
            continue;
        }
        let rest = letters[count..].to_ascii_uppercase();
        if matches!(&rest[..], b"" | b"Q" | b"QL" | b"QR" | b"NAN") {
            c.take_letters(count);
            return Some(address);
        }
    }
    None
}

pub(super) fn axis_of(letter: &str) -> Option<Axis> {
    let byte = *letter.as_bytes().last()?;
    Axis::ALL.into_iter().find(|a| a.letter() == byte)
}

impl Run<'_> {
    /// All words up to the end of the block.
    pub(super) fn words(&mut self, c: &mut Cursor<'_>) -> Result<Words, Fault> {
        let mut words = Words { at: c.offset(), ..Words::default() };
        while !c.done() {
            if !self.word(c, &mut words)? {
                return Err(c.unknown());
            }
        }
        Ok(words)
    }

    fn word(&mut self, c: &mut Cursor<'_>, words: &mut Words) -> Result<bool, Fault> {
        let at = c.offset();
        if let Some(axis) = c.axis_letter() {
            let value = self.value(c)?;
            let value = if axis.is_rotary() { value } else { value * self.core.modes.unit_mm() };
            let new = Coordinate { value, incremental: false };
            return match words.axes[axis as usize].replace(new) {
                Some(_) => Err(repeated(axis, at)),
                None => Ok(true),
            };
        }
        if c.accept("M") {
            let called = self.function_words(c, at)?;
            words.functions.push(called);
            return Ok(true);
        }
        if let Some(index) = c.accept_any(&["RL", "RR", "FMAX", "FAUTO"]) {
            match index {
                0 => words.side = Some(CompensationSide::Left),
                1 => words.side = Some(CompensationSide::Right),
                2 => words.feed = Some(FeedWord::Rapid),
                _ => words.feed = Some(FeedWord::OfTool),
            }
            return Ok(true);
        }
        let address = split_address(c);
        match address {
            Some("R") => self.radius_word(c, words)?,
            Some("F" | "FU" | "FZ") => words.feed = Some(self.feed_word(c, address)?),
            Some("DR") => words.ccw = Some(direction_sign(c)?),
            Some(name) => {
                if self.number_word(c, name, words)? {
                    return Err(repeated(name, at));
                }
            }
            None => return Ok(false),
        }
        Ok(true)
    }

    /// A word with a number; `true` if it was there before.
    fn number_word(
        &mut self,
        c: &mut Cursor<'_>,
        name: &str,
        words: &mut Words,
    ) -> Result<bool, Fault> {
        let value = self.value(c)?;
        let mm = value * self.core.modes.unit_mm();
        let place = match name {
            "LEN" => return Ok(words.length.replace(mm).is_some()),
            "CCA" => return Ok(words.sweep.replace(value).is_some()),
            "PR" | "IPR" => {
                let incremental = name == "IPR";
                let new = Coordinate { value: mm, incremental };
                return Ok(words.radius.replace(new).is_some());
            }
            "PA" | "IPA" => {
                let incremental = name == "IPA";
                return Ok(words.angle.replace(Coordinate { value, incremental }).is_some());
            }
            "NX" | "NY" | "NZ" => &mut words.normal,
            "TX" | "TY" | "TZ" => &mut words.tool,
            _ => {
                let Some(axis) = axis_of(name).filter(|_| name.len() == 1 || name.starts_with('I'))
                else {
                    return Err(unexpected(name, c));
                };
                let value = if axis.is_rotary() { value } else { mm };
                let new = Coordinate { value, incremental: name.len() == 2 };
                return Ok(words.axes[axis as usize].replace(new).is_some());
            }
        };
        let index = axis_of(name).map_or(0, |a| a as usize);
        Ok(place[index].replace(value).is_some())
    }

    /// `R0` ends the compensation; `R+` and `R-` alone are those of blocks along one axis; any other
    /// is the radius of a circle.
    fn radius_word(&mut self, c: &mut Cursor<'_>, words: &mut Words) -> Result<(), Fault> {
        let mut ahead = c.clone();
        let sign = ahead.symbol();
        if matches!(sign, Some(b'+' | b'-')) {
            ahead.accept_symbol(sign.unwrap_or(0));
            if !ahead.is_number() && !ahead.letters().eq_ignore_ascii_case(b"Q") {
                *c = ahead;
                let left = sign == Some(b'-');
                let side = if left { CompensationSide::Left } else { CompensationSide::Right };
                words.side = Some(side);
                return Ok(());
            }
        }
        let value = self.value(c)?;
        if value == 0.0 && sign.is_none() {
            words.side = Some(CompensationSide::Off);
        } else {
            words.arc_radius = Some(value * self.core.modes.unit_mm());
        }
        Ok(())
    }

    /// F and what follows it; inch programs have F in tenths of an inch per minute.
    pub(super) fn feed_word(
        &mut self,
        c: &mut Cursor<'_>,
        address: Option<&str>,
    ) -> Result<FeedWord, Fault> {
        if address == Some("F") {
            if c.accept("MAX") {
                return Ok(FeedWord::Rapid);
            }
            if c.accept("AUTO") {
                return Ok(FeedWord::OfTool);
            }
        }
        let at = c.offset();
        let value = self.value(c)?;
        if value < 0.0 {
            return Err(mistakes::negative_feed(value, at));
        }
        Ok(match address {
            Some("FU") => FeedWord::PerRevolution(value * self.core.modes.unit_mm()),
            Some("FZ") => FeedWord::PerTooth(value * self.core.modes.unit_mm()),
            _ if self.modes.per_revolution => {
                FeedWord::PerRevolution(value * self.core.modes.unit_mm())
            }
            _ => FeedWord::PerMinute(value * self.core.modes.unit_of_klartext_feed()),
        })
    }

    /// The number of an M function and the words that are its own.
    fn function_words(&mut self, c: &mut Cursor<'_>, at: usize) -> Result<FunctionCall, Fault> {
        let number = match self.operand(c)? {
            Some(n) if (0.0..1e6).contains(&n) && n.fract() == 0.0 => n as u32,
            _ => {
                let message = "the number of the M function is missing";
                return Err(fault("missing-value", at, message, "write M3"));
            }
        };
        let mut called =
            FunctionCall { number, at, value: None, feed: None, axes: AxisSet::default() };
        match number {
            // Handwheel: how far each axis may be moved by hand.
            118 => {
                while let Some(index) = c.accept_any(&["X", "Y", "Z", "A", "B", "C"]) {
                    self.value(c)?;
                    called.axes = called.axes.with(Axis::ALL[index]);
                }
            }
            94 | 104 | 138 | 144 => {
                while let Some(index) = c.accept_any(&["A", "B", "C"]) {
                    called.axes = called.axes.with(Axis::ALL[3 + index]);
                }
            }
            120 if c.accept("LA") => called.value = Some(self.value(c)?),
            124 if c.accept("T") => called.value = Some(self.value(c)?),
            103 | 128 if c.is("F") || c.is("FQ") => {
                c.take_letters(1);
                called.feed = Some(self.value(c)?);
            }
            140 => {
                let mut ahead = c.clone();
                if ahead.accept("MB") {
                    *c = ahead;
                    if c.accept("MAX") {
                        called.value = Some(f64::INFINITY);
                    } else {
                        called.value = Some(self.value(c)? * self.core.modes.unit_mm());
                    }
                }
                if c.is("F") || c.is("FQ") {
                    c.take_letters(1);
                    called.feed = Some(self.value(c)?);
                }
            }
            _ => {}
        }
        Ok(called)
    }
}

/// The sign after DR.
fn direction_sign(c: &mut Cursor<'_>) -> Result<bool, Fault> {
    if c.accept_symbol(b'+') {
        return Ok(true);
    }
    if c.accept_symbol(b'-') {
        return Ok(false);
    }
    Err(fault("missing-direction", c.offset(), "the sign of DR is missing", "write DR+ or DR-"))
}

fn repeated(name: impl std::fmt::Display, at: usize) -> Fault {
    mistakes::repeated_word(name, at)
}

fn unexpected(name: &str, c: &Cursor<'_>) -> Fault {
    let message = format!("unexpected word `{name}` in this block");
    fault("unknown-word", c.offset(), message, "check the spelling and the order of the words")
}
