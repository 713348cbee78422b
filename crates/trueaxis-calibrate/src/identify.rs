//! Identify: what the machine is like, from measurements.
//!
//! - [`probe`]: the offset of a stylus ball and its pre-travel by direction;
//! - [`surface`](mod@surface): deviations of a surface from the hits of a probing program;
//! - [`errors`](mod@errors): the errors of the machine from any mix of instruments, the whole way from
//!   readings to a verdict; what is unknown and how readings follow it stands in [`trueaxis_measure::unknowns`].

pub mod adequacy;
mod another_machine;
mod assumptions;
pub mod checks;
pub mod conflict;
pub mod convention;
pub mod covariance_file;
pub mod errors;
pub mod feeds;
pub mod file_residual;
pub mod freedom;
mod gross;
pub mod influence;
mod log_words;
pub mod machine_file;
mod mixed_signs;
pub mod predictor;
pub mod predictor_file;
pub mod probe;
pub mod records;
pub mod robust;
pub mod score;
pub mod selection;
pub mod stage_tables;
pub mod stages;
pub mod surface;
pub mod tool_setting;
pub mod verdict;
