//! What will the machine do to the part, and what must it be commanded instead?
//!
//! - [`predict`](mod@predict): is the part that this machine cuts within its tolerances, with what
//!   uncertainty, and what does each error contribute;
//! - [`compensate`]: values, tables and programs that correct it.
//!
//! ```
//! use trueaxis_correct::predict::holes::compensation_increments;
//! // 54 increments of 1 µm take away an error of −54.4 µm; halves are rounded away from zero.
//! assert_eq!(compensation_increments(-0.0544, 0.001), 54);
//! assert_eq!(compensation_increments(0.0005, 0.001), -1);
//! ```
//!
//! It takes the errors as they are stated: where they come from is the subject of `trueaxis-calibrate`.

pub mod compensate;
pub mod predict;
pub mod report;

pub use report::schemas;
