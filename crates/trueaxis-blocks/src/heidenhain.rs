//! How the text of Klartext looks.

use crate::dialect::{Control, Dialect};

/// HEIDENHAIN Klartext: key words instead of G codes; what M functions do stands with them, since
/// here many have words of their own and some take effect at the end of their block.
pub(crate) static DIALECT: Dialect = Dialect {
    control: Control::Heidenhain,
    words: true,
    quoted_texts: true,
    decimal_comma: true,
    fix_towards_zero: true,
    parameters: 1999,
    ..Dialect::BARE
};
