//! Rows without a problem, stretch by stretch in all threads: the same table as row by row.

use super::{Bound, CsvTable, Numbered};
use crate::limits::MOST_ROWS;
use rayon::prelude::*;

/// Bytes of a stretch, to the end of its last line.
const STRETCH: usize = 1 << 18;
/// Stretches that are read before their rows go into the table.
const AT_ONCE: usize = 16;

/// Reads rows until one has a problem, or there may be too many; `text` goes on with the stretch where they are.
pub(super) fn read(table: &mut CsvTable, text: &mut Numbered<'_>) {
    read_by(table, text, STRETCH);
}

fn read_by(table: &mut CsvTable, text: &mut Numbered<'_>, bytes: usize) {
    let bounds: Vec<Bound> = table.columns.iter().map(|c| Bound::of(&c.name)).collect();
    while !text.text.is_empty() {
        let mut next = *text;
        let some: Vec<&str> = (0..AT_ONCE).map_while(|_| next.stretch(bytes)).collect();
        let rows: Vec<Option<Rows>> = some.par_iter().map(|s| Rows::of(s, &bounds)).collect();
        for (stretch, rows) in some.into_iter().zip(rows) {
            let Some(rows) = rows.filter(|r| table.rows() + r.lines.len() <= MOST_ROWS) else {
                return;
            };
            let before = text.line;
            table.lines.extend(rows.lines.iter().map(|line| before + line));
            for (column, values) in table.columns.iter_mut().zip(&rows.columns) {
                column.values.extend_from_slice(values);
            }
            (text.text, text.line) = (&text.text[stretch.len()..], before + rows.count);
        }
    }
}

impl<'t> Numbered<'t> {
    /// The next lines with so many bytes or a line more.
    fn stretch(&mut self, bytes: usize) -> Option<&'t str> {
        let rest = self.text.as_bytes();
        let from = bytes.min(rest.len());
        let end =
            rest[from..].iter().position(|b| *b == b'\n').map_or(rest.len(), |k| from + k + 1);
        let (stretch, text) = self.text.split_at(end);
        self.text = text;
        (!stretch.is_empty()).then_some(stretch)
    }
}

/// The rows of a stretch.
struct Rows {
    /// The number of each in the stretch, from 1.
    lines: Vec<usize>,
    columns: Vec<Vec<f64>>,
    /// The lines of the stretch.
    count: usize,
}

impl Rows {
    /// `None` where there is anything to report.
    fn of(stretch: &str, bounds: &[Bound]) -> Option<Self> {
        let mut rows =
            Self { lines: Vec::new(), columns: vec![Vec::new(); bounds.len()], count: 0 };
        let mut text = Numbered { text: stretch, line: 0 };
        while let Some((number, line)) = text.next_row() {
            let mut fields = line.split(',');
            for (column, bound) in rows.columns.iter_mut().zip(bounds) {
                let value: f64 = fields.next()?.trim().parse().ok()?;
                let is_sound = value.is_finite() && bound.excess(value).is_none();
                column.push(is_sound.then_some(value)?);
            }
            if fields.next().is_some() {
                return None;
            }
            rows.lines.push(number);
        }
        rows.count = text.line;
        Some(rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Diagnostics;

    /// A table by rows alone, and by stretches of any length.
    fn both(text: &str, bytes: usize) -> [(CsvTable, String); 2] {
        [false, true].map(|quick| {
            let (mut table, mut problems) = (CsvTable::default(), Diagnostics::new());
            let mut rest = Numbered { text, line: 0 };
            let (number, headings) = rest.next_row().unwrap();
            table.read_headings(number, headings, &mut problems);
            if quick {
                read_by(&mut table, &mut rest, bytes);
            }
            while let Some((number, line)) = rest.next_row() {
                table.read_row(number, line, &mut problems);
            }
            (table, format!("{problems:?}"))
        })
    }

    #[test]
    fn law_a_table_is_the_same_by_stretches_of_any_length() {
        let rows = |k: u32| match k % 7 {
            0 => format!("# comment {k}\n"),
            1 => "\n".to_owned(),
            2 => format!(" {k}.5 ,\t-{k}e-1\r\n"),
            3 => format!("{k},+.5\n"),
            _ => format!("-0,{k}\n"),
        };
        let sound: String = (0..500).map(rows).collect();
        let all = format!("# µm\na_um,b\n{sound}");
        let ends = [
            "",
            "1,2",
            "1,2\r",
            "1,x\n3,4\n",
            "1\n3,4\n",
            "1,2,3\n",
            "1,inf\n",
            "1e9,0\n",
            "1,2e12\n,\n",
        ];
        for end in ends {
            let text = format!("{all}{end}");
            for bytes in [0, 1, 10, 77, 1000, 1 << 20] {
                let [by_rows, by_stretches] = both(&text, bytes);
                assert_eq!(by_rows, by_stretches, "{end} {bytes}");
            }
            // The middle is as good a place for a problem as the end.
            let text = format!("{all}{}\n{sound}", end.trim_end());
            let [by_rows, by_stretches] = both(&text, 50);
            assert_eq!(by_rows, by_stretches, "{end}");
            assert!(by_rows.0.rows() > 600);
        }
    }
}
