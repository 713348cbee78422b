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

pub mod files;

pub mod report;
pub mod verify;

pub use trueaxis_calibrate::{identify, instruments, measure, plan, unknowns};
pub use trueaxis_cl as cl;
pub use trueaxis_correct::{compensate, predict};
pub use trueaxis_geometry as geometry;
pub use trueaxis_input as input;
pub use trueaxis_machine as machine;
pub use trueaxis_machine::describe;
pub use trueaxis_motion as simulate;
pub use trueaxis_nc as nc;
pub use trueaxis_part as part;

pub use trueaxis_report::VERSION;

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
