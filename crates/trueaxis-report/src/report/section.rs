//! A section of a report and what stands in it.

use super::Table;
use crate::{DrawingError, Picture};
use std::fmt;

/// Where a section is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Place {
    /// On the terminal and on the page.
    #[default]
    Both,
    /// On the page only.
    Page,
    /// On the terminal only.
    Terminal,
}

/// How many pictures stand beside each other on a wide page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Columns {
    /// Each over the whole width.
    One,
    /// Two or three, as there is room.
    AsFit,
    /// Three, such as the views of a drawing.
    Three,
}

type Drawing<'a> = Box<dyn Fn() -> Result<String, DrawingError> + 'a>;

/// A picture, drawn when it is asked for.
pub struct Figure<'a> {
    /// Below it; may be empty.
    pub caption: String,
    /// As high as wide: not drawn over the whole width of a page.
    pub round: bool,
    draw: Drawing<'a>,
}

impl<'a> Figure<'a> {
    /// A picture from what draws it as SVG.
    pub fn new(
        caption: impl Into<String>,
        draw: impl Fn() -> Result<String, DrawingError> + 'a,
    ) -> Self {
        Self { caption: caption.into(), round: false, draw: Box::new(draw) }
    }

    /// The picture as SVG.
    ///
    /// # Errors
    /// What the drawing library says.
    pub fn svg(&self) -> Result<String, DrawingError> {
        (self.draw)()
    }
}

impl From<Picture> for Figure<'_> {
    fn from(picture: Picture) -> Self {
        let (round, caption) = (picture.is_round(), picture.note().to_owned());
        Self { round, ..Self::new(caption, move || picture.svg()) }
    }
}

impl fmt::Debug for Figure<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Figure").field("caption", &self.caption).finish_non_exhaustive()
    }
}

/// What stands in a section.
#[derive(Debug)]
pub enum Item<'a> {
    /// A paragraph.
    Paragraph(String),
    /// What explains the rest, in a soft colour.
    Note(String),
    /// One line for each.
    List(Vec<String>),
    /// Lines as they are, such as those of a file.
    Code(String),
    /// A table.
    Table(Table),
    /// Pictures beside each other.
    Figures(Columns, Vec<Figure<'a>>),
}

/// A titled part of a report.
#[derive(Debug, Default)]
pub struct Section<'a> {
    /// Above it.
    pub title: String,
    /// Where it is shown.
    pub place: Place,
    /// What stands in it.
    pub items: Vec<Item<'a>>,
}

impl<'a> Section<'a> {
    /// A section without content.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Not on the terminal.
    #[must_use]
    pub fn on_page(mut self) -> Self {
        self.place = Place::Page;
        self
    }

    /// Not on the page.
    #[must_use]
    pub fn on_terminal(mut self) -> Self {
        self.place = Place::Terminal;
        self
    }

    /// One more item.
    #[must_use]
    pub fn item(mut self, item: Item<'a>) -> Self {
        self.items.push(item);
        self
    }

    /// A paragraph.
    #[must_use]
    pub fn paragraph(self, text: impl Into<String>) -> Self {
        self.item(Item::Paragraph(text.into()))
    }

    /// What explains the rest.
    #[must_use]
    pub fn note(self, text: impl Into<String>) -> Self {
        self.item(Item::Note(text.into()))
    }

    /// One line for each; nothing where there is none.
    #[must_use]
    pub fn list(self, lines: impl IntoIterator<Item = String>) -> Self {
        self.item(Item::List(lines.into_iter().collect()))
    }

    /// Lines as they are.
    #[must_use]
    pub fn code(self, lines: impl Into<String>) -> Self {
        self.item(Item::Code(lines.into()))
    }

    /// A table.
    #[must_use]
    pub fn table(self, table: Table) -> Self {
        self.item(Item::Table(table))
    }

    /// A picture over the whole width.
    #[must_use]
    pub fn figure(self, figure: Figure<'a>) -> Self {
        self.item(Item::Figures(Columns::One, vec![figure]))
    }

    /// Pictures beside each other.
    #[must_use]
    pub fn grid(self, columns: Columns, figures: impl IntoIterator<Item = Figure<'a>>) -> Self {
        self.item(Item::Figures(columns, figures.into_iter().collect()))
    }

    /// The pictures in it.
    pub fn figures(&self) -> impl Iterator<Item = &Figure<'a>> {
        self.items.iter().flat_map(|item| match item {
            Item::Figures(_, figures) => figures.as_slice(),
            _ => &[],
        })
    }

    /// Whether the section has something to show there.
    pub(super) fn shows(&self, terminal: bool) -> bool {
        let other = if terminal { Place::Page } else { Place::Terminal };
        self.place != other && self.items.iter().any(|item| item.shows(terminal))
    }
}

impl From<Picture> for Section<'_> {
    /// A section of one picture, with its title and its note.
    fn from(picture: Picture) -> Self {
        Self::new(picture.title().to_owned()).figure(Figure::from(picture))
    }
}

impl Item<'_> {
    /// A note alone is nothing: it explains what else stands there.
    fn shows(&self, terminal: bool) -> bool {
        match self {
            Self::Paragraph(text) | Self::Code(text) => !text.is_empty(),
            Self::Note(_) => false,
            Self::List(lines) => !lines.is_empty(),
            Self::Table(table) => !table.rows.is_empty(),
            Self::Figures(_, figures) => !terminal && !figures.is_empty(),
        }
    }
}
