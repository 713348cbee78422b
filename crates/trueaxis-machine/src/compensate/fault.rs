//! Why a machine or a pose cannot be compensated.

use crate::chain::CommandFault;
use crate::errors::BodyName;

/// Why a machine cannot be compensated, or a pose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The machine cannot move its tip in all three directions.
    #[error(
        "the machine has {linear} linear axes, but three are needed to position the tip in space: \
         add them to the chain of the machine file"
    )]
    FewLinearAxes {
        /// Its number of linear axes.
        linear: usize,
    },
    /// There are no errors at the command.
    #[error("{0}")]
    Command(#[from] CommandFault),
    /// The compensated command lies outside an error table that is not extended.
    #[error(
        "at the compensated command {0}: measure the errors up to the ends of the travel, or \
         extend the table (outside = \"extend\")"
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
        "no convergence: after {evaluations} evaluations the residual error of the tip is \
         {tip_mm:.6} mm; the errors change too steeply with the position, check the error tables"
    )]
    NotConverged {
        /// Number of evaluations of the chain.
        evaluations: u32,
        /// The residual error of the tip, mm.
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
        "the compensated position of {axis} is {at:.6} {unit}, {by:.6} {unit} outside its travel: \
         move the part or shorten the path"
    )
}
