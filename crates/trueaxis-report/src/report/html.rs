//! A report as one self-contained page.

use super::{
    Columns, Figure, Heading, Item, Labels, Logo, Report, Section, Standing, Table, Verdict, filled,
};
use crate::DrawingError;
use crate::page::{THREE, document};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, PreEscaped, html};

/// Tables of more columns are printed smaller.
const MANY_COLUMNS: usize = 6;
/// A table of more rows may be broken between pages of paper.
const LONG: usize = 20;

pub(super) fn html(report: &Report<'_>) -> Result<String, DrawingError> {
    let sections = report.on_page().map(section).collect::<Result<Vec<_>, _>>()?;
    let heading = report.heading.as_ref();
    let content = html! {
        @if let Some(logo) = heading.and_then(|h| h.logo.as_ref()) { (picture(logo)) }
        h1 { (report.title) }
        @for line in &report.lines { p.soft { (line) } }
        @if let Some(heading) = heading { (self::heading(heading)) }
        @if let Some(v) = &report.verdict { (verdict(v)) }
        @for section in &sections { (section) }
        @if let Some(heading) = heading { (signatures(heading, &report.labels)) }
        p.soft { (report.made_by()) }
    };
    Ok(document(&report.title, &report.labels, &content))
}

fn picture(logo: &Logo) -> Markup {
    let data = STANDARD.encode(&logo.bytes);
    html! { img.logo alt="logo" src={ "data:" (logo.kind.media_type()) ";base64," (data) }; }
}

fn heading(heading: &Heading) -> Markup {
    html! {
        section {
            table.words { tbody { @for (name, value) in &heading.entries {
                tr { td.soft { (name) } td { (value) } }
            } } }
            @if let Some(table) = &heading.table { (self::table(table)) }
        }
    }
}

fn signatures(heading: &Heading, labels: &Labels) -> Markup {
    html! {
        @if !heading.signatures.is_empty() {
            div.signatures { @for name in &heading.signatures {
                div { (filled(&labels.signature, &[name])) }
            } }
        }
    }
}

fn verdict(verdict: &Verdict) -> Markup {
    html! {
        section class={ "verdict " (class(verdict.standing)) } {
            strong { (verdict.word) }
            span { (verdict.sentence) }
        }
    }
}

fn class(standing: Standing) -> &'static str {
    match standing {
        Standing::Good => "pass",
        Standing::Bad => "fail",
        Standing::Open => "undecided",
    }
}

fn section(section: &Section<'_>) -> Result<Markup, DrawingError> {
    let is_long = |item: &Item<'_>| match item {
        Item::Table(table) => table.rows.len() > LONG,
        Item::Figures(_, figures) => figures.len() > 4,
        _ => false,
    };
    let class = if section.items.iter().any(is_long) { "long" } else { "" };
    let items = section.items.iter().map(item).collect::<Result<Vec<_>, _>>()?;
    Ok(html! {
        section class=(class) {
            @if !section.title.is_empty() { h2 { (section.title) } }
            @for item in &items { (item) }
        }
    })
}

fn item(item: &Item<'_>) -> Result<Markup, DrawingError> {
    Ok(match item {
        Item::Paragraph(text) => html! { p { (text) } },
        Item::Note(text) => html! { p.soft { (text) } },
        Item::List(lines) => html! { ul { @for line in lines { li { (line) } } } },
        Item::Code(lines) => html! { pre { code { (lines) } } },
        Item::Table(table) => html! { (self::table(table)) },
        Item::Figures(columns, figures) => self::figures(*columns, figures)?,
    })
}

fn table(table: &Table) -> Markup {
    let columns = table.columns();
    let size = if columns > MANY_COLUMNS { "small" } else { "" };
    let sides: Vec<&str> =
        (0..columns).map(|i| if table.has_words(i) { "text-align:left" } else { "" }).collect();
    html! {
        div.scroll { table class=(size) {
            @if !table.headings.is_empty() {
                thead { tr { @for (h, side) in table.headings.iter().zip(&sides) {
                    th style=(side) { (h) }
                } } }
            }
            tbody { @for row in &table.rows { tr.decisive[row.bold] {
                @for (i, (cell, side)) in row.cells.iter().zip(&sides).enumerate() {
                    td class=[row.standing(i).map(class)] style=(side) { (cell) }
                }
            } } }
        } }
        @if !table.note.is_empty() { p.soft { (table.note) } }
    }
}

fn figures(columns: Columns, figures: &[Figure<'_>]) -> Result<Markup, DrawingError> {
    let mut drawn = Vec::new();
    for figure in figures {
        drawn.push((figure, figure.svg()?));
    }
    let style = match columns {
        Columns::One => "grid-template-columns:minmax(0, 1fr)",
        Columns::AsFit => "",
        Columns::Three => THREE,
    };
    let round = "max-width:640px;margin:0 auto;width:100%";
    Ok(html! {
        div.grid style=(style) { @for (figure, svg) in &drawn {
            figure style=(if figure.round { round } else { "" }) {
                (PreEscaped(svg))
                @if !figure.caption.is_empty() { figcaption { (figure.caption) } }
            }
        } }
    })
}
