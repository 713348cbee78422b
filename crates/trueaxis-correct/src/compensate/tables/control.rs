//! What controls have in common: what a table may be, written, read back, and applied.

use super::TablesError;
use super::carrier_chain::CarrierChain;
use super::content::Content;
use super::grid::GridRule;
use super::joints::Joints;
use super::place::Rule;
use super::table::{PER_UNIT, Table};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisKind, Travel};
use trueaxis_machine::chain::ErrorFrame;
use trueaxis_machine::errors::ErrorName;

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
    fn has_cross_tables(&self) -> bool {
        false
    }

    /// Which axis may move which: each itself; linear axes also by the position of every other.
    fn pairs(&self, machine: &Machine) -> Vec<(usize, usize)> {
        let axes = 0..machine.axes().len();
        let own = axes.clone().map(|i| (i, i));
        let cross = axes.clone().flat_map(|input| axes.clone().map(move |output| (input, output)));
        let cross = cross.filter(|(input, output)| {
            input != output && machine.axes()[*output].kind == AxisKind::Linear
        });
        match self.has_cross_tables() {
            true => own.chain(cross).collect(),
            false => own.collect(),
        }
    }

    /// Whether its own chain knows six errors of every axis as functions of its position.
    fn knows_links(&self) -> bool {
        false
    }

    /// On which side of the joint the errors of a link stand: moving with it or not.
    fn link_frame(&self, _machine: &Machine, _body: usize) -> ErrorFrame {
        ErrorFrame::Moving
    }

    /// Nodes of the errors that its chain knows.
    fn known_rule(&self) -> Rule {
        self.rule()
    }

    /// Whether its kinematic parameters know this location error.
    fn knows_location(&self, _machine: &Machine, _error: ErrorName) -> bool {
        false
    }

    /// The least increment of an error that its chain knows, counts.
    fn known_increment(&self, _error: ErrorName) -> i64 {
        1
    }

    /// Whether a straight line for the temperatures stands beside the table of an axis.
    fn has_temperature_lines(&self) -> bool {
        false
    }

    /// Whether three linear axes together can move themselves.
    fn grid(&self) -> Option<GridRule> {
        None
    }

    /// Whether a table of an endless axis repeats itself.
    fn has_modulo(&self) -> bool {
        true
    }

    /// Whether a table of a rotary axis is that of a turn, whatever its travel.
    fn has_whole_turns(&self) -> bool {
        false
    }

    /// Nodes and increments of a table.
    fn rule(&self) -> Rule;

    /// Whether a table takes the place of one that is held for other axes, because both are numbered from the first on.
    /// `directed`: the held one is by direction.
    fn shares_numbers(&self, _written: &Table, _held: (usize, usize), _directed: bool) -> bool {
        false
    }

    /// Whether the errors of all links stand in one file.
    fn has_one_file_of_links(&self) -> bool {
        false
    }

    /// The most tables, all together.
    fn most_tables(&self) -> usize {
        usize::MAX
    }

    /// The files of this content.
    fn write(&self, machine: &Machine, content: &Content) -> Vec<File>;

    /// The content of files, as the control reads them.
    ///
    /// # Errors
    /// What the control would not take.
    fn read(&self, machine: &Machine, files: &[File]) -> Result<Content, ReadFault>;

    /// What a table adds to the command of its output axis, in counts, as this control interpolates it.
    fn value(&self, table: &Table, position: f64, side: f64) -> f64 {
        table.at(position, side)
    }

    /// What its transformation does with the vectors that it writes for these joints; `None` where it follows the
    /// axes from the machine zero, whatever their places are.
    fn carrier_chain(&self, _machine: &Machine, _joints: &Joints) -> Option<CarrierChain> {
        None
    }

    /// What the control needs besides the files, in words.
    fn advice(&self) -> &'static [&'static str];
}

/// A file that has its last line has not been cut short.
pub(super) fn ended(file: &File, last: &str) -> Result<(), ReadFault> {
    match file.text.lines().last() == Some(last) {
        true => Ok(()),
        false => Err(ReadFault::new(&file.name, format!("{last} as its last line"))),
    }
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

/// The ends of a table in counts, inwards to whole counts; whether it repeats itself.
pub(super) fn range(axis: &Axis, control: &dyn Control) -> Result<((i64, i64), bool), TablesError> {
    let turn = (360.0 * PER_UNIT) as i64;
    let unit = |q: f64| PER_UNIT * if axis.kind == AxisKind::Linear { q } else { q.to_degrees() };
    match (axis.travel, control.has_modulo()) {
        (Travel::Between(from, to), _) => {
            // A count that the rounding of a file's numbers has moved over the end still counts.
            let (from, to) = ((unit(from) - 1e-3).ceil() as i64, (unit(to) + 1e-3).floor() as i64);
            if from < to {
                Ok(((from, to), false))
            } else {
                Err(TablesError::UnknownTravel(axis.name))
            }
        }
        (Travel::Unlimited, true) => Ok(((0, turn), true)),
        (Travel::Unlimited, false) => Ok(((-turn, turn), false)),
        (Travel::Unknown, _) => Err(TablesError::UnknownTravel(axis.name)),
    }
}
