//! What is sought, how readings follow it, and what they can tell apart.
//!
//! [`term`] says what is sought, a [`design`] how readings follow it, a [`fit`] finds it, [`confusion`] says what
//! cannot be separated.

pub mod confusion;
pub mod design;
pub mod fit;
pub mod minimal;
pub mod term;
