//! The unknowns, how readings follow them, and which of them are separable.
//!
//! [`term`] describes an unknown, a [`design`] how readings follow it, a [`fit`] finds it, [`confusion`] says what
//! cannot be separated, [`determined`] what remains unknown of each, [`known`] what was known before, [`stated`] what the
//! uncertainties of the machine file add, [`set_up`] whether the readings agree with what is stated of the set-up.

pub mod confusion;
pub mod design;
pub mod determined;
pub mod fit;
mod groups;
pub mod known;
pub mod minimal;
pub mod mixed;
pub mod set_up;
pub mod stated;
mod stated_errors;
pub mod term;
pub mod unlisted;
