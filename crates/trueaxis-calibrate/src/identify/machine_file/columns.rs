//! Errors that a table of the axis states: they leave the table for one of their own.

use std::path::Path;
use trueaxis_machine::errors::ErrorName;

/// A CSV text without the columns of an error; `None` if it has none.
pub(super) fn without(text: &str, name: ErrorName) -> Option<String> {
    let is_row = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let heading = text.lines().find(is_row)?;
    let prefix = format!("{name}_");
    let leaves: Vec<bool> =
        heading.split(',').map(|cell| cell.trim().starts_with(&prefix)).collect();
    if !leaves.contains(&true) {
        return None;
    }
    let kept = |line: &str| {
        let cells = line.split(',').enumerate();
        let cells = cells.filter(|(i, _)| leaves.get(*i) != Some(&true)).map(|(_, cell)| cell);
        cells.collect::<Vec<_>>().join(",")
    };
    let lines = text.lines().map(|l| if is_row(&l) { kept(l) } else { l.to_owned() });
    Some(lines.collect::<Vec<_>>().join("\n") + "\n")
}

/// Whether positions are all that is left.
pub(super) fn is_bare(text: &str) -> bool {
    let rows = text.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with('#'));
    rows.take(1).all(|heading| heading.split(',').all(|cell| cell.trim().starts_with("position")))
}

/// `X.csv` becomes `X-identified.csv`.
pub(super) fn new_name(table: &str) -> String {
    let stem = Path::new(table).file_stem().map_or(table.into(), |s| s.to_string_lossy());
    format!("{}-identified.csv", stem.trim_end_matches("-identified"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_columns_of_one_error_leave() {
        let text = "# laser\nposition_mm,EXX_up_um,EXX_down_um,EYX_um\n0,1,2,3\n10,4,5,6\n";
        let name = ErrorName::parse("EXX").unwrap(); // why: a name of ISO 230-1
        let left = without(text, name).unwrap();
        assert_eq!(left, "# laser\nposition_mm,EYX_um\n0,3\n10,6\n");
        assert!(without(&left, name).is_none() && !is_bare(&left));
        assert!(is_bare(&without(&left, ErrorName::parse("EYX").unwrap()).unwrap()));
        assert_eq!(new_name("X.csv"), "X-identified.csv");
    }
}
