//! The tokens of one line, read one by one.

use crate::lexer::{Lexer, Token, TokenKind, number_value};
use crate::program::{Fault, Program, fault, unclosed_bracket};

/// Tokens of one block: more than any control takes, little for the memory.
const MOST_TOKENS: usize = 10_000;

/// What a line is apart from its tokens.
#[derive(Debug)]
pub struct Line {
    /// The offset after the line end.
    pub end: usize,
    /// Where the last token ends.
    pub stop: usize,
    /// Begins with `/`.
    pub skip: bool,
    /// What is wrong with it, if anything is.
    pub fault: Option<Fault>,
}

/// Collects the tokens of the line that begins at a byte; blanks and comments are left out.
pub fn read_line(program: &Program, start: usize, tokens: &mut Vec<Token>) -> Line {
    tokens.clear();
    let source = program.source();
    let end = source.len();
    let mut line = Line { end, stop: start, skip: false, fault: None };
    for token in Lexer::new(source, program.dialect(), start) {
        match token.kind {
            TokenKind::LineEnd => {
                line.end = token.end;
                break;
            }
            TokenKind::Space | TokenKind::Comment => {}
            TokenKind::Skip => line.skip = true,
            _ if line.fault.is_some() => {}
            TokenKind::Unknown => {
                let text =
                    String::from_utf8_lossy(&source[token.start..token.end.min(token.start + 40)]);
                let message = format!("unexpected text `{text}`");
                let hint = "write words such as G1 X10";
                line.fault = Some(fault("unexpected-sign", token.start, message, hint));
            }
            TokenKind::Text if !is_closed(&source[token.start..token.end]) => {
                let message = "the text is not closed in its line";
                line.fault = Some(fault("unclosed-text", token.start, message, "close it with \""));
            }
            _ if tokens.len() >= MOST_TOKENS => {
                let message = format!("more than {MOST_TOKENS} parts in one line");
                let hint = "check whether the file is an NC program";
                line.fault = Some(fault("too-many-words", token.start, message, hint));
            }
            _ => tokens.push(token),
        }
    }
    line.stop = tokens.last().map_or(start, |t| t.end);
    line
}

fn is_closed(text: &[u8]) -> bool {
    text.len() >= 2 && text.ends_with(b"\"")
}

/// Goes through the tokens of a block.
#[derive(Debug, Clone, Copy)]
pub struct Reader<'t> {
    /// The whole text.
    pub source: &'t [u8],
    tokens: &'t [Token],
    /// The number of the next token.
    pub at: usize,
    stop: usize,
}

impl<'t> Reader<'t> {
    /// Reads tokens of a text up to a place of it.
    pub fn new(source: &'t [u8], tokens: &'t [Token], stop: usize) -> Self {
        Self { source, tokens, at: 0, stop }
    }

    /// The next token.
    pub fn peek(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    /// The token after so many others.
    pub fn ahead(&self, count: usize) -> Option<Token> {
        self.tokens.get(self.at + count).copied()
    }

    /// Goes on by one token.
    pub fn advance(&mut self) {
        self.at += 1;
    }

    /// Whether nothing follows.
    pub fn is_empty(&self) -> bool {
        self.at >= self.tokens.len()
    }

    /// The byte where the next token begins, or where the line ends.
    pub fn here(&self) -> usize {
        self.peek().map_or(self.stop, |t| t.start)
    }

    /// The bytes of a token.
    pub fn text(&self, token: Token) -> &'t [u8] {
        &self.source[token.start..token.end]
    }

    fn symbol_of(&self, token: Option<Token>) -> Option<u8> {
        token.filter(|t| t.kind == TokenKind::Symbol).map(|t| self.source[t.start])
    }

    /// The next sign, if a sign follows.
    pub fn symbol(&self) -> Option<u8> {
        self.symbol_of(self.peek())
    }

    /// The sign after so many tokens, if there is one.
    pub fn symbol_ahead(&self, count: usize) -> Option<u8> {
        self.symbol_of(self.ahead(count))
    }

    /// Two signs without anything between them.
    pub fn pair(&self, count: usize) -> Option<[u8; 2]> {
        let (first, second) = (self.ahead(count)?, self.ahead(count + 1)?);
        let signs = [self.symbol_of(Some(first))?, self.symbol_of(Some(second))?];
        (first.end == second.start).then_some(signs)
    }

    /// Takes a sign if it follows.
    pub fn accept(&mut self, symbol: u8) -> bool {
        let found = self.symbol() == Some(symbol);
        self.at += usize::from(found);
        found
    }

    /// Whether an `=` of an assignment stands `count` tokens ahead.
    pub fn equals_ahead(&self, count: usize) -> bool {
        self.symbol_ahead(count) == Some(b'=') && self.pair(count) != Some(*b"==")
    }

    /// One letter, upper case.
    pub fn letter(&self) -> Option<u8> {
        self.letter_ahead(0)
    }

    /// The letter after so many tokens, if there is one.
    pub fn letter_ahead(&self, count: usize) -> Option<u8> {
        let token = self.ahead(count).filter(|t| t.kind == TokenKind::Letter)?;
        Some(self.source[token.start].to_ascii_uppercase())
    }

    /// A key word or name of several letters, upper case.
    pub fn word(&self) -> Option<String> {
        self.word_ahead(0)
    }

    /// The word after so many tokens, in capital letters, if there is one.
    pub fn word_ahead(&self, count: usize) -> Option<String> {
        let token = self.ahead(count).filter(|t| t.kind == TokenKind::Word)?;
        Some(String::from_utf8_lossy(self.text(token)).to_ascii_uppercase())
    }

    /// A name: several letters, or a letter with the number that touches it; with its length in
    /// tokens.
    pub fn name(&self) -> Option<(String, usize)> {
        if let Some(word) = self.word() {
            return Some((word, 1));
        }
        let letter = self.peek().filter(|t| t.kind == TokenKind::Letter)?;
        let mut name = String::from_utf8_lossy(self.text(letter)).to_ascii_uppercase();
        let number = self.ahead(1).filter(|t| t.kind == TokenKind::Number && t.start == letter.end);
        let Some(number) = number else { return Some((name, 1)) };
        name.push_str(&String::from_utf8_lossy(self.text(number)));
        Some((name, 2))
    }

    /// Takes a word if it follows.
    pub fn accept_word(&mut self, word: &str) -> bool {
        let token = self.peek().filter(|t| t.kind == TokenKind::Word);
        let found = token.is_some_and(|t| self.text(t).eq_ignore_ascii_case(word.as_bytes()));
        self.at += usize::from(found);
        found
    }

    /// The number after so many tokens, if there is one.
    pub fn number_ahead(&self, count: usize) -> Option<Token> {
        self.ahead(count).filter(|t| t.kind == TokenKind::Number)
    }

    /// A plain number, with `EX` and its exponent.
    pub fn number(&mut self) -> Option<Result<f64, Fault>> {
        let token = self.number_ahead(0)?;
        self.advance();
        let bad = |at| fault("bad-number", at, "expected a number", "write a number such as 1.5");
        let Some(value) = number_value(self.text(token)) else {
            return Some(Err(bad(token.start)));
        };
        let touching = self.peek().filter(|t| t.start == token.end && t.kind == TokenKind::Word);
        let Some(exponent) = touching else { return Some(Ok(value)) };
        let text = self.text(exponent);
        if !text[..text.len().min(2)].eq_ignore_ascii_case(b"EX") {
            return Some(Ok(value));
        }
        let digits = &text[2..];
        let mut power = if digits.is_empty() { None } else { whole(digits) };
        if digits.is_empty() {
            let negative = self.symbol_ahead(1) == Some(b'-');
            let signed = negative || self.symbol_ahead(1) == Some(b'+');
            let at = 1 + usize::from(signed);
            power = self.number_ahead(at).and_then(|t| whole(self.text(t)));
            power = power.map(|p| if negative { -p } else { p });
            self.at += at;
        }
        self.advance();
        let scaled = power.map(|p| value * 10_f64.powi(p)).filter(|v| v.is_finite());
        Some(scaled.ok_or_else(|| bad(exponent.start)))
    }

    /// A text without its quotes.
    pub fn quoted(&mut self) -> Option<String> {
        let token = self.peek().filter(|t| t.kind == TokenKind::Text)?;
        self.advance();
        let text = self.text(token);
        Some(String::from_utf8_lossy(&text[1..text.len() - 1]).into_owned())
    }

    /// Takes the bracket that closes the one at `open`.
    pub fn close(&mut self, open: usize) -> Result<(), Fault> {
        if self.accept(b')') { Ok(()) } else { Err(unclosed_bracket(open)) }
    }

    /// Takes a sign that must be there.
    pub fn require(&mut self, symbol: u8, hint: &'static str) -> Result<(), Fault> {
        if self.accept(symbol) {
            return Ok(());
        }
        let sign = char::from(symbol);
        let code =
            if matches!(symbol, b')' | b']') { "unbalanced-brackets" } else { "missing-sign" };
        Err(fault(code, self.here(), format!("expected `{sign}`"), hint))
    }

    /// Whether one of the words GOTO, GOTOF … follows in the line.
    pub fn jumps_later(&self) -> bool {
        self.tokens[self.at.min(self.tokens.len())..].iter().any(|t| {
            t.kind == TokenKind::Word && {
                let text = self.text(*t);
                text.len() >= 4 && text[..4].eq_ignore_ascii_case(b"GOTO")
            }
        })
    }
}

fn whole(digits: &[u8]) -> Option<i32> {
    std::str::from_utf8(digits).ok()?.parse().ok().filter(|v: &i32| (0..400).contains(v))
}
