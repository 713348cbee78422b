//! Reading of TOML: every problem is collected with its place.

use crate::limits::{MOST_SYNTAX_FAULTS, toml_excess};
use crate::plausible::{Limits, Quantity, Seen};
use crate::{
    Date, Diagnostic, Diagnostics, Dimension, Files, MeasuredValue, Place, QuantityError, Severity,
    Unit, parse_measured, parse_quantity,
};
use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A TOML text that is being read. Problems are collected, each with its place, and returned by
/// [`SourceText::finish`].
///
/// ```
/// use trueaxis_input::{Dimension, SourceText};
/// let source = SourceText::new("tool.toml", "length = '100 mm'\nwidht = '3 mm'");
/// let length = source.read(|root| root.quantity("length", Dimension::Length));
/// assert_eq!(length, Some(100.0));
/// let problems = source.finish();
/// assert_eq!(problems.iter().next().unwrap().code, "unknown-key");
/// ```
#[derive(Debug)]
pub struct SourceText<'a> {
    file: &'a str,
    text: &'a str,
    /// The files that the text may name.
    files: Files,
    /// Byte offset where each line begins.
    line_starts: Vec<usize>,
    /// The last place that was determined, as byte offset and column: most places are needed in
    /// the order of the text, and a long line is then counted only once.
    last: Cell<(usize, usize)>,
    /// Why the text is not parsed, if it is beyond a limit.
    excess: Option<Diagnostic>,
    problems: RefCell<Diagnostics>,
    /// Those of `[plausible]`.
    limits: Cell<Limits>,
}

impl<'a> SourceText<'a> {
    /// A text and the name of its file, without access to the files that it names.
    pub fn new(file: &'a str, text: &'a str) -> Self {
        Self::from(&Files::none(), file, text)
    }

    /// A text, the name of its file, and where the files that it names are read from.
    /// One beyond the limits of [`limits`](crate::limits) is not parsed: it reads as an empty one, and that is its
    /// only problem.
    pub fn from(files: &Files, file: &'a str, text: &'a str) -> Self {
        let excess = toml_excess(text).map(|(at, message)| over_limit(file, text, at, &message));
        let text = if excess.is_some() { "" } else { text };
        let line_starts =
            std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let (files, last) = (files.clone(), Cell::new((0, 1)));
        let (problems, limits) = (RefCell::default(), Cell::default());
        Self { file, text, files, line_starts, last, excess, problems, limits }
    }

    /// As [`Place::of`], in a time that does not grow with the size of the file.
    fn place(&self, offset: usize) -> Place {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.line_starts.partition_point(|start| *start <= offset);
        let start = self.line_starts[line - 1];
        let (from, known) = match self.last.get() {
            last if (start..=offset).contains(&last.0) => last,
            _ => (start, 1),
        };
        let column = known + self.text[from..offset].chars().count();
        self.last.set((offset, column));
        Place { file: self.file.to_owned(), line, column }
    }

    /// Parses the text and hands its root to `reader`; syntax errors are kept as problems.
    pub fn read<T>(&self, reader: impl FnOnce(&Section<'_>) -> T) -> T {
        let (root, errors) = DeTable::parse_recoverable(self.text);
        if errors.len() > MOST_SYNTAX_FAULTS {
            let message =
                format!("{} faults; the first {MOST_SYNTAX_FAULTS} are listed", errors.len());
            let place = Place::whole(self.file);
            self.problems.borrow_mut().note(
                "too-many-problems",
                place,
                message,
                "correct the first ones; the others may follow from them",
            );
        }
        for error in errors.into_iter().take(MOST_SYNTAX_FAULTS) {
            let at = error.span().unwrap_or(0..0);
            let message = error.message().to_owned();
            self.error(
                "toml-syntax",
                at,
                message,
                "the file must be TOML 1.1, as the files in machines/",
            );
        }
        let section = Section::new(self, String::new(), root.span(), root.get_ref());
        // Before everything else, wherever it stands.
        if let Some(limits) = section.section("plausible", Limits::read) {
            self.limits.set(limits);
        }
        let result = reader(&section);
        section.report_unknown_keys();
        result
    }

    /// All problems found.
    pub fn finish(self) -> Diagnostics {
        match self.excess {
            Some(excess) => {
                let mut only = Diagnostics::new();
                only.add(excess);
                only
            }
            None => self.problems.into_inner(),
        }
    }

    fn error(&self, code: &'static str, span: Range<usize>, message: String, hint: &str) {
        let place = self.place(span.start);
        self.problems.borrow_mut().error(code, place, message, hint);
    }
}

/// The problem of a text that is not parsed.
fn over_limit(file: &str, text: &str, at: usize, message: &str) -> Diagnostic {
    let hint = "check whether this is the intended file; rows of numbers belong into a CSV table that the file names";
    Diagnostic {
        code: "over-limit",
        severity: Severity::Error,
        place: Place::of(file, text, at),
        message: format!("{message}: so large a TOML file is not read"),
        hint: hint.to_owned(),
    }
}

/// A value of a TOML file with its key path and place.
#[derive(Debug, Clone, Copy)]
pub struct Item<'s> {
    source: &'s SourceText<'s>,
    value: &'s Spanned<DeValue<'s>>,
}

impl<'s> Item<'s> {
    /// The files that the text may name.
    pub fn files(&self) -> &'s Files {
        &self.source.files
    }

    /// The place of the value in the file.
    pub fn place(&self) -> Place {
        self.source.place(self.value.span().start)
    }

    /// Adds an error about this value.
    pub fn error(&self, code: &'static str, message: String, hint: &str) {
        self.source.error(code, self.value.span(), message, hint);
    }

    /// Adds a warning about this value.
    pub fn warn(&self, code: &'static str, message: String, hint: &str) {
        self.source.problems.borrow_mut().warn(code, self.place(), message, hint);
    }

    /// The string; `None` and a problem if the value is of another type.
    pub fn text(&self) -> Option<&'s str> {
        let text = self.value.get_ref().as_str();
        if text.is_none() {
            self.expected("a text in quotes", "write it in quotes, such as \"100 mm\"");
        }
        text
    }

    /// The string, if it is one.
    pub fn as_text(&self) -> Option<&'s str> {
        self.value.get_ref().as_str()
    }

    /// A quantity in its inner unit; `None` and a problem if it is not one of this dimension. One that no
    /// machine has is reported too: [`Quantity::of`] the dimension.
    pub fn quantity(&self, dimension: Dimension) -> Option<f64> {
        let possible = |v: &f64| Quantity::of(dimension).is_none_or(|q| self.is_possible(q, *v));
        self.unjudged(dimension).filter(possible)
    }

    /// A quantity with an optional standard uncertainty, both in the inner unit; `None` and a
    /// problem if it is not one of this dimension.
    pub fn measured(&self, dimension: Dimension) -> Option<MeasuredValue> {
        let possible = |v: &MeasuredValue| {
            Quantity::of(dimension).is_none_or(|q| self.is_possible(q, v.value))
        };
        self.measured_unjudged(dimension).filter(possible)
    }

    /// A quantity that has a range of its own, in its inner unit; `None` and a problem if it is far outside.
    pub fn quantity_of(&self, quantity: Quantity) -> Option<f64> {
        self.unjudged(quantity.dimension()).filter(|v| self.is_possible(quantity, *v))
    }

    /// As [`Item::quantity_of`], with an optional standard uncertainty.
    pub fn measured_of(&self, quantity: Quantity) -> Option<MeasuredValue> {
        let value = self.measured_unjudged(quantity.dimension());
        value.filter(|v| self.is_possible(quantity, v.value))
    }

    /// As [`Item::quantity`], of any size.
    pub fn unjudged(&self, dimension: Dimension) -> Option<f64> {
        match self.value.get_ref() {
            DeValue::String(text) => self.accept(parse_quantity(text, dimension)),
            _ => self.plain_number(dimension),
        }
    }

    /// As [`Item::measured`], of any size.
    pub fn measured_unjudged(&self, dimension: Dimension) -> Option<MeasuredValue> {
        match self.value.get_ref() {
            DeValue::String(text) => self.accept(parse_measured(text, dimension)),
            _ => self.plain_number(dimension).map(|value| MeasuredValue { value, u: None }),
        }
    }

    /// Reports a value, in its inner unit, that is outside its range; `false` if it is refused.
    pub fn is_possible(&self, quantity: Quantity, value: f64) -> bool {
        let limits = self.source.limits.get();
        let name = self.as_text().unwrap_or(quantity.range().key);
        let seen = Seen::one(name, value);
        // The place is only determined where there is something to report: it takes time.
        if limits.standing(quantity, value) == crate::plausible::Standing::Plausible {
            return true;
        }
        let place = self.place();
        limits.judge(quantity, &seen, &place, &mut self.source.problems.borrow_mut())
    }

    /// The ranges of the file: [`Limits::read`].
    pub fn limits(&self) -> Limits {
        self.source.limits.get()
    }

    /// A finite number (integer or float) without unit; `None` and a problem otherwise.
    pub fn number(&self) -> Option<f64> {
        let parsed = match self.value.get_ref() {
            // An integer of more than 64 bits is read as a float: finite, though too large.
            DeValue::Integer(i) => i64::from_str_radix(i.as_str(), i.radix())
                .map_or_else(|_| i.as_str().parse::<f64>(), |v| Ok(v as f64))
                .ok(),
            DeValue::Float(f) => f.as_str().parse::<f64>().ok(),
            _ => {
                self.expected("a number", "write a plain number without quotes, such as 1");
                return None;
            }
        };
        match parsed {
            Some(value) if value.is_finite() => Some(value),
            _ => {
                self.error(
                    "not-finite",
                    "the number is not finite".into(),
                    "write a finite number",
                );
                None
            }
        }
    }

    /// A whole number from 0 to 10¹²; `None` and a problem otherwise.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked: whole and from 0 to 10^12"
    )]
    pub fn count(&self) -> Option<usize> {
        let value = self.number()?;
        // Exact in a double, and small enough for a loop over it to end.
        if value.fract() == 0.0 && (0.0..=1e12).contains(&value) {
            return Some(value as usize);
        }
        let message = format!("expected a whole number from 0 to 10^12, found {value}");
        self.error("bad-count", message, "write a number such as 0 or 12");
        None
    }

    /// `true` or `false`; `None` and a problem otherwise.
    pub fn flag(&self) -> Option<bool> {
        let flag = self.value.get_ref().as_bool();
        if flag.is_none() {
            self.expected("true or false", "write true or false without quotes");
        }
        flag
    }

    /// The elements of an array; `None` and a problem if the value is of another type.
    pub fn list(&self) -> Option<Vec<Item<'s>>> {
        let DeValue::Array(array) = self.value.get_ref() else {
            self.expected("a list in brackets", "write [\"…\", \"…\"]");
            return None;
        };
        Some(array.iter().map(|value| Item { source: self.source, value }).collect())
    }

    /// Whether this is a list.
    pub fn is_list(&self) -> bool {
        self.value.get_ref().is_array()
    }

    /// Whether this is a table.
    pub fn is_table(&self) -> bool {
        self.value.get_ref().is_table()
    }

    /// Reads the value as a table. Keys that `reader` did not ask for are reported as unknown.
    pub fn section<T>(&self, name: &str, reader: impl FnOnce(&Section<'s>) -> T) -> Option<T> {
        let DeValue::Table(table) = self.value.get_ref() else {
            self.expected(
                "a table",
                "write it as a section in [brackets] or as { key = \"value\" }",
            );
            return None;
        };
        let section = Section::new(self.source, name.to_owned(), self.value.span(), table);
        let result = reader(&section);
        section.report_unknown_keys();
        Some(result)
    }

    fn plain_number(&self, dimension: Dimension) -> Option<f64> {
        let is_number = matches!(self.value.get_ref(), DeValue::Integer(_) | DeValue::Float(_));
        if dimension != Dimension::Ratio && !is_number {
            self.expected(
                &dimension.to_string(),
                "write it in quotes with its unit, such as \"10 ± 2 um\"",
            );
            return None;
        }
        let value = self.number()?;
        // Only a ratio may be a plain number: everything else needs its unit.
        self.accept(match dimension {
            Dimension::Ratio => Unit::find("", dimension).and_then(|one| one.checked(value)),
            _ => Err(QuantityError::NoUnit(dimension)),
        })
    }

    fn accept<T>(&self, parsed: Result<T, QuantityError>) -> Option<T> {
        parsed.map_err(|e| self.error(e.code(), e.to_string(), &e.hint())).ok()
    }

    fn expected(&self, what: &str, hint: &str) {
        let found = match self.value.get_ref() {
            DeValue::String(_) => "a text",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.error("wrong-type", format!("expected {what} here, found {found}"), hint);
    }

    /// A date as it was written; what is none is refused.
    pub fn date(&self) -> Option<String> {
        let text = self.date_or_text()?;
        if Date::parse(&text).is_some() {
            return Some(text);
        }
        let message = format!("`{text}` is not a date");
        self.error("bad-date", message, DATE_HINT);
        None
    }

    /// A date as it was written, or a text.
    pub fn date_or_text(&self) -> Option<String> {
        match self.value.get_ref() {
            DeValue::Datetime(date) => Some(date.to_string()),
            _ => self.text().map(str::to_owned),
        }
    }
}

/// How dates are written.
pub const DATE_HINT: &str = "2026-03-14, or \"14.03.2026\"";

/// A table of a TOML file. It records which keys were asked for and reports the others as unknown.
#[derive(Debug)]
pub struct Section<'s> {
    source: &'s SourceText<'s>,
    name: String,
    span: Range<usize>,
    table: &'s DeTable<'s>,
    asked: RefCell<BTreeSet<String>>,
    /// How many problems there were when a key was asked for last.
    problems_then: Cell<usize>,
}

impl<'s> Section<'s> {
    fn new(
        source: &'s SourceText<'s>,
        name: String,
        span: Range<usize>,
        table: &'s DeTable<'s>,
    ) -> Self {
        let problems_then = Cell::new(source.problems.borrow().count());
        Self { source, name, span, table, asked: RefCell::default(), problems_then }
    }

    /// The files that the text may name.
    pub fn files(&self) -> &'s Files {
        &self.source.files
    }

    /// The ranges of the file: [`Limits::read`].
    pub fn limits(&self) -> Limits {
        self.source.limits.get()
    }

    /// An optional quantity that has a range of its own, in its inner unit.
    pub fn quantity_of(&self, key: &str, quantity: Quantity) -> Option<f64> {
        self.get(key)?.quantity_of(quantity)
    }

    /// The name of the section, such as `axis.X`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The place where the section begins.
    pub fn place(&self) -> Place {
        self.source.place(self.span.start)
    }

    /// Adds an error about the section as a whole.
    pub fn error(&self, code: &'static str, message: String, hint: &str) {
        self.source.error(code, self.span.clone(), message, hint);
    }

    /// Adds a warning about the section as a whole.
    pub fn warn(&self, code: &'static str, message: String, hint: &str) {
        self.source.problems.borrow_mut().warn(code, self.place(), message, hint);
    }

    /// Adds problems found elsewhere, such as in a CSV table that this section names.
    pub fn take_over(&self, problems: Diagnostics) {
        self.source.problems.borrow_mut().append(problems);
    }

    /// The value of a key, if it is there.
    pub fn get(&self, key: &str) -> Option<Item<'s>> {
        self.asked.borrow_mut().insert(key.to_owned());
        self.problems_then.set(self.source.problems.borrow().count());
        self.table.get(key).map(|value| Item { source: self.source, value })
    }

    /// The value of a key; `None` and a problem with this hint if it is missing.
    pub fn require(&self, key: &str, hint: &str) -> Option<Item<'s>> {
        let item = self.get(key);
        if item.is_none() {
            let place = if self.name.is_empty() { "the file".into() } else { self.heading() };
            self.error("missing-key", format!("missing entry `{key}` in {place}"), hint);
        }
        item
    }

    /// An optional text.
    pub fn text(&self, key: &str) -> Option<&'s str> {
        self.get(key)?.text()
    }

    /// An optional quantity in its inner unit.
    pub fn quantity(&self, key: &str, dimension: Dimension) -> Option<f64> {
        self.get(key)?.quantity(dimension)
    }

    /// An optional sub-section.
    pub fn section<T>(&self, key: &str, reader: impl FnOnce(&Section<'s>) -> T) -> Option<T> {
        self.get(key)?.section(&self.path(key), reader)
    }

    /// All keys with their places and values, in the order of the file; none is reported as unknown.
    pub fn entries(&self) -> Vec<(&'s str, Place, Item<'s>)> {
        let mut entries: Vec<_> = self.table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        entries
            .into_iter()
            .map(|(key, value)| {
                let name: &'s str = key.get_ref();
                self.asked.borrow_mut().insert(name.to_owned());
                let place = self.source.place(key.span().start);
                (name, place, Item { source: self.source, value })
            })
            .collect()
    }

    /// Adds an error at a place from [`Section::entries`].
    pub fn error_at(&self, place: Place, code: &'static str, message: String, hint: &str) {
        self.source.problems.borrow_mut().error(code, place, message, hint);
    }

    /// The key path of a sub-key.
    pub fn path(&self, key: &str) -> String {
        if self.name.is_empty() { key.to_owned() } else { format!("{}.{key}", self.name) }
    }

    fn heading(&self) -> String {
        format!("[{}]", self.name)
    }

    /// A reader that meets an error may give up: keys that it would have asked for after it are not unknown. Where
    /// an error came after the last key that was asked for, only what looks like one of the known keys is named.
    fn report_unknown_keys(&self) {
        let gave_up = self.source.problems.borrow().has_errors_from(self.problems_then.get());
        let mut asked = self.asked.borrow_mut();
        // Every file may have it; it is named where it is described.
        if self.name.is_empty() && !self.table.contains_key("plausible") {
            asked.remove("plausible");
        }
        let misspelt = |key: &str| {
            asked
                .iter()
                .any(|known| !self.table.contains_key(known.as_str()) && is_nearly(key, known))
        };
        for (key, _) in self.table.iter().filter(|(k, _)| !asked.contains(k.get_ref().as_ref())) {
            if gave_up && !misspelt(key.get_ref()) {
                continue;
            }
            let known = asked.iter().map(String::as_str).collect::<Vec<_>>().join(", ");
            self.source.error(
                "unknown-key",
                key.span(),
                format!("unknown entry `{}`", self.path(key.get_ref())),
                &format!("known entries: {known}"),
            );
        }
    }
}

/// Whether one word becomes the other by one letter more, less, other, or exchanged with the next one.
fn is_nearly(a: &str, b: &str) -> bool {
    let [a, b] =
        [a, b].map(|word| word.chars().map(|c| c.to_ascii_lowercase()).collect::<Vec<_>>());
    let same = |pair: &(&char, &char)| pair.0 == pair.1;
    let head = a.iter().zip(&b).take_while(same).count();
    let most = a.len().min(b.len()) - head;
    let tail = a.iter().rev().zip(b.iter().rev()).take(most).take_while(same).count();
    match [&a, &b].map(|word| &word[head..word.len() - tail]) {
        [[], []] | [[_], []] | [[], [_]] | [[_], [_]] => true,
        [[c, d], [e, f]] => c == f && d == e,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::MOST_TOML_LINES;

    /// Two megabytes of lines without a value took 1.6 GB when each was a problem of its own.
    #[test]
    fn a_text_beyond_a_limit_is_not_parsed() {
        let text = "a\n".repeat(1 << 20);
        let source = SourceText::new("m.toml", &text);
        let name = source.read(|root| root.require("name", "a text").is_some());
        let problems = source.finish();
        let all: Vec<_> = problems.iter().map(|d| (d.code, d.place.line)).collect();
        assert_eq!((name, all), (false, vec![("over-limit", MOST_TOML_LINES + 1)]));
    }

    /// What a reader had asked for, had it not given up, is not blamed; what it had not, and a slip of the pen, are.
    #[test]
    fn keys_beside_a_wrong_one_are_not_blamed() {
        let codes = |text: &str, gives_up: bool| -> Vec<(&'static str, usize)> {
            let source = SourceText::new("m.toml", text);
            source.read(|root| {
                let tool = root.section("tool", |tool| {
                    let length = tool.quantity("length", Dimension::Length);
                    if gives_up && length.is_none() {
                        return None;
                    }
                    tool.quantity("diameter", Dimension::Length)
                });
                if tool.flatten().is_some() {
                    root.get("name");
                }
            });
            source.finish().iter().map(|p| (p.code, p.place.line)).collect()
        };
        let wrong = ("wrong-unit", 2);
        let text = "tool.diameter = '9 mm'\ntool.length = '1 s'\nname = 'a'\n";
        assert_eq!(codes(text, true), [wrong]);
        assert_eq!(codes(text, false), [wrong]);
        // The reader has gone on: the key is not one of its own.
        let more = format!("{text}tool.colour = 'red'\n");
        assert_eq!(codes(&more, false), [wrong, ("unknown-key", 4)]);
        assert_eq!(codes(&more, true), [wrong]);
        let misspelt = "tool.lenght = '1 mm'\ntool.diameter = '9 s'\n";
        assert_eq!(codes(misspelt, false), [("wrong-unit", 2), ("unknown-key", 1)]);
    }

    #[test]
    fn words_that_are_nearly_the_same() {
        for (a, b) in [
            ("widht", "width"),
            ("lenth", "length"),
            ("Name", "name"),
            ("axiss", "axis"),
            ("feet", "feed"),
        ] {
            assert!(is_nearly(a, b) && is_nearly(b, a), "{a} {b}");
        }
        for (a, b) in [("colour", "length"), ("speed", "feed"), ("table", "stylus"), ("ab", "")] {
            assert!(!is_nearly(a, b) && !is_nearly(b, a), "{a} {b}");
        }
    }

    #[test]
    fn the_first_hundred_faults_of_the_syntax_are_listed() {
        let text = "a\n".repeat(300);
        let source = SourceText::new("m.toml", &text);
        source.read(|_| ());
        let problems = source.finish();
        let faults = problems.iter().filter(|d| d.code == "toml-syntax").count();
        assert_eq!(faults, MOST_SYNTAX_FAULTS);
        let counted = problems.iter().find(|d| d.code == "too-many-problems").unwrap();
        assert!(counted.message.starts_with("300 faults"), "{}", counted.message);
    }
}
