//! Describe: what a machine is, in data that a page can show, and one error of it put into the text of
//! its machine file.

mod description;
pub mod lines;
mod positions;
pub mod replacement;
mod set_error;

pub use description::{
    DescribedError, DescribedLink, DescribedSensor, Description, MOST_SAMPLES, SampledError,
    describe,
};
pub use positions::{
    axis_index, command, command_words, shown, to_inner, to_shown, unit, warn_beyond_travel,
};
pub use set_error::set_error;
