//! **What surface does a moving cutter leave?** For each point of a nominal surface a *nail* stands along the normal; the sweep of
//! the cutter along its path shortens it, and what remains is the deviation of the surface there, exact along the nail, with the
//! move that made it.
//!
//! The idea of nails is that of Jerard, Drysdale, Hauck, Schaudt and Magewick, *Methods for detecting errors in numerically
//! controlled machining of sculptured surfaces*, IEEE Computer Graphics and Applications 9 (1989) 26–39. There each cutter pose
//! shortens each nail; here a nail asks a tree of all moves for the lowest one, so that the order of the moves does not matter.
//!
//! ```text
//! Apt ──Cutter::new──> Cutter               convex, of revolution: distance and gradient
//! [ToolPose; 2]… ──Sweep::new──> Sweep      motions in which the tool turns little, in a tree
//! [Sweep] + [Nail] ──cut──> [Reach]         deviation, move, place, normal of the cutter
//! ```
//!
//! Lengths are mm, angles rad, all in the workpiece frame. The crate knows nothing of machines, programs and drawings.

// On top of the list of the workspace, as this crate has no hits.
#![warn(clippy::needless_pass_by_value, clippy::redundant_closure_for_method_calls)]

mod cutter;
mod motion;
mod nail;
pub mod stock;
mod sweep;
mod tree;

pub use cutter::{Apt, Cutter, CutterError};
pub use motion::ToolPose;
pub use nail::{Cut, Nail, Reach};
pub use sweep::{BOUND_MM, Sweep, SweepError, cut};
