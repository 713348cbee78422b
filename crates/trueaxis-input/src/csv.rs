//! Tables of numbers whose headings carry the units.

mod stretch;

use crate::limits::{LONGEST_HEADING, MOST_BAD_ROWS, MOST_COLUMNS, MOST_ROWS, beginning};
use crate::plausible::largest_under;
use crate::{Diagnostics, Place, Unit};

/// One column of numbers with its heading.
#[derive(Debug, Clone, PartialEq)]
pub struct CsvColumn {
    /// The heading, such as `EXX_um`.
    pub name: String,
    /// The place of the heading.
    pub place: Place,
    /// The numbers, one for each row. Unit: that of the heading.
    pub values: Vec<f64>,
}

/// A table of finite numbers under named columns, with the line of every row.
///
/// ```
/// use trueaxis_input::{CsvTable, Diagnostics};
/// let mut problems = Diagnostics::new();
/// let table = CsvTable::parse("x.csv", "# made by hand\nposition_mm,EXX_um\n0,1.5\n10,2\n", &mut problems);
/// assert_eq!(table.columns[1].values, [1.5, 2.0]);
/// assert_eq!(table.row_place(1).line, 4);
/// assert!(!problems.has_errors());
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CsvTable {
    /// The file as the user named it.
    pub file: String,
    /// All columns, of equal length.
    pub columns: Vec<CsvColumn>,
    lines: Vec<usize>,
}

impl CsvTable {
    /// Reads a text: `#` comments, one line of headings, rows of numbers.
    ///
    /// Rows with problems are reported and omitted, up to [`MOST_BAD_ROWS`] of them; a table with errors must not be used.
    pub fn parse(file: &str, text: &str, problems: &mut Diagnostics) -> Self {
        let mut table = Self { file: file.to_owned(), ..Self::default() };
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut text = Numbered { text, line: 0 };
        let mut bad = 0;
        while let Some((number, line)) = text.next_row() {
            if table.columns.is_empty() {
                let place = Place { file: file.to_owned(), line: number, column: 1 };
                if has_headings_excess(line, &place, problems) {
                    return table;
                }
                table.read_headings(number, line, problems);
                if let Some(separator) = foreign_separator(line) {
                    let place = Place { file: file.to_owned(), line: number, column: 1 };
                    let message = format!("the columns are separated by {separator}");
                    let hint = "separate them by commas, and write decimals with a point";
                    problems.error("bad-separator", place, message, hint);
                    return table;
                }
                // What can be read without a word is; the first problem is met again row by row.
                stretch::read(&mut table, &mut text);
            } else {
                bad += usize::from(table.read_row(number, line, problems).is_none());
                if table.rows() > MOST_ROWS || bad == MOST_BAD_ROWS {
                    let place = Place { file: file.to_owned(), line: number, column: 1 };
                    rows_excess(bad, place, problems);
                    return table;
                }
            }
        }
        if table.columns.is_empty() {
            problems.error(
                "empty-table",
                Place::whole(file),
                "the table has no line of headings".to_owned(),
                "the first line names the columns, each with its unit, such as position_mm,EXX_um",
            );
        }
        table
    }

    /// A table from binary columns, such as those of a Parquet file; places count rows as lines.
    ///
    /// Columns of different lengths and numbers that are not finite are reported; a table with
    /// errors must not be used.
    pub fn from_columns(
        file: &str,
        columns: Vec<(String, Vec<f64>)>,
        problems: &mut Diagnostics,
    ) -> Self {
        let rows = columns.first().map_or(0, |c| c.1.len());
        let mut table = Self { file: file.to_owned(), ..Self::default() };
        table.lines = (1..=rows).collect();
        for (column, (name, values)) in columns.into_iter().enumerate() {
            let place = |line| Place { file: file.to_owned(), line, column: column + 1 };
            if let Some(row) = values.iter().position(|v| !v.is_finite()) {
                let message = format!("column `{name}`, row {}: found {}", row + 1, values[row]);
                problems.error(
                    "not-a-number",
                    place(row + 1),
                    message,
                    "every row needs a finite number",
                );
            }
            if values.len() != rows {
                let message = format!("column `{name}` has {} rows, expected {rows}", values.len());
                problems.error("ragged-row", place(0), message, "write one number in each row");
            }
            if table.column(&name).is_some() {
                let message = format!("two columns are named `{name}`");
                problems.error("duplicate-column", place(0), message, "give each its own name");
            }
            table.columns.push(CsvColumn { name, place: place(0), values });
        }
        table
    }

    /// The column of that name.
    pub fn column(&self, name: &str) -> Option<&CsvColumn> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.lines.len()
    }

    /// The place of a row, counted from 0.
    pub fn row_place(&self, row: usize) -> Place {
        Place { file: self.file.clone(), line: self.lines[row], column: 1 }
    }

    /// The numbers of a column, given in `unit`, in the inner unit (mm, rad, s …). `None` and a
    /// problem with its line if a number exceeds the largest accepted value.
    pub fn in_unit(
        &self,
        column: &CsvColumn,
        unit: Unit,
        problems: &mut Diagnostics,
    ) -> Option<Vec<f64>> {
        let mut values = Vec::with_capacity(column.values.len());
        for (row, value) in column.values.iter().enumerate() {
            match unit.checked(*value) {
                Ok(value) => values.push(value),
                Err(error) => {
                    let message = format!("column `{}`: {error}", column.name);
                    problems.error(error.code(), self.row_place(row), message, &error.hint());
                    return None;
                }
            }
        }
        Some(values)
    }

    fn read_headings(&mut self, line: usize, text: &str, problems: &mut Diagnostics) {
        for (column, name) in fields(text) {
            let place = Place { file: self.file.clone(), line, column };
            if self.column(name).is_some() {
                problems.error(
                    "duplicate-column",
                    place.clone(),
                    format!("two columns are named `{name}`"),
                    "give each column its own name",
                );
            }
            self.columns.push(CsvColumn { name: name.to_owned(), place, values: Vec::new() });
        }
    }

    fn read_row(&mut self, line: usize, text: &str, problems: &mut Diagnostics) -> Option<()> {
        let mut row = Vec::with_capacity(self.columns.len());
        for (column, field) in fields(text) {
            let heading = self.columns.get(row.len()).map_or("", |c| c.name.as_str());
            match field.parse::<f64>() {
                Ok(value) if value.is_finite() && too_large(heading, value).is_none() => {
                    row.push(value);
                }
                Ok(value) if value.is_finite() => {
                    let place = Place { file: self.file.clone(), line, column };
                    report_too_large(heading, (field, value), place, problems);
                    return None;
                }
                _ => {
                    let place = Place { file: self.file.clone(), line, column };
                    let message = format!("`{field}` is not a finite number");
                    problems.error("not-a-number", place, message, "write a number such as -1.5");
                    return None;
                }
            }
        }
        if row.len() != self.columns.len() {
            let place = Place { file: self.file.clone(), line, column: 1 };
            let message =
                format!("fields in this row: {}, headings: {}", row.len(), self.columns.len());
            problems.error("ragged-row", place, message, "write one number under each heading");
            return None;
        }
        self.lines.push(line);
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.values.push(value);
        }
        Some(())
    }
}

/// The part of a text that is still to be read, and how many of its lines were.
#[derive(Clone, Copy)]
struct Numbered<'t> {
    text: &'t str,
    line: usize,
}

impl<'t> Numbered<'t> {
    /// The next line that is neither empty nor a comment, with its number.
    fn next_row(&mut self) -> Option<(usize, &'t str)> {
        loop {
            let line = self.text.lines().next()?;
            let end = self.text.find('\n').map_or(self.text.len(), |at| at + 1);
            (self.text, self.line) = (&self.text[end..], self.line + 1);
            let words = line.trim_start();
            if !words.is_empty() && !words.starts_with('#') {
                return Some((self.line, line));
            }
        }
    }
}

/// Whether a row of headings is longer than that of any table; a problem says so.
pub(crate) fn has_headings_excess(text: &str, place: &Place, problems: &mut Diagnostics) -> bool {
    let columns = text.split(',').take(MOST_COLUMNS + 1).count();
    let long = text.split(',').find(|name| name.trim().chars().nth(LONGEST_HEADING).is_some());
    let message = match long {
        Some(name) => {
            let begins = beginning(name.trim());
            format!("a heading has more than {LONGEST_HEADING} characters: `{begins}`")
        }
        None if columns > MOST_COLUMNS => {
            format!("the table has more than {MOST_COLUMNS} columns")
        }
        None => return false,
    };
    let hint = "check whether this is the intended file; keep the columns that are needed, each with a short heading";
    problems.error("over-limit", place.clone(), message, hint);
    true
}

/// The problem of a table that is read no further: too many rows, or too many that cannot be read.
pub(crate) fn rows_excess(bad: usize, place: Place, problems: &mut Diagnostics) {
    if bad < MOST_BAD_ROWS {
        let message = format!("the table has more than {MOST_ROWS} rows");
        let hint = "divide it, or keep every tenth row";
        return problems.error("over-limit", place, message, hint);
    }
    let message = format!("{bad} rows cannot be read; the remaining rows were not checked");
    let hint = "check whether this is the intended file";
    problems.error("too-many-bad-rows", place, message, hint);
}

/// The bound that a number exceeds under a heading: no machine has such a value, whatever the table is about.
pub(crate) fn too_large(heading: &str, value: f64) -> Option<&'static str> {
    // The usual case is fast: the heading is not read.
    if value.abs() < SMALL { None } else { Bound::of(heading).excess(value) }
}

/// Below this no unit of a heading makes a number too large.
const SMALL: f64 = 10.0;

/// The largest number under a heading.
struct Bound(Option<(Unit, f64, &'static str)>);

impl Bound {
    fn of(heading: &str) -> Self {
        Self(largest_under(heading))
    }

    /// The bound in words, if a number exceeds it.
    fn excess(&self, value: f64) -> Option<&'static str> {
        match self.0 {
            _ if value.abs() < SMALL => None,
            Some((unit, largest, words)) => (unit.to_inner(value).abs() > largest).then_some(words),
            None => (value.abs() > LARGEST_NUMBER).then_some("10^12"),
        }
    }
}

/// The largest number under a heading without a unit.
const LARGEST_NUMBER: f64 = 1e12;

pub(crate) fn report_too_large(
    heading: &str,
    (field, value): (&str, f64),
    place: Place,
    problems: &mut Diagnostics,
) {
    let largest = too_large(heading, value).unwrap_or("the largest value");
    let message =
        format!("column `{heading}`: `{field}` exceeds {largest}, the most of any machine");
    problems.error("too-large", place, message, "check the exponent, and the unit of the heading");
}

/// The separator of the headings, if it is not a comma.
fn foreign_separator(headings: &str) -> Option<&'static str> {
    let separators = [(';', "semicolons"), ('\t', "tabs")];
    let found = separators.into_iter().find(|(c, _)| headings.trim().contains(*c))?;
    (!headings.contains(',')).then_some(found.1)
}

/// The trimmed fields of a line with the column (from 1, in characters) where each begins.
fn fields(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut column = 1;
    text.trim_end_matches(['\r', '\n']).split(',').map(move |field| {
        let lead = field.chars().take_while(|c| c.is_whitespace()).count();
        let start = column + lead;
        column += field.chars().count() + 1;
        (start, field.trim())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bad_row_is_reported_with_its_place() {
        let mut problems = Diagnostics::new();
        CsvTable::parse("t.csv", "a,b\n1, x\n1\nnan,2\n3,4\n", &mut problems);
        let places: Vec<_> = problems.iter().map(|d| d.place.to_string()).collect();
        assert_eq!(places, ["t.csv:2:4", "t.csv:3:1", "t.csv:4:1"]);
    }

    #[test]
    fn no_table_is_read_without_end() {
        let first = |text: &str| {
            let mut problems = Diagnostics::new();
            let rows = CsvTable::parse("t.csv", text, &mut problems).rows();
            let last = problems.iter().last().map(|d| (d.code, d.place.line));
            (rows, problems.iter().count(), last)
        };
        let heading = |n: usize| "µ".repeat(n);
        assert_eq!(first(&format!("{}\n1\n", heading(LONGEST_HEADING))), (1, 0, None));
        let long = format!("# by hand\na,{}\n1,2\n", heading(LONGEST_HEADING + 1));
        assert_eq!(first(&long), (0, 1, Some(("over-limit", 2))));
        let columns = |n: usize| (0..n).map(|i| format!("c{i}")).collect::<Vec<_>>().join(",");
        assert_eq!(first(&columns(MOST_COLUMNS)), (0, 0, None));
        assert_eq!(first(&columns(MOST_COLUMNS + 1)), (0, 1, Some(("over-limit", 1))));
        // A table of words: a hundred of them are enough.
        let words = format!("a\n{}", "x\n".repeat(5_000));
        let due = (0, MOST_BAD_ROWS + 1, Some(("too-many-bad-rows", MOST_BAD_ROWS + 1)));
        assert_eq!(first(&words), due);
    }

    #[test]
    fn semicolons_are_one_problem_and_comments_may_be_indented() {
        let codes = |text: &str| {
            let mut problems = Diagnostics::new();
            CsvTable::parse("t.csv", text, &mut problems);
            problems.iter().map(|d| d.code).collect::<Vec<_>>()
        };
        assert_eq!(codes("a;b\n1;2\n3;4\n"), ["bad-separator"]);
        assert!(codes("  # by hand\na,b\n1,2\n").is_empty());
    }
}
