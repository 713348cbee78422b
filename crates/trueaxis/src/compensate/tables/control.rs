//! What controls have in common: what a table may be, written, read back, and applied.

use super::place::Rule;
use super::table::Table;
use trueaxis_machine::Machine;

/// A file of a control.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct File {
    /// Its name in the folder.
    pub name: String,
    /// Its content.
    pub text: String,
}

/// Why a file is not understood: which, and what was expected.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {expected}")]
pub struct ReadFault {
    /// The file.
    pub file: String,
    /// What was expected.
    pub expected: String,
}

impl ReadFault {
    pub(super) fn new(file: &str, expected: impl Into<String>) -> Self {
        Self { file: file.to_owned(), expected: expected.into() }
    }
}

/// One control: its rules, its files and how it applies them.
pub trait Control {
    /// How it is called on the command line.
    fn key(&self) -> &'static str;

    /// The letters of axes that it knows.
    fn letters(&self) -> &'static str {
        "XYZABCUVW"
    }

    /// Whether one axis can move another.
    fn has_cross_tables(&self) -> bool;

    /// Whether a table of an endless axis repeats itself.
    fn has_modulo(&self) -> bool;

    /// Nodes and increments of a table.
    fn rule(&self) -> Rule;

    /// The most tables, all together.
    fn most_tables(&self) -> usize {
        usize::MAX
    }

    /// The files of these tables.
    fn write(&self, machine: &Machine, tables: &[Table]) -> Vec<File>;

    /// The tables of files, as the control reads them.
    ///
    /// # Errors
    /// What the control would not take.
    fn read(&self, machine: &Machine, files: &[File]) -> Result<Vec<Table>, ReadFault>;

    /// What a table adds to the command of its output axis, in counts, as this control interpolates it.
    fn value(&self, table: &Table, position: f64, side: f64) -> f64 {
        table.at(position, side)
    }

    /// What the control needs besides the files, for people.
    fn advice(&self) -> &'static [&'static str];
}

/// Rising positions, two at least, a turn for a table that repeats itself.
pub(super) fn checked(file: &str, mut table: Table, most: usize) -> Result<Table, ReadFault> {
    table.nodes.sort_by_key(|n| n.at);
    if table.nodes.windows(2).any(|n| n[0].at == n[1].at) {
        return Err(ReadFault::new(file, "each position once"));
    }
    if !(2..=most).contains(&table.nodes.len()) {
        return Err(ReadFault::new(file, format!("2 to {most} rows, not {}", table.nodes.len())));
    }
    Ok(table)
}
