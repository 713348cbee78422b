//! Text from users: quantities with units, TOML and CSV that report every problem with its place.
//!
//! - [`parse_quantity`], [`parse_measured`]: `"12 urad"`, `"10 ± 1 um"`, in the inner unit;
//! - [`SourceText`], [`Section`], [`Item`]: reading of TOML; [`CsvTable`] and [`sheet`]: tables;
//! - [`Diagnostic`]: code, place, message and hint of one problem; [`Diagnostics`]: all of them;
//! - [`Files`], [`Source`]: access to files; [`limits`]: how much of a text is read;
//! - [`stl`]: facets of STL files;
//! - [`plausible`]: ranges that quantities of machine tools have;
//! - [`in_order()`]: blocks of a long text on several threads.
//!
//! ```
//! use trueaxis_input::{Dimension, SourceText};
//! let text = SourceText::new("probe.toml", "stylus = '50 mm'\nball = 6");
//! let read = text.read(|root| {
//!     (root.quantity("stylus", Dimension::Length), root.quantity("ball", Dimension::Length))
//! });
//! assert_eq!(read, (Some(50.0), None)); // a length needs its unit
//! let problems = text.finish();
//! assert_eq!(problems.iter().next().unwrap().place.to_string(), "probe.toml:2:8");
//! ```
//!
//! `examples/tool_file.rs` reads a length in inches with its uncertainty and a table of errors.
//!
//! Input is never repaired without notice: a value without a unit, an unknown key, a NaN is a
//! [`Diagnostic`]. The crate knows nothing of machines, programs and parts, and opens no file itself.

// On top of the list of the workspace, as this crate has no hits.
#![warn(clippy::needless_pass_by_value, clippy::redundant_closure_for_method_calls)]
// Numbers decide here: a cast that could change one is checked or has a reason.
#![warn(clippy::cast_possible_truncation, clippy::cast_sign_loss)]

mod content;
mod csv;
mod date;
mod diagnostic;
mod draft;
mod files;
pub mod foreign;
mod in_order;
pub mod limits;
pub mod plausible;
mod quantity;
mod section;
pub mod sheet;
pub mod stl;
mod vector;

pub use content::{Content, Kept};
pub use csv::{CsvColumn, CsvTable};
pub use date::Date;
pub use diagnostic::{Diagnostic, Diagnostics, Place, Severity};
pub use draft::Draft;
pub use files::{Files, Source};
pub use in_order::{in_order, usual_threads};
pub use quantity::{Dimension, MeasuredValue, QuantityError, Unit, parse_measured, parse_quantity};
pub use section::{DATE_HINT, Item, Section, SourceText};
