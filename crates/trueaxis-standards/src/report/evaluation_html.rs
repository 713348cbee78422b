//! An evaluation as one self-contained page: opens offline, no script, no file from elsewhere.

use super::evaluation::Evaluation;
use maud::{Markup, html};
use trueaxis_report::page::document;
use trueaxis_report::picture_page::pictures;
use trueaxis_report::section;

/// The report as the text of an HTML file.
///
/// # Errors
/// What the drawing library says.
pub fn evaluation_html(
    evaluation: &Evaluation<'_>,
) -> Result<String, trueaxis_report::DrawingError> {
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
        p.soft { "made by trueaxis " (trueaxis_report::VERSION) }
    };
    Ok(document(evaluation.title(), &content))
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
