//! A table with a title, for the terminal and for the page.

use maud::{Markup, html};
use std::fmt::Write;

/// A table with a title; the first column is text.
pub struct Block {
    /// Above it.
    pub title: String,
    /// Below it.
    pub note: &'static str,
    /// The first line, with units.
    pub headings: Vec<String>,
    /// The cells.
    pub rows: Vec<Vec<String>>,
}

impl Block {
    /// A table without rows.
    pub fn new(title: &str, note: &'static str, headings: &[&str]) -> Self {
        let headings = headings.iter().map(|h| (*h).to_owned()).collect();
        Self { title: title.to_owned(), note, headings, rows: Vec::new() }
    }

    /// Whether a column holds words, which read better from the left.
    pub fn has_words(&self, column: usize) -> bool {
        let number = |cell: &String| cell == "–" || cell.parse::<f64>().is_ok();
        self.rows.iter().filter_map(|row| row.get(column)).all(|cell| !number(cell))
    }
}

/// A table for the terminal.
pub fn write_block(out: &mut String, block: &Block) -> std::fmt::Result {
    /// More rows are in the page and in JSON.
    const MOST_ROWS: usize = 60;
    writeln!(out, "\n  {}", block.title)?;
    let shown = || std::iter::once(&block.headings).chain(block.rows.iter().take(MOST_ROWS));
    let wide = |column: usize| {
        let widths = shown().filter_map(|row| row.get(column)).map(|cell| width(cell));
        widths.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..block.headings.len()).map(wide).collect();
    let words: Vec<bool> = (0..widths.len()).map(|i| block.has_words(i)).collect();
    for row in shown() {
        let mut line = "  ".to_owned();
        for (i, (cell, wide)) in row.iter().zip(&widths).enumerate() {
            let gap = " ".repeat(wide - width(cell).min(*wide));
            match i {
                0 => write!(line, "{cell}{gap}")?,
                _ if words[i] => write!(line, "   {cell}{gap}")?,
                _ => write!(line, "   {gap}{cell}")?,
            }
        }
        writeln!(out, "{}", line.trim_end())?;
    }
    if block.rows.len() > MOST_ROWS {
        let more = block.rows.len() - MOST_ROWS;
        writeln!(out, "  … and {more} more; --format json has them")?;
    }
    if !block.note.is_empty() {
        writeln!(out, "  {}", block.note)?;
    }
    Ok(())
}

/// Columns on a terminal: the bar above B̄ takes none.
fn width(cell: &str) -> usize {
    cell.chars().filter(|c| *c != '\u{304}').count()
}

/// A table as a section of a page.
pub fn section(block: &Block) -> Markup {
    let small = if block.headings.len() > 6 { "small" } else { "" };
    let side = |i: usize| if block.has_words(i) { "text-align:left" } else { "" };
    html! {
        section {
            h2 { (block.title) }
            div.scroll { table class=(small) {
                thead { tr { @for (i, h) in block.headings.iter().enumerate() {
                    th style=(side(i)) { (h) }
                } } }
                tbody { @for row in &block.rows { tr {
                    @for (i, cell) in row.iter().enumerate() { td style=(side(i)) { (cell) } }
                } } }
            } }
            @if !block.note.is_empty() { p.soft { (block.note) } }
        }
    }
}
