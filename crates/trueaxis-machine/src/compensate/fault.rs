//! Why a machine or a pose cannot be compensated.

use crate::chain::CommandFault;
use crate::errors::BodyName;

/// Why a machine cannot be compensated, or a pose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The machine cannot move its tip in all three directions.
    #[error(
        "{linear} linear axes cannot bring the tip to its place in space; three are needed: name \
         them in the chain of the machine file"
    )]
    FewLinearAxes {
        /// How many it has.
        linear: usize,
    },
    /// There are no errors at the command.
    #[error("{0}")]
    Command(#[from] CommandFault),
    /// The compensated command lies where an error table says nothing.
    #[error(
        "at the compensated command {0}: measure the errors up to the ends of the travel, or let the \
         table be extended (outside = \"extend\")"
    )]
    Corrected(CommandFault),
    /// An axis would pass the end of its travel.
    #[error("{}", travel_passed(.axis, .at, .by))]
    Travel {
        /// The axis.
        axis: BodyName,
        /// Where it would have to go, mm or rad.
        at: f64,
        /// By how much that passes the end of the travel, mm or rad.
        by: f64,
    },
    /// The linear axes do not span the space at this pose.
    #[error("at this pose the linear axes do not move the tip in all three directions")]
    Flat,
    /// The errors are no small change of the machine.
    #[error(
        "after {evaluations} evaluations the tip is still {tip_mm:.6} mm off: the errors change too \
         steeply with the position; check the error tables"
    )]
    NotConverged {
        /// How often the chain was evaluated.
        evaluations: u32,
        /// What is left, mm.
        tip_mm: f64,
    },
}

fn travel_passed(axis: &BodyName, at: &f64, by: &f64) -> String {
    let (scale, unit) = match axis.is_rotary() {
        true => (180.0 / std::f64::consts::PI, "deg"),
        false => (1.0, "mm"),
    };
    let (at, by) = (at * scale, by * scale);
    format!(
        "{axis} would have to go to {at:.6} {unit}, {by:.6} {unit} beyond the end of its travel: move \
         the part or shorten the path"
    )
}
