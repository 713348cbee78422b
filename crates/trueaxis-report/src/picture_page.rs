//! A page of tables and pictures.

use super::DrawingError;
use super::page::document;
use crate::pictures::Picture;
use crate::{Block, section};
use maud::{Markup, PreEscaped, html};

/// What stands on the page, from above.
pub struct PicturePage<'a> {
    /// Its title.
    pub title: &'a str,
    /// Under the title.
    pub lines: &'a [String],
    /// A verdict, if there is one.
    pub verdict: Option<Markup>,
    /// Tables.
    pub blocks: &'a [Block],
    /// Pictures after them.
    pub pictures: &'a [Picture],
}

/// The page as the text of an HTML file.
pub fn picture_page(page: &PicturePage<'_>) -> Result<String, DrawingError> {
    let pictures = pictures(page.pictures)?;
    let content = html! {
        h1 { (page.title) }
        @for line in page.lines { p.soft { (line) } }
        @if let Some(verdict) = &page.verdict { (verdict) }
        @for block in page.blocks { (section(block)) }
        (pictures)
        p.soft { "made by trueaxis " (crate::VERSION) }
    };
    Ok(document(page.title, &content))
}

/// Pictures with their titles and notes, one section each.
pub fn pictures(pictures: &[Picture]) -> Result<Markup, DrawingError> {
    let mut drawn = Vec::new();
    for picture in pictures {
        drawn.push((picture.title(), picture.note(), picture.svg()?, picture.is_round()));
    }
    Ok(html! {
        @for (title, note, svg, round) in &drawn {
            section {
                h2 { (title) }
                @if *round {
                    div style="max-width:640px;margin:0 auto" { (PreEscaped(svg)) }
                } @else { (PreEscaped(svg)) }
                @if !note.is_empty() { p.soft { (note) } }
            }
        }
    })
}
