//! An evaluation as text, JSON and a page.

mod evaluation;
mod evaluation_circular;
mod evaluation_html;
mod evaluation_json;
mod evaluation_others;
mod evaluation_positioning;

pub use evaluation::{Evaluation, Sheets, evaluation_text};
pub use evaluation_html::evaluation_html;
pub use evaluation_json::evaluation_json;
