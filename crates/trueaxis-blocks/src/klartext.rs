//! One block of Klartext: its line, or several of them joined by `~`, as words and numbers.

use crate::dialect::Dialect;
use crate::lexer::{Lexer, Token, TokenKind, number_value};
use crate::program::{Fault, fault, is_trivia, unclosed_bracket};
use trueaxis_moves::Axis;

/// Words of one block: more than any control takes, little for the memory.
const MOST_TOKENS: usize = 10_000;

/// A block without its number, comments and blanks.
#[derive(Debug, Clone, Default)]
pub struct Line {
    /// Its words, numbers and signs.
    pub tokens: Vec<Token>,
    /// The first byte.
    pub start: usize,
    /// The offset after the last byte, with the line end.
    pub end: usize,
    /// How many lines of the text it has.
    pub lines: u32,
    /// Begins with `/`.
    pub skip: bool,
    /// More words than a block may have.
    pub too_long: bool,
}

impl Line {
    /// Reads the block that begins at a byte; the room is used again.
    pub fn read(&mut self, source: &[u8], dialect: &'static Dialect, start: usize) {
        self.tokens.clear();
        (self.start, self.end, self.lines) = (start, start, 0);
        (self.skip, self.too_long) = (false, false);
        let mut silent = false;
        loop {
            let from = self.end;
            silent = self.physical(source, dialect, silent);
            self.lines += 1;
            let continued = self.end < source.len()
                && ends_with_tilde(&source[from..self.end])
                && (silent || !self.tokens.is_empty());
            if !continued {
                break;
            }
            let tilde = self.tokens.last().is_some_and(|t| source[t.start] == b'~');
            if tilde {
                self.tokens.pop();
            }
        }
    }

    /// One line of the text; `silent` inside a structure item, which is a comment.
    fn physical(&mut self, source: &[u8], dialect: &'static Dialect, mut silent: bool) -> bool {
        let mut numbered = self.lines > 0;
        let mut lexer = Lexer::new(source, dialect, self.end);
        self.end = source.len();
        let (mut comment, mut torn) = (false, false);
        for token in lexer.by_ref() {
            match token.kind {
                TokenKind::LineEnd => {
                    if comment && is_torn(source, token) {
                        torn = true;
                        self.lines += 1;
                        continue;
                    }
                    self.end = token.end;
                    break;
                }
                TokenKind::Comment => {
                    comment = true;
                    continue;
                }
                kind if is_trivia(kind) || silent || torn => continue,
                _ => {}
            }
            let first = source[token.start];
            if self.tokens.is_empty() && self.lines == 0 {
                if first == b'/' {
                    self.skip = true;
                    continue;
                }
                if !numbered && token.kind == TokenKind::Number {
                    numbered = true;
                    continue;
                }
                if first == b'*' {
                    silent = true;
                    continue;
                }
            }
            if self.tokens.len() >= MOST_TOKENS {
                self.too_long = true;
                continue;
            }
            self.tokens.push(token);
        }
        silent
    }
}

/// Whether a carriage return stands within a comment of a text whose lines end with a line feed:
/// postprocessors copy such comments from the names of tools.
fn is_torn(source: &[u8], line_end: Token) -> bool {
    let after = &source[line_end.end..];
    let next = after.iter().position(|b| matches!(b, b'\r' | b'\n'));
    source[line_end.start..line_end.end] == *b"\r"
        && next.is_some_and(|i| after[i] == b'\n' || after.get(i + 1) == Some(&b'\n'))
}

fn ends_with_tilde(line: &[u8]) -> bool {
    line.trim_ascii_end().last() == Some(&b'~')
}

/// Walks through the words of a block.
#[derive(Debug, Clone)]
pub struct Cursor<'s> {
    source: &'s [u8],
    tokens: &'s [Token],
    at: usize,
    /// Letters of the present word that were taken already.
    taken: usize,
    /// Where the first word of the block stands.
    pub start: usize,
    /// Formulas within formulas.
    pub depth: usize,
}

impl<'s> Cursor<'s> {
    /// The words of a block.
    pub fn new(source: &'s [u8], line: &'s Line) -> Self {
        let start = line.tokens.first().map_or(line.start, |t| t.start);
        Self { source, tokens: &line.tokens, at: 0, taken: 0, start, depth: 0 }
    }

    #[inline]
    fn token(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    /// Whether nothing follows.
    #[inline]
    pub fn done(&self) -> bool {
        self.at >= self.tokens.len()
    }

    #[inline]
    fn advance(&mut self) {
        self.at += 1;
        self.taken = 0;
    }

    /// The byte of the next word, or the offset after the last one.
    #[inline]
    pub fn offset(&self) -> usize {
        match self.token() {
            Some(token) => token.start + self.taken,
            None => self.tokens.last().map_or(self.start, |t| t.end),
        }
    }

    /// After the last word that was taken.
    pub fn taken_to(&self) -> usize {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        if self.taken > 0 { self.offset() } else { before.map_or(self.start, |t| t.end) }
    }

    /// Whether a name, as that of a parameter, has been taken since a byte.
    pub fn names_since(&self, at: usize) -> bool {
        self.source[at..self.taken_to().max(at)].iter().any(u8::is_ascii_alphabetic)
    }

    /// The letters that stand here.
    #[inline]
    pub fn letters(&self) -> &'s [u8] {
        match self.token() {
            Some(t) if matches!(t.kind, TokenKind::Letter | TokenKind::Word) => {
                &self.source[t.start + self.taken..t.end]
            }
            _ => &[],
        }
    }

    /// Takes the letter of an axis that stands alone.
    #[inline]
    pub fn axis_letter(&mut self) -> Option<Axis> {
        let [letter] = self.letters() else { return None };
        let axis = match letter.to_ascii_uppercase() {
            b'X' => Axis::X,
            b'Y' => Axis::Y,
            b'Z' => Axis::Z,
            b'A' => Axis::A,
            b'B' => Axis::B,
            b'C' => Axis::C,
            b'U' => Axis::U,
            b'V' => Axis::V,
            b'W' => Axis::W,
            _ => return None,
        };
        self.advance();
        Some(axis)
    }

    /// Takes some of the letters that stand here.
    #[inline]
    pub fn take_letters(&mut self, count: usize) {
        if count >= self.letters().len() {
            self.advance();
        } else {
            self.taken += count;
        }
    }

    /// Whether the next word is this one.
    #[inline]
    pub fn is(&self, word: &str) -> bool {
        self.letters().eq_ignore_ascii_case(word.as_bytes())
    }

    /// A statement of labels, calls and calculations: nothing that a flat program needs.
    pub fn steers(&self) -> bool {
        ["LBL", "CALL", "SEL", "FN", "DECLARE"].iter().any(|word| self.is(word))
    }

    /// Takes a whole key word.
    #[inline]
    pub fn accept(&mut self, word: &str) -> bool {
        let found = self.is(word);
        if found {
            self.advance();
        }
        found
    }

    /// Takes the first of some key words and tells which.
    pub fn accept_any(&mut self, words: &[&str]) -> Option<usize> {
        words.iter().position(|w| self.accept(w))
    }

    /// The next sign, if a sign follows.
    #[inline]
    pub fn symbol(&self) -> Option<u8> {
        let sign =
            |t: &Token| matches!(t.kind, TokenKind::Symbol | TokenKind::Mark | TokenKind::Skip);
        self.token().filter(sign).map(|t| self.source[t.start])
    }

    /// Takes a sign if it follows.
    #[inline]
    pub fn accept_symbol(&mut self, symbol: u8) -> bool {
        let found = self.symbol() == Some(symbol);
        if found {
            self.advance();
        }
        found
    }

    /// Takes the bracket that closes the one at `open`.
    pub fn close(&mut self, open: usize) -> Result<(), Fault> {
        if self.accept_symbol(b')') { Ok(()) } else { Err(unclosed_bracket(open)) }
    }

    /// Whether a number follows.
    #[inline]
    pub fn is_number(&self) -> bool {
        self.token().is_some_and(|t| t.kind == TokenKind::Number)
    }

    /// Takes a point that stands alone, as in `V.ZEIT`.
    pub fn accept_point(&mut self) -> bool {
        let found = self.token().is_some_and(|t| self.source[t.start..t.end] == *b".");
        if found {
            self.advance();
        }
        found
    }

    /// An unsigned number.
    #[inline]
    pub fn number(&mut self) -> Result<Option<f64>, Fault> {
        let Some(token) = self.token().filter(|t| t.kind == TokenKind::Number) else {
            return Ok(None);
        };
        let Some(value) = number_value(&self.source[token.start..token.end]) else {
            let message = "expected a number";
            return Err(fault("bad-number", token.start, message, "write digits, such as 1.5"));
        };
        self.advance();
        Ok(Some(value))
    }

    /// A whole number such as that of a label or cycle.
    pub fn whole(&mut self) -> Result<Option<u32>, Fault> {
        let at = self.offset();
        match self.number()? {
            None => Ok(None),
            Some(n) if n.fract() == 0.0 && n < 1e9 => Ok(Some(n as u32)),
            Some(n) => {
                let message = format!("expected a whole number, found {n}");
                Err(fault("bad-number", at, message, "write a whole number"))
            }
        }
    }

    /// A text in quotes, without them.
    pub fn text(&mut self) -> Option<String> {
        let token = self.token().filter(|t| t.kind == TokenKind::Text)?;
        let bytes = &self.source[token.start + 1..token.end];
        self.advance();
        let bytes = bytes.strip_suffix(b"\"").unwrap_or(bytes);
        Some(String::from_utf8_lossy(bytes).into_owned())
    }

    /// The rest of the block as it is written: names of programs.
    pub fn rest(&mut self) -> String {
        let from = self.offset();
        let to = self.tokens.last().map_or(from, |t| t.end).max(from);
        self.at = self.tokens.len();
        String::from_utf8_lossy(&self.source[from..to]).trim().to_owned()
    }

    /// Leaves one word out.
    pub fn skip(&mut self) {
        self.advance();
    }

    /// Leaves the rest of the block out.
    pub fn leave(&mut self) {
        self.at = self.tokens.len();
    }

    /// What stands here, for messages.
    pub fn shown(&self) -> String {
        match self.token() {
            Some(t) => {
                let end = t.end.min(t.start + self.taken + 40);
                String::from_utf8_lossy(&self.source[t.start + self.taken..end]).into_owned()
            }
            None => "the end of the block".to_owned(),
        }
    }

    /// Nothing may remain unread.
    pub fn finish(&self) -> Result<(), Fault> {
        if self.done() { Ok(()) } else { Err(self.unknown()) }
    }

    /// What stands here is not understood.
    pub fn unknown(&self) -> Fault {
        let message = format!("unexpected text `{}`", self.shown());
        let code = match self.token().map(|t| t.kind) {
            Some(TokenKind::Letter | TokenKind::Word) => "unknown-word",
            _ => "unexpected-sign",
        };
        fault(code, self.offset(), message, "check the spelling and the order of the words")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialect::Control;

    fn shown(source: &[u8]) -> (Vec<String>, u32) {
        let mut line = Line::default();
        line.read(source, Dialect::of(Control::Heidenhain), 0);
        let text = |t: &Token| String::from_utf8_lossy(&source[t.start..t.end]).into_owned();
        (line.tokens.iter().map(text).collect(), line.lines)
    }

    #[test]
    fn a_tilde_joins_lines_even_behind_a_comment() {
        let (words, lines) =
            shown(b"5 CYCL DEF 200 DRILLING ~\n  Q200=2 ;clear ~\n  Q201=-9\nL X1\n");
        assert_eq!(words[..4], ["CYCL", "DEF", "200", "DRILLING"]);
        assert_eq!((words.len(), lines), (13, 3));
    }

    #[test]
    fn numbers_of_blocks_and_structure_are_no_words() {
        assert_eq!(shown(b"12 LBL1\n").0, ["LBL", "1"]);
        assert_eq!(shown(b"3 * - Roughing X1\n").0, Vec::<String>::new());
        assert_eq!(shown(b"; only ~\nL X1\n").1, 1);
        assert_eq!(shown(b"L X1 ;a\rL X2\rL X3").0.len(), 3);
        assert_eq!(shown(b"L X1 ;a\r still the comment\nL X2").0.len(), 3);
        assert_eq!(shown(b"L X1 ;a\r still the comment\r\nL X2").1, 2);
    }
}
