//! Tables of measuring instruments: numbers, empty cells and words.

use crate::csv::{has_headings_excess, report_too_large, rows_excess, too_large};
use crate::limits::{MOST_BAD_ROWS, MOST_ROWS};
use crate::{Diagnostics, Dimension, Place, Unit};

mod copies;

/// A column of words names directions or diagonals, which are few; with more different words it is
/// probably another column.
const MAX_WORDS: usize = 100;

/// The content that is accepted below a heading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cells {
    /// A finite number in every row.
    Numbers,
    /// Finite numbers and empty cells; an empty cell is NaN in [`Column::values`].
    Gaps,
    /// Words; [`Column::values`] holds their indices in [`Sheet::words`].
    Words,
    /// Any text; it is not read.
    Unused,
}

/// One column.
#[derive(Debug, Clone)]
pub struct Column {
    /// The whole heading, such as `deviation_um`.
    pub name: String,
    /// The place of the heading.
    pub place: Place,
    /// The accepted content.
    pub cells: Cells,
    /// One value for each row. Unit: that of the heading.
    pub values: Vec<f64>,
}

impl Column {
    /// The heading without its unit, such as `deviation`.
    pub fn role(&self) -> &str {
        heading(&self.name).0
    }

    /// The unit after the last underscore; empty if there is none.
    pub fn unit(&self) -> &str {
        heading(&self.name).1
    }
}

/// Columns of equal length, with the line of every row.
#[derive(Debug, Clone, Default)]
pub struct Sheet {
    /// The file as the user named it.
    pub file: String,
    /// All columns.
    pub columns: Vec<Column>,
    /// The different words, in the order in which they came.
    pub words: Vec<String>,
    lines: Vec<usize>,
}

/// Splits a heading into name and unit: `deviation_um` is `deviation` in `um`.
pub fn heading(name: &str) -> (&str, &str) {
    name.rsplit_once('_').unwrap_or((name, ""))
}

impl Sheet {
    /// Reads a text: `#` comments, one line of headings, rows. `None` if a row cannot be read; all
    /// such rows are reported.
    pub fn parse(
        file: &str,
        text: &str,
        cells: impl Fn(&str) -> Cells,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let mut sheet = Self { file: file.to_owned(), ..Self::default() };
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut bad = 0;
        for (i, line) in text.lines().enumerate() {
            let start = line.trim_start();
            if start.is_empty() || start.starts_with('#') {
                continue;
            }
            if sheet.columns.is_empty() {
                sheet.read_headings(i + 1, line, &cells, problems)?;
            } else {
                bad += usize::from(sheet.read_row(i + 1, line, problems).is_none());
                if sheet.rows() > MOST_ROWS || bad == MOST_BAD_ROWS {
                    rows_excess(bad, sheet.place(i + 1, 1), problems);
                    return None;
                }
            }
        }
        if sheet.lines.is_empty() && bad == 0 {
            let hint = "one line of headings, each with its unit, then one row for each reading";
            let message = "the table has no row".to_owned();
            problems.error("empty-table", Place::whole(file), message, hint);
            return None;
        }
        (bad == 0).then_some(sheet)
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }

    /// The place of a row, counted from 0.
    pub fn row_place(&self, row: usize) -> Place {
        self.place(self.lines.get(row).copied().unwrap_or(0), 1)
    }

    /// The place of the headings.
    pub fn headings_place(&self) -> Place {
        self.columns.first().map_or(Place::whole(&self.file), |c| c.place.clone())
    }

    /// The column of that name, with any unit.
    pub fn about(&self, role: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.role() == role || c.name == role)
    }

    /// The rows with one word (its index in [`Sheet::words`]) in a column, as a table.
    pub fn rows_with(&self, column: &Column, word: f64) -> Self {
        self.filtered(|row| column.values.get(row) == Some(&word))
    }

    fn filtered(&self, is_kept: impl Fn(usize) -> bool) -> Self {
        let kept = |values: &[f64]| {
            let numbered = values.iter().enumerate().filter(|(row, _)| is_kept(*row));
            numbered.map(|(_, v)| *v).collect()
        };
        let lines = self.lines.iter().enumerate().filter(|(row, _)| is_kept(*row));
        let columns = self.columns.iter();
        Self {
            file: self.file.clone(),
            columns: columns.map(|c| Column { values: kept(&c.values), ..c.clone() }).collect(),
            words: self.words.clone(),
            lines: lines.map(|(_, line)| *line).collect(),
        }
    }

    /// The numbers of a column in the inner unit (mm, rad, s, °C), NaN for empty cells; `None` and a
    /// problem if the heading does not name a unit of this dimension.
    pub fn inner(
        &self,
        column: &Column,
        dimension: Dimension,
        problems: &mut Diagnostics,
    ) -> Option<Vec<f64>> {
        let fault = |e: crate::QuantityError, place, problems: &mut Diagnostics| {
            let message = format!("column `{}`: {e}", column.name);
            problems.error(e.code(), place, message, &e.hint());
        };
        let unit = match Unit::find(column.unit(), dimension) {
            Ok(unit) => unit,
            Err(e) => {
                fault(e, column.place.clone(), problems);
                return None;
            }
        };
        let mut values = Vec::with_capacity(column.values.len());
        for (row, value) in column.values.iter().enumerate() {
            match unit.checked(*value) {
                _ if value.is_nan() => values.push(f64::NAN),
                Ok(value) => values.push(value),
                Err(e) => {
                    fault(e, self.row_place(row), problems);
                    return None;
                }
            }
        }
        Some(values)
    }

    fn place(&self, line: usize, column: usize) -> Place {
        Place { file: self.file.clone(), line, column }
    }

    fn read_headings(
        &mut self,
        line: usize,
        text: &str,
        cells: &impl Fn(&str) -> Cells,
        problems: &mut Diagnostics,
    ) -> Option<()> {
        let foreign = [(';', "semicolons"), ('\t', "tabs")];
        if let Some((_, name)) =
            foreign.iter().find(|(c, _)| text.trim().contains(*c) && !text.contains(','))
        {
            let message = format!("the columns are separated by {name}");
            let hint = "separate them by commas, and write decimals with a point";
            problems.error("bad-separator", self.place(line, 1), message, hint);
            return None;
        }
        if has_headings_excess(text, &self.place(line, 1), problems) {
            return None;
        }
        for (column, name) in fields(text) {
            let place = self.place(line, column);
            if self.columns.iter().any(|c| c.name == name) {
                let message = format!("two columns are named `{name}`");
                problems.error("duplicate-column", place, message, "give each its own name");
                return None;
            }
            let (name, cells) = (name.to_owned(), cells(name));
            self.columns.push(Column { name, place, cells, values: Vec::new() });
        }
        Some(())
    }

    fn read_row(&mut self, line: usize, text: &str, problems: &mut Diagnostics) -> Option<()> {
        let mut sound = 0;
        let mut fault = None;
        for (i, (at, field)) in fields(text).enumerate() {
            let Some(column) = self.columns.get_mut(i) else {
                fault.get_or_insert((1, None));
                break;
            };
            let value = match column.cells {
                Cells::Unused => Some(0.0),
                Cells::Words => word(&mut self.words, field),
                Cells::Gaps if field.is_empty() => Some(f64::NAN),
                _ => field.parse::<f64>().ok().filter(|v| v.is_finite()),
            };
            let number = value.filter(|_| matches!(column.cells, Cells::Numbers | Cells::Gaps));
            if let Some(number) = number.filter(|v| too_large(&column.name, *v).is_some()) {
                let place = Place { file: self.file.clone(), line, column: at };
                report_too_large(&column.name, (field, number), place, problems);
                for column in &mut self.columns {
                    column.values.truncate(self.lines.len());
                }
                return None;
            }
            match value {
                Some(value) => column.values.push(value),
                None => {
                    fault = Some((at, Some(field.to_owned())));
                    break;
                }
            }
            sound = i + 1;
        }
        if fault.is_none() && sound == self.columns.len() {
            self.lines.push(line);
            return Some(());
        }
        // The row is discarded: no column may be longer than the others.
        for column in &mut self.columns {
            column.values.truncate(self.lines.len());
        }
        match fault {
            Some((at, Some(field))) => {
                let number = fields(text).position(|(c, _)| c == at);
                let number = number.and_then(|i| self.columns.get(i));
                if number.is_some_and(|c| c.cells == Cells::Words) {
                    let message =
                        format!("`{field}`: more than {MAX_WORDS} different words in this column");
                    let hint = "check whether this is the intended column";
                    problems.error("too-many-words", self.place(line, at), message, hint);
                    return None;
                }
                let message = format!("`{field}` is not a finite number");
                let hint = "write a number such as -1.5";
                problems.error("not-a-number", self.place(line, at), message, hint);
            }
            _ => {
                let count = fields(text).count();
                let message =
                    format!("fields in this row: {count}, headings: {}", self.columns.len());
                let hint = "write one field under each heading";
                problems.error("ragged-row", self.place(line, 1), message, hint);
            }
        }
        None
    }
}

/// The index of a word in the list; a new word is appended, up to [`MAX_WORDS`].
fn word(words: &mut Vec<String>, field: &str) -> Option<f64> {
    let at = words.iter().position(|w| w == field).or_else(|| {
        words.push(field.to_owned());
        (words.len() <= MAX_WORDS).then(|| words.len() - 1)
    });
    words.truncate(MAX_WORDS);
    at.map(|at| at as f64)
}

/// The trimmed fields of a line with the column (from 1, in characters) where each begins.
fn fields(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut column = 1;
    text.trim_end_matches('\r').split(',').map(move |field| {
        let lead = field.chars().take_while(|c| c.is_whitespace()).count();
        let start = column + lead;
        // Columns count characters, so that a µ in a remark does not shift the following places.
        column += if field.is_ascii() { field.len() } else { field.chars().count() } + 1;
        (start, field.trim())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(name: &str) -> Cells {
        match heading(name).0 {
            "direction" => Cells::Words,
            "gap" => Cells::Gaps,
            _ => Cells::Numbers,
        }
    }

    #[test]
    fn gaps_and_words_are_read_where_they_may_stand() {
        let mut problems = Diagnostics::new();
        let text = "# by hand\ntarget_mm,direction,gap_um\n1,up,2\n2,down,\n3,up,4\n";
        let sheet = Sheet::parse("t.csv", text, cells, &mut problems).unwrap();
        assert_eq!(sheet.columns[1].values, [0.0, 1.0, 0.0]);
        assert!(sheet.columns[2].values[1].is_nan());
        assert_eq!(sheet.row_place(2).line, 5);
        assert!(!problems.has_errors());
    }

    #[test]
    fn a_heading_without_end_is_refused_and_not_repeated() {
        let mut problems = Diagnostics::new();
        let text = format!("target_mm,{}\n1,2\n", "x".repeat(1 << 20));
        assert!(Sheet::parse("t.csv", &text, cells, &mut problems).is_none());
        let found = problems.iter().next().unwrap();
        assert_eq!(found.code, "over-limit");
        assert!(found.message.len() < 200, "{}", found.message);
    }

    #[test]
    fn too_many_words_are_refused() {
        let rows: String = (0..=MAX_WORDS).map(|i| format!("w{i}\n")).collect();
        let mut problems = Diagnostics::new();
        let text = format!("direction\n{rows}");
        assert!(Sheet::parse("t.csv", &text, cells, &mut problems).is_none());
        let found = problems.iter().next().unwrap();
        assert_eq!((found.code, found.place.line), ("too-many-words", MAX_WORDS + 2));
    }

    #[test]
    fn a_number_that_no_machine_has_is_refused_with_its_row() {
        // 1e9 µm are 1 km; under a heading without a unit a number may be larger.
        for (text, place) in [
            ("target_mm,gap_um\n1,2\n3,1e9\n", "t.csv:3:3"),
            ("target_mm,gap_um\n-1e308,2\n", "t.csv:2:1"),
            ("target_deg,gap_urad\n1,1e9\n", "t.csv:2:3"),
        ] {
            let mut problems = Diagnostics::new();
            assert!(Sheet::parse("t.csv", text, cells, &mut problems).is_none());
            let found = problems.iter().next().unwrap();
            assert_eq!((found.code, found.place.to_string().as_str()), ("too-large", place));
        }
        let mut problems = Diagnostics::new();
        assert!(Sheet::parse("t.csv", "number\n1e9\n", cells, &mut problems).is_some());
    }

    #[test]
    fn every_bad_row_is_reported_with_its_place() {
        let mut problems = Diagnostics::new();
        let text = "target_mm,gap_um\nnan,1\n1\n1,2,3\n4,x\n5,\n";
        assert!(Sheet::parse("t.csv", text, cells, &mut problems).is_none());
        let places: Vec<_> = problems.iter().map(|d| d.place.to_string()).collect();
        assert_eq!(places, ["t.csv:2:1", "t.csv:3:1", "t.csv:4:1", "t.csv:5:3"]);
    }
}
