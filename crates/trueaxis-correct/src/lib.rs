//! What will the machine do to the part, and what must it be told instead?
//!
//! - [`predict`](mod@predict): is the part that this machine cuts within its tolerances, how sure is that, and
//!   which error costs how much;
//! - [`compensate`]: values, tables and programs that correct it.

pub mod compensate;
pub mod predict;
pub mod report;
