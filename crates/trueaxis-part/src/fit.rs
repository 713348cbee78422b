//! Associated features: the ideal geometry that represents measured points (crate `trueaxis-form`).

pub use trueaxis_form::circle;
