//! Answers on paper: numbers, tables and pictures as text, HTML and SVG. It knows no word of the field.
//!
//! - [`numbers`]: numbers as they are printed everywhere;
//! - [`Block`]: a table with a title, for the terminal ([`write_block`]) and for a page ([`section`]);
//! - [`Picture`]: curves, bands, scatter and polar pictures as SVG;
//! - [`page`]: one self-contained HTML page that opens offline; [`picture_page`](mod@picture_page) one of
//!   tables and pictures.

mod block;
pub mod numbers;
pub mod page;
pub mod picture_page;
mod pictures;
pub mod plots;

pub use block::{Block, section, write_block};
pub use pictures::{Band, Picture, Polar, PolarLine, Scatter};
pub use plots::DrawingError;

/// The version that reports state.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
