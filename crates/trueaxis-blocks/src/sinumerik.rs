//! How the text of SINUMERIK looks.

use crate::dialect::{Control, Dialect};

/// SINUMERIK 840D: how its tokens look. What its words do stands in `sinumerik/tables.rs`.
pub(crate) static DIALECT: Dialect = Dialect {
    control: Control::Sinumerik840d,
    header_lines: true,
    words: true,
    quoted_texts: true,
    fix_towards_zero: true,
    parameters: 999,
    ..Dialect::BARE
};
