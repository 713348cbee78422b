//! An evaluation for people: the same tables for the terminal and the page.

use super::evaluation_plots::Picture;
use crate::verify::conditions::Conditions;
use crate::verify::{Evaluated, Standard};
use std::fmt::Write as _;

/// Everything that a report of an evaluation shows.
pub struct Evaluation<'a> {
    /// By which standard.
    pub standard: Standard,
    /// The file of the readings.
    pub file: &'a str,
    /// What is known beside them.
    pub conditions: &'a Conditions,
    /// The result.
    pub evaluated: &'a Evaluated,
    /// Warnings and notes, each as one text.
    pub remarks: &'a [String],
}

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

/// What all reports of an evaluation show, in their order.
pub struct Sheets {
    /// Before the pictures.
    pub figures: Vec<Block>,
    /// Behind them.
    pub details: Vec<Block>,
    /// Between them.
    pub pictures: Vec<Picture>,
}

impl Evaluation<'_> {
    /// Tables and pictures.
    pub fn sheets(&self) -> Sheets {
        match self.evaluated {
            Evaluated::Positioning(measurement, result) => {
                super::evaluation_positioning::sheets(self.standard, measurement, result)
            }
            Evaluated::Circular(circle) => super::evaluation_circular::sheets(circle),
            Evaluated::Drift(drift) => super::evaluation_others::drift_sheets(drift),
            Evaluated::Diagonals(d) => super::evaluation_others::diagonal_sheets(d),
            Evaluated::Rotation(r) => super::evaluation_others::rotation_sheets(r),
        }
    }

    /// What was measured, in words.
    pub(super) fn title(&self) -> &str {
        self.conditions.name.as_deref().unwrap_or(self.file)
    }

    /// Machine, axis, instrument, date, temperature, where known.
    pub(super) fn circumstances(&self) -> String {
        let c = self.conditions;
        let axis = c.axis.as_ref().map(|a| format!("axis {a}"));
        let temperature = c.temperature_c.map(|t| match t.u {
            Some(u) => format!("{} ± {u} °C", t.value),
            None => format!("{} °C", t.value),
        });
        let parts = [
            c.machine.clone(),
            axis,
            c.instrument_name.clone(),
            c.date.clone(),
            temperature,
            Some(self.file.to_owned()),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
    }
}

/// A figure, or a dash where there is none.
pub(super) fn figure(value: Option<f64>, scale: f64) -> String {
    match value {
        // No minus before what is shown as zero.
        Some(v) if (v * scale).abs() < 0.005 => "0.00".to_owned(),
        Some(v) => format!("{:.2}", v * scale),
        None => "–".to_owned(),
    }
}

/// The evaluation as the terminal shows it.
pub fn evaluation_text(evaluation: &Evaluation<'_>) -> String {
    let sheets = evaluation.sheets();
    let mut out = format!(
        "{}\n  {}\n  {}\n",
        evaluation.title(),
        evaluation.standard.title(),
        evaluation.circumstances()
    );
    for block in sheets.figures.iter().chain(&sheets.details) {
        // Writing into a text cannot fail.
        let _ = write_block(&mut out, block);
    }
    out
}

/// A table for the terminal.
pub(super) fn write_block(out: &mut String, block: &Block) -> std::fmt::Result {
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
