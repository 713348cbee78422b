//! A short cut for lines of plain words.

use super::Run;
use super::words::check_groups;
use crate::dialect::Dialect;
use crate::rs274::code::Action;
use crate::text::lexer::plain_number;

/// G codes by their number in tenths, for one look each.
pub(super) type CodeTable = Box<[Option<Action>; 1000]>;

pub(super) fn code_table(dialect: &Dialect) -> CodeTable {
    let mut table = Box::new([None; 1000]);
    for (code, action) in dialect.g_codes {
        if let Some(entry) = table.get_mut(usize::from(*code)) {
            entry.get_or_insert(*action);
        }
    }
    table
}

impl Run<'_> {
    /// Reads a line that holds nothing but plain words straight into the words; its end.
    ///
    /// Most lines of long programs are of this kind. `None` leaves the line to the parser, which
    /// reads all of them and says what is wrong.
    pub(super) fn quick(
        &mut self,
        dialect: &Dialect,
        source: &[u8],
        start: usize,
    ) -> Option<usize> {
        if !self.modes.macros.is_empty() || !self.core.settings.codes.is_empty() {
            return None;
        }
        let mut at = start;
        self.words.clear();
        loop {
            let byte = *source.get(at)?;
            match byte {
                b' ' => at += 1,
                b'\n' => {
                    at += 1;
                    break;
                }
                b'\r' if source.get(at + 1) == Some(&b'\n') => {
                    at += 2;
                    break;
                }
                b'a'..=b'z' | b'A'..=b'Z' => {
                    let (value, after) = plain_number(source, at + 1)?;
                    self.quick_word(dialect, byte.to_ascii_uppercase(), value, at)?;
                    at = after;
                }
                _ => return None,
            }
        }
        if self.words.actions.len() > 1 {
            self.words.actions.sort_by_key(|(action, _)| action.rank());
            check_groups(&self.words).ok()?;
        }
        Some(at)
    }

    fn quick_word(&mut self, dialect: &Dialect, letter: u8, value: f64, at: usize) -> Option<()> {
        let action = match letter {
            b'O' => return None,
            b'N' => {
                self.modes.last[1] = value;
                return Some(());
            }
            b'G' => self.codes[super::words::whole(value * 10.0).filter(|t| *t < 1000)? as usize]?,
            b'M' => {
                self.modes.last[0] = value;
                dialect.m_code(super::words::whole(value)?)?
            }
            _ => return self.words.put(letter, value, at).ok(),
        };
        let call = matches!(action, Action::MacroCall | Action::ModalMacro { .. });
        if call || self.words.actions.len() > 20 {
            return None;
        }
        self.words.actions.push((action, at));
        Some(())
    }
}
