//! The loop: describe · simulate · predict · plan (and measure) · identify · compensate · verify.
//!
//! One machine file goes through all of it. So far:
//!
//! - *describe*: [`machine`] (a checked machine tool, its poses and errors) and [`files`];
//! - *simulate*: [`simulate`](mod@simulate): an NC program on the machine as it is: path, time, poses,
//!   deviations, troubles;
//! - *predict*: [`predict`](mod@predict): is the test piece that this machine cuts within its
//!   tolerances, how sure is that, and which error is to blame;
//! - *identify*: [`identify`]: the expansion of a scale from laser runs at two temperatures;
//! - *compensate*: [`compensate`]: cutter locations into programs for one machine;
//! - *verify*: [`verify`]: readings of instruments evaluated by ISO 230;
//! - [`report`]: all that as text, JSON and self-contained HTML pages.
//!
//! The nouns live in crates of their own and are handed on here: [`geometry`], [`machine`],
//! [`part`].

pub mod compensate;
pub mod files;
pub mod identify;
pub mod predict;
pub mod report;
pub mod simulate;
pub mod verify;

pub use trueaxis_geometry as geometry;
pub use trueaxis_machine as machine;
pub use trueaxis_nc as nc;
pub use trueaxis_part as part;

/// The version that reports state.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
