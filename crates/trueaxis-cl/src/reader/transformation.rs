//! Words that displace or turn the points, and those that are not applied.

use super::super::Word;
use super::super::numbers::{Fault, is_near, number};
use super::super::scan::Statement;
use super::Reader;

impl Reader<'_> {
    /// TRANS/x,y,z: added to the coordinates of all following points, until TRANS/0,0,0 or OFF. Whether a second one
    /// replaces the first or adds to it differs between systems: between two there must be one of 0.
    pub(super) fn translate(&mut self, s: &Statement) -> Result<Word, Fault> {
        let off = is_off(s);
        if !off && s.count() != 3 {
            let message = format!("TRANS has 3 numbers, not {}", s.count());
            return Err(("bad-point", message, "write TRANS/x,y,z"));
        }
        let by = if off { [0.0; 3] } else { self.numbers::<3>(s, 0)?.map(|v| v * self.unit_mm) };
        if !is_near(&by) {
            let message = "a coordinate of TRANS exceeds 10 km".to_owned();
            return Err(("too-far", message, "check the units"));
        }
        let zero = [0.0; 3];
        if self.translation != zero && by != zero {
            let message =
                "TRANS stands after another one: it may replace it, or add to it".to_owned();
            return Err(("motion-not-read", message, "write TRANS/0,0,0 before it"));
        }
        if self.translation != by {
            // A step counts from a point of the same translation.
            self.tip_mm = None;
        }
        self.translation = by;
        Ok(Word::Translation(by))
    }

    pub(super) fn displaced(&self, place_mm: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| place_mm[i] + self.translation[i])
    }

    pub(super) fn not_applied(&mut self, what: &str, s: &Statement) -> Word {
        if !is_off(s) {
            let message = format!("{} is read, but not applied: {what}", s.word);
            let hint = "check the path of the tool";
            self.warn("not-applied", &s.word, s.line, message, hint);
        }
        Word::Noted
    }

    /// The same for what changes neither motion nor spindle nor coolant.
    pub(super) fn replaced(&mut self, what: &str, s: &Statement) -> Word {
        if !is_off(s) && self.reported.insert(format!("not-applied {}", s.word)) {
            let message = format!("{} is read, but not applied: {what}", s.word);
            let hint = "check the end of the program, or put it into a template";
            self.problems.note("not-applied", self.place(s.line), message, hint);
        }
        Word::Noted
    }
}

/// A word that changes where the points are, unless it ends that or changes nothing.
pub(super) fn refused(what: &str, s: &Statement) -> Result<Word, Fault> {
    let is_zero = |text: &str| number(text).is_ok_and(|value| value == 0.0);
    let nowhere = s.word == "ORIGIN" && s.count() > 0 && s.arguments().all(is_zero);
    if is_off(s) || nowhere {
        return Ok(Word::Noted);
    }
    let message = format!("{} is not read: {what}", s.word);
    Err(("motion-not-read", message, "let the CAM system write the points where they are machined"))
}

fn is_off(s: &Statement) -> bool {
    ["OFF", "NOMORE"].iter().any(|word| s.argument(0).eq_ignore_ascii_case(word))
}
