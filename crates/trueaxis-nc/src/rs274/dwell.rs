//! How long a dwell lasts.

use super::Run;
use crate::dialect::Control;
use crate::execution::mistakes;
use crate::moves::MoveKind;
use crate::text::program::Fault;

impl Run<'_> {
    pub(super) fn dwell(&mut self, at: usize) -> Result<(), Fault> {
        let seconds = match self.seconds_by_p()? {
            // X and U of FANUC count seconds.
            None if self.is_fanuc() => {
                self.words.take_away(b'X').or_else(|| self.words.take_away(b'U'))
            }
            seconds => seconds,
        };
        let Some(seconds) = seconds.filter(|s| *s >= 0.0) else {
            return Err(mistakes::bad_dwell(at));
        };
        self.step(MoveKind::Dwell { seconds }, self.frames.position);
        Ok(())
    }

    /// The time of a dwell by P, s.
    ///
    /// FANUC, "Operator's Manual" (30i), G04: P counts milliseconds, a decimal point is not permitted; files have P500. all the same.
    /// Haas Automation, "Mill Operator's Manual", G04: P10 is 10 ms, P10. is 10 s. LinuxCNC counts seconds.
    pub(super) fn seconds_by_p(&mut self) -> Result<Option<f64>, Fault> {
        let has_point = self.has_point(b'P');
        let at = self.words.place(b'P');
        let Some(value) = self.words.take(b'P') else { return Ok(None) };
        match self.current().dialect().control {
            Control::Fanuc if value.fract() != 0.0 && has_point => {
                Err(mistakes::dwell_with_a_point(at))
            }
            Control::Fanuc => {
                if has_point && value != 0.0 {
                    let message = format!(
                        "P{value}. is read as {value} ms; FANUC may refuse its decimal point"
                    );
                    let hint = "write P without a point in milliseconds; in G4 X counts seconds";
                    self.core.warn("bad-dwell", "P", at, message, hint);
                }
                Ok(Some(value / 1000.0))
            }
            Control::Haas if !has_point => Ok(Some(value / 1000.0)),
            _ => Ok(Some(value)),
        }
    }

    /// Whether a word is a number with a decimal point.
    pub(super) fn has_point(&self, letter: u8) -> bool {
        self.written(self.words.place(letter)).1
    }

    /// Whether a word at a byte is a number, and whether it has a decimal point.
    pub(super) fn written(&self, place: usize) -> (bool, bool) {
        let program = self.current();
        let number = program.source().get(place + 1..).unwrap_or_default().iter();
        let number = number.take_while(|b| b.is_ascii_digit() || b"+- .".contains(b));
        (number.clone().any(u8::is_ascii_digit), number.clone().any(|b| *b == b'.'))
    }
}
