//! Where is the tool really?
//!
//! ```text
//!     machine.toml ──MachineFile──> Machine ──errors_at──> ErrorValues ──pose──> workpiece_from_tool
//!                                      ├──────solve <── tip and tool axis wanted
//!                                      └──Compensator::at──> command that reaches the nominal pose
//! ```
//!
//! A [`Machine`] is a chain of bodies from the workpiece over the bed to the tool, each with its
//! place, its axis and its errors by ISO 230-1 name. It gives the nominal and the actual pose of
//! the tool in the workpiece ([`Machine::pose`], [`Machine::deviation`]) and the axis positions for
//! a wanted tool pose ([`Machine::solve`]), and the command at which the actual tool stands where the
//! programmed one should ([`compensate`]).
//!
//! It does not read NC programs, does not know parts, and opens no file: texts come in as strings.

mod active;
/// Axes: what they carry, which way they move, how far and how fast.
pub mod axis;
pub mod batch;
pub mod chain;
pub mod compensate;
pub mod describe;
mod deviation;
pub mod errors;
pub mod file;
pub mod heat;
mod inverse;
pub mod models;
pub mod tcp;
mod tool;
pub mod twist;
pub mod volume;

pub use chain::{ErrorFrame, ErrorModel, Machine, Squareness};
pub use deviation::Deviation;
pub use inverse::{FollowError, FollowFault, Singularity, Solution, Solutions, SolveError, Target};
pub use tool::ToolAssembly;
