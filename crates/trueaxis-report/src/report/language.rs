//! A report in another language: its texts, the words of its own, and those in its pictures.
//!
//! The reports are written in English, as sentences with values in them. A [`Language`] is asked for each text; what it
//! does not know stays English. What a text means to the layout (`pass` is green) is settled before.

use super::{Figure, Heading, Item, Report, Row, Section, Standing, Table, Verdict};
use std::fmt;

/// Says English texts in another language.
pub trait Language: fmt::Debug + Sync {
    /// As HTML names it: `en`, `de`, `zh`.
    fn code(&self) -> &str;

    /// The text in this language; the same text where it is not known.
    fn text(&self, english: &str) -> String;
}

/// The language that the reports are written in.
#[derive(Debug, Clone, Copy)]
pub struct English;

impl Language for English {
    fn code(&self) -> &str {
        "en"
    }

    fn text(&self, english: &str) -> String {
        english.to_owned()
    }
}

/// What the layout itself says; `{0}`, `{1}` stand for values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Labels {
    /// As HTML names it.
    pub language: String,
    /// At the foot of a report without a date.
    pub made: String,
    /// The same with its date.
    pub made_on: String,
    /// Beside a line for a signature.
    pub signature: String,
    /// At the foot of each page.
    pub page: String,
    /// Below a table that the terminal cuts.
    pub more_rows: String,
    /// Below a table that paper cuts.
    pub more_on_paper: String,
}

impl Default for Labels {
    fn default() -> Self {
        Self {
            language: "en".to_owned(),
            made: "made by trueaxis {0}".to_owned(),
            made_on: "made by trueaxis {0} on {1}".to_owned(),
            signature: "{0}: name, date, signature".to_owned(),
            page: "page {0} of {1}".to_owned(),
            more_rows: "… and {0} more; --format json has all".to_owned(),
            more_on_paper: "… and {0} more rows: the HTML report has them all.".to_owned(),
        }
    }
}

/// A label with its values.
pub fn filled(label: &str, values: &[&str]) -> String {
    let numbered = values.iter().enumerate();
    numbered.fold(label.to_owned(), |text, (i, value)| text.replace(&format!("{{{i}}}"), value))
}

impl Labels {
    fn of(language: &dyn Language) -> Self {
        let english = Self::default();
        Self {
            language: language.code().to_owned(),
            made: language.text(&english.made),
            made_on: language.text(&english.made_on),
            signature: language.text(&english.signature),
            page: language.text(&english.page),
            more_rows: language.text(&english.more_rows),
            more_on_paper: language.text(&english.more_on_paper),
        }
    }
}

impl<'a> Report<'a> {
    /// The same report in another language. Names, values and lines of files stay as they are.
    ///
    /// ```
    /// use trueaxis_report::{Language, Report, Section, Table};
    /// #[derive(Debug)]
    /// struct German;
    /// impl Language for German {
    ///     fn code(&self) -> &str {
    ///         "de"
    ///     }
    ///     fn text(&self, english: &str) -> String {
    ///         if english == "Figures" { "Kennwerte" } else { english }.to_owned()
    ///     }
    /// }
    /// let figures = Table::new(["", "µm"]).row(["B", "2.50"]);
    /// let report = Report::new("X").section(Section::new("Figures").table(figures));
    /// assert_eq!(report.in_language(&German).text(), "X\n\nKennwerte\n        µm\n  B   2.50\n");
    /// ```
    #[must_use]
    pub fn in_language(self, language: &'a dyn Language) -> Self {
        let say = |text: String| language.text(&text);
        Self {
            title: say(self.title),
            heading: self.heading.map(|heading| in_heading(heading, language)),
            date: self.date,
            lines: said(self.lines, language),
            verdict: self.verdict.map(|v| Verdict {
                standing: v.standing,
                word: say(v.word),
                sentence: say(v.sentence),
            }),
            sections: self.sections.into_iter().map(|s| in_section(s, language)).collect(),
            labels: Labels::of(language),
        }
    }
}

fn said(texts: Vec<String>, language: &dyn Language) -> Vec<String> {
    texts.into_iter().map(|text| language.text(&text)).collect()
}

/// The names of the entries; what is stated stays as it was stated.
fn in_heading(heading: Heading, language: &dyn Language) -> Heading {
    let entries = heading.entries.into_iter();
    Heading {
        entries: entries.map(|(name, value)| (language.text(&name), value)).collect(),
        table: heading.table.map(|table| in_instruments(table, language)),
        ..heading
    }
}

/// Names and numbers stay as stated; whether each is valid stands in the last column.
fn in_instruments(table: Table, language: &dyn Language) -> Table {
    let mut rows = table.rows;
    for cell in rows.iter_mut().filter_map(|row| row.cells.last_mut()) {
        *cell = language.text(cell);
    }
    Table { headings: said(table.headings, language), rows, ..table }
}

fn in_section<'a>(section: Section<'a>, language: &'a dyn Language) -> Section<'a> {
    Section {
        title: language.text(&section.title),
        place: section.place,
        items: section.items.into_iter().map(|item| in_item(item, language)).collect(),
    }
}

fn in_item<'a>(item: Item<'a>, language: &'a dyn Language) -> Item<'a> {
    match item {
        Item::Paragraph(text) => Item::Paragraph(language.text(&text)),
        Item::Note(text) => Item::Note(language.text(&text)),
        Item::List(lines) => Item::List(said(lines, language)),
        Item::Code(lines) => Item::Code(lines),
        Item::Table(table) => Item::Table(in_table(table, language)),
        Item::Figures(columns, figures) => {
            let figures = figures.into_iter().map(|figure| in_figure(figure, language));
            Item::Figures(columns, figures.collect())
        }
    }
}

fn in_table(table: Table, language: &dyn Language) -> Table {
    let row = |row: Row| {
        let standings: Vec<Option<Standing>> =
            (0..row.cells.len()).map(|i| row.standing(i)).collect();
        Row { cells: said(row.cells, language), bold: row.bold, standings }
    };
    Table {
        headings: said(table.headings, language),
        rows: table.rows.into_iter().map(row).collect(),
        note: language.text(&table.note),
        most_on_terminal: table.most_on_terminal,
    }
}

fn in_figure<'a>(figure: Figure<'a>, language: &'a dyn Language) -> Figure<'a> {
    let (caption, round) = (language.text(&figure.caption), figure.round);
    let drawn = move || figure.svg().map(|svg| in_svg(&svg, language));
    let mut said = Figure::new(caption, drawn);
    said.round = round;
    said
}

/// What stands between the tags of `<text>` and `<title>`.
fn in_svg(svg: &str, language: &dyn Language) -> String {
    let mut out = String::with_capacity(svg.len());
    let mut rest = svg;
    while let Some(at) = next_text(rest) {
        let (before, text) = rest.split_at(at);
        let (text, after) = text.split_at(text.find('<').unwrap_or(text.len()));
        out.push_str(before);
        let (lead, content) = text.split_at(text.len() - text.trim_start().len());
        let (content, trail) = content.split_at(content.trim_end().len());
        out.push_str(lead);
        out.push_str(&escaped(&language.text(&unescaped(content))));
        out.push_str(trail);
        rest = after;
    }
    out.push_str(rest);
    out
}

/// Where the content of the next text begins.
fn next_text(svg: &str) -> Option<usize> {
    let starts = ["<text", "<title"].iter().filter_map(|tag| svg.find(tag));
    let start = starts.min()?;
    Some(start + svg.get(start..)?.find('>')? + 1)
}

const ESCAPES: [(&str, &str); 5] =
    [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];

fn unescaped(text: &str) -> String {
    ESCAPES.iter().fold(text.to_owned(), |text, (escape, sign)| text.replace(escape, sign))
}

fn escaped(text: &str) -> String {
    ESCAPES.iter().rev().fold(text.to_owned(), |text, (escape, sign)| text.replace(sign, escape))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Says every text backwards, so that nothing stays by chance.
    #[derive(Debug)]
    struct Backwards;

    impl Language for Backwards {
        fn code(&self) -> &str {
            "xx"
        }

        fn text(&self, english: &str) -> String {
            english.chars().rev().collect()
        }
    }

    #[test]
    fn texts_of_a_picture_are_said_and_nothing_else_of_it() {
        let svg = "<svg><text x=\"1\">\nab &lt;\n</text><rect/><title>cd</title></svg>";
        let said = "<svg><text x=\"1\">\n&lt; ba\n</text><rect/><title>dc</title></svg>";
        assert_eq!(in_svg(svg, &Backwards), said);
        assert_eq!(in_svg("<text", &Backwards), "<text");
    }

    #[test]
    fn every_text_is_said_and_verdicts_keep_their_colours() {
        let table = Table::new(["one"]).row(["pass"]).note("two");
        let report = Report::new("three").line("four").verdict(Standing::Good, "five", "six");
        let report =
            report.section(Section::new("seven").paragraph("eight").table(table).code("nine"));
        let page = report.in_language(&Backwards).html().unwrap();
        for text in ["eno", "owt", "eerht", "ruof", "evif", "xis", "neves", "thgie", "nine"] {
            assert!(page.contains(text), "{text}");
        }
        assert!(page.contains("<html lang=\"xx\">"));
        assert!(page.contains("class=\"pass\"") && page.contains(">ssap<"));
    }
}
