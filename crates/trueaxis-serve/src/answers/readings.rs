//! Readings of any program before they are evaluated: their text, and what their columns are.

use crate::body::{needed, short};
use crate::desk::{Desk, Job};
use crate::refusal::Refusal;
use crate::request::{Reply, Request};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize};
use trueaxis::JsonSchema;
use trueaxis::files::{disk, read_bytes};
use trueaxis::input::Diagnostics;
use trueaxis::input::foreign::{
    LookAs, LookColumn, Mapping, decode, decode_as, encoding_named, look,
};

/// The text of a file that was dropped, in any usual encoding.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ReadingsTextRequest {
    /// Its bytes in base64.
    base64: String,
    /// Its encoding by a name of the WHATWG standard; found by its bytes if it is left out.
    encoding: Option<String>,
}

/// The text of readings.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ReadingsTextAnswer {
    /// The text.
    text: String,
    /// The encoding by its name in the WHATWG standard.
    encoding: &'static str,
    /// Whether nothing in the file proves that encoding.
    is_assumed: bool,
}

impl Request for ReadingsTextRequest {
    type Answer<'a> = ReadingsTextAnswer;

    fn answer(self, _: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let bytes = STANDARD.decode(&self.base64);
        let bytes = bytes.map_err(|e| Refusal::bad(format!("`base64`: {e}"), ""))?;
        let named = |name: &String| {
            let unknown = || Refusal::bad(format!("unknown encoding `{}`", short(name)), "utf-8");
            encoding_named(name).ok_or_else(unknown)
        };
        let decoded = match self.encoding.as_ref().map(named).transpose()? {
            Some(encoding) => decode_as(&bytes, encoding),
            None => decode(&bytes),
        };
        // Files of DOS end with 0x1A.
        let is_binary = |c: char| c.is_ascii_control() && !"\t\n\r\u{c}\u{1a}".contains(c);
        if decoded.text.chars().any(is_binary) {
            let hint =
                "save the readings as CSV: a line of headings, then one row for each reading";
            return Err(Refusal::new(422, "not-text", "the file is not a text file", hint));
        }
        let (text, encoding, is_assumed) = (decoded.text, decoded.encoding, decoded.is_assumed);
        Ok(Reply::json(&ReadingsTextAnswer { text, encoding, is_assumed }))
    }
}

/// What the columns of a table are: of a file of the project, or of a text.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ReadingsColumnsRequest {
    /// The file of the readings.
    path: Option<String>,
    /// Their text instead.
    text: Option<String>,
    /// What separates the columns; found if it is left out. A space stands for any number of them.
    separator: Option<char>,
    /// The line of the headings, counted from 1; 0 where there are none; found if it is left out.
    heading_line: Option<usize>,
    /// The text of a mapping file; that beside the file of the readings if it is left out.
    mapping: Option<String>,
}

/// A table as it stands in its file.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ReadingsColumnsAnswer {
    /// The table; null where no two columns were found.
    table: Option<TableEntry>,
    /// The text of the mapping file; null if there is none.
    mapping: Option<String>,
    /// Whether it says more than what the columns of one table are, so that only its text can be edited.
    is_mapping_text: bool,
}

/// Its layout.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct TableEntry {
    /// What separates its columns.
    separator: char,
    /// The sign before decimals that the mapping file states.
    decimal: Option<char>,
    /// What the line after the last reading begins with, as the mapping file states it.
    until: Option<String>,
    /// The line of the headings, counted from 1; null where there are none.
    heading_line: Option<usize>,
    /// The line of the headings, or of the first reading.
    first_line: usize,
    /// Rows between headings and readings.
    rows_below_headings: usize,
    /// Rows of readings.
    readings: usize,
    /// Its columns.
    columns: Vec<TableColumnEntry>,
}

/// A column of it.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct TableColumnEntry {
    /// Its heading; empty where there is none.
    heading: String,
    /// What it is, by its heading or the mapping file; null if that is not known.
    role: Option<String>,
    /// Its unit; null if that is not known.
    unit: Option<&'static str>,
    /// Whether its sign is changed.
    negate: bool,
    /// Its first values.
    values: Vec<String>,
    /// Its words, each with what it means; null if that is not known.
    words: Vec<(String, Option<String>)>,
}

impl From<LookColumn> for TableColumnEntry {
    fn from(column: LookColumn) -> Self {
        let LookColumn { heading, role, unit, negate, values, words } = column;
        Self { heading, role, unit, negate, values, words }
    }
}

impl Request for ReadingsColumnsRequest {
    type Answer<'a> = ReadingsColumnsAnswer;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let (text, mapping) = match self.path {
            Some(name) => {
                let path = desk.project.path(&name)?;
                let unreadable = |e: std::io::Error| {
                    let message = format!("{name}: cannot be read: {e}");
                    Refusal::new(422, "unreadable-file", message, "choose a file from the list")
                };
                let text = decode(&read_bytes(&path).map_err(unreadable)?).text;
                let beside = || disk().read_text(&path.with_extension("map.toml")).ok();
                (text, self.mapping.or_else(beside))
            }
            None => (needed(self.text, "text")?, self.mapping),
        };
        let read = match &mapping {
            None => None,
            Some(text) => {
                let mut problems = Diagnostics::new();
                let read = problems.keep(Mapping::parse("the mapping file", text));
                Some(read.ok_or_else(|| Refusal::unusable(&problems))?)
            }
        };
        let is_mapping_text = read.as_ref().is_some_and(|mapping| !mapping.is_plain());
        let decimal = read.as_ref().and_then(Mapping::decimal);
        let until = read.as_ref().and_then(Mapping::until).map(str::to_owned);
        let known = LookAs {
            separator: self.separator,
            heading_line: self.heading_line,
            mapping: read.as_ref(),
        };
        let table = look(&text, &known).map(|found| TableEntry {
            separator: found.separator,
            decimal,
            until: until.clone(),
            heading_line: found.heading_line,
            first_line: found.first_line,
            rows_below_headings: found.rows_below_headings,
            readings: found.readings,
            columns: found.columns.into_iter().map(TableColumnEntry::from).collect(),
        });
        Ok(Reply::json(&ReadingsColumnsAnswer { table, mapping, is_mapping_text }))
    }
}
