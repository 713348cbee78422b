//! Answers on paper: numbers, tables and pictures as text, HTML and SVG.
//!
//! - [`numbers`]: numbers as they are printed everywhere;
//! - [`document`](fn@document), [`Keyed`]: an answer as one JSON document, and its JSON Schema;
//! - [`Report`]: an answer described once, from which come text, one page that opens offline, and pictures;
//! - [`Picture`], [`plots`]: curves, bands, scatter and polar pictures as SVG.
//!
//! ```
//! use trueaxis_report::{Report, Section, Table};
//! let figures = Table::new(["", "µm"]).row(["reversal", "2.50"]);
//! let report = Report::new("Axis X").section(Section::new("Figures").table(figures));
//! assert_eq!(report.text(), "Axis X\n\nFigures\n               µm\n  reversal   2.50\n");
//! ```
//!
//! It knows no word of the field: what a figure means stands with who has computed it.

mod document;
mod finite;
pub mod numbers;
mod page;
mod pictures;
pub mod plots;
mod report;
#[cfg(feature = "schemas")]
mod schema;

pub use document::{Keyed, document, not_finite};
pub use finite::first_not_finite;
pub use pictures::{Band, Picture, Polar, PolarLine, Scatter};
pub use plots::DrawingError;
pub use report::{
    Columns, English, Figure, Heading, Item, Labels, Language, Logo, LogoKind, Place, Report, Row,
    Section, Standing, Table, Verdict, filled,
};

#[cfg(feature = "schemas")]
pub use schema::{NamedSchema, named_schema};
#[cfg(feature = "schemas")]
pub use schemars::JsonSchema;
#[cfg(not(feature = "schemas"))]
pub use trueaxis_schemaless::JsonSchema;

/// Every type, where no JSON Schemas are made of types.
#[cfg(not(feature = "schemas"))]
pub trait JsonSchema {}

#[cfg(not(feature = "schemas"))]
impl<T: ?Sized> JsonSchema for T {}

/// The version that reports state.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
