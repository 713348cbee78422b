//! How much text is read, and how much of it is quoted; docs/reference/limits.md gives the reasons.
//!
//! The limits hold before a text is parsed: a parser builds its whole tree, with every fault in it, before anything
//! could be refused.

use std::borrow::Cow;

/// Bytes of a TOML file. Rows of numbers stand in tables; the largest machine file with all of its error curves
/// in it has less than 1 MB.
pub const MOST_TOML_BYTES: usize = 16 << 20;

/// Lines of a TOML file: each may be an entry, or a fault.
pub const MOST_TOML_LINES: usize = 100_000;

/// Words, texts, signs and brackets of a TOML file: the tree has at most as many parts.
pub const MOST_TOML_WORDS: usize = 1_000_000;

/// Tables in tables of a TOML file; no reader looks deeper than into the fifth.
pub const DEEPEST_TOML: usize = 32;

/// Columns of a table: the channels of the largest logs are some hundreds.
pub const MOST_COLUMNS: usize = 2_000;

/// Rows of a table: a log of a day at 100 Hz has 8.64 million.
pub const MOST_ROWS: usize = 10_000_000;

/// Characters of a heading.
pub const LONGEST_HEADING: usize = 200;

/// Rows that cannot be read, before the rest of a table is left unread.
pub const MOST_BAD_ROWS: usize = 100;

/// Faults of the syntax of a TOML file that are listed.
pub(crate) const MOST_SYNTAX_FAULTS: usize = 100;

/// Characters of a message or a hint.
pub const LONGEST_MESSAGE: usize = 2_000;

/// Characters that remain at the end of a message that is cut, so that what is said after a quotation remains.
const KEPT_AT_THE_END: usize = 400;

/// A text of at most [`LONGEST_MESSAGE`] characters: of a longer one its beginning and its end.
///
/// ```
/// use trueaxis_input::limits::{LONGEST_MESSAGE, cut};
/// let long = format!("`{}` is not a finite number", "µ".repeat(5_000));
/// let shown = cut(&long);
/// assert_eq!(shown.chars().count(), LONGEST_MESSAGE);
/// assert!(shown.starts_with("`µ") && shown.contains('…') && shown.ends_with("not a finite number"));
/// assert_eq!(cut("as it is"), "as it is");
/// ```
pub fn cut(text: &str) -> Cow<'_, str> {
    // No text has more characters than bytes.
    if text.len() <= LONGEST_MESSAGE {
        return Cow::Borrowed(text);
    }
    let count = text.chars().count();
    if count <= LONGEST_MESSAGE {
        return Cow::Borrowed(text);
    }
    let beginning = text.chars().take(LONGEST_MESSAGE - KEPT_AT_THE_END - 1);
    let end = text.chars().skip(count - KEPT_AT_THE_END);
    Cow::Owned(beginning.chain(['…']).chain(end).collect())
}

/// The beginning of a name from a file, for a message.
pub(crate) fn beginning(name: &str) -> String {
    name.chars().take(60).chain(['…']).collect()
}

/// The first place where a TOML text passes a limit, and what it passes. One pass over the bytes that knows texts
/// and comments, and nothing of the grammar.
pub(crate) fn toml_excess(text: &str) -> Option<(usize, String)> {
    if text.len() > MOST_TOML_BYTES {
        return Some((0, format!("the file has more than {} MB", MOST_TOML_BYTES >> 20)));
    }
    let mut scan = Scan::default();
    let bytes = text.as_bytes();
    while scan.at < bytes.len() {
        scan.step(bytes);
        let passed = [
            (scan.lines >= MOST_TOML_LINES, MOST_TOML_LINES, "lines"),
            (scan.words > MOST_TOML_WORDS, MOST_TOML_WORDS, "words and signs"),
            (scan.open + scan.dots > DEEPEST_TOML, DEEPEST_TOML, "tables or lists in each other"),
        ];
        if let Some((_, most, what)) = passed.into_iter().find(|(is_passed, ..)| *is_passed) {
            return Some((
                scan.at.min(text.len()),
                format!("the file has more than {most} {what}"),
            ));
        }
    }
    None
}

/// What was counted up to a byte.
#[derive(Default)]
struct Scan {
    at: usize,
    lines: usize,
    words: usize,
    /// Brackets and braces that are open.
    open: usize,
    /// Points since the last sign that ends a key: each is a table in the one before.
    dots: usize,
    in_word: bool,
}

impl Scan {
    /// One sign, text or comment.
    fn step(&mut self, bytes: &[u8]) {
        let byte = bytes[self.at];
        let was_in_word = std::mem::take(&mut self.in_word);
        match byte {
            b'#' => return self.pass(bytes, |rest| rest.iter().position(|b| *b == b'\n')),
            b'"' | b'\'' => {
                self.words += 1;
                return self.text(bytes, byte);
            }
            b'\n' => (self.lines, self.dots) = (self.lines + 1, 0),
            b'[' | b'{' => (self.words, self.open, self.dots) = (self.words + 1, self.open + 1, 0),
            b']' | b'}' => {
                (self.words, self.dots) = (self.words + 1, 0);
                self.open = self.open.saturating_sub(1);
            }
            b'=' | b',' => (self.words, self.dots) = (self.words + 1, 0),
            b'.' => (self.words, self.dots) = (self.words + 1, self.dots + 1),
            b' ' | b'\t' | b'\r' => {}
            _ => {
                self.words += usize::from(!was_in_word);
                self.in_word = true;
            }
        }
        self.at += 1;
    }

    /// A text in quotes of either kind, on one line or, between three of them, on many.
    fn text(&mut self, bytes: &[u8], quote: u8) {
        let three = [quote; 3];
        let is_long = bytes[self.at..].starts_with(&three);
        self.at += if is_long { 3 } else { 1 };
        while let Some(byte) = bytes.get(self.at) {
            match *byte {
                b'\\' if quote == b'"' => self.at += 1,
                b'\n' if !is_long => return,
                b'\n' => self.lines += 1,
                b if b == quote && !is_long => {
                    self.at += 1;
                    return;
                }
                b if b == quote && bytes[self.at..].starts_with(&three) => {
                    self.at += 3;
                    return;
                }
                _ => {}
            }
            self.at += 1;
        }
    }

    /// On to where something is found in the rest, or to the end.
    fn pass(&mut self, bytes: &[u8], found: impl Fn(&[u8]) -> Option<usize>) {
        self.at = found(&bytes[self.at..]).map_or(bytes.len(), |by| self.at + by);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn excess(text: &str) -> Option<String> {
        toml_excess(text).map(|(_, what)| what)
    }

    #[test]
    fn each_limit_is_passed_by_one() {
        let lines = |n: usize| "a\n".repeat(n);
        assert_eq!(excess(&lines(MOST_TOML_LINES - 1)), None);
        assert!(excess(&lines(MOST_TOML_LINES)).unwrap().contains("100000 lines"));
        let nested = |n: usize| format!("a = {}1{}", "[".repeat(n), "]".repeat(n));
        assert_eq!(excess(&nested(DEEPEST_TOML)), None);
        assert!(excess(&nested(DEEPEST_TOML + 1)).unwrap().contains("32 tables or lists"));
        // A key with points is a table in each other, too, and a list on one line has many words.
        assert!(excess(&format!("{}b = 1", "a.".repeat(DEEPEST_TOML + 1))).is_some());
        let list = |n: usize| format!("a=[{}]", "1,".repeat(n));
        assert_eq!(excess(&list((MOST_TOML_WORDS - 4) / 2)), None);
        assert!(excess(&list(MOST_TOML_WORDS / 2)).unwrap().contains("words"));
        assert!(excess(&" ".repeat(MOST_TOML_BYTES + 1)).unwrap().contains("16 MB"));
    }

    #[test]
    fn texts_and_comments_hide_signs_but_not_lines() {
        let signs = "[{.".repeat(50);
        for quiet in [
            format!("# {signs}\na = 1\n"),
            format!("a = \"{signs}\\\"{signs}\"\n"),
            format!("a = '{signs}\\'\nb = 1\n"),
            format!("a = \"\"\"{signs}\n\"{signs}\\\"\"\"\"\n"),
            format!("a = '''{signs}\n''{signs}'''\n"),
        ] {
            assert_eq!(excess(&quiet), None, "{quiet}");
        }
        // The text has ended: what stands after it counts again.
        assert!(excess(&format!("a = '''x''' {signs}")).is_some());
        assert!(excess(&format!("a = \"open\n{signs}")).is_some());
        assert!(excess(&format!("a = '''{}'''", "\n".repeat(MOST_TOML_LINES))).is_some());
    }

    #[test]
    fn real_forms_are_far_from_the_limits() {
        let text =
            "[axis.X]\ntravel = [\"0 mm\", \"500 mm\"]\n[error.X]\nEXX = { table = \"a.csv\" }\n";
        assert_eq!(excess(&text.repeat(1_000)), None);
    }
}
