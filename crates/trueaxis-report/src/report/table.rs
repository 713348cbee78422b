//! A table of a report.

use super::Standing;

/// A row of a table.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Row {
    /// The cells.
    pub cells: Vec<String>,
    /// Whether it stands out: a chosen or decisive one.
    pub bold: bool,
    /// What the cells stand for, where their words no longer say it.
    pub standings: Vec<Option<Standing>>,
}

impl Row {
    /// Whether a cell is a verdict, which is coloured.
    pub fn standing(&self, column: usize) -> Option<Standing> {
        match self.cells.get(column)?.as_str() {
            "pass" => Some(Standing::Good),
            "fail" => Some(Standing::Bad),
            "undecided" => Some(Standing::Open),
            _ => *self.standings.get(column)?,
        }
    }
}

/// A table; the first column is text.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Table {
    /// The first line, with units; none for pairs of name and value.
    pub headings: Vec<String>,
    /// The rows.
    pub rows: Vec<Row>,
    /// Below it; may be empty.
    pub note: String,
    /// How many rows the terminal shows.
    pub most_on_terminal: usize,
}

impl Table {
    /// A table without rows.
    pub fn new<T: Into<String>>(headings: impl IntoIterator<Item = T>) -> Self {
        let headings = headings.into_iter().map(Into::into).collect();
        Self { headings, most_on_terminal: 60, ..Self::default() }
    }

    /// Names with their values, without headings.
    pub fn pairs<N: Into<String>, V: Into<String>>(rows: impl IntoIterator<Item = (N, V)>) -> Self {
        let rows = rows.into_iter().map(|(name, value)| [name.into(), value.into()]);
        Self::new(Vec::<String>::new()).rows(rows)
    }

    /// One more row.
    #[must_use]
    pub fn row<T: Into<String>>(mut self, cells: impl IntoIterator<Item = T>) -> Self {
        self.push(cells);
        self
    }

    /// More rows.
    #[must_use]
    pub fn rows<T: Into<String>, R: IntoIterator<Item = T>>(
        mut self,
        rows: impl IntoIterator<Item = R>,
    ) -> Self {
        rows.into_iter().for_each(|row| self.push(row));
        self
    }

    /// One more row that stands out.
    #[must_use]
    pub fn bold_row<T: Into<String>>(mut self, cells: impl IntoIterator<Item = T>) -> Self {
        self.push(cells);
        if let Some(row) = self.rows.last_mut() {
            row.bold = true;
        }
        self
    }

    /// What stands below it.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.note = note.into();
        self
    }

    /// How many rows the terminal shows.
    #[must_use]
    pub fn most_on_terminal(mut self, rows: usize) -> Self {
        self.most_on_terminal = rows;
        self
    }

    /// Adds a row.
    pub fn push<T: Into<String>>(&mut self, cells: impl IntoIterator<Item = T>) {
        let cells = cells.into_iter().map(Into::into).collect();
        self.rows.push(Row { cells, ..Row::default() });
    }

    /// How many columns it has.
    pub fn columns(&self) -> usize {
        let cells = self.rows.iter().map(|row| row.cells.len());
        cells.chain([self.headings.len()]).max().unwrap_or(0)
    }

    /// Whether a column holds words, which read better from the left: where no cell is a number.
    pub fn has_words(&self, column: usize) -> bool {
        let cells = || self.rows.iter().filter_map(|row| row.cells.get(column));
        let is_number = |cell: &String| cell == "–" || starts_with_number(cell);
        column == 0 || self.headings.is_empty() || !cells().any(is_number)
    }
}

/// `2.50`, `+1.2 µm`, `98 %`, `1.2 … 3.4`; not `3 of 5 poses`.
fn starts_with_number(cell: &str) -> bool {
    let mut words = cell.split_whitespace();
    let first = words.next().is_some_and(|word| word.parse::<f64>().is_ok());
    first && words.all(|word| word.chars().count() <= 6)
}
