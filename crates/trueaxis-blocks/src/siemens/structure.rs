//! Where jumps can go: labels, block numbers, control structures, programs in one file.

use std::collections::HashMap;
use std::ops::Range;

use super::reader::{self, Reader};
use crate::program::Program;

/// The control structures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keyword {
    /// IF without a jump.
    If,
    /// ELSE.
    Else,
    /// ENDIF.
    EndIf,
    /// FOR.
    For,
    /// ENDFOR.
    EndFor,
    /// WHILE.
    While,
    /// ENDWHILE.
    EndWhile,
    /// LOOP.
    Loop,
    /// ENDLOOP.
    EndLoop,
    /// REPEAT.
    Repeat,
    /// UNTIL.
    Until,
    /// ENDLABEL.
    EndLabel,
}

impl Keyword {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "IF" => Self::If,
            "ELSE" => Self::Else,
            "ENDIF" => Self::EndIf,
            "FOR" => Self::For,
            "ENDFOR" => Self::EndFor,
            "WHILE" => Self::While,
            "ENDWHILE" => Self::EndWhile,
            "LOOP" => Self::Loop,
            "ENDLOOP" => Self::EndLoop,
            "REPEAT" => Self::Repeat,
            "UNTIL" => Self::Until,
            "ENDLABEL" => Self::EndLabel,
            _ => return None,
        })
    }

    /// What ends it.
    fn end(self) -> Option<Self> {
        Some(match self {
            Self::If | Self::Else => Self::EndIf,
            Self::For => Self::EndFor,
            Self::While => Self::EndWhile,
            Self::Loop => Self::EndLoop,
            Self::Repeat => Self::Until,
            _ => return None,
        })
    }
}

/// A control structure with its place.
#[derive(Debug, Clone)]
pub struct Mark {
    /// Which word it is.
    pub keyword: Keyword,
    /// The block that contains it.
    pub start: usize,
    /// The block after it.
    pub next: usize,
    /// Its line, from 1.
    pub line: u32,
    /// The end of what begins here, or the beginning of what ends here.
    pub partner: Option<usize>,
    /// The ELSE of an IF.
    pub other: Option<usize>,
}

/// One program of a file with several.
#[derive(Debug, Clone)]
pub struct Section {
    /// Upper case, without `_N_` and `_SPF`.
    pub name: String,
    /// Its bytes.
    pub span: Range<usize>,
    /// Its line, from 1.
    pub line: u32,
}

/// Blocks that jumps can reach.
#[derive(Debug, Clone, Default)]
pub struct Structure {
    /// The words of structure, in order.
    pub marks: Vec<Mark>,
    /// Which of them begins at a byte.
    pub by_start: HashMap<usize, usize>,
    /// Block and line, in the order of the text.
    pub labels: HashMap<String, Vec<(usize, u32)>>,
    /// Number, block and line, sorted.
    pub numbers: Vec<(u64, usize, u32)>,
    /// The programs of the text, each after its head.
    pub sections: Vec<Section>,
}

/// `_N_NAME_SPF`, `NAME.SPF` and `/_N_WKS_DIR/_N_NAME_SPF` as NAME.
pub fn plain_name(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name).trim().to_ascii_uppercase();
    let last = last.strip_prefix("_N_").unwrap_or(&last);
    let ends = ["_SPF", "_MPF", ".SPF", ".MPF"];
    let plain = ends.iter().find_map(|end| last.strip_suffix(end)).unwrap_or(last);
    plain.to_owned()
}

/// The main program of a file: its first byte, line and end.
pub fn main_section(program: &Program) -> (usize, u32, usize) {
    let source = program.source();
    // Only a file of several programs has the sign that begins one.
    if !program.parts().any(|part| part.contains(&b'%')) {
        return (0, 1, source.len());
    }
    let mut start = 0;
    let mut begun = false;
    while start < source.len() {
        let line = line_of(source, start);
        let text = source[line.clone()].trim_ascii();
        if text.starts_with(b"%_N_") && begun {
            return (0, 1, start);
        }
        begun |= !text.is_empty() && !text.starts_with(b";");
        start = line.end;
    }
    (0, 1, source.len())
}

/// The line that begins here, with its end.
fn line_of(source: &[u8], start: usize) -> Range<usize> {
    let mut end = start;
    for byte in &source[start..] {
        end += 1;
        match byte {
            b'\n' => break,
            b'\r' if source.get(end) != Some(&b'\n') => break,
            _ => {}
        }
    }
    start..end
}

impl Structure {
    /// Looks through a program once.
    pub fn of(program: &Program) -> Self {
        let mut found = Self::default();
        let source = program.source();
        let (mut start, mut line) = (0, 1);
        let mut open = Vec::new();
        let mut tokens = Vec::new();
        while start < source.len() {
            let span = line_of(source, start);
            let text = source[span.clone()].trim_ascii();
            if text.starts_with(b"%_N_") {
                found.begin_section(text, start, line);
                open.clear();
            }
            if is_candidate(text) {
                reader::read_line(program, start, &mut tokens);
                let mut reader = Reader::new(source, &tokens, span.end);
                found.take(&mut reader, &span, line, &mut open);
            }
            start = span.end;
            line += 1;
        }
        if let Some(last) = found.sections.last_mut() {
            last.span.end = source.len();
        }
        found.numbers.sort_unstable();
        found
    }

    fn begin_section(&mut self, text: &[u8], start: usize, line: u32) {
        if let Some(last) = self.sections.last_mut() {
            last.span.end = start;
        }
        let name = plain_name(&String::from_utf8_lossy(&text[1..]));
        self.sections.push(Section { name, span: start..start, line });
    }

    fn take(
        &mut self,
        reader: &mut Reader<'_>,
        span: &Range<usize>,
        line: u32,
        open: &mut Vec<usize>,
    ) {
        if reader.letter() == Some(b'N')
            && let Some(number) = reader.number_ahead(1)
        {
            let digits = String::from_utf8_lossy(reader.text(number)).into_owned();
            if let Ok(number) = digits.parse() {
                self.numbers.push((number, span.start, line));
            }
            reader.at += 2;
        }
        while let Some(name) = reader.word()
            && reader.symbol_ahead(1) == Some(b':')
        {
            self.labels.entry(name).or_default().push((span.start, line));
            reader.at += 2;
        }
        let Some(keyword) = reader.word().as_deref().and_then(Keyword::of) else { return };
        if keyword == Keyword::If && reader.jumps_later() {
            return;
        }
        // With a label after it, REPEAT repeats a part and opens no structure.
        if keyword == Keyword::Repeat && reader.ahead(1).is_some() {
            return;
        }
        let index = self.marks.len();
        let mut mark =
            Mark { keyword, start: span.start, next: span.end, line, partner: None, other: None };
        match keyword {
            Keyword::Else => {
                if let Some(top) = open.last().copied()
                    && self.marks[top].keyword == Keyword::If
                {
                    self.marks[top].other = Some(index);
                }
            }
            Keyword::EndLabel => {}
            _ if keyword.end().is_some() => open.push(index),
            _ => {
                let top = open.last().copied();
                if let Some(top) = top.filter(|t| self.marks[*t].keyword.end() == Some(keyword)) {
                    open.pop();
                    mark.partner = Some(top);
                    self.marks[top].partner = Some(index);
                    if let Some(other) = self.marks[top].other {
                        self.marks[other].partner = Some(index);
                    }
                }
            }
        }
        self.by_start.insert(span.start, index);
        self.marks.push(mark);
    }
}

/// Whether a line can have a label, a block number or a control structure.
fn is_candidate(text: &[u8]) -> bool {
    let first = text.iter().position(|b| !matches!(b, b'/' | b'0'..=b'9' | b' ' | b'\t'));
    let Some(first) = first.map(|i| &text[i..]) else { return false };
    match first {
        [b'n' | b'N', b'0'..=b'9' | b' ' | b'\t', ..] => true,
        [a, b, ..] => {
            (a.is_ascii_alphabetic() || *a == b'_') && (b.is_ascii_alphabetic() || *b == b'_')
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_programs() {
        assert_eq!(plain_name("/_N_WKS_DIR/_N_PART_WPD/_N_HOLE_SPF"), "HOLE");
        assert_eq!(plain_name("hole.spf"), "HOLE");
        assert_eq!(plain_name("HOLE"), "HOLE");
    }

    #[test]
    fn the_main_program_ends_where_the_next_begins() {
        let main_of = |text: &str| {
            main_section(&Program::new("p", text.into(), crate::Control::Sinumerik840d))
        };
        assert_eq!(main_of("%_N_A_MPF\nG0\n%_N_B_SPF\nM17\n"), (0, 1, 13));
        assert_eq!(main_of("G0 X1\n"), (0, 1, 6));
    }
}
