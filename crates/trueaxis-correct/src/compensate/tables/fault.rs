//! Why there are no tables.

use super::control::ReadFault;
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::{BodyName, ErrorName};

/// Why there are no tables.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TablesError {
    /// The control has no such axis.
    #[error("{target} knows no axis {axis}")]
    UnknownAxis {
        /// Which.
        axis: BodyName,
        /// The control.
        target: &'static str,
    },
    /// The machine file does not say how far an axis goes.
    #[error("the travel of {0} is not stated")]
    UnknownTravel(BodyName),
    /// A position that an error table does not cover.
    #[error(transparent)]
    Position(#[from] CommandFault),
    /// A correction that should not be loaded without being examined.
    #[error("{output} would have to be corrected by {value} at {input} {at}, more than {limit}")]
    TooLarge {
        /// The axis that is moved.
        output: BodyName,
        /// The axis that is looked up.
        input: BodyName,
        /// mm or rad, as people write it.
        value: String,
        /// Where.
        at: String,
        /// The limit.
        limit: String,
    },
    /// The control has the table of one turn, and the correction is another one in the next.
    #[error(
        "the table of {axis} of {target} is that of one turn; the correction differs from turn to turn, which would \
         leave {loss}, more than {bound}"
    )]
    Turns {
        /// The control.
        target: &'static str,
        /// The rotary axis.
        axis: BodyName,
        /// Half the largest difference.
        loss: String,
        /// What was asked.
        bound: String,
    },
    /// The control has not enough nodes.
    #[error("{most} nodes of {input} for {output} leave {loss}, more than {bound}")]
    TooManyNodes {
        /// The axis that is looked up.
        input: BodyName,
        /// The axis that is moved.
        output: BodyName,
        /// What the control takes.
        most: usize,
        /// The loss with them.
        loss: String,
        /// What was asked.
        bound: String,
    },
    /// Half an increment of the control is more than the bound.
    #[error("the increments of {target} lose more than the bound {bound} of {output}")]
    Increment {
        /// The control.
        target: &'static str,
        /// The axis.
        output: BodyName,
        /// What was asked.
        bound: String,
    },
    /// An error that should not be loaded without being examined.
    #[error("{error} is {value} somewhere in the travel, above the limit of {limit}")]
    ErrorTooLarge {
        /// Which.
        error: ErrorName,
        /// How large.
        value: String,
        /// The limit.
        limit: String,
    },
    /// Half an increment of an error is more than the bound.
    #[error("{error}: half an increment of {target} is more than {bound}")]
    ErrorIncrement {
        /// The control.
        target: &'static str,
        /// Which.
        error: ErrorName,
        /// What is allowed.
        bound: String,
    },
    /// More nodes than the control takes.
    #[error("{error} with {most} nodes loses {loss}, more than {bound}")]
    ErrorNodes {
        /// Which.
        error: ErrorName,
        /// The most nodes.
        most: usize,
        /// What is lost then.
        loss: String,
        /// What is allowed.
        bound: String,
    },
    /// More points than the control's grid has.
    #[error(
        "the grid of {target} loses {loss:.2} µm with the most points, more than {bound:.2} µm"
    )]
    GridPoints {
        /// The control.
        target: &'static str,
        /// What is lost, µm.
        loss: f64,
        /// What is allowed, µm.
        bound: f64,
    },
    /// A larger value than the control's grid takes.
    #[error("the grid of {target} takes {most:.2} µm at most, not {value:.2} µm")]
    GridValue {
        /// The control.
        target: &'static str,
        /// The value, µm.
        value: f64,
        /// The most, µm.
        most: f64,
    },
    /// More tables than the control has.
    #[error("{needed} tables, {target} has {most}")]
    TooManyTables {
        /// The control.
        target: &'static str,
        /// How many.
        needed: usize,
        /// What it takes.
        most: usize,
    },
    /// The control has one place for it, and an active error is there.
    #[error(
        "{written} would go in the place of what the control holds for {error}, which is active"
    )]
    Active {
        /// The active error.
        error: ErrorName,
        /// What would be written there.
        written: String,
    },
    /// What was written is not what is read.
    #[error("what was written could not be read back: {0}")]
    NotRecovered(String),
}

impl From<ReadFault> for TablesError {
    fn from(fault: ReadFault) -> Self {
        Self::NotRecovered(fault.to_string())
    }
}
