//! The differences between the controls, as tables.

use crate::code::Action;
use crate::{fanuc, haas, heidenhain, linuxcnc, sinumerik};

/// The controls whose programs are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Control {
    /// Siemens SINUMERIK 840D.
    Sinumerik840d,
    /// FANUC and compatible controls.
    Fanuc,
    /// HAAS: the words of FANUC with some codes of its own.
    Haas,
    /// LinuxCNC, RS274/NGC.
    LinuxCnc,
    /// HEIDENHAIN Klartext.
    Heidenhain,
}

/// The syntax and the codes of the programs of one control.
#[derive(Debug, Clone, PartialEq)]
pub struct Dialect {
    /// The control.
    pub control: Control,
    /// `( … )` is a comment.
    pub paren_comments: bool,
    /// `; …` is a comment up to the end of the line.
    pub semicolon_comments: bool,
    /// A line that begins with `%` is a header with a name, not a tape mark.
    pub header_lines: bool,
    /// Key words and names of several letters are one token.
    pub words: bool,
    /// `<name>` is a name.
    pub angle_names: bool,
    /// `"text"` is a text.
    pub quoted_texts: bool,
    /// A comma may stand for the decimal point.
    pub decimal_comma: bool,
    /// `@1 ^30` are polar coordinates, `$0` is a spindle.
    pub sign_words: bool,
    /// `O100 sub`, `O<name> call`: control statements begin with the letter O.
    pub o_words: bool,
    /// `IF [ ] GOTO`, `WHILE [ ] DO1`: control statements are key words, labels are N numbers.
    pub macro_words: bool,
    /// FIX and FUP round towards and away from zero, not down and up.
    pub fix_towards_zero: bool,
    /// The largest number of a parameter.
    pub parameters: u32,
    /// G codes in tenths (G43.1 is 431) with their actions.
    pub g_codes: &'static [(u16, Action)],
    /// M codes with their actions.
    pub m_codes: &'static [(u16, Action)],
}

impl Dialect {
    /// Letters, numbers and `;` comments only: the basis of all controls.
    pub(crate) const BARE: Self = Self {
        control: Control::LinuxCnc,
        paren_comments: false,
        semicolon_comments: true,
        header_lines: false,
        words: false,
        angle_names: false,
        quoted_texts: false,
        decimal_comma: false,
        sign_words: false,
        o_words: false,
        macro_words: false,
        fix_towards_zero: false,
        parameters: 0,
        g_codes: &[],
        m_codes: &[],
    };

    /// The table of a control.
    pub fn of(control: Control) -> &'static Self {
        match control {
            Control::Sinumerik840d => &sinumerik::DIALECT,
            Control::Fanuc => &fanuc::DIALECT,
            Control::Haas => &haas::DIALECT,
            Control::LinuxCnc => &linuxcnc::DIALECT,
            Control::Heidenhain => &heidenhain::DIALECT,
        }
    }

    /// The action of a G code, by its number in tenths.
    pub fn g_code(&self, tenths: u16) -> Option<Action> {
        self.g_codes.iter().find(|(code, _)| *code == tenths).map(|(_, action)| *action)
    }

    /// The action of an M code.
    pub fn m_code(&self, number: u16) -> Option<Action> {
        self.m_codes.iter().find(|(code, _)| *code == number).map(|(_, action)| *action)
    }
}
