//! How the text of SINUMERIK looks.

use crate::dialect::{Control, Dialect};

/// SINUMERIK 840D: how its tokens look. What its words do stands in `sinumerik/tables.rs`.
pub(crate) static DIALECT: Dialect = Dialect {
    control: Control::Sinumerik840d,
    paren_comments: false,
    semicolon_comments: true,
    header_lines: true,
    words: true,
    angle_names: false,
    quoted_texts: true,
    decimal_comma: false,
    o_words: false,
    macro_words: false,
    fix_towards_zero: true,
    parameters: 999,
    g_codes: &[],
    m_codes: &[],
};
