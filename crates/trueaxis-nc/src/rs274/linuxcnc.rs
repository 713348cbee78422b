//! LinuxCNC: comments that do something, polar words, saved modes.

mod comments;
pub(super) mod modal_state;
pub(super) mod polar;
pub(super) mod splines;
pub(super) mod turning;
