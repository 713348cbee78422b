//! The text of a machine file line by line, so that one entry can be changed and all else stays as it is.
//!
//! A line is a logical line of TOML: an entry over several lines of text is one. Which lines belong
//! together follows from strings, brackets and comments alone; a changed file is read back.

use crate::errors::{ErrorKind, ErrorName};
use std::ops::Range;

/// A text, line by line; every line has its own end.
#[derive(Debug, Clone)]
pub struct Lines {
    lines: Vec<String>,
    /// The end of a new line: that of the first one.
    end: &'static str,
}

impl Lines {
    /// The lines of a text, from which the text can be restored.
    pub fn of(text: &str) -> Self {
        let first = text.find('\n').map(|at| &text[..at]);
        let end = if first.is_some_and(|line| line.ends_with('\r')) { "\r\n" } else { "\n" };
        let mut lines: Vec<String> = Vec::new();
        let mut scan = Scan::default();
        for piece in text.split_inclusive('\n') {
            match lines.last_mut().filter(|_| scan.goes_on()) {
                Some(line) => line.push_str(piece),
                None => lines.push(piece.to_owned()),
            }
            scan.line(piece);
        }
        Self { lines, end }
    }

    /// The text.
    pub fn text(&self) -> String {
        self.lines.concat()
    }

    /// A line without its end.
    pub fn line(&self, at: usize) -> &str {
        without_end(&self.lines[at])
    }

    /// The number of its first line of text, from 1.
    pub fn number(&self, at: usize) -> usize {
        let before = self.lines.iter().take(at);
        before.map(|line| line.matches('\n').count()).sum::<usize>() + 1
    }

    /// Puts something else in place of a line.
    pub fn replace(&mut self, at: usize, text: &str) {
        let line = &self.lines[at];
        let end = &line[without_end(line).len()..];
        self.lines[at] = format!("{text}{end}");
    }

    /// Inserts a line before another one, or after the last.
    pub fn insert(&mut self, at: usize, text: &str) {
        let (end, behind_all) = (self.end, at == self.lines.len());
        let mut open = self.lines.last_mut().filter(|l| behind_all && !l.ends_with('\n'));
        match &mut open {
            Some(last) => {
                last.push_str(end);
                self.lines.push(text.to_owned());
            }
            None => self.lines.insert(at, format!("{text}{end}")),
        }
    }

    /// Takes a line out.
    pub fn remove(&mut self, at: usize) {
        let gone = self.lines.remove(at);
        if !gone.ends_with('\n')
            && let Some(last) = self.lines.last_mut()
        {
            // As before: the last line of this text has no end.
            last.truncate(without_end(last).len());
        }
    }

    /// Makes a comment of a line.
    pub fn comment_out(&mut self, at: usize) {
        self.replace(at, &format!("# {}", self.line(at).replace('\n', "\n# ")));
    }

    /// The lines of a section without its heading.
    pub fn section(&self, header: &str) -> Option<Range<usize>> {
        let is_heading = |line: &String| line.trim_start().starts_with('[');
        let from = self.lines.iter().position(|l| heading(l).as_deref() == Some(header))? + 1;
        let length = self.lines[from..].iter().position(is_heading);
        Some(from..length.map_or(self.lines.len(), |n| from + n))
    }

    /// The line of a key of a section.
    pub fn key(&self, header: &str, key: &str) -> Option<usize> {
        self.section(header)?.find(|i| key_of(&self.lines[*i]) == Some(key))
    }

    /// The line of the entry of an error.
    pub fn error(&self, name: ErrorName) -> Option<usize> {
        let key = |i: &usize| key_of(&self.lines[*i]).and_then(ErrorName::parse) == Some(name);
        self.section(&header(name))?.find(key)
    }

    /// Puts a new entry at the end of its section, which is made if it is not there.
    pub fn add(&mut self, header: &str, text: &str) {
        let at = match self.section(header) {
            Some(section) => {
                let from = section.start;
                let full = |i: &usize| {
                    !matches!(self.line(*i).trim_start().chars().next(), None | Some('#'))
                };
                section.rev().find(full).map_or(from, |i| i + 1)
            }
            None => {
                self.insert(self.lines.len(), "");
                self.insert(self.lines.len(), &format!("[{header}]"));
                self.lines.len()
            }
        };
        self.insert(at, text);
    }

    /// Removes an entry; a last section that becomes empty is removed with it.
    pub fn take_out(&mut self, header: &str, at: usize) {
        self.remove(at);
        let Some(section) = self.section(header) else { return };
        let bare = section.is_empty() && section.end == self.lines.len() && section.start >= 2;
        if bare && self.line(section.start - 2).is_empty() {
            self.remove(section.start - 1);
            self.remove(section.start - 2);
        }
    }

    /// The text of the value of an entry: after its `=`, without a comment.
    pub fn value(&self, at: usize) -> Option<&str> {
        value_of(self.line(at)).map(|range| &self.line(at)[range])
    }

    /// Changes the value of an entry and nothing else; `false` if the line is no entry.
    pub fn set_value(&mut self, at: usize, value: &str) -> bool {
        let Some(range) = value_of(self.line(at)) else { return false };
        let mut line = self.line(at).to_owned();
        line.replace_range(range, value);
        self.replace(at, &line);
        true
    }

    /// `table = "X.csv"` of a section: the line and the name.
    pub fn table_of(&self, header: &str) -> Option<(usize, String)> {
        let line = self.key(header, "table")?;
        let value = self.value(line)?;
        let quote = value.chars().next().filter(|c| ['"', '\''].contains(c))?;
        let (name, _) = value[1..].split_once(quote)?;
        Some((line, name.to_owned()))
    }
}

/// The section that states an error.
pub fn header(name: ErrorName) -> String {
    match name.kind {
        ErrorKind::Location => "location".to_owned(),
        ErrorKind::Motion => format!("motion.{}", name.body),
    }
}

fn without_end(line: &str) -> &str {
    let line = line.strip_suffix('\n').unwrap_or(line);
    line.strip_suffix('\r').unwrap_or(line)
}

/// `[a.b]` without blanks and quotes.
fn heading(line: &str) -> Option<String> {
    let line = line.split('#').next().unwrap_or("").trim();
    let inner = line.strip_prefix('[')?.strip_suffix(']')?;
    Some(inner.replace([' ', '\t', '"', '\''], ""))
}

/// The key of a line: the text before its `=`.
pub fn key_of(line: &str) -> Option<&str> {
    line.split_once('=').map(|(key, _)| key.trim().trim_matches(['"', '\'']))
}

/// The range of the value of an entry: after its `=`, without blanks and comment.
pub fn value_of(line: &str) -> Option<Range<usize>> {
    key_of(line).filter(|key| !key.starts_with(['#', '[']))?;
    let from = line.find('=')? + 1;
    let mut scan = Scan::default();
    scan.line(&line[from..]);
    let value = &line[from..from + scan.comment.unwrap_or(line.len() - from)];
    let from = from + value.len() - value.trim_start().len();
    let range = from..from + value.trim().len();
    (!range.is_empty() && !scan.goes_on()).then_some(range)
}

/// What of TOML spans lines: strings in three quotes, brackets.
#[derive(Debug, Default)]
struct Scan {
    /// The quotes that end the string.
    quote: Option<&'static str>,
    depth: usize,
    /// Where the comment begins outside all brackets.
    comment: Option<usize>,
}

const QUOTES: [&str; 4] = ["\"\"\"", "'''", "\"", "'"];

impl Scan {
    /// Whether the next line belongs to the same entry.
    fn goes_on(&self) -> bool {
        self.depth > 0 || self.quote.is_some()
    }

    /// Goes over some text.
    fn line(&mut self, text: &str) {
        let mut at = 0;
        let mut in_comment = false;
        while let Some(c) = text[at..].chars().next() {
            let rest = &text[at..];
            let mut step = c.len_utf8();
            match self.quote {
                _ if in_comment => in_comment = c != '\n',
                Some(quote) if rest.starts_with(quote) => {
                    step = quote.len();
                    self.quote = None;
                }
                Some(quote) if c == '\\' && quote.starts_with('"') => {
                    step += rest[1..].chars().next().map_or(0, char::len_utf8);
                }
                // A string in one quote that is still open at the end of its line is a mistake.
                Some(quote) if c == '\n' && quote.len() == 1 => self.quote = None,
                Some(_) => {}
                None => match c {
                    '"' | '\'' => {
                        let quote = QUOTES.into_iter().find(|q| rest.starts_with(q));
                        step = quote.map_or(step, str::len);
                        self.quote = quote;
                    }
                    '#' => {
                        in_comment = true;
                        if self.depth == 0 && self.comment.is_none() {
                            self.comment = Some(at);
                        }
                    }
                    '[' | '{' => self.depth += 1,
                    ']' | '}' => self.depth = self.depth.saturating_sub(1),
                    _ => {}
                },
            }
            at += step;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(text: &str) -> ErrorName {
        ErrorName::parse(text).unwrap() // why: the tests write names of ISO 230-1
    }

    #[test]
    fn the_value_of_a_line_changes_alone() {
        let old =
            "# mine\r\n[location] # here\r\n  EC0Y  =  '1 urad'   # old = \"x\"\r\n\r\n[tool]\r\n";
        let mut file = Lines::of(old);
        let at = file.error(name("EC0Y")).unwrap();
        assert_eq!((file.value(at), file.number(at)), (Some("'1 urad'"), 3));
        assert!(file.set_value(at, "\"# 3\""));
        assert_eq!(file.text(), old.replace("'1 urad'", "\"# 3\""));
        assert!(file.set_value(at, "'1 urad'"));
        assert_eq!(file.text(), old);
    }

    #[test]
    fn an_entry_over_several_lines_is_one() {
        let old = "[motion.C]\nEXC = { fourier = { terms = [ # why\n  [1, \"1 um\", \"2 # \
            um\"],\n] } } # end\nEYC = \"1 um\"\n\
                   note = \"\"\"\n[location]\nEC0Y = 1\n\"\"\"\n[location]\n";
        let mut file = Lines::of(old);
        let at = file.error(name("EXC")).unwrap();
        assert!(file.value(at).unwrap().ends_with("\n] } }"));
        assert_eq!(file.number(file.error(name("EYC")).unwrap()), 5);
        assert_eq!(file.error(name("EC0Y")), None); // within a text
        assert_eq!(file.text(), old);
        file.comment_out(at);
        assert!(
            file.text().contains("# EXC = { f") && file.text().contains("\n# ] } } # end\nEYC")
        );
    }

    #[test]
    fn what_was_added_can_be_taken_out() {
        for old in
            ["a = 1\n", "a = 1", "a = 1\r\n", "a = 1\r\nb = 2", "[location]\n# none\n[tool]\n"]
        {
            let mut file = Lines::of(old);
            file.add("location", "EC0Y = \"1 urad\"");
            let at = file.error(name("EC0Y")).unwrap();
            assert_eq!(file.text().contains("\r\n[location]\r\nEC0Y"), old.contains('\r'));
            file.take_out("location", at);
            assert_eq!(file.text(), old);
        }
    }
}
