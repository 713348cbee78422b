//! From bytes to statements: continuation, comments, major word and its arguments.

use std::ops::Range;

/// Words whose line is text; `$` in it means nothing.
const TEXTS: [&str; 7] = ["PARTNO", "REMARK", "PPRINT", "TPRINT", "INSERT", "LETTER", "CATIA0"];

/// One statement, taken apart; the room is used again.
#[derive(Debug, Default)]
pub(super) struct Statement {
    /// Where it begins, from 1.
    pub line: u32,
    pub span: Range<usize>,
    /// The words without comments and continuation marks; `None` of it for a comment alone.
    pub text: String,
    /// The major word, upper case; empty for a comment or a row of numbers.
    pub word: String,
    /// Its arguments, as places in `text`.
    arguments: Vec<Range<usize>>,
    /// What is said in `$$` comments.
    pub comment: String,
    /// It is a record of Creo for its own use: `$$-> CSYS / …`.
    pub of_creo: bool,
}

impl Statement {
    pub fn count(&self) -> usize {
        self.arguments.len()
    }

    /// An argument without the blanks around it; empty where there is none.
    pub fn argument(&self, index: usize) -> &str {
        self.arguments.get(index).map_or("", |range| self.text[range.clone()].trim())
    }

    /// All arguments.
    pub fn arguments(&self) -> impl Iterator<Item = &str> {
        self.arguments.iter().map(|range| self.text[range.clone()].trim())
    }

    /// The text after the major word and its slash.
    pub fn rest(&self) -> &str {
        let rest = self.text.trim_start();
        let rest = rest.get(self.word.len()..).unwrap_or_default().trim_start();
        rest.strip_prefix('/').unwrap_or(rest).trim()
    }
}

/// Statement by statement.
#[derive(Debug)]
pub(super) struct Scanner<'s> {
    source: &'s [u8],
    at: usize,
    line: u32,
    /// Whether the file ended where a statement goes on.
    is_cut: bool,
}

impl<'s> Scanner<'s> {
    pub fn new(source: &'s [u8]) -> Self {
        let bom = source.starts_with(b"\xEF\xBB\xBF");
        Self { source, at: if bom { 3 } else { 0 }, line: 1, is_cut: false }
    }

    /// Where the next statement begins, or blank lines before it.
    pub fn at(&self) -> usize {
        self.at
    }

    /// The number of the line there.
    pub fn line(&self) -> u32 {
        self.line
    }

    /// The number of the line before, where the file ends.
    pub fn last_line(&self) -> u32 {
        self.line.saturating_sub(1).max(1)
    }

    /// Whether the file ended where a statement goes on in the next line.
    pub fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// Leaves out the line that ends where another one begins.
    pub fn skip_line(&mut self, next: usize) {
        self.at = next;
        self.line += 1;
    }

    /// The next line without its end; `None` at the end of the file.
    fn next_line(&mut self) -> Option<Range<usize>> {
        if self.at >= self.source.len() {
            return None;
        }
        let start = self.at;
        let rest = &self.source[start..];
        let length = rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
        let end = match (rest.get(length), rest.get(length + 1)) {
            (Some(b'\r'), Some(b'\n')) => 2,
            (Some(_), _) => 1,
            (None, _) => 0,
        };
        self.at = start + length + end;
        self.line += 1;
        Some(start..start + length)
    }

    /// Reads the next statement into `into`; `false` at the end of the file.
    pub fn next(&mut self, into: &mut Statement) -> bool {
        into.text.clear();
        into.word.clear();
        into.comment.clear();
        into.arguments.clear();
        let first = loop {
            into.line = self.line;
            match self.next_line() {
                None => return false,
                Some(line) if self.source[line.clone()].iter().all(u8::is_ascii_whitespace) => {}
                Some(line) => break line,
            }
        };
        into.span = first.clone();
        let text = String::from_utf8_lossy(&self.source[first]);
        let record = record_of_creo(&text);
        into.of_creo = record.is_some();
        let text = record.unwrap_or(&text);
        into.word.push_str(major_word(text));
        into.word.make_ascii_uppercase();
        if TEXTS.contains(&into.word.as_str()) {
            into.text.push_str(text);
            return true;
        }
        let mut goes_on = take_line(text, into);
        while goes_on {
            let Some(line) = self.next_line() else {
                self.is_cut = true;
                break;
            };
            into.span.end = line.end;
            goes_on = take_line(&String::from_utf8_lossy(&self.source[line]), into);
        }
        find_arguments(into);
        true
    }
}

/// What follows `$$->`: to other systems a comment, to Creo a statement that may go on in the next lines.
fn record_of_creo(line: &str) -> Option<&str> {
    line.trim_start().strip_prefix("$$")?.trim_start().strip_prefix("->")
}

/// Adds a line without its comment; `true` if the statement goes on in the next line.
fn take_line(line: &str, into: &mut Statement) -> bool {
    let mut quoted = false;
    for (i, c) in line.char_indices() {
        match c {
            '\'' => quoted = !quoted,
            '$' if !quoted => {
                into.text.push_str(&line[..i]);
                let rest = &line[i + 1..];
                if let Some(comment) = rest.strip_prefix('$') {
                    into.comment.push_str(comment.trim());
                    return false;
                }
                // After a single mark only a comment may follow.
                into.comment.push_str(rest.trim());
                return true;
            }
            _ => {}
        }
    }
    into.text.push_str(line);
    false
}

/// The word that a statement begins with; empty for numbers and comments.
fn major_word(line: &str) -> &str {
    let line = line.trim_start();
    if !line.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return "";
    }
    let end = line.find(|c: char| !(c.is_ascii_alphanumeric() || "_.*".contains(c)));
    &line[..end.unwrap_or(line.len())]
}

/// Arguments stand between commas; those of a row of numbers between blanks as well.
fn find_arguments(statement: &mut Statement) {
    let text = &statement.text;
    let row = statement.word.is_empty();
    let begin = if row {
        0
    } else {
        let word_end = text.len() - text.trim_start().len() + statement.word.len();
        match text.get(word_end..).map(|rest| (rest, rest.trim_start().starts_with('/'))) {
            Some((rest, true)) => word_end + rest.find('/').map_or(0, |i| i + 1),
            // MULTAX ON and the like, without a slash.
            _ => word_end,
        }
    };
    let bytes = text.as_bytes();
    let (mut start, mut depth, mut quoted) = (begin, 0_usize, false);
    if text.get(begin..).is_none_or(|rest| rest.trim().is_empty()) {
        return;
    }
    for (i, byte) in bytes.iter().enumerate().skip(begin) {
        match byte {
            b'\'' => quoted = !quoted,
            b'(' if !quoted => depth += 1,
            b')' if !quoted => depth = depth.saturating_sub(1),
            b',' if !quoted && depth == 0 => {
                statement.arguments.push(start..i);
                start = i + 1;
            }
            b' ' | b'\t' | b';' if row => {
                if !text[start..i].trim().is_empty() {
                    statement.arguments.push(start..i);
                }
                start = i + 1;
            }
            _ => {}
        }
    }
    if !row || !text[start..].trim().is_empty() {
        statement.arguments.push(start..text.len());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Vec<(u32, String, Vec<String>, String)> {
        let mut scanner = Scanner::new(text.as_bytes());
        let (mut statement, mut found) = (Statement::default(), Vec::new());
        while scanner.next(&mut statement) {
            let arguments = statement.arguments().map(str::to_owned).collect();
            found.push((
                statement.line,
                statement.word.clone(),
                arguments,
                statement.comment.clone(),
            ));
        }
        found
    }

    #[test]
    fn statements_go_on_and_end() {
        let found = all("GOTO / 1, 2,  $\r\n3 $$ top\r\n\nRAPID\n$$ note\n 1.5 -2 3\n");
        let words: Vec<_> = found.iter().map(|(line, word, ..)| (*line, word.as_str())).collect();
        assert_eq!(words, [(1, "GOTO"), (4, "RAPID"), (5, ""), (6, "")]);
        assert_eq!(found[0].2, ["1", "2", "3"]);
        assert_eq!(found[0].3, "top");
        assert_eq!(found[3].2, ["1.5", "-2", "3"]);
    }

    #[test]
    fn records_of_creo_go_on_too() {
        let found = all(
            "$$-> CSYS / 1.0, 0.0, 0.0, 5.0, $\n  0.0, 1.0, 0.0, 0.0\n$$* note, $\nGOTO / 1, 2, 3\n",
        );
        assert_eq!(found.len(), 3);
        assert_eq!((found[0].1.as_str(), found[0].2.len()), ("CSYS", 8));
        assert_eq!((found[1].1.as_str(), found[2].1.as_str()), ("", "GOTO"));
    }

    #[test]
    fn texts_and_quotes_keep_their_marks() {
        let found = all("SYN/'TLAXIS','$$*TLAXIS'\nPPRINT costs 5 $\nMULTAX ON\nCSI_SET/4.\n");
        assert_eq!(found[0].2, ["'TLAXIS'", "'$$*TLAXIS'"]);
        assert_eq!(found[1].1, "PPRINT");
        assert_eq!((found[2].1.as_str(), found[2].2[0].as_str()), ("MULTAX", "ON"));
        assert_eq!((found[3].1.as_str(), found[3].2[0].as_str()), ("CSI_SET", "4."));
    }
}
