//! Bytes into tokens; every byte belongs to exactly one of them.

use crate::dialect::{Control, Dialect};

/// What a token is, by its looks alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TokenKind {
    /// Blanks, tabs and whatever else stands between words.
    Space,
    /// The end of a line: `\n`, `\r\n` or `\r`.
    LineEnd,
    /// A comment with its marks; it ends with the line at the latest.
    Comment,
    /// The mark `/`, `/1` … at the beginning of a block that may be skipped.
    Skip,
    /// A tape mark `%`.
    Mark,
    /// One letter: the address of a word, or one letter of a key word.
    Letter,
    /// A key word or name of several letters, in the dialects that have them.
    Word,
    /// An unsigned number.
    Number,
    /// A name in angle brackets.
    Name,
    /// A text in double quotes.
    Text,
    /// One sign such as `[`, `=` or `#`.
    Symbol,
    /// Bytes that no control of this kind reads.
    Unknown,
}

/// A piece of the program: `source[start..end]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// The first byte.
    pub start: usize,
    /// The offset after the last byte.
    pub end: usize,
}

/// Cuts a program into tokens, from any byte on.
///
/// ```
/// use trueaxis_blocks::dialect::{Control, Dialect};
/// use trueaxis_blocks::lexer::{Lexer, TokenKind};
/// let source = b"/G1 X-.5 ; slow";
/// let tokens: Vec<_> = Lexer::new(source, Dialect::of(Control::LinuxCnc), 0).collect();
/// assert_eq!(tokens[0].kind, TokenKind::Skip);
/// assert_eq!(tokens.last().map(|t| t.end), Some(source.len()));
/// ```
#[derive(Debug, Clone)]
pub struct Lexer<'s> {
    source: &'s [u8],
    dialect: &'static Dialect,
    at: usize,
    /// Nothing but blanks so far in this line.
    fresh: bool,
}

impl<'s> Lexer<'s> {
    /// Begins at a byte that begins a line.
    pub fn new(source: &'s [u8], dialect: &'static Dialect, start: usize) -> Self {
        Self { source, dialect, at: start.min(source.len()), fresh: true }
    }

    /// The offset after the last token.
    pub fn offset(&self) -> usize {
        self.at
    }

    fn run(&self, from: usize, belongs: impl Fn(u8) -> bool) -> usize {
        self.source[from..]
            .iter()
            .position(|b| !belongs(*b))
            .map_or(self.source.len(), |n| from + n)
    }

    fn line_end(&self, from: usize) -> usize {
        self.run(from, |b| b != b'\n' && b != b'\r')
    }

    /// The end of a bracket that must close in its line.
    fn closed(&self, from: usize, close: u8) -> usize {
        let end = self.run(from + 1, |b| b != close && b != b'\n' && b != b'\r');
        if self.source.get(end) == Some(&close) { end + 1 } else { end }
    }

    fn number(&self, from: usize) -> usize {
        let whole = self.run(from, |b| b.is_ascii_digit());
        match self.source.get(whole) {
            Some(b'.') => self.run(whole + 1, |b| b.is_ascii_digit()),
            Some(b',') if self.dialect.decimal_comma => self.run(whole + 1, |b| b.is_ascii_digit()),
            _ => whole,
        }
    }

    fn letters(&self, from: usize) -> (TokenKind, usize) {
        let next = self.source.get(from + 1).copied().unwrap_or(0);
        let name = self.source[from] == b'_' || next.is_ascii_alphabetic() || next == b'_';
        if self.dialect.words && name {
            // Klartext writes key words and numbers without a blank: LBL1, IX2.5, FN18.
            let digits = self.dialect.control != Control::Heidenhain;
            let belongs =
                |b: u8| b.is_ascii_alphabetic() || b == b'_' || digits && b.is_ascii_digit();
            return (TokenKind::Word, self.run(from, belongs));
        }
        (TokenKind::Letter, from + 1)
    }

    fn cut(&self, from: usize) -> (TokenKind, usize) {
        let dialect = self.dialect;
        match self.source[from] {
            b' ' | b'\t' | 0x0b | 0x0c => {
                (TokenKind::Space, self.run(from, |b| matches!(b, b' ' | b'\t' | 0x0b | 0x0c)))
            }
            b'\r' if self.source.get(from + 1) == Some(&b'\n') => (TokenKind::LineEnd, from + 2),
            b'\n' | b'\r' => (TokenKind::LineEnd, from + 1),
            b'0'..=b'9' | b'.' => (TokenKind::Number, self.number(from)),
            b'a'..=b'z' | b'A'..=b'Z' => self.letters(from),
            b'_' if dialect.words => self.letters(from),
            b'(' if dialect.paren_comments => (TokenKind::Comment, self.closed(from, b')')),
            b';' if dialect.semicolon_comments => (TokenKind::Comment, self.line_end(from)),
            b'%' if self.fresh && dialect.header_lines => (TokenKind::Comment, self.line_end(from)),
            b'%' => (TokenKind::Mark, from + 1),
            b'/' if self.fresh => {
                // In Klartext the number of the block follows, elsewhere a level.
                let digit = dialect.control != Control::Heidenhain
                    && self.source.get(from + 1).is_some_and(u8::is_ascii_digit);
                (TokenKind::Skip, from + 1 + usize::from(digit))
            }
            b'<' if dialect.angle_names => (TokenKind::Name, self.closed(from, b'>')),
            b'"' if dialect.quoted_texts => (TokenKind::Text, self.closed(from, b'"')),
            b'!'..=b'~' => (TokenKind::Symbol, from + 1),
            _ => (TokenKind::Unknown, self.run(from, is_foreign)),
        }
    }
}

fn is_foreign(byte: u8) -> bool {
    !matches!(byte, b' '..=b'~' | b'\t' | b'\n' | 0x0b | 0x0c | b'\r')
}

impl Iterator for Lexer<'_> {
    type Item = Token;

    #[inline]
    fn next(&mut self) -> Option<Token> {
        let start = self.at;
        if start >= self.source.len() {
            return None;
        }
        let (kind, end) = self.cut(start);
        self.at = end;
        match kind {
            TokenKind::LineEnd => self.fresh = true,
            TokenKind::Space => {}
            _ => self.fresh = false,
        }
        Some(Token { kind, start, end })
    }
}

/// The value of a number token; a decimal comma counts as a point.
///
/// Up to 15 digits the value is exact (both the digits and the power of ten fit in a double, so one
/// division rounds correctly); beyond that the standard library reads it.
pub fn number_value(text: &[u8]) -> Option<f64> {
    const TENS: [f64; 16] =
        [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
    let (mut digits, mut count, mut decimals, mut point) = (0_u64, 0_usize, 0_usize, false);
    if text.len() > 16 {
        return slow_number(text);
    }
    for byte in text {
        match byte {
            b'0'..=b'9' => {
                digits = digits * 10 + u64::from(byte - b'0');
                count += 1;
                decimals += usize::from(point);
            }
            b'.' | b',' if !point => point = true,
            _ => return None,
        }
    }
    match count {
        0 => None,
        1..=15 => Some(digits as f64 / TENS[decimals]),
        _ => slow_number(text),
    }
}

fn slow_number(text: &[u8]) -> Option<f64> {
    // No program means a number of more digits than any double has in full.
    const LONGEST: usize = 800;
    if text.len() > LONGEST {
        return None;
    }
    let text = std::str::from_utf8(text).ok()?.replace(',', ".");
    text.parse().ok().filter(|v: &f64| v.is_finite())
}

/// A number of at most 15 digits that begins here, and where it ends.
#[inline]
pub fn plain_number(source: &[u8], start: usize) -> Option<(f64, usize)> {
    const TENS: [f64; 16] =
        [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
    let mut at = start;
    let negative = source.get(at) == Some(&b'-');
    at += usize::from(negative);
    let first = at;
    let (mut digits, mut point) = (0_u64, None);
    while let Some(byte) = source.get(at) {
        match byte {
            b'0'..=b'9' => digits = digits.wrapping_mul(10).wrapping_add(u64::from(byte - b'0')),
            b'.' if point.is_none() => point = Some(at),
            _ => break,
        }
        at += 1;
    }
    let count = at - first - usize::from(point.is_some());
    if count == 0 || count > 15 {
        return None;
    }
    let decimals = point.map_or(0, |p| at - p - 1);
    // Both fit in a double without loss, so one division rounds correctly.
    let value = digits as f64 / TENS[decimals];
    Some((if negative { -value } else { value }, at))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_touch_each_other() {
        let source = b"N10 G1 X-.5Y2.\r\n(open\n#<a b>=[1]\x80\x81 %";
        let mut end = 0;
        for token in Lexer::new(source, Dialect::of(Control::LinuxCnc), 0) {
            assert_eq!(token.start, end);
            end = token.end;
        }
        assert_eq!(end, source.len());
    }

    #[test]
    fn numbers_are_read_to_the_last_bit() {
        assert_eq!(number_value(b"0.1"), Some(0.1));
        assert_eq!(number_value(b".5"), Some(0.5));
        assert_eq!(number_value(b"2."), Some(2.0));
        assert_eq!(number_value(b"3.14159265358979323846"), Some(std::f64::consts::PI));
        assert_eq!(number_value(b"."), None);
    }
}
