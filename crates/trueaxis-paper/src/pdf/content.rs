//! The content of a report as data for `report.typ`, with its pictures.

use crate::PrintError;
use serde::Serialize;
use std::borrow::Cow;
use trueaxis_report::{
    Columns, Figure, Heading, Item, Labels, Report, Row, Section, Standing, Table, Verdict,
    filled as label,
};

/// Rows of a table on paper, some forty pages; more are read by programs.
const MOST_ROWS: usize = 2000;

type Files = Vec<(String, Vec<u8>)>;

#[derive(Serialize)]
struct Content<'a> {
    title: &'a str,
    lines: &'a [String],
    number: &'a str,
    entries: &'a [(String, String)],
    instruments: Option<Block<'a>>,
    logo: Option<String>,
    verdict: Option<&'a Verdict>,
    sections: Vec<Titled<'a>>,
    /// What stands below each line.
    signatures: Vec<String>,
    made: String,
    labels: Footer<'a>,
}

/// What the layout says on every page.
#[derive(Serialize)]
struct Footer<'a> {
    language: &'a str,
    page: &'a str,
}

#[derive(Serialize)]
struct Titled<'a> {
    title: &'a str,
    items: Vec<Block<'a>>,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Block<'a> {
    Paragraph {
        text: &'a str,
    },
    Note {
        text: &'a str,
    },
    List {
        lines: &'a [String],
    },
    Code {
        text: &'a str,
    },
    Table {
        headings: &'a [String],
        rows: Vec<Cells<'a>>,
        /// Whether the column stands on the left.
        left: Vec<bool>,
        note: Cow<'a, str>,
    },
    Figures {
        columns: &'static str,
        figures: Vec<Drawn<'a>>,
    },
}

#[derive(Serialize)]
struct Cells<'a> {
    cells: Vec<&'a str>,
    /// Of those that are verdicts.
    standings: Vec<Option<Standing>>,
    bold: bool,
}

#[derive(Serialize)]
struct Drawn<'a> {
    file: String,
    caption: &'a str,
    /// For those who do not see it.
    alt: &'a str,
    round: bool,
}

/// `report.json` and the pictures that it names.
pub(super) fn files(report: &Report<'_>) -> Result<Files, PrintError> {
    let mut files = Files::new();
    let empty = Heading::default();
    let heading = report.heading.as_ref().unwrap_or(&empty);
    let logo = heading.logo.as_ref().map(|logo| {
        let name = format!("logo.{}", logo.kind.ending());
        files.push((name.clone(), logo.bytes.clone()));
        name
    });
    let labels = &report.labels;
    let mut sections = Vec::new();
    for section in report.on_page() {
        sections.push(titled(section, labels, &mut files)?);
    }
    let content = Content {
        title: &report.title,
        lines: &report.lines,
        number: &heading.number,
        entries: &heading.entries,
        instruments: heading.table.as_ref().map(|of| table(of, labels)),
        logo,
        verdict: report.verdict.as_ref(),
        sections,
        signatures: signatures(heading, labels),
        made: report.made_by(),
        labels: Footer { language: &labels.language, page: &labels.page },
    };
    let json = serde_json::to_vec(&content).map_err(|e| PrintError(e.to_string()))?;
    files.push(("report.json".to_owned(), json));
    Ok(files)
}

fn signatures(heading: &Heading, labels: &Labels) -> Vec<String> {
    heading.signatures.iter().map(|name| label(&labels.signature, &[name])).collect()
}

fn titled<'a>(
    section: &'a Section<'_>,
    labels: &Labels,
    files: &mut Files,
) -> Result<Titled<'a>, PrintError> {
    let mut items = Vec::new();
    for item in &section.items {
        items.extend(block(&section.title, item, labels, files)?);
    }
    Ok(Titled { title: &section.title, items })
}

/// None where there is nothing to show.
fn block<'a>(
    title: &'a str,
    item: &'a Item<'_>,
    labels: &Labels,
    files: &mut Files,
) -> Result<Option<Block<'a>>, PrintError> {
    Ok(match item {
        Item::Paragraph(text) => Some(Block::Paragraph { text }),
        Item::Note(text) => Some(Block::Note { text }),
        Item::List(lines) => (!lines.is_empty()).then_some(Block::List { lines }),
        Item::Code(text) => Some(Block::Code { text }),
        Item::Table(of) => (of.columns() > 0).then(|| table(of, labels)),
        Item::Figures(_, figures) if figures.is_empty() => None,
        Item::Figures(columns, figures) => {
            let figures = figures.iter().map(|figure| drawn(title, figure, files));
            let figures = figures.collect::<Result<Vec<_>, _>>()?;
            let columns = match columns {
                Columns::One => "one",
                Columns::AsFit => "fit",
                Columns::Three => "three",
            };
            Some(Block::Figures { columns, figures })
        }
    })
}

fn drawn<'a>(
    title: &'a str,
    figure: &'a Figure<'_>,
    files: &mut Files,
) -> Result<Drawn<'a>, PrintError> {
    let svg = figure.svg().map_err(|e| PrintError(e.to_string()))?;
    let file = format!("figure-{}.svg", files.len());
    files.push((file.clone(), svg.into_bytes()));
    let caption = figure.caption.as_str();
    let alt = if caption.is_empty() { title } else { caption };
    Ok(Drawn { file, caption, alt, round: figure.round })
}

fn table<'a>(table: &'a Table, labels: &Labels) -> Block<'a> {
    let columns = table.columns();
    Block::Table {
        headings: &table.headings,
        rows: table.rows.iter().take(MOST_ROWS).map(|row| filled(row, columns)).collect(),
        left: (0..columns).map(|i| table.has_words(i)).collect(),
        note: note(table, labels),
    }
}

/// Every row has all columns, or those below would move up.
fn filled(row: &Row, columns: usize) -> Cells<'_> {
    let mut cells: Vec<&str> = row.cells.iter().map(String::as_str).collect();
    cells.resize(columns, "");
    let standings = (0..columns).map(|i| row.standing(i)).collect();
    Cells { cells, standings, bold: row.bold }
}

/// What stands below a table, with what is not printed.
fn note<'a>(table: &'a Table, labels: &Labels) -> Cow<'a, str> {
    match table.rows.len().saturating_sub(MOST_ROWS) {
        0 => Cow::Borrowed(&table.note),
        more => {
            let more = label(&labels.more_on_paper, &[&more.to_string()]);
            format!("{} {more}", table.note).trim_start().to_owned().into()
        }
    }
}
