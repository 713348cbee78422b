//! Rows that were copied: they count once, or U shrinks without a reading.

use super::{Cells, Sheet};
use crate::Diagnostics;
use std::collections::{BTreeMap, HashMap};

/// So many copies are named one by one.
const MOST_NAMED: usize = 3;
/// Below this number of different rows, rows that are all repeated may be readings of few digits.
const LEAST_DIFFERENT: usize = 5;
/// Numbers are equal that agree to so many digits of the largest of their column: no control and no instrument states more.
/// Copies whose places were changed by less would shrink U as well.
const DIGITS: f64 = 9.0;

impl Sheet {
    /// The table without rows that are equal to an earlier one to the ninth digit: for points, which no
    /// instrument measures twice alike.
    pub fn with_copies_once(&self, problems: &mut Diagnostics) -> Self {
        self.without(&self.copies(), problems)
    }

    /// As [`Sheet::with_copies_once`], but only such rows count once.
    pub fn with_copies_once_of(
        &self,
        is_point: impl Fn(usize) -> bool,
        problems: &mut Diagnostics,
    ) -> Self {
        let mut copies = self.copies();
        copies.retain(|row, _| is_point(*row));
        self.without(&copies, problems)
    }

    /// As [`Sheet::with_copies_once`], for readings of few digits, which may be equal by chance. Copies are
    /// equal rows that state their run or their time, and a whole table that was pasted several times.
    pub fn with_repeats(&self, problems: &mut Diagnostics) -> Self {
        let copies = self.copies();
        let states = |role: &str| {
            self.columns
                .iter()
                .any(|c| c.cells != Cells::Unused && (c.role() == role || c.name == role))
        };
        if states("run") || states("time") || self.is_pasted(&copies) {
            return self.without(&copies, problems);
        }
        self.clone()
    }

    /// Of every row that is there before, the first of its kind.
    fn copies(&self) -> BTreeMap<usize, usize> {
        let mut first: HashMap<Vec<u64>, usize> = HashMap::new();
        let mut copies = BTreeMap::new();
        let steps: Vec<f64> = self.columns.iter().map(|c| last_digit(&c.values)).collect();
        for row in 0..self.rows() {
            let columns = self.columns.iter().zip(&steps);
            // −0 is 0.
            let digits = columns.map(|(c, step)| ((c.values[row] / step).round() + 0.0).to_bits());
            let key = digits.collect();
            let of = *first.entry(key).or_insert(row);
            if of != row {
                copies.insert(row, of);
            }
        }
        copies
    }

    /// Whether every row is there equally often, at least twice.
    fn is_pasted(&self, copies: &BTreeMap<usize, usize>) -> bool {
        let mut times: BTreeMap<usize, usize> = BTreeMap::new();
        for of in copies.values() {
            *times.entry(*of).or_default() += 1;
        }
        let different = self.rows() - copies.len();
        let often = times.values().next().copied().unwrap_or(0);
        different >= LEAST_DIFFERENT
            && times.len() == different
            && times.values().all(|n| *n == often)
    }

    fn without(&self, copies: &BTreeMap<usize, usize>, problems: &mut Diagnostics) -> Self {
        let hint = "a reading that was taken again has another run or time; delete copies";
        for (copy, of) in copies.iter().take(MOST_NAMED) {
            let message = format!(
                "this row is that of line {} again, to the ninth digit: the two count once",
                self.row_place(*of).line
            );
            problems.warn("copied-rows", self.row_place(*copy), message, hint);
        }
        if let Some((copy, _)) = copies.iter().nth(MOST_NAMED) {
            let message = format!("{} of {} rows are copies in all", copies.len(), self.rows());
            problems.warn("copied-rows", self.row_place(*copy), message, hint);
        }
        self.filtered(|row| !copies.contains_key(&row))
    }
}

/// One in the last of so many digits of the largest number.
fn last_digit(values: &[f64]) -> f64 {
    let largest = values.iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
    let first = largest.log10().floor();
    // Of zeros there is no digit.
    if first.is_finite() { 10_f64.powf(first + 1.0 - DIGITS).max(f64::MIN_POSITIVE) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str, once: bool) -> (usize, Vec<String>) {
        let mut problems = Diagnostics::new();
        let cells = |h: &str| if h == "note" { Cells::Unused } else { Cells::Numbers };
        let sheet = Sheet::parse("t.csv", text, cells, &mut problems).expect("a table");
        let kept = match once {
            true => sheet.with_copies_once(&mut problems),
            false => sheet.with_repeats(&mut problems),
        };
        (kept.rows(), problems.iter().map(|d| format!("{}:{}", d.code, d.place.line)).collect())
    }

    #[test]
    fn points_count_once() {
        let (kept, told) = rows("x_mm,y_mm,note\n1,2,a\n0,2,b\n1,2.0,c\n-0,2,d\n", true);
        assert_eq!((kept, told.len()), (2, 2), "{told:?}");
        assert_eq!(told[0], "copied-rows:4");
    }

    #[test]
    fn readings_of_few_digits_may_be_equal_unless_they_state_their_run() {
        let equal = "p_mm,d_um\n1,2\n1,2\n2,3\n2,4\n3,1\n";
        assert_eq!(rows(equal, false), (5, vec![]));
        let of_run = "p_mm,run,d_um\n1,1,2\n1,2,2\n2,1,3\n2,1,3\n";
        let (kept, told) = rows(of_run, false);
        assert_eq!((kept, told), (3, vec!["copied-rows:5".to_owned()]));
    }

    #[test]
    fn a_table_that_was_pasted_again_counts_once() {
        let body = "1,2\n2,3\n3,1\n4,0\n5,2\n";
        for times in [2, 4] {
            let (kept, told) = rows(&format!("p_mm,d_um\n{}", body.repeat(times)), false);
            assert_eq!((kept, told.len()), (5, 4), "{told:?}");
        }
        // Nor is one whose places were changed by less than is measured, in any unit.
        for unit in [1.0, 1e-3, 25.4] {
            let row = |x: f64, d: f64| format!("{},{}\n", x * unit, d * unit);
            let near: String = (0..4)
                .flat_map(|k| (1..8).map(move |i| (k, f64::from(i))))
                .map(|(k, i)| row(i + f64::from(k) * 1e-9, i * 1.1))
                .collect();
            let (kept, told) = rows(&format!("p_mm,d_um\n{near}"), false);
            assert_eq!((kept, told.len()), (7, 4), "{told:?}");
            // A nanometre in 7 mm is another place.
            let far: String = (0..4)
                .flat_map(|k| (1..8).map(move |i| (k, f64::from(i))))
                .map(|(k, i)| row(i + f64::from(k) * 1e-6, i * 1.1))
                .collect();
            assert_eq!(rows(&format!("p_mm,d_um\n{far}"), false), (28, vec![]));
        }
        // Once more for some rows only is no copy of the table.
        assert_eq!(rows(&format!("p_mm,d_um\n{body}1,2\n2,3\n"), false), (7, vec![]));
    }
}
