//! Answers on paper: numbers, tables and pictures as text, HTML and SVG.
//!
//! - [`numbers`]: numbers as they are printed everywhere;
//! - [`document`](fn@document), [`Keyed`]: an answer as one JSON document;
//! - [`Report`]: an answer for people, described once: text, page, pictures;
//! - [`Block`]: a table with a title, for the terminal ([`write_block`]) and for a page ([`section`]);
//! - [`Picture`]: curves, bands, scatter and polar pictures as SVG;
//! - [`page`]: one self-contained HTML page that opens offline; [`picture_page`](mod@picture_page) one of
//!   tables and pictures.
//!
//! ```
//! use trueaxis_report::{Block, write_block};
//! let mut block = Block::new("Figures", "", &["", "µm"]);
//! block.rows.push(vec!["reversal".into(), "2.50".into()]);
//! let mut text = String::new();
//! write_block(&mut text, &block).unwrap();
//! assert_eq!(text, "\n  Figures\n               µm\n  reversal   2.50\n");
//! ```
//!
//! It knows no word of the field: what a figure means stands with who has computed it.

mod block;
mod document;
pub mod numbers;
pub mod page;
pub mod picture_page;
mod pictures;
pub mod plots;
mod report;

pub use block::{Block, section, write_block};
pub use document::{Keyed, NamedSchema, document, named_schema};
pub use pictures::{Band, Picture, Polar, PolarLine, Scatter};
pub use plots::DrawingError;
pub use report::{Columns, Figure, Item, Place, Report, Row, Section, Standing, Table, Verdict};

/// The version that reports state.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
