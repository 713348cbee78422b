//! The loop: describe · simulate · predict · plan (and measure) · identify · compensate · verify.
//!
//! One machine file goes through all of it. So far:
//!
//! - *describe*: [`machine`] (a checked machine tool, its poses and errors) and [`files`];
//! - *predict*: [`predict`](mod@predict): is the test piece that this machine cuts within its
//!   tolerances, how sure is that, and which error is to blame;
//! - [`collide`]: the bodies of machine, tool, stock and fixture: clearances and collisions;
//! - [`report`]: the prediction as text, JSON and one self-contained HTML page.
//!
//! The nouns live in crates of their own and are handed on here: [`geometry`], [`machine`],
//! [`part`].

pub mod collide;
pub mod files;
pub mod predict;
pub mod report;

pub use trueaxis_geometry as geometry;
pub use trueaxis_machine as machine;
pub use trueaxis_part as part;

/// The version that reports state.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
