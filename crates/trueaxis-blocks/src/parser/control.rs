//! Control statements of LinuxCNC and FANUC.

use super::Parser;
use crate::lexer::{TokenKind, number_value};
use crate::program::{Item, Keyword, Label};

/// The key words after an O label; longer ones first where one begins another.
const O_WORDS: [(&[u8], Keyword); 15] = [
    (b"SUB", Keyword::Sub),
    (b"ENDSUB", Keyword::EndSub),
    (b"CALL", Keyword::Call),
    (b"RETURN", Keyword::Return),
    (b"IF", Keyword::If),
    (b"ELSEIF", Keyword::ElseIf),
    (b"ELSE", Keyword::Else),
    (b"ENDIF", Keyword::EndIf),
    (b"WHILE", Keyword::While),
    (b"ENDWHILE", Keyword::EndWhile),
    (b"DO", Keyword::Do),
    (b"REPEAT", Keyword::Repeat),
    (b"ENDREPEAT", Keyword::EndRepeat),
    (b"BREAK", Keyword::Break),
    (b"CONTINUE", Keyword::Continue),
];

/// What opens, writes and closes a file or an interface of FANUC.
const OUTPUTS: [&[u8]; 4] = [b"POPEN", b"DPRNT", b"BPRNT", b"PCLOS"];

impl Parser<'_, '_> {
    /// A control statement, if one begins here; `Some(false)` if it is faulty.
    pub(super) fn control(&mut self) -> Option<bool> {
        match self.letter()? {
            b'O' if self.dialect.o_words => Some(self.o_word()),
            b'O' if self.dialect.macro_words => Some(self.program_number()),
            b'P' | b'B' | b'D' if self.dialect.macro_words => {
                self.output().or_else(|| self.macro_word())
            }
            b'I' | b'W' | b'E' | b'G' if self.dialect.macro_words => self.macro_word(),
            _ => None,
        }
    }

    /// `POPEN`, `DPRNT[X#5061[44]]`, `BPRNT[…]`, `PCLOS`: no word of it moves an axis; its text is kept like a
    /// comment.
    fn output(&mut self) -> Option<bool> {
        let offset = self.here();
        OUTPUTS.iter().find(|word| self.accept_word(word))?;
        self.give_up();
        self.block.items.push(Item::Comment(offset..self.stop.max(offset)));
        Some(true)
    }

    pub(super) fn program_number(&mut self) -> bool {
        let offset = self.here();
        self.advance();
        let Some(label) = self.label() else { return false };
        self.push(Keyword::ProgramNumber, Some(label), Vec::new(), offset);
        true
    }

    /// `M98 <NAME>`: the program that the block calls.
    pub(super) fn called_name(&mut self) -> bool {
        let offset = self.here();
        let Some(label) = self.label() else { return false };
        self.push(Keyword::Call, Some(label), Vec::new(), offset);
        true
    }

    fn push(&mut self, keyword: Keyword, label: Option<Label>, arguments: Vec<u32>, offset: usize) {
        self.block.items.push(Item::Control { keyword, label, arguments, offset });
    }

    fn o_word(&mut self) -> bool {
        let offset = self.here();
        self.advance();
        let Some(label) = self.label() else { return false };
        if self.token.is_none() && matches!(label, Label::Number(_) | Label::Name(_)) {
            // A program of FANUC's style: called by M98, ended by M99; the main program has a name.
            self.push(Keyword::ProgramNumber, Some(label), Vec::new(), offset);
            return true;
        }
        let Some((_, keyword)) = O_WORDS.iter().find(|(word, _)| self.accept_word(word)) else {
            let hint = "sub endsub call return if elseif else endif while endwhile do repeat \
                        endrepeat break continue";
            let message = "expected a key word after the O label".to_owned();
            self.fault("unknown-o-word", self.here(), message, hint);
            return false;
        };
        if *keyword == Keyword::Sub {
            // The text after `sub` in its line only documents its arguments.
            self.give_up();
        }
        let mut arguments = Vec::new();
        while self.symbol() == Some(b'[') {
            let Some(argument) = self.bracket() else { return false };
            arguments.push(argument);
        }
        if self.token.is_some() {
            let message = "unexpected text after an O word".to_owned();
            self.fault("unexpected-sign", self.here(), message, "write it on a separate line");
            return false;
        }
        let conditional =
            matches!(keyword, Keyword::If | Keyword::ElseIf | Keyword::While | Keyword::Repeat);
        if conditional && arguments.len() != 1 {
            let message = "expected one condition or count in brackets".to_owned();
            self.fault("missing-value", self.here(), message, "write o1 if [#1 GT 0]");
            return false;
        }
        self.push(*keyword, Some(label), arguments, offset);
        true
    }

    fn label(&mut self) -> Option<Label> {
        let Some(name) = self.token.filter(|t| t.kind == TokenKind::Name) else {
            return self.number_label();
        };
        let text = &self.source[name.start + 1..name.end];
        let Some(text) = text.strip_suffix(b">") else {
            let message = "the name of the O word is not closed".to_owned();
            self.fault("unclosed-name", name.start, message, "close it with >");
            return None;
        };
        let name: String = String::from_utf8_lossy(text)
            .chars()
            .filter(|c| !c.is_whitespace())
            .collect::<String>()
            .to_ascii_lowercase();
        self.advance();
        Some(Label::Name(name))
    }

    fn number_label(&mut self) -> Option<Label> {
        if let Some(token) = self.token.filter(|t| t.kind == TokenKind::Number) {
            let value = number_value(&self.source[token.start..token.end]);
            let Some(value) = value.filter(|v| v.fract() == 0.0 && *v < 1e15) else {
                let message = "the label must be a whole number".to_owned();
                self.fault("bad-label", token.start, message, "write O100");
                return None;
            };
            self.advance();
            return Some(Label::Number(value as u64));
        }
        self.value().map(Label::Computed)
    }

    fn macro_word(&mut self) -> Option<bool> {
        let offset = self.here();
        let keyword = [
            (&b"IF"[..], Keyword::If),
            (b"WHILE", Keyword::While),
            (b"END", Keyword::EndWhile),
            (b"GOTO", Keyword::Goto),
            (b"DO", Keyword::Do),
        ]
        .into_iter()
        .find(|(word, _)| self.accept_short(word))?
        .1;
        Some(self.macro_statement(keyword, offset).is_some())
    }

    /// A jump, loop or condition and nothing else: other words of its block would be lost.
    fn macro_statement(&mut self, keyword: Keyword, offset: usize) -> Option<()> {
        const ALONE: &str = "write it into a block of its own";
        let named = |item: &Item| match item {
            Item::Comment(_) | Item::LooseEnd(_) | Item::Word { letter: b'N', .. } => false,
            Item::Control { keyword, .. } => *keyword != Keyword::ProgramNumber,
            _ => true,
        };
        if self.block.items.iter().any(named) {
            let message = "unexpected text before a jump, loop or condition".to_owned();
            self.fault("unexpected-sign", offset, message, ALONE);
            return None;
        }
        self.macro_parts(keyword, offset)?;
        let then =
            matches!(self.block.items.last(), Some(Item::Control { keyword: Keyword::IfThen, .. }));
        match self.token {
            Some(token) if !then => {
                let message = "unexpected text after a jump or loop".to_owned();
                self.fault("unexpected-sign", token.start, message, ALONE);
                None
            }
            _ => Some(()),
        }
    }

    fn macro_parts(&mut self, keyword: Keyword, offset: usize) -> Option<()> {
        match keyword {
            Keyword::If => {
                let condition = self.bracket()?;
                if self.accept_short(b"GOTO") {
                    let label = self.number_label()?;
                    self.push(Keyword::IfGoto, Some(label), vec![condition], offset);
                } else if self.accept_short(b"THEN") {
                    self.push(Keyword::IfThen, None, vec![condition], offset);
                } else {
                    let message = "expected GOTO or THEN after the condition".to_owned();
                    self.fault("unknown-macro-word", self.here(), message, "IF [#1 GT 0] GOTO 10");
                    return None;
                }
            }
            Keyword::While => {
                let condition = self.bracket()?;
                if !self.accept_word(b"DO") {
                    let message = "expected DO after the condition".to_owned();
                    self.fault("unknown-macro-word", self.here(), message, "WHILE [#1 GT 0] DO1");
                    return None;
                }
                let label = self.number_label()?;
                self.push(Keyword::While, Some(label), vec![condition], offset);
            }
            _ => {
                let label = self.number_label()?;
                self.push(keyword, Some(label), Vec::new(), offset);
            }
        }
        Some(())
    }
}
