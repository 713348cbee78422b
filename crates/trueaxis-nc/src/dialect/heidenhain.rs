use super::{Control, Dialect};

/// HEIDENHAIN Klartext: so far only its tokens; its blocks are not interpreted.
pub(super) static DIALECT: Dialect = Dialect {
    control: Control::Heidenhain,
    paren_comments: false,
    semicolon_comments: true,
    header_lines: true,
    words: true,
    angle_names: false,
    quoted_texts: true,
    decimal_comma: true,
    o_words: false,
    macro_words: false,
    fix_towards_zero: true,
    parameters: 1999,
    g_codes: &[],
    m_codes: &[],
};
