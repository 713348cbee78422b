//! The words of one block: where their values stand in the text.

use super::number::Unit;
use std::ops::Range;
use trueaxis_nc::Control;
use trueaxis_nc::dialect::Dialect;
use trueaxis_nc::lexer::{Lexer, Token, TokenKind, number_value};
use trueaxis_nc::moves::Axis;

/// A word with a value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Word {
    /// The whole word.
    pub all: Range<usize>,
    /// Sign and number, inside of AC( ) and the like.
    pub number: Range<usize>,
    /// What the number says; `None` for expressions and variables.
    pub value: Option<f64>,
    /// It counts from the present place whatever G90 and G91 say.
    pub increment: Option<bool>,
    /// `number` is an expression, and `value` what it comes to where the program is executed.
    pub computed: bool,
}

impl Word {
    /// Whether it counts from the present place, where G91 is on or not.
    pub fn is_increment(&self, incremental: bool) -> bool {
        self.increment.unwrap_or(incremental)
    }
}

/// The words of a block that a correction has to do with.
#[derive(Debug, Clone, Default)]
pub(super) struct Words {
    /// X … W.
    pub axes: [Option<Word>; 9],
    /// The tool axis: A3 B3 C3, I J K, TX TY TZ.
    pub vector: [Option<Word>; 3],
    /// F with its value.
    pub feed: Option<Word>,
    /// G0 … G3, or the first word of a Klartext block.
    pub motion: Option<Range<usize>>,
    /// It is a circle.
    pub circle: bool,
    /// Centre, radius, sense and turns of a circle.
    pub circle_words: Vec<Range<usize>>,
    /// M functions that act when the block has been travelled.
    pub at_end: Vec<Range<usize>>,
    /// Machine coordinates for this block alone: G53, SUPA, M91.
    pub machine: Option<Range<usize>>,
    /// By way of a place to a reference point, or back: G27 to G30, G74, G75.
    pub reference: bool,
    /// Back along the tool axis: MB of M140 and of PLANE.
    pub retracts: bool,
    /// What switches increments: `Some(true)` for G91.
    pub incremental: Option<bool>,
    /// What switches the unit of lengths: G20, G70, BEGIN PGM … INCH.
    pub unit: Option<Unit>,
    /// F counts in that unit, too.
    pub feed_unit: Option<Unit>,
    /// `/`, with its number.
    pub skip: Option<Range<usize>>,
    /// After number and `/` of the block.
    pub front: usize,
    /// After the last word.
    pub end: usize,
    /// After the last word of an axis or of the tool axis.
    pub behind_axes: Option<usize>,
    /// Goes on in the next line.
    pub torn: bool,
}

impl Words {
    /// Whether the block leads an axis by a way from where it stands, not to a place.
    pub fn is_increment(&self, axis: Axis, incremental: bool) -> bool {
        let word = self.axes[axis as usize].as_ref();
        word.map_or(self.retracts, |word| word.is_increment(incremental))
    }

    /// Where further axis words go.
    pub fn room(&self, control: Control) -> usize {
        let klartext = (control == Control::Heidenhain).then_some(self.motion.as_ref());
        let first = klartext.flatten().map(|m| m.end);
        self.behind_axes.or(first).unwrap_or(self.end)
    }

    /// Lengths in mm.
    pub fn scale(&mut self, unit: Unit) {
        for axis in Axis::ALL.into_iter().filter(|axis| !axis.is_rotary()) {
            if let Some(word) = &mut self.axes[axis as usize] {
                word.value = word.value.map(|value| value * unit.mm());
            }
        }
    }

    /// Reads the block between two bytes.
    pub fn read(source: &[u8], dialect: &'static Dialect, line: Range<usize>) -> Self {
        Self::read_with(source, dialect, line, &mut Vec::new())
    }

    /// The same with room for its tokens that is used again.
    pub fn read_with(
        source: &[u8],
        dialect: &'static Dialect,
        line: Range<usize>,
        tokens: &mut Vec<Token>,
    ) -> Self {
        tokens.clear();
        tokens.extend(
            Lexer::new(source, dialect, line.start)
                .take_while(|t| t.start < line.end && t.kind != TokenKind::LineEnd)
                .filter(|t| !matches!(t.kind, TokenKind::Space | TokenKind::Comment)),
        );
        let words = Self { front: line.start, end: line.start, ..Self::default() };
        let mut scan = Scan { source, control: dialect.control, tokens, at: 0, words };
        scan.all();
        scan.words
    }
}

/// Operators that are words.
const OPERATORS: [&str; 6] = ["DIV", "MOD", "AND", "OR", "XOR", "EX"];

struct Scan<'s> {
    source: &'s [u8],
    control: Control,
    tokens: &'s [Token],
    at: usize,
    words: Words,
}

impl Scan<'_> {
    fn token(&self, ahead: usize) -> Option<Token> {
        self.tokens.get(self.at + ahead).copied()
    }

    fn upper(&self, token: Token) -> String {
        String::from_utf8_lossy(&self.source[token.start..token.end]).to_ascii_uppercase()
    }

    fn is(&self, ahead: usize, symbol: u8) -> bool {
        self.token(ahead).is_some_and(|t| self.source[t.start] == symbol && t.end == t.start + 1)
    }

    fn all(&mut self) {
        self.beginning();
        while let Some(token) = self.token(0) {
            let before = self.at;
            match token.kind {
                TokenKind::Letter => self.letter(token),
                TokenKind::Word => self.long(token),
                TokenKind::Symbol if self.source[token.start] == b'~' => self.words.torn = true,
                _ => {}
            }
            if self.at == before {
                self.at += 1;
            }
            self.words.end = self.tokens[self.at - 1].end;
        }
    }

    /// `/` and the number of the block.
    fn beginning(&mut self) {
        while let Some(token) = self.token(0) {
            match token.kind {
                TokenKind::Skip => self.words.skip = Some(token.start..token.end),
                TokenKind::Number if self.control == Control::Heidenhain => {}
                TokenKind::Letter if self.source[token.start].eq_ignore_ascii_case(&b'N') => {
                    self.at += 1;
                }
                _ => return,
            }
            self.at += 1;
            self.words.front = self.tokens[(self.at - 1).min(self.tokens.len() - 1)].end;
            self.words.end = self.words.front;
        }
    }

    /// Sign and number from here, and whether nothing computes with it.
    fn number(&mut self) -> (Range<usize>, Option<f64>) {
        let start = self.token(0).map_or(self.words.end, |t| t.start);
        let mut negative = false;
        while self.is(0, b'-') || self.is(0, b'+') {
            negative ^= self.is(0, b'-');
            self.at += 1;
        }
        let Some(token) = self.token(0).filter(|t| t.kind == TokenKind::Number) else {
            return (start..start, None);
        };
        self.at += 1;
        let value = number_value(&self.source[token.start..token.end]);
        (start..token.end, value.map(|v| if negative { -v } else { v }))
    }

    /// An expression: to its end, as far as brackets and operators go.
    fn skip_expression(&mut self) {
        let mut depth = 0_i32;
        while let Some(token) = self.token(0) {
            let byte = self.source[token.start];
            // The bracket of AC( ) is not its own.
            let closes = depth == 0 && matches!(byte, b')' | b']');
            if closes || depth == 0 && !self.goes_on(token) {
                return;
            }
            depth +=
                i32::from(matches!(byte, b'(' | b'[')) - i32::from(matches!(byte, b')' | b']'));
            self.at += 1;
        }
    }

    /// Whether a token outside of brackets belongs to the expression before it.
    fn goes_on(&self, token: Token) -> bool {
        let byte = self.source[token.start];
        let operator = |token: Token| match token.kind {
            TokenKind::Symbol => !matches!(self.source[token.start], b'~' | b'$' | b','),
            TokenKind::Word => OPERATORS.contains(&self.upper(token).as_str()),
            _ => false,
        };
        let function = token.kind == TokenKind::Word && (self.is(1, b'[') || self.is(1, b'('));
        let Some(last) = self.at.checked_sub(1).map(|at| self.tokens[at]) else { return false };
        // R1, Q1.
        let number = token.kind == TokenKind::Number
            && last.end == token.start
            && matches!(last.kind, TokenKind::Letter | TokenKind::Word);
        let open = operator(last) && !matches!(self.source[last.start], b']' | b')');
        operator(token) && byte != b'=' || function || number || open
    }

    /// The value of a word whose letters end before the present token.
    fn value(&mut self, from: usize) -> Word {
        let equals = self.is(0, b'=');
        self.at += usize::from(equals);
        let mut increment = None;
        let mut bracket = false;
        if let Some(token) = self.token(0).filter(|t| equals && t.kind == TokenKind::Word) {
            let mode = self.upper(token);
            if ["AC", "IC", "DC", "ACP", "ACN"].contains(&mode.as_str()) && self.is(1, b'(') {
                increment = Some(mode == "IC");
                bracket = true;
                self.at += 2;
            }
        }
        let (number, mut value) = self.number();
        let computes = |s: &Self| match s.token(0) {
            Some(t) if t.kind == TokenKind::Symbol => !matches!(s.source[t.start], b'~' | b'$'),
            Some(t) if t.kind == TokenKind::Word && equals => {
                OPERATORS.contains(&s.upper(t).as_str())
            }
            _ => false,
        };
        if bracket {
            if self.is(0, b')') {
                self.at += 1;
            } else {
                value = None;
            }
        } else if value.is_none() || computes(self) {
            value = None;
        }
        if value.is_none() {
            self.skip_expression();
            self.at += usize::from(bracket && self.is(0, b')'));
        }
        let end = self.tokens[..self.at].last().map_or(from, |t| t.end);
        Word { all: from..end, number, value, increment, computed: false }
    }

    fn letter(&mut self, token: Token) {
        let letter = self.source[token.start].to_ascii_uppercase();
        let numbered =
            self.token(1).filter(|t| t.kind == TokenKind::Number && t.start == token.end);
        if let Some(number) = numbered.filter(|_| self.is(2, b'=')) {
            return self.numbered(letter, token, number);
        }
        if self.control == Control::Heidenhain && !self.has_value(1) {
            // C X+10 Y+0 DR+: a circle; L and others are the kind of block.
            self.at += 1;
            let mut name = [0; 4];
            return self.kind_of_block(char::from(letter).encode_utf8(&mut name), token);
        }
        self.at += 1;
        let word = self.value(token.start);
        let axis = Axis::ALL.into_iter().find(|a| a.letter() == letter);
        match letter {
            _ if axis.is_some() => self.put_axis(axis.map_or(0, |a| a as usize), word),
            b'F' => self.words.feed = Some(word),
            b'G' => self.g_code(&word),
            b'M' => self.m_code(&word),
            b'I' | b'J' | b'K' => {
                self.words.circle_words.push(word.all.clone());
                self.words.vector[usize::from(letter - b'I')] = Some(word);
            }
            b'R' | b'P' => self.words.circle_words.push(word.all),
            _ => {}
        }
    }

    fn has_value(&self, ahead: usize) -> bool {
        let sign = self.is(ahead, b'-') || self.is(ahead, b'+') || self.is(ahead, b'=');
        sign || self
            .token(ahead)
            .is_some_and(|t| t.kind == TokenKind::Number || self.upper(t).starts_with('Q'))
    }

    fn put_axis(&mut self, index: usize, word: Word) {
        self.words.behind_axes = Some(word.all.end);
        self.words.axes[index] = Some(word);
    }

    fn put_vector(&mut self, index: usize, word: Word) {
        self.words.behind_axes = Some(word.all.end);
        self.words.vector[index] = Some(word);
    }

    /// A3=, I1=, X1=.
    fn numbered(&mut self, letter: u8, token: Token, number: Token) {
        self.at += 2;
        let word = self.value(token.start);
        match (letter, &self.source[number.start..number.end]) {
            (b'A'..=b'C', b"3") => self.put_vector(usize::from(letter - b'A'), word),
            (b'I'..=b'K', b"1") => self.words.circle_words.push(word.all),
            _ => {}
        }
    }

    fn g_code(&mut self, word: &Word) {
        let Some(code) = word.value else { return };
        match code {
            0.0..=3.0 if code.fract() == 0.0 => {
                self.words.motion = Some(word.all.clone());
                self.words.circle = code >= 2.0;
            }
            27.0..=30.0 if self.control != Control::Sinumerik840d => self.words.reference = true,
            74.0 | 75.0 if self.control == Control::Sinumerik840d => self.words.reference = true,
            53.0 | 153.0 => self.words.machine = Some(word.all.clone()),
            20.0 | 21.0 if self.control != Control::Sinumerik840d => {
                let unit = if code == 20.0 { Unit::Inch } else { Unit::Millimetre };
                (self.words.unit, self.words.feed_unit) = (Some(unit), Some(unit));
            }
            70.0 | 71.0 | 700.0 | 710.0 if self.control == Control::Sinumerik840d => {
                let inch = code == 70.0 || code == 700.0;
                self.words.unit = Some(if inch { Unit::Inch } else { Unit::Millimetre });
                if code >= 700.0 {
                    self.words.feed_unit = self.words.unit;
                }
            }
            90.0 => self.words.incremental = Some(false),
            91.0 => self.words.incremental = Some(true),
            _ => {}
        }
    }

    fn m_code(&mut self, word: &Word) {
        let Some(code) = word.value else { return };
        if code == 91.0 && self.control == Control::Heidenhain {
            self.words.machine = Some(word.all.clone());
        } else if [0.0, 1.0, 2.0, 5.0, 9.0, 17.0, 30.0, 60.0].contains(&code) {
            self.words.at_end.push(word.all.clone());
        }
    }

    /// A word of several letters.
    fn long(&mut self, token: Token) {
        let name = self.upper(token);
        self.at += 1;
        if self.control == Control::Heidenhain {
            return self.klartext(&name, token);
        }
        match name.as_str() {
            "CR" | "AR" | "TURN" if self.is(0, b'=') => {
                let word = self.value(token.start);
                self.words.circle_words.push(word.all);
            }
            "CIP" | "CT" => {
                self.words.motion = Some(token.start..token.end);
                self.words.circle = true;
            }
            "SUPA" => self.words.machine = Some(token.start..token.end),
            _ if self.is(0, b'=') => {
                self.value(token.start);
            }
            _ => {}
        }
    }

    fn klartext(&mut self, name: &str, token: Token) {
        let letters = name.as_bytes();
        let axis = |letter: u8| Axis::ALL.into_iter().position(|a| a.letter() == letter);
        match letters {
            // BEGIN PGM NAME MM, or INCH: the last word counts.
            b"MM" | b"INCH" => {
                let unit = if letters == b"MM" { Unit::Millimetre } else { Unit::Inch };
                (self.words.unit, self.words.feed_unit) = (Some(unit), Some(unit));
            }
            [b'I', letter] if axis(*letter).is_some() && self.has_value(0) => {
                let word = self.value(token.start);
                let word = Word { increment: Some(true), ..word };
                self.put_axis(axis(*letter).unwrap_or(0), word);
            }
            [b'T', letter @ b'X'..=b'Z'] if self.has_value(0) => {
                let word = self.value(token.start);
                self.put_vector(usize::from(letter - b'X'), word);
            }
            b"MB" => self.words.retracts = true,
            b"DR" => {
                self.at += usize::from(self.is(0, b'+') || self.is(0, b'-'));
                let end = self.tokens[self.at - 1].end;
                self.words.circle_words.push(token.start..end);
            }
            _ => self.kind_of_block(name, token),
        }
    }

    /// The first word of a Klartext block.
    fn kind_of_block(&mut self, name: &str, token: Token) {
        if self.words.motion.is_none() && self.words.behind_axes.is_none() {
            self.words.motion = Some(token.start..token.end);
            self.words.circle = ["C", "CR", "CT"].contains(&name);
        }
    }
}
