//! The loop: describe · simulate · predict · plan (and measure) · identify · compensate · verify.
//!
//! One machine file goes through all of it. So far:
//!
//! - *describe*: [`machine`] (a checked machine tool, its poses and errors), [`describe`](mod@describe)
//!   (the machine as data, one error put into its file) and [`files`];
//! - *simulate*: [`simulate`](mod@simulate): an NC program on the machine as it is: path, time, poses,
//!   deviations, troubles;
//! - *predict*: [`predict`](mod@predict): is the test piece that this machine cuts within its
//!   tolerances, how sure is that, and which error is to blame;
//! - *plan*: [`plan`](mod@plan): what a measurement will tell, its programs, the poses that tell most;
//! - *identify*: [`identify`]: errors of the machine from any mix of instruments, the expansion of
//!   a scale, thermal models from logs; [`measure`]: what instruments read;
//! - *compensate*: [`compensate`]: what the control has to add to its commands, and cutter
//!   locations into programs for one machine;
//! - *verify*: [`verify`]: readings of instruments evaluated by ISO 230;
//! - [`report`]: all that as text, JSON and self-contained HTML pages.
//!
//! The nouns live in crates of their own and are handed on here: [`geometry`], [`machine`],
//! [`part`].

pub mod compensate;
pub mod describe;
pub mod files;
pub mod identify;
pub mod measure;

pub mod plan;
pub mod predict;
pub mod report;
pub mod simulate;
pub mod verify;
mod volume;

pub use trueaxis_geometry as geometry;
pub use trueaxis_input as input;
pub use trueaxis_machine as machine;
pub use trueaxis_nc as nc;
pub use trueaxis_part as part;

/// The version that reports state.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
