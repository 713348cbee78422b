//! What must the machine be commanded, so that the tool is where the part needs it?
//!
//! - [`compensate`]: values, tables and programs that correct it;
//! - [`report`]: what they do and what they leave, as text, JSON and pages.
//!
//! It takes the errors as they are stated: where they come from is the subject of `trueaxis-calibrate`;
//! `trueaxis-predict` says what they do to the part.

pub mod compensate;
pub mod report;

#[cfg(feature = "schemas")]
pub use report::schemas;
