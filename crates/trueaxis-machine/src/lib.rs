//! Model of a multi-axis machine tool: nominal and actual pose of the tool in the workpiece.
//!
//! ```text
//!     machine.toml ──MachineFile──> Machine ──errors_at──> ErrorValues ──pose──> workpiece_from_tool
//!                                      ├──────solve <── required tip and tool axis
//!                                      └──Compensator::at──> command that reaches the nominal pose
//! ```
//!
//! A [`Machine`] is a chain of bodies from the workpiece over the bed to the tool, each with its
//! placement, its axis and its errors by ISO 230-1 name. It gives the nominal and the actual pose of
//! the tool in the workpiece ([`Machine::pose`], [`Machine::deviation`]) and the axis positions for
//! a required tool pose ([`Machine::solve`]), and the command at which the actual tool reaches the
//! programmed pose ([`compensate`]).
//!
//! Units are mm, rad, s and °C. `examples/squareness.rs` computes the deviation that a squareness of
//! 10 µrad causes at Y = 500 mm and the compensated command.
//!
//! The crate does not read NC programs, has no parts, and opens no file: texts are passed as strings.

// On top of the list of the workspace, as this crate has no hits.
#![warn(clippy::needless_pass_by_value, clippy::redundant_closure_for_method_calls)]
// Numbers decide here: a cast that could change one is checked or has a reason.
#![warn(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

mod active;
/// Axes: side of the chain, direction, sense, travel and limits.
pub mod axis;
pub mod batch;
pub mod calibrations;
pub mod chain;
pub mod compensate;
pub mod describe;
mod deviation;
pub mod equipment;
pub mod errors;
pub mod file;
pub mod heat;
mod inverse;
mod lanes;
pub mod models;
pub mod tcp;
mod tool;
pub mod twist;
pub mod variations;
pub mod volume;

pub use chain::{ErrorFrame, ErrorModel, Machine, Squareness};
pub use deviation::Deviation;
pub use inverse::{
    FollowError, FollowFault, FollowSolver, FollowedPath, Follower, Reached, Singularity, Solution,
    Solutions, SolveError, Target,
};
pub use tool::ToolAssembly;
