//! An answer described once: text for the terminal, one page, its pictures.
//!
//! ```
//! use trueaxis_report::{Report, Section, Standing, Table};
//! let table = Table::new(["", "µm"]).row(["reversal", "2.50"]);
//! let report = Report::new("Axis X")
//!     .verdict(Standing::Good, "PASS", "within the limit")
//!     .section(Section::new("Figures").table(table));
//! assert_eq!(
//!     report.text(),
//!     "Axis X\n\nPASS: within the limit\n\nFigures\n               µm\n  reversal   2.50\n"
//! );
//! assert!(report.html().unwrap().contains("<h2>Figures</h2>"));
//! ```

mod heading;
mod html;
mod language;
mod section;
mod table;
mod text;

pub use heading::{Heading, Logo, LogoKind};
pub use language::{English, Labels, Language, filled};
pub use section::{Columns, Figure, Item, Place, Section};
pub use table::{Row, Table};

use crate::DrawingError;
use crate::JsonSchema;
use serde::Serialize;

/// How a verdict is coloured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Standing {
    /// Nothing to object.
    Good,
    /// Out of limits, or without result.
    Bad,
    /// Neither.
    Open,
}

/// The result in one word and in one sentence.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Verdict {
    /// How it is coloured.
    pub standing: Standing,
    /// `PASS`.
    pub word: String,
    /// What that means; may be empty.
    pub sentence: String,
}

/// An answer.
#[derive(Debug, Default)]
pub struct Report<'a> {
    /// Above all.
    pub title: String,
    /// Below the title on paper: number, customer, instruments; the lines for signatures at the end.
    pub heading: Option<Heading>,
    /// When it was made, such as `2026-11-28`; may be empty.
    pub date: String,
    /// Under the title: the subject of the report.
    pub lines: Vec<String>,
    /// The result, if there is one.
    pub verdict: Option<Verdict>,
    /// What stands below, in its order; those without content are left out.
    pub sections: Vec<Section<'a>>,
    /// What the layout itself says.
    pub labels: Labels,
}

impl<'a> Report<'a> {
    /// A report without content.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// A line under the title.
    #[must_use]
    pub fn line(mut self, line: impl Into<String>) -> Self {
        self.lines.push(line.into());
        self
    }

    /// The result.
    #[must_use]
    pub fn verdict(
        mut self,
        standing: Standing,
        word: impl Into<String>,
        sentence: impl Into<String>,
    ) -> Self {
        let (word, sentence) = (word.into(), sentence.into());
        self.verdict = Some(Verdict { standing, word, sentence });
        self
    }

    /// One more section.
    #[must_use]
    pub fn section(mut self, section: Section<'a>) -> Self {
        self.sections.push(section);
        self
    }

    /// More sections.
    #[must_use]
    pub fn sections(mut self, sections: impl IntoIterator<Item = Section<'a>>) -> Self {
        self.sections.extend(sections);
        self
    }

    /// The sections that have something to show on a page.
    pub fn on_page(&self) -> impl Iterator<Item = &Section<'a>> {
        self.sections.iter().filter(|section| section.shows(false))
    }

    /// Who made it, for the foot of a page.
    pub fn made_by(&self) -> String {
        let Labels { made, made_on, .. } = &self.labels;
        let label = if self.date.is_empty() { made } else { made_on };
        filled(label, &[crate::VERSION, &self.date])
    }

    /// As the terminal shows it: without heading and pictures, tables cut to the rows that one can read.
    pub fn text(&self) -> String {
        text::text(self)
    }

    /// One self-contained page: opens offline, no script, no file from elsewhere.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn html(&self) -> Result<String, DrawingError> {
        html::html(self)
    }

    /// The pictures in their order, each as SVG.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn pictures(&self) -> Result<Vec<String>, DrawingError> {
        let figures = self.sections.iter().flat_map(Section::figures);
        figures.map(Figure::svg).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    fn report(drawn: &Cell<u32>) -> Report<'_> {
        let draw = || {
            drawn.set(drawn.get() + 1);
            Ok("<svg/>".to_owned())
        };
        Report::new("T")
            .line("l < 1")
            .section(Section::new("empty"))
            .section(
                Section::new("seen on the page")
                    .on_page()
                    .paragraph("p")
                    .figure(Figure::new("c", draw)),
            )
            .section(Section::new("both").note("n").list(["a".to_owned()]).code("x = 1\n"))
    }

    #[test]
    fn text_has_no_picture_and_no_empty_section() {
        let drawn = Cell::new(0);
        let report = report(&drawn);
        assert_eq!(report.text(), "T\n  l < 1\n\nboth\n  n\n  - a\n\n  x = 1\n");
        assert_eq!(drawn.get(), 0);
        assert_eq!(report.pictures().unwrap(), ["<svg/>"]);
    }

    #[test]
    fn page_is_escaped_and_complete() {
        let drawn = Cell::new(0);
        let page = report(&drawn).html().unwrap();
        assert_eq!(drawn.get(), 1);
        for part in
            ["l &lt; 1", "<figcaption>c</figcaption>", "<svg/>", "x = 1", "made by trueaxis"]
        {
            assert!(page.contains(part), "{part}");
        }
        assert!(!page.contains("empty"));
    }

    #[test]
    fn a_picture_that_fails_fails_the_page() {
        let draw = || Err(crate::plots::drawing_error("no"));
        let report = Report::new("T").section(Section::new("s").figure(Figure::new("", draw)));
        assert!(report.html().is_err());
        assert!(report.pictures().is_err());
    }
}
