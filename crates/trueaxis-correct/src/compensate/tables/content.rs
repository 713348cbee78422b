//! What a control holds after the files are loaded.
//!
//! ```text
//!     tables    position of one axis            -> added to the command of one axis
//!     lines     the same by a straight line     -> for the temperatures
//!     known     errors of the links by name     -> the control's own chain moves the tip back
//!     joints    where the rotary axes are       -> the same
//!     grid      position of three linear axes   -> added to the same three axes, after the others
//! ```

use super::grid::Grid;
use super::joints::Joints;
use super::table::{Node, Table};
use trueaxis_machine::Machine;
use trueaxis_machine::errors::ErrorName;

/// A straight line that is added to the command of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line {
    /// The axis, by its place in the machine.
    pub axis: usize,
    /// Where the offset holds, counts.
    pub reference: i64,
    /// What is added there, counts.
    pub offset: i64,
    /// What it grows by with the position, 10⁻⁹.
    pub slope: i64,
}

/// Everything that a control looks up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Content {
    /// Functions of one axis that are added to the command of one axis.
    pub tables: Vec<Table>,
    /// Errors that the control's own chain knows; it moves the linear axes so that the tip is right.
    pub known: Vec<Known>,
    /// Straight lines that are added for the temperatures.
    pub lines: Vec<Line>,
    /// Where its own chain has the rotary axes.
    pub joints: Option<Joints>,
    /// What three linear axes together add to themselves.
    pub grid: Option<Grid>,
}

/// One error as the control knows it, actual minus nominal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Known {
    /// Which: an error motion, by the position of its axis.
    pub error: ErrorName,
    /// Whether the nodes repeat themselves after a turn.
    pub modulo: bool,
    /// Values in counts: 10⁻⁶ mm of shifts, [`Known::COUNT_RAD`] of rotations; `at` in counts of the axis.
    pub nodes: Vec<Node>,
}

impl Known {
    /// A count of a rotation, rad.
    pub const COUNT_RAD: f64 = 1e-9;
    /// A count of a shift, mm.
    pub const COUNT_MM: f64 = 1e-6;

    /// What a count of its values is, mm or rad.
    pub fn count(&self) -> f64 {
        count_of_error(self.error)
    }
}

/// What a count of an error is, mm or rad.
pub fn count_of_error(error: ErrorName) -> f64 {
    match error.component.is_rotation() {
        true => Known::COUNT_RAD,
        false => Known::COUNT_MM,
    }
}

impl Content {
    /// The same with every sign turned.
    pub fn negated(&self, machine: &Machine) -> Self {
        let nodes = |k: &Known| k.nodes.iter().map(Node::negated).collect();
        Self {
            tables: self.tables.iter().map(Table::negated).collect(),
            known: self.known.iter().map(|k| Known { nodes: nodes(k), ..k.clone() }).collect(),
            lines: self.lines.iter().map(Line::negated).collect(),
            joints: self.joints.as_ref().map(|j| j.negated(&Joints::nominal(machine))),
            grid: self.grid.as_ref().map(Grid::negated),
        }
    }

    /// In one order, so that two can be compared.
    pub fn sorted(mut self) -> Self {
        self.tables.sort_by_key(|t| (t.input, t.output));
        self.known.sort_by_key(|k| k.error.to_string());
        self
    }
}
