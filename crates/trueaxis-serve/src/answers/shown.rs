//! The answer of a command as its report shows it: verdict, sentences, tables.

use serde::Serialize;
use trueaxis::JsonSchema;
use trueaxis::questions::Answer;
use trueaxis::report::{Item, Report, Section, Table, Verdict};

/// A report of the command line without its pictures.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ShownEntry {
    /// Its title.
    title: String,
    /// The lines below it.
    lines: Vec<String>,
    /// The verdict; null if there is none.
    verdict: Option<Verdict>,
    /// Its sections in their order.
    sections: Vec<ShownSection>,
}

/// A part of the report.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ShownSection {
    /// Its title; may be empty.
    title: String,
    /// What stands in it.
    items: Vec<ShownItem>,
}

/// What stands in a section.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub(super) enum ShownItem {
    /// A paragraph.
    Paragraph {
        /// Its text.
        text: String,
    },
    /// What explains the rest.
    Note {
        /// Its text.
        text: String,
    },
    /// One line for each.
    List {
        /// The lines.
        lines: Vec<String>,
    },
    /// Lines of a file.
    Code {
        /// The lines.
        text: String,
    },
    /// A table.
    Table {
        /// The headings with their units; empty for pairs of name and value.
        headings: Vec<String>,
        /// The cells, row by row.
        rows: Vec<Vec<String>>,
        /// The text below it; may be empty.
        note: String,
    },
}

/// Rows of a table that go to the page.
const MOST_ROWS: usize = 2000;

impl ShownEntry {
    /// What an answer says.
    pub(super) fn of(answer: &impl Answer) -> Self {
        let report = unwritten(answer.report());
        Self {
            title: report.title,
            lines: report.lines,
            verdict: report.verdict,
            sections: report.sections.iter().filter_map(ShownSection::of).collect(),
        }
    }
}

impl ShownSection {
    fn of(section: &Section<'_>) -> Option<Self> {
        let items: Vec<ShownItem> = section.items.iter().filter_map(ShownItem::of).collect();
        // A note alone explains nothing.
        let is_note = |item: &ShownItem| matches!(item, ShownItem::Note { .. });
        let is_shown = !items.iter().all(is_note);
        is_shown.then(|| Self { title: section.title.clone(), items })
    }
}

impl ShownItem {
    fn of(item: &Item<'_>) -> Option<Self> {
        Some(match item {
            Item::Paragraph(text) if !text.is_empty() => Self::Paragraph { text: text.clone() },
            Item::Note(text) if !text.is_empty() => Self::Note { text: text.clone() },
            Item::Code(text) if !text.is_empty() => Self::Code { text: text.clone() },
            Item::List(lines) if !lines.is_empty() => Self::List { lines: lines.clone() },
            Item::Table(table) if !table.rows.is_empty() => Self::table(table),
            // Pictures are drawn by the page from the document.
            _ => return None,
        })
    }

    fn table(table: &Table) -> Self {
        let left_out = table.rows.len().saturating_sub(MOST_ROWS);
        let mut note = table.note.clone();
        if left_out > 0 {
            note = format!("{left_out} further rows are in the document. {note}");
        }
        Self::Table {
            headings: table.headings.clone(),
            rows: table.rows.iter().take(MOST_ROWS).map(|row| row.cells.clone()).collect(),
            note,
        }
    }
}

/// The files of an answer are kept for the page, not written: no line says so.
pub(super) fn unwritten(mut report: Report<'_>) -> Report<'_> {
    for line in &mut report.lines {
        let Some((before, after)) = line.split_once(", written to ") else { continue };
        let rounding = [", rounded to ", ", not rounded"].iter().find_map(|r| after.rfind(r));
        if let Some(rest) = rounding.and_then(|at| after.get(at..)) {
            *line = format!("{before}{rest}");
        }
    }
    report
}
