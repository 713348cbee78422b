//! An evaluation as one self-contained page: opens offline, no script, no file from elsewhere.

use super::evaluation::{Block, Evaluation};
use super::page::document;
use super::picture_page::pictures;
use maud::{Markup, html};

/// The report as the text of an HTML file.
///
/// # Errors
/// What the drawing library says.
pub fn evaluation_html(evaluation: &Evaluation<'_>) -> Result<String, super::DrawingError> {
    let sheets = evaluation.sheets();
    let pictures = pictures(&sheets.pictures)?;
    let content = html! {
        h1 { (evaluation.title()) }
        p.soft { (evaluation.standard.title()) }
        p.soft { (evaluation.circumstances()) }
        @for block in &sheets.figures { (section(block)) }
        (pictures)
        (remarks(evaluation.remarks))
        @for block in &sheets.details { (section(block)) }
        p.soft { "made by trueaxis " (crate::VERSION) }
    };
    Ok(document(evaluation.title(), &content))
}

pub(super) fn section(block: &Block) -> Markup {
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

fn remarks(remarks: &[String]) -> Markup {
    html! {
        @if !remarks.is_empty() {
            section {
                h2 { "What to know of these readings" }
                ul { @for remark in remarks { li { (remark) } } }
            }
        }
    }
}
