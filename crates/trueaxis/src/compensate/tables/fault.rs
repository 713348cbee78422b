use super::control::ReadFault;
use trueaxis_machine::chain::CommandFault;
use trueaxis_machine::errors::BodyName;

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
    /// A correction that nobody should load unseen.
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
    /// What was written is not what is read.
    #[error("what was written could not be read back: {0}")]
    NotRecovered(String),
}

impl From<ReadFault> for TablesError {
    fn from(fault: ReadFault) -> Self {
        Self::NotRecovered(fault.to_string())
    }
}
