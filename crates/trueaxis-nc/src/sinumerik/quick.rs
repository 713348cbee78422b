//! A short cut for lines of plain words, which most lines of long programs are.

use super::Run;
use super::tables::{self, Code};
use super::variables::axis_of;
use super::words::Mode;
use crate::text::lexer::plain_number;

impl Run<'_> {
    /// Reads a line that holds nothing but plain words straight into the words; its end.
    ///
    /// `None` leaves the line to the reader, which reads all of them and says what is wrong.
    pub(super) fn quick(&mut self, source: &[u8], start: usize) -> Option<usize> {
        let mut at = start;
        self.words.clear();
        let mut first = true;
        loop {
            let byte = *source.get(at)?;
            match byte {
                b' ' => at += 1,
                b'\n' => return Some(at + 1),
                b'\r' if source.get(at + 1) == Some(&b'\n') => return Some(at + 2),
                b'A'..=b'Z' => {
                    at = self.quick_word(source, byte, at, first)?;
                    first = false;
                }
                _ => return None,
            }
        }
    }

    #[inline]
    fn quick_word(&mut self, source: &[u8], letter: u8, at: usize, first: bool) -> Option<usize> {
        let (value, after) = plain_number(source, at + 1)?;
        // A3=0.5: a number after the letter, then = and the value.
        if source.get(after) == Some(&b'=') {
            if !matches!(letter, b'A'..=b'C') || value != 3.0 {
                return None;
            }
            let (value, end) = plain_number(source, after + 1)?;
            self.words.put_vector([3, usize::from(letter - b'A')], value, at);
            return ends_word(source, end).then_some(end);
        }
        if !ends_word(source, after) {
            return None;
        }
        match letter {
            b'N' if first => {}
            b'F' => self.words.feed = Some((value, at)),
            b'G' if !self.core.settings.codes.is_empty() => return None,
            b'G' if value.fract() == 0.0 && (0.0..=999.0).contains(&value) => {
                let code = tables::g_code(value as u32)?;
                if !matches!(code, Code::Motion(_)) || !self.words.codes.is_empty() {
                    return None;
                }
                self.words.codes.push((code, at));
            }
            b'I'..=b'K' => {
                self.words.centers[usize::from(letter - b'I')] = Some((value, Mode::Modal));
            }
            _ => self.words.put_axis(axis_of(letter)?, (value, Mode::Modal), at).ok()?,
        }
        Some(after)
    }
}

/// What may follow a plain value.
fn ends_word(source: &[u8], at: usize) -> bool {
    match source.get(at) {
        Some(b' ' | b'\n' | b'\r') => true,
        Some(b'A'..=b'Z') => {
            source.get(at + 1).is_some_and(|b| !b.is_ascii_alphabetic() && *b != b'_')
        }
        _ => false,
    }
}
