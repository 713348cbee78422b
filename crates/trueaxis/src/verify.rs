//! Verify: how good is the machine, by the standards and against what was promised?
//!
//! Readings of instruments are evaluated by ISO 230 and its relatives, each figure with its clause
//! (`trueaxis-standards`). [`compare`](mod@compare) holds readings against a prediction, or against other
//! readings; [`calibrations`](mod@calibrations) one machine file against a later one;
//! [`certificate`](mod@certificate) what a compensation leaves, proved on poses that were not used;
//! [`error_tables`](mod@error_tables) readings as the error tables of the machine file;
//! [`part`](mod@part) a test piece that was measured against its tolerances and its prediction;
//! [`before_after`](mod@before_after) what a laser reads on a virtual machine before and after.

pub mod before_after;
pub mod certificate;
pub mod compare;
pub mod error_tables;
pub mod part;
pub mod write_back;

pub use trueaxis_machine::calibrations;
pub use trueaxis_standards::*;
