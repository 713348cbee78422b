//! A program as text with structure: blocks, words, expressions, control statements.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::OnceLock;

use trueaxis_input::{Content, Diagnostics, Place};

use crate::dialect::{Control, Dialect};
use crate::lexer::{Lexer, TokenKind};
use crate::parser::parse_block;

/// An error in a piece of text; it becomes an entry of [`Diagnostics`] with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The code of the diagnostic, stable for programs.
    pub code: &'static str,
    /// The byte offset in the program.
    pub offset: usize,
    /// The error in one sentence.
    pub message: String,
    /// The action to take.
    pub hint: &'static str,
}

/// An error in a piece of text.
pub fn fault(
    code: &'static str,
    offset: usize,
    message: impl Into<String>,
    hint: &'static str,
) -> Fault {
    Fault { code, offset, message: message.into(), hint }
}

/// A bracket that is not closed.
pub fn unclosed_bracket(at: usize) -> Fault {
    let hint = "write one closing bracket for each opening one";
    fault("unbalanced-brackets", at, "this bracket is not closed", hint)
}

/// A node of the expressions of a block.
pub type NodeId = u32;

/// One node of an expression; nodes refer to earlier nodes of the same block.
#[derive(Debug, Clone, PartialEq)]
pub enum Node {
    /// A number.
    Number(f64),
    /// `#n` with n an expression.
    Parameter(NodeId),
    /// `#<name>`: the bytes between the brackets.
    Named(Range<usize>),
    /// `-x`.
    Negative(NodeId),
    /// A function of one argument.
    Function(Function, NodeId, usize),
    /// `ATAN[y]/[x]`, degrees.
    ArcTangent(NodeId, Option<NodeId>),
    /// `EXISTS[#n]`.
    Exists(NodeId),
    /// `a op b`, and the byte offset of the operator.
    Binary(Operator, NodeId, NodeId, usize),
}

/// Functions of one argument; angles are degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "named as in every control's manual")]
pub enum Function {
    Abs,
    Acos,
    Asin,
    Bcd,
    Bin,
    Cos,
    Exp,
    Fix,
    Fup,
    Ln,
    Round,
    Sin,
    Sqrt,
    Tan,
}

/// Operators; comparisons and logic give 1 or 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "named as in every control's manual")]
pub enum Operator {
    Power,
    Times,
    Divide,
    Modulo,
    Plus,
    Minus,
    Equal,
    NotEqual,
    Greater,
    GreaterEqual,
    Less,
    LessEqual,
    And,
    Or,
    Xor,
}

/// The name of a sub, a loop or a branch.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Label {
    /// `O100`, `DO1`, `GOTO 10`.
    Number(u64),
    /// `O<name>`, lower case.
    Name(String),
    /// `O#1`, `GOTO #1`: known only during execution.
    Computed(NodeId),
}

/// Control statements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "named as in every control's manual")]
pub enum Keyword {
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
    Goto,
    /// `IF [ ] GOTO n`.
    IfGoto,
    /// `IF [ ] THEN`: the rest of the block is executed if it holds.
    IfThen,
    /// `O1234` at the beginning of a FANUC program.
    ProgramNumber,
}

/// One part of a block.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// A word such as `X1.5`; without a value where the control allows it.
    Word {
        /// Upper case; small for `,C` and `,R`, the corners of FANUC.
        letter: u8,
        /// Its value.
        value: NodeId,
        /// The byte offset of the letter.
        offset: usize,
    },
    /// `#n = x`: the target is a [`Node::Parameter`] or [`Node::Named`].
    Assign {
        /// The parameter that is set.
        target: NodeId,
        /// The new value.
        value: NodeId,
        /// The byte offset of the assignment.
        offset: usize,
    },
    /// A control statement.
    Control {
        /// The key word.
        keyword: Keyword,
        /// Its label.
        label: Option<Label>,
        /// Its condition, count or arguments.
        arguments: Vec<NodeId>,
        /// The byte offset at which it begins.
        offset: usize,
    },
    /// A comment with its marks.
    Comment(Range<usize>),
    /// A tape mark.
    Mark(usize),
    /// A `)` without its `(`, after a comment.
    LooseEnd(usize),
    /// A `/` within a block: what follows is optional.
    Optional(usize),
}

/// One parsed line of a program.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    /// Its bytes with the line end.
    pub span: Range<usize>,
    /// Its line, from 1.
    pub line: u32,
    /// The level of `/` before it.
    pub skip: Option<u8>,
    /// Its parts, in order.
    pub items: Vec<Item>,
    /// The nodes of all expressions in it.
    pub nodes: Vec<Node>,
    /// Its errors; a block with faults must not be executed.
    pub faults: Vec<Fault>,
}

/// A program: its text, read by the rules of its control.
///
/// The text is not changed, and blocks are parsed when they are needed, so that the memory does not
/// grow with the number of blocks beyond the text itself.
///
/// ```
/// use trueaxis_blocks::{Control, Program};
/// let program = Program::new("demo.ngc", b"G0 X1\n(done)\nM2\n".to_vec(), Control::LinuxCnc);
/// assert_eq!(program.blocks().count(), 3);
/// assert_eq!(program.print(), program.source());
/// assert!(!program.check().has_errors());
/// ```
#[derive(Debug, Clone)]
pub struct Program {
    file: String,
    source: Content,
    dialect: &'static Dialect,
    structure: OnceLock<Structure>,
}

/// A control statement with its place, for jumps.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// The key word.
    pub keyword: Keyword,
    /// Its label.
    pub label: Label,
    /// The byte offset of the block that contains it.
    pub start: usize,
    /// The byte offset of the next block.
    pub next: usize,
    /// Its line, from 1.
    pub line: u32,
}

/// The targets of jumps.
#[derive(Debug, Clone, Default)]
pub struct Structure {
    /// The control statements in the order of the text.
    pub marks: Vec<Mark>,
    /// The first `sub` of a label.
    pub subs: HashMap<Label, usize>,
    /// N words at block begin: number, block, line.
    pub numbers: Vec<(u64, usize, u32)>,
}

impl Program {
    /// A program from its text, which is not parsed yet.
    pub fn new(file: &str, source: Vec<u8>, control: Control) -> Self {
        Self::of(file, source.into(), control)
    }

    /// The same from a text that may be kept elsewhere than in the memory.
    pub fn of(file: &str, source: Content, control: Control) -> Self {
        let dialect = Dialect::of(control);
        Self { file: file.to_owned(), source, dialect, structure: OnceLock::new() }
    }

    /// The file as the user named it.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The text.
    pub fn source(&self) -> &[u8] {
        &self.source
    }

    /// Its text, back again.
    pub fn into_source(self) -> Content {
        self.source
    }

    /// The text in parts; the one before is passed, so that a long text is looked through in little memory.
    pub fn parts(&self) -> impl Iterator<Item = &[u8]> {
        const AT_ONCE: usize = 8 << 20;
        self.source.chunks(AT_ONCE).enumerate().map(|(k, part)| {
            self.pass(k.saturating_sub(1) * AT_ONCE..k * AT_ONCE);
            part
        })
    }

    /// These bytes of the text were executed and may not be needed again; see [`Content::pass`].
    pub fn pass(&self, range: Range<usize>) {
        self.source.pass(range);
    }

    /// The rules of its control.
    pub fn dialect(&self) -> &'static Dialect {
        self.dialect
    }

    /// All blocks, one after the other.
    pub fn blocks(&self) -> impl Iterator<Item = Block> + '_ {
        let (mut at, mut line) = (0, 1);
        std::iter::from_fn(move || {
            if at >= self.source.len() {
                return None;
            }
            let mut block = Block::default();
            self.read_block(at, line, &mut block);
            at = block.span.end;
            line += 1;
            Some(block)
        })
    }

    /// Parses the block that begins at a byte into `block`, whose memory is used again.
    pub fn read_block(&self, start: usize, line: u32, block: &mut Block) {
        parse_block(&self.source, self.dialect, start, block);
        block.line = line;
    }

    /// The text as the sequence of its tokens: equal to the source.
    pub fn print(&self) -> Vec<u8> {
        let mut text = Vec::with_capacity(self.source.len());
        for token in Lexer::new(&self.source, self.dialect, 0) {
            text.extend_from_slice(&self.source[token.start..token.end]);
        }
        text
    }

    /// All syntax errors of the text, up to 100 problems.
    pub fn check(&self) -> Diagnostics {
        let mut places = Places::new(self);
        let mut problems = Diagnostics::new();
        let mut count = 0;
        let (mut at, mut line, mut block) = (0, 1, Block::default());
        while at < self.source.len() {
            self.read_block(at, line, &mut block);
            at = block.span.end;
            line += 1;
            for fault in block.faults.drain(..) {
                count += 1;
                if count > 100 {
                    let message =
                        "more than 100 problems; the remaining ones are not listed".to_owned();
                    problems.note(
                        "too-many-problems",
                        places.of(fault.offset),
                        message,
                        "correct the first ones; the others may follow from them",
                    );
                    return problems;
                }
                let place = places.of(fault.offset);
                problems.error(fault.code, place, fault.message, fault.hint);
            }
        }
        problems
    }

    /// The targets of jumps, determined at the first jump.
    pub fn structure(&self) -> &Structure {
        self.structure.get_or_init(|| self.find_structure())
    }

    fn find_structure(&self) -> Structure {
        let mut found = Structure::default();
        let (mut at, mut line, mut block) = (0, 1, Block::default());
        while at < self.source.len() {
            let (candidate, end) = self.may_have_control(at);
            if candidate {
                self.read_block(at, line, &mut block);
                found.take(&block);
            }
            at = end;
            line += 1;
        }
        found
    }

    /// Whether the line that begins here can hold a label or control statement, and where it ends.
    fn may_have_control(&self, start: usize) -> (bool, usize) {
        let mut first = None;
        let mut end = start;
        for byte in &self.source[start..] {
            end += 1;
            match byte {
                b'\n' => break,
                b'\r' if self.source.get(end) != Some(&b'\n') => break,
                b' ' | b'\t' | b'/' | b'\r' => {}
                _ if first.is_none() => first = Some(byte.to_ascii_lowercase()),
                _ => {}
            }
        }
        let letters: &[u8] = if self.dialect.o_words { b"on(" } else { b"noiwedg(:" };
        (first.is_some_and(|b| letters.contains(&b)), end)
    }
}

impl Structure {
    /// The beginning of the block with a number: the next one after a byte, otherwise the first one,
    /// within the program (O number) that contains the byte.
    pub fn block_number(&self, wanted: u64, from: usize) -> Option<(usize, u32)> {
        let mut programs = self.marks.iter().filter(|m| m.keyword == Keyword::ProgramNumber);
        let end = programs.clone().find(|m| m.start > from).map_or(usize::MAX, |m| m.start);
        let begin = programs.rfind(|m| m.start <= from).map_or(0, |m| m.start);
        let place = |byte: usize| self.numbers.partition_point(|(_, start, _)| *start < byte);
        let own = &self.numbers[place(begin)..place(end)];
        let after = own.partition_point(|(_, start, _)| *start <= from);
        let mut numbers = own[after..].iter().chain(&own[..after]);
        numbers.find(|(number, ..)| *number == wanted).map(|(_, start, line)| (*start, *line))
    }

    fn take(&mut self, block: &Block) {
        for item in &block.items {
            match item {
                Item::Control { keyword, label: Some(label), .. }
                    if !matches!(label, Label::Computed(_)) =>
                {
                    if matches!(keyword, Keyword::Sub | Keyword::ProgramNumber) {
                        self.subs.entry(label.clone()).or_insert(self.marks.len());
                    }
                    self.marks.push(Mark {
                        keyword: *keyword,
                        label: label.clone(),
                        start: block.span.start,
                        next: block.span.end,
                        line: block.line,
                    });
                }
                Item::Word { letter: b'N', value, .. } => {
                    if let Some(Node::Number(number)) = block.nodes.get(*value as usize) {
                        self.numbers.push((*number as u64, block.span.start, block.line));
                    }
                }
                _ => {}
            }
        }
    }
}

/// Converts byte offsets to lines and columns; fast for increasing offsets.
#[derive(Debug, Clone)]
pub struct Places<'p> {
    program: &'p Program,
    at: usize,
    line: usize,
    column: usize,
}

impl<'p> Places<'p> {
    /// From the beginning of a program.
    pub fn new(program: &'p Program) -> Self {
        Self { program, at: 0, line: 1, column: 1 }
    }

    /// A converter that begins at a byte at the beginning of a line.
    pub fn beginning(program: &'p Program, at: usize, line: u32) -> Self {
        Self { program, at, line: line as usize, column: 1 }
    }

    /// The place of a byte.
    pub fn of(&mut self, offset: usize) -> Place {
        let source = &self.program.source;
        let offset = offset.min(source.len());
        if offset < self.at {
            (self.at, self.line, self.column) = (0, 1, 1);
        }
        while self.at < offset {
            match source[self.at] {
                b'\n' => (self.line, self.column) = (self.line + 1, 1),
                b'\r' if source.get(self.at + 1) != Some(&b'\n') => {
                    (self.line, self.column) = (self.line + 1, 1);
                }
                // Continuation bytes of UTF-8 do not count: columns are characters.
                0x80..=0xbf => {}
                _ => self.column += 1,
            }
            self.at += 1;
        }
        Place { file: self.program.file.clone(), line: self.line, column: self.column }
    }
}

/// Whether a token carries no meaning for the block.
pub fn is_trivia(kind: TokenKind) -> bool {
    matches!(kind, TokenKind::Space)
}
