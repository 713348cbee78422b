//! Associated features: the ideal geometry that represents measured points.

pub mod circle;
