//! The mapping file: which column of a table is what, where its headings do not say it.

use super::encoding::{Decoded, decode, decode_as, encoding_named};
use super::headings::{Holds, unit_named};
use super::table::Used;
use crate::{Diagnostics, Dimension, Files, Item, Section, SourceText};
use encoding_rs::Encoding;
use std::path::{Path, PathBuf};

/// How a table of another program is to be read.
#[derive(Debug, Clone, PartialEq)]
pub struct Mapping {
    /// The mapping file, as the user named it.
    pub(super) file: String,
    pub(super) encoding: Option<&'static Encoding>,
    /// What separates columns; a space stands for any number of them.
    pub(super) separator: char,
    pub(super) decimal: Option<char>,
    pub(super) thousands: Option<char>,
    pub(super) has_headings: bool,
    /// Rows between the headings and the first reading.
    pub(super) below: usize,
    pub(super) columns: Vec<Mapped>,
    pub(super) blocks: Vec<Block>,
}

/// One column.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mapped {
    pub source: Source,
    pub used: UsedAs,
}

/// What a column becomes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct UsedAs {
    pub role: String,
    pub holds: Holds,
    pub unit: Option<&'static str>,
    pub negate: bool,
    pub words: Vec<(String, String)>,
}

impl UsedAs {
    /// The same at a place of the row.
    pub fn at(&self, at: usize) -> Used {
        let Self { role, holds, unit, negate, words } = self.clone();
        Used { at, role, holds, unit, negate, words }
    }
}

/// Where the values of a column come from.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Source {
    /// The column of this heading.
    Heading(String),
    /// The column of this number, from 0.
    Number(usize),
    /// Equal steps from row to row, deg.
    Steps { from_deg: f64, step_deg: f64 },
}

/// A part of the file with readings.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Block {
    /// Readings begin below the line that begins so.
    pub after: Option<String>,
    /// They end above the line that begins so.
    pub until: Option<String>,
    /// So many lines are left out at its beginning.
    pub skip_rows: usize,
    /// Constant columns: heading and word.
    pub constants: Vec<(String, String)>,
    /// Its own steps, deg.
    pub steps: Option<(f64, f64)>,
}

/// The mapping file that is named, or the one beside the data: `NAME.map.toml` for `NAME.csv`.
pub(crate) fn mapping_file(files: &Files, named: Option<&Path>, data: &Path) -> Option<PathBuf> {
    let beside = data.with_extension("map.toml");
    named.map(Path::to_path_buf).or_else(|| files.is_file(&beside).then_some(beside))
}

/// Reads the mapping file of a table: the one that is named, else `NAME.map.toml` beside `NAME.csv`, if there is one.
/// `None` where there is none, and with errors in `problems`.
pub fn read_mapping(
    files: &Files,
    named: Option<&Path>,
    data: &Path,
    problems: &mut Diagnostics,
) -> Option<Mapping> {
    let path = mapping_file(files, named, data)?;
    let text = files.text(&path, "a mapping file (TOML)", problems)?;
    problems.keep(Mapping::parse(&path.display().to_string(), &text))
}

impl Mapping {
    /// Reads a text; none with errors.
    ///
    /// ```
    /// use trueaxis_input::foreign::Mapping;
    /// let text = "separator = ';'\n[columns.target]\ncolumn = 2\nunit = 'mm'";
    /// let (mapping, problems) = Mapping::parse("x.map.toml", text);
    /// assert!(mapping.is_some() && !problems.has_errors());
    /// ```
    pub fn parse(file: &str, text: &str) -> (Option<Self>, Diagnostics) {
        let source = SourceText::new(file, text);
        let mapping = source.read(|root| read_root(file, root));
        let problems = source.finish();
        (mapping.filter(|_| !problems.has_errors()), problems)
    }

    /// The text of the table, in the encoding that the file states.
    pub fn decode(&self, bytes: &[u8]) -> Decoded {
        match self.encoding {
            Some(encoding) => decode_as(bytes, encoding),
            None => decode(bytes),
        }
    }

    /// Whether it names columns of one table and no more: one block to a mark, no constants, equal steps, encoding, thousands.
    pub fn is_plain(&self) -> bool {
        let [block] = &self.blocks[..] else { return false };
        let named = |column: &Mapped| !matches!(column.source, Source::Steps { .. });
        let until = block.until.clone();
        let whole = Block { skip_rows: block.skip_rows, until, ..Block::default() };
        let plain = self.encoding.is_none() && self.thousands.is_none();
        *block == whole && plain && self.columns.iter().all(named)
    }

    /// What the line after the last reading of its first block begins with.
    pub fn until(&self) -> Option<&str> {
        self.blocks.first()?.until.as_deref()
    }

    /// The sign before decimals that it states.
    pub fn decimal(&self) -> Option<char> {
        self.decimal
    }

    /// The mapping file, as the user named it.
    pub fn file(&self) -> &str {
        &self.file
    }
}

fn read_root(file: &str, root: &Section<'_>) -> Option<Mapping> {
    root.text("name");
    root.text("source");
    let encoding = root.get("encoding").and_then(|item| {
        let found = encoding_named(item.text()?);
        if found.is_none() {
            let hint = "\"utf-8\", \"windows-1252\", \"gbk\", \"utf-16le\", \"utf-16be\" …";
            item.error("unknown-word", "no encoding has this name".to_owned(), hint);
        }
        found
    });
    let separator = one_of(
        root,
        "separator",
        &[(",", ','), (";", ';'), ("tab", '\t'), ("\t", '\t'), ("spaces", ' '), ("|", '|')],
    );
    let decimal = one_of(root, "decimal", &[(".", '.'), (",", ',')]);
    let thousands = one_of(root, "thousands", &[(".", '.'), (",", ',')]);
    if decimal.is_some() && decimal == thousands {
        let hint = "one of them is \".\", the other \",\"";
        root.error("unknown-word", "decimal and thousands are the same sign".to_owned(), hint);
    }
    let has_headings = root.get("headings").and_then(|i| i.flag()).unwrap_or(true);
    let below = root.get("rows_below_headings").and_then(|i| i.count()).unwrap_or(0);
    let columns = root.section("columns", |s| {
        let of = |(role, _, item): (&str, _, Item<'_>)| {
            item.section(&s.path(role), |s| read_column(s, role, has_headings)).flatten()
        };
        s.entries().into_iter().filter_map(of).collect::<Vec<_>>()
    });
    let columns = columns.unwrap_or_default();
    if columns.is_empty() {
        let hint = "[columns.target] column = \"Position\", unit = \"mm\", and so on";
        root.error("missing-key", "the mapping file names no columns".to_owned(), hint);
    }
    let whole = read_block(root);
    let mut blocks = Vec::new();
    for (i, item) in root.get("block").and_then(|i| i.list()).unwrap_or_default().iter().enumerate()
    {
        blocks.extend(item.section(&format!("block.{}", i + 1), read_block));
    }
    if blocks.is_empty() {
        blocks.push(whole);
    }
    let file = file.to_owned();
    let separator = separator.unwrap_or(',');
    Some(Mapping {
        file,
        encoding,
        separator,
        decimal,
        thousands,
        has_headings,
        below,
        columns,
        blocks,
    })
}

fn one_of(root: &Section<'_>, key: &str, words: &[(&str, char)]) -> Option<char> {
    let item = root.get(key)?;
    let text = item.text()?;
    let found = words.iter().find(|(word, _)| *word == text).map(|(_, c)| *c);
    if found.is_none() {
        let known: Vec<String> = words.iter().map(|(word, _)| format!("{word:?}")).collect();
        item.error("unknown-word", format!("unknown {key} `{text}`"), &known.join(" or "));
    }
    found
}

/// `after`, `until`, `skip_rows`, constants and steps: at the top of the file, or in a `[[block]]`.
fn read_block(section: &Section<'_>) -> Block {
    let text = |key: &str| section.text(key).map(str::to_owned);
    let angle = |key: &str| {
        section.quantity(key, Dimension::Angle).map(|rad| (rad.to_degrees() * 1e9).round() / 1e9)
    };
    let mut constants = Vec::new();
    if let Some(item) = section.get("direction")
        && let Some(word) = item.text()
    {
        match super::headings::direction_named(word) {
            Some(ours) => constants.push(("direction".to_owned(), ours.to_owned())),
            None => item.error(
                "unknown-word",
                format!("`{word}` is not a direction"),
                "\"up\", \"down\", \"cw\" or \"ccw\"",
            ),
        }
    }
    if let Some(run) = section.get("run").and_then(|i| i.count()) {
        constants.push(("run".to_owned(), run.to_string()));
    }
    Block {
        after: text("after"),
        until: text("until"),
        skip_rows: section.get("skip_rows").and_then(|i| i.count()).unwrap_or(0),
        constants,
        steps: angle("angle_from").zip(angle("angle_step")),
    }
}

fn read_column(s: &Section<'_>, role: &str, has_headings: bool) -> Option<Mapped> {
    let holds = holds_of(role);
    let source = read_source(s, has_headings);
    let unit = s.get("unit").and_then(|item| {
        let found = unit_named(item.text()?);
        if found.is_none() {
            let message = "unknown unit".to_owned();
            item.error("unknown-unit", message, "mm, um, nm, in, deg, arcsec, urad, degC, s …");
        }
        found
    });
    let negate = s.get("sign").and_then(|item| match item.number()? {
        1.0 => Some(false),
        -1.0 => Some(true),
        _ => {
            item.error("unknown-word", "a sign is 1 or -1".to_owned(), "sign = -1");
            None
        }
    });
    let words = s.section("words", |s| {
        let mut words = Vec::new();
        for (ours, _, item) in s.entries() {
            let all = match item.is_list() {
                true => item.list().unwrap_or_default(),
                false => vec![item],
            };
            words.extend(all.iter().filter_map(|i| Some((i.text()?.to_owned(), ours.to_owned()))));
        }
        words
    });
    let source = source?;
    let is_measured = matches!(holds, Holds::Large | Holds::Small);
    if is_measured && unit.is_none() && !matches!(source, Source::Steps { .. }) {
        let message = format!("the column `{role}` has no unit");
        s.error("missing-unit", message, "unit = \"mm\", \"um\", \"deg\" …");
        return None;
    }
    let unit = if matches!(source, Source::Steps { .. }) { Some("deg") } else { unit };
    let unit = unit.filter(|_| is_measured);
    let (words, negate) = (words.unwrap_or_default(), negate.unwrap_or(false));
    Some(Mapped { source, used: UsedAs { role: role.to_owned(), holds, unit, negate, words } })
}

fn read_source(s: &Section<'_>, has_headings: bool) -> Option<Source> {
    let angle = |key: &str| {
        s.quantity(key, Dimension::Angle).map(|rad| (rad.to_degrees() * 1e9).round() / 1e9)
    };
    if let (Some(from_deg), Some(step_deg)) = (angle("from"), angle("step")) {
        return Some(Source::Steps { from_deg, step_deg });
    }
    let item =
        s.require("column", "column = \"Position\" (its heading), or column = 3 (its number)")?;
    if let Some(heading) = item.as_text() {
        if !has_headings {
            let message = "the table has no headings: `headings = false`".to_owned();
            item.error("unknown-word", message, "column = 3, counted from 1");
            return None;
        }
        return Some(Source::Heading(heading.trim().to_owned()));
    }
    let number = item.count()?;
    if number == 0 {
        item.error("unknown-word", "columns are counted from 1".to_owned(), "column = 1");
        return None;
    }
    Some(Source::Number(number - 1))
}

/// What a role holds; a role of another table (`X`, `length`) holds positions.
fn holds_of(role: &str) -> Holds {
    let small = |name: &str| {
        let rest = name.strip_prefix("deviation_").unwrap_or(name);
        rest.starts_with("up_") || rest.starts_with("down_") || name == "deviation"
    };
    match role {
        "run" | "group" => Holds::Count,
        _ if role.ends_with("_approach") => Holds::Count,
        "direction" => Holds::Direction,
        "diagonal" | "setup" | "axis" | "line" | "test" => Holds::Word,
        _ if small(role) => Holds::Small,
        _ => Holds::Large,
    }
}
