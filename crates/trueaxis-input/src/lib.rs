//! Text from people: quantities with units, TOML that reports every problem with its place.
//!
//! Nothing here repairs input in silence: a value without a unit, an unknown key, a NaN is a
//! [`Diagnostic`] with file, line, column, what was expected and what to do.

mod csv;
mod diagnostic;
mod files;
mod quantity;
mod section;
pub mod sheet;

pub use csv::{CsvColumn, CsvTable};
pub use diagnostic::{Diagnostic, Diagnostics, Place, Severity};
pub use files::{Files, Source};
pub use quantity::{Dimension, Measured, QuantityError, Unit, parse_measured, parse_quantity};
pub use section::{Item, Section, SourceText};
