//! FANUC: custom macro B, its own coordinates.

pub(super) mod dynamic_offset;
pub(super) mod macros;
mod system;
pub(super) mod transforms;
