//! The words of one block with their values.

use super::reader::Reader;
use super::tables::{self, Code, Name};
use super::variables::axis_of;
use super::{Next, Run, fault};
use crate::execution::mistakes;
use crate::execution::values::LARGEST;
use crate::moves::{Axis, AxisSet};
use crate::text::lexer::TokenKind;
use crate::text::program::Fault;

/// How a value is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Mode {
    /// By G90 or G91.
    #[default]
    Modal,
    Absolute,
    Increment,
    Shortest,
    Positive,
    Negative,
}

/// T with a number or a name.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ToolCall {
    Number(u32),
    Name(String),
}

/// The words of one block.
#[derive(Debug, Clone, Default)]
pub(super) struct Words {
    pub axes: AxisSet,
    pub values: [f64; 9],
    pub modes: [Mode; 9],
    pub places: [usize; 9],
    /// I, J and K.
    pub centers: [Option<(f64, Mode)>; 3],
    /// I1, J1 and K1.
    pub through: [Option<(f64, Mode)>; 3],
    /// A2 B2 C2 to A7 B7 C7.
    pub vectors: [[Option<f64>; 3]; 6],
    /// One bit for each of these vectors.
    pub vector_bits: u8,
    pub vector_place: usize,
    pub feed: Option<(f64, usize)>,
    pub speed: Option<f64>,
    pub tool: Option<(ToolCall, usize)>,
    pub edge: Option<(u32, usize)>,
    pub named: Vec<(Name, f64, Mode, usize)>,
    pub codes: Vec<(Code, usize)>,
    pub m: Vec<(u32, usize)>,
    /// Axes with numbers, such as X1: known to reference points only.
    pub numbered: Vec<(String, usize)>,
}

impl Words {
    pub fn clear(&mut self) {
        self.axes = AxisSet::default();
        self.centers = [None; 3];
        self.through = [None; 3];
        if self.vector_bits != 0 {
            self.vectors = [[None; 3]; 6];
            self.vector_bits = 0;
        }
        (self.feed, self.speed, self.tool, self.edge) = (None, None, None, None);
        self.named.clear();
        self.codes.clear();
        self.m.clear();
        self.numbered.clear();
    }

    #[inline]
    pub fn put_axis(&mut self, axis: Axis, value: (f64, Mode), at: usize) -> Result<(), Fault> {
        if self.axes.contains(axis) {
            return Err(mistakes::repeated_word(axis, at));
        }
        if value.0.is_nan() || value.0.abs() > LARGEST {
            return Err(mistakes::too_large(value.0, axis, at));
        }
        self.axes = self.axes.with(axis);
        let index = axis as usize;
        (self.values[index], self.modes[index]) = value;
        self.places[index] = at;
        Ok(())
    }

    /// A2 … C7: the vector by its number.
    pub fn vector(&self, number: usize) -> Option<[Option<f64>; 3]> {
        (self.vector_bits & (1 << (number - 2)) != 0).then(|| self.vectors[number - 2])
    }

    pub fn put_vector(&mut self, place: [usize; 2], value: f64, at: usize) {
        let [number, axis] = place;
        self.vectors[number - 2][axis] = Some(value);
        self.vector_bits |= 1 << (number - 2);
        self.vector_place = at;
    }

    /// The value of a named word; it is taken out.
    pub fn take(&mut self, name: Name) -> Option<(f64, Mode, usize)> {
        let index = self.named.iter().position(|(n, ..)| *n == name)?;
        let (_, value, mode, at) = self.named.remove(index);
        Some((value, mode, at))
    }

    pub fn has(&self, name: Name) -> bool {
        self.named.iter().any(|(n, ..)| *n == name)
    }
}

impl Run<'_> {
    /// Reads the words of a block and executes its assignments and calls.
    pub(super) fn gather(&mut self, reader: &mut Reader<'_>) -> Result<Option<Next>, Fault> {
        while let Some(token) = reader.peek() {
            let at = token.start;
            match token.kind {
                TokenKind::Letter => {
                    if let Some(next) = self.letter_word(reader, at)? {
                        return Ok(Some(next));
                    }
                }
                TokenKind::Word => self.long_word(reader, at)?,
                TokenKind::Symbol if reader.source[at] == b'$' => self.system_assignment(reader)?,
                TokenKind::Symbol if reader.source[at] == b',' => reader.advance(),
                _ => return Err(foreign(reader)),
            }
        }
        Ok(None)
    }

    /// A word that begins with one letter.
    fn letter_word(&mut self, reader: &mut Reader<'_>, at: usize) -> Result<Option<Next>, Fault> {
        let letter = reader.letter().unwrap_or(b' ');
        let numbered = reader.number_ahead(1);
        if letter == b'R' && (reader.symbol_ahead(1) == Some(b'[') || numbered.is_some()) {
            let slot = self.slot(reader)?;
            if !reader.equals_ahead(0) {
                return Err(mistakes::missing_equals(
                    "an R parameter",
                    "write R1=2",
                    reader.here(),
                ));
            }
            self.assignment(&slot, reader)?;
            self.core.report_computed(at..reader.here(), None);
            return Ok(None);
        }
        if letter == b'L'
            && let Some((_, 2)) = reader.name()
        {
            let (name, arguments) = self.called(reader)?;
            let rounds = self.rounds(reader)?;
            return self.call(&name, arguments, rounds, at).map(Some);
        }
        if let Some(number) = numbered
            && reader.equals_ahead(2)
        {
            let digits = String::from_utf8_lossy(reader.text(number)).into_owned();
            reader.at += 3;
            self.extended(letter, &digits, reader, at)?;
            return Ok(None);
        }
        reader.advance();
        if reader.accept(b'[') {
            // S[2]=1000 is S2=1000 with a computed number.
            let number = self.number(reader)?;
            reader.require(b']', "write one ] for each [")?;
            reader.require(b'=', "write S[2]=1000")?;
            self.extended(letter, &number.to_string(), reader, at)?;
            return Ok(None);
        }
        let equals = reader.equals_ahead(0);
        reader.at += usize::from(equals);
        if letter == b'T' && equals {
            return self.tool_word(reader, at).map(|()| None);
        }
        let value = if equals {
            self.moded_value(reader)?
        } else {
            (self.plain_value(reader)?, Mode::Modal)
        };
        self.put(letter, value, at)?;
        Ok(None)
    }

    fn tool_word(&mut self, reader: &mut Reader<'_>, at: usize) -> Result<(), Fault> {
        let tool = match self.expression(reader)? {
            super::values::Value::Text(name) => ToolCall::Name(name),
            value => ToolCall::Number(tool_number(value.number(at)?, at)?),
        };
        self.words.tool = Some((tool, at));
        Ok(())
    }

    /// A signed number after a letter.
    fn plain_value(&mut self, reader: &mut Reader<'_>) -> Result<f64, Fault> {
        let mut negative = false;
        while let Some(sign @ (b'-' | b'+')) = reader.symbol() {
            negative ^= sign == b'-';
            reader.advance();
        }
        match reader.number() {
            Some(value) => value.map(|v| if negative { -v } else { v }),
            None => {
                let hint = "write a number after a letter, or = and an expression";
                Err(fault("missing-value", reader.here(), "a value is missing here", hint))
            }
        }
    }

    /// An expression, in AC( ), IC( ), DC( ), ACP( ) or ACN( ) or plain.
    pub(super) fn moded_value(&mut self, reader: &mut Reader<'_>) -> Result<(f64, Mode), Fault> {
        let mode = match reader.word().as_deref() {
            Some("AC") => Mode::Absolute,
            Some("IC") => Mode::Increment,
            Some("DC") => Mode::Shortest,
            Some("ACP") => Mode::Positive,
            Some("ACN") => Mode::Negative,
            Some("QU") => Mode::Modal,
            _ => return Ok((self.reported_number(reader)?, Mode::Modal)),
        };
        let open = reader.here();
        reader.advance();
        reader.require(b'(', "write X=AC(10)")?;
        let value = self.reported_number(reader)?;
        reader.close(open)?;
        Ok((value, mode))
    }

    /// The value of an expression; with `report_blocks` one that is not a plain number is reported.
    fn reported_number(&mut self, reader: &mut Reader<'_>) -> Result<f64, Fault> {
        let (from, signed) = (reader.here(), matches!(reader.symbol(), Some(b'+' | b'-')));
        let first = reader.at;
        let value = self.number(reader)?;
        let plain = reader.at == first + 1 + usize::from(signed);
        let begins = reader.source.get(from + usize::from(signed));
        let is_digit = begins.is_some_and(|b| b.is_ascii_digit() || *b == b'.');
        if !(plain && is_digit) {
            self.core.report_computed(from..reader.here(), Some(value));
        }
        Ok(value)
    }

    /// `A3=`, `I1=`, `S2=`, `M1=`, `X1=`: a letter with a number and `=`.
    fn extended(
        &mut self,
        letter: u8,
        digits: &str,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<(), Fault> {
        let (value, mode) = match letter {
            b'T' => {
                self.core.not_applied("the tool of another spindle", at, "only T is applied");
                self.expression(reader)?;
                return Ok(());
            }
            _ => self.moded_value(reader)?,
        };
        let number: usize = digits.parse().unwrap_or(usize::MAX);
        match (letter, number) {
            (b'A'..=b'C', 2..=7) => {
                self.words.put_vector([number, usize::from(letter - b'A')], value, at);
            }
            (b'I'..=b'K', 1) => {
                if value.abs() > LARGEST {
                    return Err(mistakes::too_large(value, char::from(letter), at));
                }
                self.words.through[usize::from(letter - b'I')] = Some((value, mode));
            }
            (b'S', 1) => self.words.speed = Some(value),
            (b'M', 1) => return self.put(b'M', (value, mode), at),
            (b'S' | b'M', _) => {
                let subject = format!("{}{digits}= for another spindle", char::from(letter));
                self.core.not_applied(&subject, at, "only the main spindle is applied");
            }
            (b'F' | b'G', _) => {
                let subject = format!("{}[{digits}]=", char::from(letter));
                self.core.not_applied(&subject, at, "write the code or the feed itself");
            }
            (b'H', _) => self.words.codes.push((Code::Note("an H function"), at)),
            _ if axis_of(letter).is_some() => {
                let name = format!("{}{digits}", char::from(letter));
                self.words.numbered.push((name, at));
            }
            _ => {
                let name = format!("{}{digits}", char::from(letter));
                return Err(mistakes::unknown_word(name, at));
            }
        }
        Ok(())
    }

    /// A word of one letter.
    fn put(&mut self, letter: u8, value: (f64, Mode), at: usize) -> Result<(), Fault> {
        if let Some(axis) = axis_of(letter) {
            return self.words.put_axis(axis, value, at);
        }
        let number = value.0;
        match letter {
            b'G' if self.core.own_number('G', number, at) => {
                // The axis words of its block are its own.
                self.words.codes.push((Code::Own, at));
            }
            b'M' if self.core.own_number('M', number, at) => {}
            b'G' => {
                let code = code_number(number).and_then(tables::g_code);
                let Some(code) = code else {
                    return Err(mistakes::unknown_g_code(number, at));
                };
                self.words.codes.push((code, at));
            }
            b'M' => {
                let Some(m) = code_number(number) else {
                    let message = format!("unknown M function M{number} for this control");
                    return Err(fault("unknown-m-code", at, message, "write a whole number"));
                };
                self.words.m.push((m, at));
            }
            b'F' => self.words.feed = Some((number, at)),
            b'S' => self.words.speed = Some(number),
            b'T' => self.words.tool = Some((ToolCall::Number(tool_number(number, at)?), at)),
            b'D' => {
                let Some(edge) = code_number(number) else {
                    return Err(mistakes::bad_tool(format_args!("D{number}"), at));
                };
                self.words.edge = Some((edge, at));
            }
            b'I'..=b'K' => {
                if number.is_nan() || number.abs() > LARGEST {
                    return Err(mistakes::too_large(number, char::from(letter), at));
                }
                self.words.centers[usize::from(letter - b'I')] = Some(value);
            }
            b'H' => self.words.codes.push((Code::Note("an H function"), at)),
            b'N' => {}
            _ => {
                let name = char::from(letter);
                return Err(mistakes::unknown_word(name, at));
            }
        }
        Ok(())
    }

    /// A word of several letters: code, address with `=`, variable.
    fn long_word(&mut self, reader: &mut Reader<'_>, at: usize) -> Result<(), Fault> {
        let word = reader.word().unwrap_or_default();
        if self.has_variable(&word) {
            let slot = self.slot(reader)?;
            if !reader.equals_ahead(0) {
                return Err(mistakes::missing_equals(word, "write NAME=2", reader.here()));
            }
            self.assignment(&slot, reader)?;
            self.core.report_computed(at..reader.here(), None);
            return Ok(());
        }
        reader.advance();
        if let Some(name) = tables::parameter(&word) {
            return self.named_word(name, &word, reader, at);
        }
        if word == "AX" {
            reader.require(b'[', "write AX[AXIS1]=10")?;
            let axis = self.axis(reader)?;
            reader.require(b']', "write one ] for each [")?;
            reader.require(b'=', "write AX[AXIS1]=10")?;
            let value = self.moded_value(reader)?;
            return self.words.put_axis(axis, value, at);
        }
        if word == "MSG" {
            let values = self.arguments(reader)?;
            let text = values.first().and_then(Option::as_ref).map(super::functions::message);
            self.core.emit(crate::moves::Event::Message(text.unwrap_or_default()));
            return Ok(());
        }
        if let Some(code) = tables::code(&word) {
            skip_brackets(reader)?;
            self.words.codes.push((code, at));
            return Ok(());
        }
        let is_set = reader.equals_ahead(0) || reader.symbol() == Some(b'[');
        let (message, hint) = if is_set {
            (format!("{word} is neither declared nor known to this control"), "declare it with DEF")
        } else {
            let hint = "check the spelling; call a subprogram in a separate block";
            (format!("unknown word {word} for this control"), hint)
        };
        Err(fault("unknown-word", at, message, hint))
    }

    /// `CR=5`, `POS[X]=10`.
    fn named_word(
        &mut self,
        name: Name,
        word: &str,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<(), Fault> {
        let mut axis = None;
        if reader.accept(b'[') {
            let place = reader.here();
            if name == Name::AxisPlace {
                axis = Some(self.axis(reader)?);
            } else if self.axis_or_other(reader).is_err() {
                return Err(mistakes::unknown_axis(place));
            }
            reader.require(b']', "write one ] for each [")?;
        }
        if !reader.equals_ahead(0) {
            // FZ, MEAS … may stand as switches in other releases.
            return Err(mistakes::missing_equals(word, "write CR=5", reader.here()));
        }
        reader.advance();
        if let Name::NotApplied(subject) = name {
            self.core.not_applied(subject, at, "the following moves are computed without it");
            if reader.symbol() == Some(b'(') {
                return skip_brackets(reader);
            }
        }
        let (value, mode) = self.moded_value(reader)?;
        if let Some(axis) = axis {
            let hint = "the axis moves with the other axes of the block";
            self.core.not_applied("the independent motion of POS axes", at, hint);
            return self.words.put_axis(axis, (value, mode), at);
        }
        if value.is_nan() || value.abs() > LARGEST {
            return Err(mistakes::too_large(value, word, at));
        }
        if !matches!(name, Name::NotApplied(_)) {
            self.words.named.push((name, value, mode, at));
        }
        Ok(())
    }
}

fn tool_number(value: f64, at: usize) -> Result<u32, Fault> {
    if (0.0..1e9).contains(&value) && value.fract() == 0.0 {
        return Ok(value as u32);
    }
    Err(mistakes::bad_tool(format_args!("T{value}"), at))
}

/// A code number, allowing for what arithmetic does to it.
fn code_number(value: f64) -> Option<u32> {
    let near = value.round();
    ((value - near).abs() < 1e-3 && (0.0..1e9).contains(&near)).then_some(near as u32)
}

/// Leaves out `( … )` if it comes next.
fn skip_brackets(reader: &mut Reader<'_>) -> Result<(), Fault> {
    let open = reader.here();
    if reader.symbol() != Some(b'(') {
        return Ok(());
    }
    let mut depth = 0;
    while !reader.is_empty() {
        match reader.symbol() {
            Some(b'(') => depth += 1,
            Some(b')') => depth -= 1,
            _ => {}
        }
        reader.advance();
        if depth == 0 {
            return Ok(());
        }
    }
    Err(mistakes::unclosed_bracket(open))
}

fn foreign(reader: &Reader<'_>) -> Fault {
    let Some(token) = reader.peek() else { return super::expression::missing_value(reader) };
    let end = token.end.min(token.start + 40);
    let text = String::from_utf8_lossy(&reader.source[token.start..end]).into_owned();
    let (code, hint) = match token.kind {
        TokenKind::Symbol if text == ")" || text == "]" => {
            ("unbalanced-brackets", "write one opening bracket for each closing one")
        }
        TokenKind::Number => ("no-address", "write a number after a letter, such as X1"),
        _ => ("unexpected-sign", "write words such as G1 X10"),
    };
    fault(code, token.start, format!("unexpected text `{text}`"), hint)
}
