//! The text that is rewritten line by line; all other bytes stay.

use super::computed::any_at;
use super::line_table::LineTable;
use super::number::Unit;
use super::words::Words;
use std::collections::BTreeMap;
use std::io;
use std::ops::Range;
use trueaxis_input::{Content, Draft, Files};
use trueaxis_nc::Control;

/// What became of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Line {
    /// Not executed, or without a move.
    AsItWas,
    /// Executed, and nothing had to be changed.
    Seen,
    /// Other text.
    Changed,
}

/// Other text for a line, with its line ends; how many lines, and how many of them stand before the block.
#[derive(Debug, Clone, PartialEq)]
struct Change {
    text: Box<[u8]>,
    count: u32,
    first: u32,
}

/// A program that is being rewritten: its new text grows line by line, in the order of the lines.
pub(super) struct Text<'p> {
    table: &'p LineTable<'p>,
    lines: Vec<Line>,
    /// The new text of the first lines, where each of them begins in it, and its new number.
    out: Box<dyn Draft>,
    places: Vec<usize>,
    numbers: Vec<u32>,
    /// Used again line by line.
    room: Vec<u8>,
    /// The number of the next line of the new text.
    number: u32,
    /// Lines that were executed after later ones.
    late: BTreeMap<usize, Change>,
    /// Stands before the line with this index.
    comment: (usize, String),
    /// The last line that was examined for what lasts, and what lasts there.
    modes: (usize, Modes),
    has_modes: bool,
    /// What lasts follows the execution, which may jump, and not the order of the lines.
    executed: bool,
}

/// Changes of one line: what stands in a range becomes other text. Used again line by line, it allocates nothing.
#[derive(Debug, Clone, Default)]
pub(super) struct Edits {
    /// What is replaced, and where the text for it stands in `text`.
    places: Vec<(Range<usize>, Range<usize>)>,
    text: String,
}

impl Edits {
    pub fn put(&mut self, range: Range<usize>, text: &str) {
        self.put_with(range, |out| out.push_str(text));
    }

    /// With a text that is written at once.
    pub fn put_with(&mut self, range: Range<usize>, write: impl FnOnce(&mut String)) {
        let from = self.text.len();
        write(&mut self.text);
        self.places.push((range, from..self.text.len()));
    }

    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    pub fn clear(&mut self) {
        self.places.clear();
        self.text.clear();
    }

    pub fn applied(mut self, source: &[u8], line: Range<usize>) -> Vec<u8> {
        let mut out = Vec::with_capacity(line.len() + 32);
        self.apply(source, line, &mut out);
        out
    }

    fn apply(&mut self, source: &[u8], line: Range<usize>, out: &mut Vec<u8>) {
        // Stable: what is put at one place keeps its order.
        self.places.sort_by_key(|(range, _)| range.start);
        let mut at = line.start;
        for (range, text) in &self.places {
            out.extend_from_slice(&source[at..range.start.max(at)]);
            out.extend_from_slice(self.text[text.clone()].as_bytes());
            at = range.end.max(at);
        }
        out.extend_from_slice(&source[at..line.end]);
    }
}

/// What lasts from line to line.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Modes {
    /// G91.
    pub incremental: bool,
    pub unit: Unit,
    pub feed_unit: Unit,
}

impl Modes {
    pub fn follow(&mut self, words: &Words) {
        self.incremental = words.incremental.unwrap_or(self.incremental);
        self.unit = words.unit.unwrap_or(self.unit);
        self.feed_unit = words.feed_unit.unwrap_or(self.feed_unit);
    }
}

/// Whether there may be a word that changes what lasts.
fn has_modes(source: &[u8]) -> bool {
    const WORDS: [&[u8]; 4] = [b"G91", b"G20", b"G70", b"INCH"];
    let begins = |i: usize, word: &[u8]| {
        source.get(i..i + word.len()).is_some_and(|w| w.eq_ignore_ascii_case(word))
    };
    let is_first = |byte: u8| matches!(byte, b'G' | b'g' | b'I' | b'i');
    any_at(source, is_first, |i| WORDS.iter().any(|word| begins(i, word)))
}

impl<'p> Text<'p> {
    /// With a comment after its heading, put together where `files` keep long texts.
    pub fn of(table: &'p LineTable<'p>, comment: String, files: &Files) -> Self {
        let (count, has_modes) = (table.count(), has_modes(table.source()));
        let mut text = Self {
            table,
            lines: vec![Line::AsItWas; count],
            out: files.draft(table.source().len() + 256),
            places: Vec::with_capacity(count),
            numbers: Vec::with_capacity(count),
            room: Vec::new(),
            number: 1,
            late: BTreeMap::new(),
            comment: (0, comment),
            modes: (0, Modes::default()),
            has_modes,
            executed: false,
        };
        text.comment.0 = text.heading();
        text
    }

    pub fn control(&self) -> Control {
        self.table.program().dialect().control
    }

    pub fn source(&self) -> &'p [u8] {
        self.table.source()
    }

    /// A block is executed.
    pub fn execute(&mut self, block: &Range<usize>) {
        self.executed = true;
        if self.has_modes {
            let (source, dialect) = (self.source(), self.table.program().dialect());
            self.modes.1.follow(&Words::read(source, dialect, block.clone()));
        }
    }

    /// Makes the words of a line from 1, which are read already, lengths in mm; what lasts there.
    pub fn words(&mut self, line: u32, read: &mut Words) -> Modes {
        let index = line as usize;
        if self.has_modes && !self.executed && index > self.modes.0 {
            for number in self.modes.0 + 1..=index {
                self.modes.1.follow(&self.table.words(number as u32));
            }
            self.modes.0 = index;
        }
        read.scale(self.modes.1.unit);
        self.modes.1
    }

    /// The line was executed and stays as it is; `false` if it was changed before.
    pub fn keep(&mut self, line: u32) -> bool {
        let at = &mut self.lines[line as usize - 1];
        match at {
            Line::AsItWas => *at = Line::Seen,
            Line::Seen => {}
            Line::Changed => return false,
        }
        true
    }

    /// The line is changed and others follow it; `false` if it was executed before with another
    /// outcome.
    pub fn change(
        &mut self,
        line: u32,
        edits: &mut Edits,
        [before, further]: [&[String]; 2],
    ) -> bool {
        let index = line as usize - 1;
        let is_first = self.lines[index] == Line::AsItWas;
        if !is_first && self.lines[index] == Line::Seen {
            return false;
        }
        self.lines[index] = Line::Changed;
        let first = before.len() as u32;
        let count = first + 1 + further.len() as u32;
        if index >= self.places.len() {
            self.reach(index);
            let mut room = std::mem::take(&mut self.room);
            self.put(line, edits, [before, further], &mut room);
            self.out.put(&room);
            room.clear();
            self.room = room;
            self.done(count, first);
            return true;
        }
        let mut text = Vec::new();
        self.put(line, edits, [before, further], &mut text);
        if is_first {
            self.late.insert(index, Change { text: text.into(), count, first });
            return true;
        }
        text == self.changed(index)
    }

    /// The changed line, and the others.
    fn put(
        &self,
        line: u32,
        edits: &mut Edits,
        [before, further]: [&[String]; 2],
        out: &mut Vec<u8>,
    ) {
        let ending = self.table.ending(line);
        let between: &[u8] = if ending.is_empty() { b"\n" } else { ending };
        for first in before {
            out.extend_from_slice(first.as_bytes());
            out.extend_from_slice(between);
        }
        edits.apply(self.source(), self.table.line(line), out);
        for more in further {
            out.extend_from_slice(between);
            out.extend_from_slice(more.as_bytes());
        }
        out.extend_from_slice(ending);
    }

    /// The new text of a line that was changed.
    fn changed(&self, index: usize) -> Vec<u8> {
        if let Some(change) = self.late.get(&index) {
            return change.text.to_vec();
        }
        let end = self.places.get(index + 1).copied().unwrap_or(self.out.length());
        let mut text = self.out.read(self.places[index]..end);
        // The comment is no part of the line before it.
        let comment = if self.comment.0 == index + 1 { self.heading_comment() } else { Vec::new() };
        if text.ends_with(&comment) {
            text.truncate(text.len() - comment.len());
        }
        text
    }

    fn heading_comment(&self) -> Vec<u8> {
        let ending = if self.table.count() == 1 { b"\n" } else { self.table.ending(1) };
        [self.comment.1.as_bytes(), ending].concat()
    }

    /// The lines before an index stay as they were.
    fn reach(&mut self, index: usize) {
        loop {
            let at = self.places.len();
            if at == self.comment.0 {
                let comment = self.heading_comment();
                self.out.put(&comment);
                self.number += 1;
            }
            self.places.push(self.out.length());
            if at >= index {
                return;
            }
            let line = &self.table.source()[self.table.whole(at)];
            self.out.put(line);
            self.done(1, 0);
        }
    }

    /// A line is written: as so many lines, so many of them before the block.
    fn done(&mut self, count: u32, first: u32) {
        self.numbers.push(self.number + first);
        self.number += count;
    }

    /// Whether the line was executed already.
    pub fn was_executed(&self, line: u32) -> bool {
        self.lines[line as usize - 1] != Line::AsItWas
    }

    /// The new text, and the new number of each line.
    ///
    /// # Errors
    /// What the disk says, if the text is kept there.
    pub fn finish(mut self, files: &Files) -> io::Result<(Content, Vec<u32>)> {
        if self.places.len() < self.table.count() {
            self.reach(self.table.count());
        }
        let mut numbers = std::mem::take(&mut self.numbers);
        let written = self.out.finish()?;
        if self.late.is_empty() {
            return Ok((written, numbers));
        }
        let mut shift = 0;
        for (index, number) in numbers.iter_mut().enumerate() {
            *number += shift;
            if let Some(change) = self.late.get(&index) {
                *number += change.first;
                shift += change.count - 1;
            }
        }
        let (mut out, mut from) = (files.draft(written.len()), 0);
        for (index, change) in &self.late {
            // They were written as they were.
            let place = self.places[*index];
            out.put(&written[from..place]);
            out.put(&change.text);
            from = place + self.table.whole(*index).len();
        }
        out.put(&written[from..]);
        Ok((out.finish()?, numbers))
    }

    /// Lines that have to stand first: tape marks, program numbers and names.
    fn heading(&self) -> usize {
        let is_heading = |line: usize| {
            let range = self.table.line(line as u32 + 1);
            let text = String::from_utf8_lossy(&self.source()[range]).trim().to_ascii_uppercase();
            let number =
                |t: &str| t.starts_with('O') && t[1..].starts_with(|c: char| c.is_ascii_digit());
            text.is_empty()
                || text.starts_with('%')
                || text.starts_with(";$PATH")
                || number(&text)
                || text.contains("BEGIN PGM")
        };
        (0..self.table.count().min(20)).find(|i| !is_heading(*i)).unwrap_or(0)
    }
}
