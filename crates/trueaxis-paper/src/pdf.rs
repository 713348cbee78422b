//! A report as PDF: its content as data, laid out by `report.typ`.

mod content;
mod sheet;

use crate::{PrintError, Printed};
use sheet::{Sheet, fonts_of_system, own_fonts};
use std::collections::BTreeSet;
use trueaxis_report::Report;
use typst::diag::SourceDiagnostic;
use typst::foundations::Smart;
use typst::layout::{Frame, FrameItem};
use typst_layout::PagedDocument;
use typst_pdf::PdfOptions;

/// Typesets a report. Characters that the fonts of this program lack are looked for in those of the system.
pub(crate) fn pdf(report: &Report<'_>) -> Result<Printed, PrintError> {
    let files = content::files(report)?;
    let mut sheet = Sheet::new(files, own_fonts().clone());
    let mut pages = typeset(&sheet)?;
    let mut missing = missing(&pages);
    if !missing.is_empty() {
        sheet = sheet.with_fonts(fonts_of_system());
        pages = typeset(&sheet)?;
        missing = self::missing(&pages);
    }
    let creator = Smart::Custom(Some(format!("trueaxis {}", trueaxis_report::VERSION).into()));
    let options = PdfOptions { creator, ..PdfOptions::default() };
    let bytes = typst_pdf::pdf(&pages, &options).map_err(|e| said(&e))?;
    // The library remembers what it has laid out: a server that prints all day would keep all of it.
    typst::comemo::evict(0);
    Ok(Printed { bytes, missing: missing.into_iter().collect() })
}

fn typeset(sheet: &Sheet) -> Result<PagedDocument, PrintError> {
    typst::compile::<PagedDocument>(sheet).output.map_err(|e| said(&e))
}

fn said(errors: &[SourceDiagnostic]) -> PrintError {
    let first = errors.first().map_or_else(|| "no reason given".into(), |e| e.message.clone());
    PrintError(format!("the report cannot be typeset: {first}"))
}

/// The characters without a glyph.
fn missing(pages: &PagedDocument) -> BTreeSet<char> {
    let mut found = BTreeSet::new();
    pages.pages().iter().for_each(|page| look(&page.frame, &mut found));
    found
}

fn look(frame: &Frame, found: &mut BTreeSet<char>) {
    for (_, item) in frame.items() {
        match item {
            FrameItem::Group(group) => look(&group.frame, found),
            FrameItem::Text(text) => {
                let lost = text.glyphs.iter().filter(|glyph| glyph.id == 0);
                let lost = lost.filter_map(|glyph| text.text.get(glyph.range()));
                found.extend(lost.flat_map(str::chars));
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests;
