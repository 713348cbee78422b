//! One line into words, assignments and control statements.

mod control;
mod expression;
mod plain;

use crate::dialect::{Control, Dialect};
use crate::lexer::{Lexer, Token, TokenKind};
use crate::program::{Block, Fault, Item, Node, NodeId, is_trivia};

/// Largest depth of nested brackets, functions and parameters (a bracket counts twice): ample for
/// programs, small for the stack.
const DEEPEST: usize = 100;

/// Parts of one block: more than any control takes, little for the memory.
const MOST_ITEMS: usize = 10_000;

/// Takes the line apart that begins at `start`; the room of `block` is used again.
pub(crate) fn parse_block(
    source: &[u8],
    dialect: &'static Dialect,
    start: usize,
    block: &mut Block,
) {
    block.items.clear();
    block.nodes.clear();
    block.faults.clear();
    block.skip = None;
    let mut parser = Parser::new(source, dialect, start, block);
    parser.line();
    let end = parser.end;
    block.span = start..end;
}

struct Parser<'s, 'b> {
    source: &'s [u8],
    dialect: &'static Dialect,
    lexer: Lexer<'s>,
    /// The next token that is neither a blank nor a comment; `None` at the end of the line.
    token: Option<Token>,
    /// The offset after the line end, known once the line is read.
    end: usize,
    /// Where the line end begins, known once the line is read.
    stop: usize,
    block: &'b mut Block,
    depth: usize,
}

impl<'s, 'b> Parser<'s, 'b> {
    fn new(
        source: &'s [u8],
        dialect: &'static Dialect,
        start: usize,
        block: &'b mut Block,
    ) -> Self {
        let lexer = Lexer::new(source, dialect, start);
        let end = source.len();
        let mut parser =
            Self { source, dialect, lexer, token: None, end, stop: end, block, depth: 0 };
        parser.advance();
        parser
    }

    fn advance(&mut self) {
        self.token = loop {
            match self.lexer.next() {
                None => {
                    self.end = self.source.len();
                    break None;
                }
                Some(token) if token.kind == TokenKind::LineEnd => {
                    (self.stop, self.end) = (token.start, token.end);
                    break None;
                }
                Some(token) if is_trivia(token.kind) => {}
                Some(token) if token.kind == TokenKind::Comment => self.comment(token),
                Some(token) => break Some(token),
            }
        };
        if self.token.is_none() {
            // Nothing after the line end belongs to this block.
            self.lexer = Lexer::new(self.source, self.dialect, self.source.len());
        }
    }

    fn comment(&mut self, token: Token) {
        let open = self.source[token.start] == b'(';
        if open && (self.source[token.end - 1] != b')' || token.end - token.start < 2) {
            let message = "the comment is not closed in its line".to_owned();
            self.fault("unclosed-comment", token.start, message, "close it with )");
        }
        if self.block.items.len() <= MOST_ITEMS {
            self.block.items.push(Item::Comment(token.start..token.end));
        }
    }

    /// The byte where the next token begins, or where the line ends.
    fn here(&self) -> usize {
        self.token.map_or(self.stop, |t| t.start)
    }

    fn symbol(&self) -> Option<u8> {
        self.token.filter(|t| t.kind == TokenKind::Symbol).map(|t| self.source[t.start])
    }

    fn letter(&self) -> Option<u8> {
        self.token
            .filter(|t| t.kind == TokenKind::Letter)
            .map(|t| self.source[t.start].to_ascii_uppercase())
    }

    fn accept(&mut self, symbol: u8) -> bool {
        let found = self.symbol() == Some(symbol);
        if found {
            self.advance();
        }
        found
    }

    /// Takes a key word written in single letters, blanks between them or not.
    fn accept_word(&mut self, word: &[u8]) -> bool {
        let mut ahead = self.lexer.clone();
        let mut token = self.token;
        for letter in word {
            let fits = token.is_some_and(|t| {
                t.kind == TokenKind::Letter && self.source[t.start].to_ascii_uppercase() == *letter
            });
            if !fits {
                return false;
            }
            token = ahead.by_ref().find(|t| !is_trivia(t.kind));
        }
        for _ in word {
            self.advance();
        }
        true
    }

    /// A word of custom macros, which two of its letters or more may stand for: WH, GO, SI.
    fn accept_short(&mut self, word: &[u8]) -> bool {
        let shortest = if self.dialect.macro_words { 2 } else { word.len() };
        (shortest.min(word.len())..=word.len()).rev().any(|n| self.accept_word(&word[..n]))
    }

    fn fault(&mut self, code: &'static str, offset: usize, message: String, hint: &'static str) {
        self.block.faults.push(Fault { code, offset, message, hint });
    }

    fn node(&mut self, node: Node) -> NodeId {
        self.block.nodes.push(node);
        (self.block.nodes.len() - 1) as NodeId
    }

    /// Leaves the rest of the line out; its comments stay.
    fn give_up(&mut self) {
        while self.token.is_some() {
            self.advance();
        }
    }

    fn line(&mut self) {
        if let Some(token) = self.token.filter(|t| t.kind == TokenKind::Skip) {
            let digit = self.source[token.end - 1];
            self.block.skip = Some(if digit.is_ascii_digit() { digit - b'0' } else { 1 });
            self.advance();
        }
        if self.dialect.control == Control::Sinumerik840d {
            return self.plain_words();
        }
        if self.dialect.g_codes.is_empty() {
            // Programs of this control are cut into tokens only.
            return self.give_up();
        }
        while let Some(token) = self.token {
            if self.block.items.len() >= MOST_ITEMS {
                let message = format!("more than {MOST_ITEMS} words in one line");
                self.fault(
                    "too-many-words",
                    token.start,
                    message,
                    "check whether the file is an NC program",
                );
                return self.give_up();
            }
            let understood = match token.kind {
                TokenKind::Letter => self.word_or_control(),
                TokenKind::Symbol if self.is_sign_word(token) => {
                    self.word(self.source[token.start], token.start)
                }
                TokenKind::Symbol if self.is_loose_end(token) => {
                    self.block.items.push(Item::LooseEnd(token.start));
                    self.advance();
                    true
                }
                TokenKind::Symbol if self.source[token.start] == b'#' => self.assignment(),
                TokenKind::Symbol if self.source[token.start] == b':' => self.program_number(),
                TokenKind::Symbol if self.is_corner(token) => self.corner_word(),
                TokenKind::Symbol if self.is_optional(token) => self.optional_rest(token),
                TokenKind::Name if self.dialect.macro_words => self.called_name(),
                TokenKind::Mark => {
                    self.block.items.push(Item::Mark(token.start));
                    self.give_up();
                    true
                }
                _ => self.foreign(token),
            };
            if !understood {
                self.give_up();
            }
        }
    }

    /// `,C` and `,R` of FANUC.
    fn is_corner(&self, token: Token) -> bool {
        let next = self.lexer.clone().find(|t| !is_trivia(t.kind));
        let letter = next.map_or(0, |t| self.source[t.start].to_ascii_uppercase());
        self.dialect.macro_words
            && self.source[token.start] == b','
            && matches!(letter, b'C' | b'R')
    }

    /// A word of a corner: its letter is written small, so that it is no axis.
    fn corner_word(&mut self) -> bool {
        self.advance();
        let (letter, offset) = (self.letter().unwrap_or(b'C'), self.here());
        self.advance();
        let Some(value) = self.value() else { return false };
        self.block.items.push(Item::Word { letter: letter.to_ascii_lowercase(), value, offset });
        true
    }

    /// `/` within a block of FANUC, with the number of its switch or not.
    ///
    /// # Source
    /// FANUC Series 16i operator's manual, "Program configuration", optional block skip: where the slash is not at the head
    /// of the block, what stands between it and the end of the block is ignored.
    fn is_optional(&self, token: Token) -> bool {
        self.dialect.control == Control::Fanuc && self.source[token.start] == b'/'
    }

    fn optional_rest(&mut self, token: Token) -> bool {
        self.block.items.push(Item::Optional(token.start));
        self.advance();
        if self.token.is_some_and(|t| t.kind == TokenKind::Number && t.start == token.end) {
            self.advance();
        }
        true
    }

    fn foreign(&mut self, token: Token) -> bool {
        let text =
            String::from_utf8_lossy(&self.source[token.start..token.end.min(token.start + 40)])
                .into_owned();
        let (code, hint) = match token.kind {
            TokenKind::Symbol if text == "]" => ("unbalanced-brackets", "write one [ for each ]"),
            TokenKind::Number => ("no-address", "write a number after a letter, such as X1"),
            _ => ("unexpected-sign", "write words such as G1 X10"),
        };
        self.fault(code, token.start, format!("unexpected text `{text}`"), hint);
        false
    }

    fn is_sign_word(&self, token: Token) -> bool {
        self.dialect.sign_words && b"@^$".contains(&self.source[token.start])
    }

    /// The `)` after a comment in a comment: FANUC ends the comment at its first `)`.
    fn is_loose_end(&self, token: Token) -> bool {
        let comment = |item: &Item| matches!(item, Item::Comment(_) | Item::LooseEnd(_));
        self.dialect.macro_words
            && self.source[token.start] == b')'
            && self.block.items.last().is_some_and(comment)
    }

    fn word_or_control(&mut self) -> bool {
        if let Some(understood) = self.control() {
            return understood;
        }
        let (Some(letter), offset) = (self.letter(), self.here()) else { return false };
        self.word(letter, offset)
    }

    fn word(&mut self, letter: u8, offset: usize) -> bool {
        self.advance();
        let plain = self.token.filter(|t| t.kind == TokenKind::Number);
        let value = match plain {
            Some(number) => self.number(number),
            None => match self.value() {
                Some(value) => value,
                None => return false,
            },
        };
        self.block.items.push(Item::Word { letter, value, offset });
        true
    }

    fn assignment(&mut self) -> bool {
        let offset = self.here();
        let Some(target) = self.value() else { return false };
        if !matches!(self.block.nodes[target as usize], Node::Parameter(_) | Node::Named(_)) {
            let message = "expected a parameter before =".to_owned();
            self.fault("bad-assignment", offset, message, "write #1=2");
            return false;
        }
        if !self.accept(b'=') {
            let message = "expected = after the parameter".to_owned();
            self.fault("missing-equals", self.here(), message, "write #1=2");
            return false;
        }
        let value = if self.dialect.macro_words { self.chain(0) } else { self.value() };
        let Some(value) = value else { return false };
        self.block.items.push(Item::Assign { target, value, offset });
        true
    }
}
