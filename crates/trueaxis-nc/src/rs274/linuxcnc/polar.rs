//! The polar words of LinuxCNC: `@` is the distance from the origin of the work offset, `^` the angle
//! from the first axis. They are read as X and Y of the same place.
//!
//! # Source
//! LinuxCNC 2.9 user manual, "G-Code Overview", section "Polar Coordinates".

use crate::execution::mistakes::too_large;
use crate::execution::values::LARGEST;
use crate::moves::{Axis, Position};
use crate::rs274::Run;
use crate::text::program::{Fault, fault};

/// A polar word: its value and its place in the text.
pub(in crate::rs274) type PolarWord = Option<(f64, usize)>;

impl Run<'_> {
    /// Puts X and Y in the place of the polar words of a motion.
    pub(in crate::rs274) fn polar_words(&mut self, machine: bool) -> Result<(), Fault> {
        let Some([x, y]) = self.polar_target(machine)? else { return Ok(()) };
        let at = self.polar_at();
        self.words.polar = [None; 2];
        let (unit, place) = (self.core.modes.unit_mm(), self.frames.position);
        let base = if self.core.modes.incremental { place } else { Position::default() };
        self.words.put(b'X', (x - base[Axis::X]) / unit, at)?;
        self.words.put(b'Y', (y - base[Axis::Y]) / unit, at)
    }

    fn polar_at(&self) -> usize {
        self.words.polar.iter().flatten().next().map_or(0, |(_, at)| *at)
    }

    /// Where the polar words of the block lead from here, X and Y in mm.
    pub(in crate::rs274) fn polar_target(&self, machine: bool) -> Result<Option<[f64; 2]>, Fault> {
        let [distance, angle] = self.words.polar.map(|word| word.map(|(value, _)| value));
        if distance.is_none() && angle.is_none() {
            return Ok(None);
        }
        let at = self.polar_at();
        let wrong = |message: &str, hint| Err(fault("polar-words", at, message.to_owned(), hint));
        if machine {
            return wrong("G53 takes no polar words", "write X and Y");
        }
        if self.words.look(b'X').or(self.words.look(b'Y')).is_some() {
            return wrong("polar words and X or Y are in one block", "write either of them");
        }
        let distance = distance.map(|d| d * self.core.modes.unit_mm());
        let [x, y] = [self.frames.position[Axis::X], self.frames.position[Axis::Y]];
        let (from, bearing) = (x.hypot(y), y.atan2(x));
        let incremental = self.core.modes.incremental;
        if from == 0.0 && (incremental || angle.is_none()) {
            return wrong("the angle of the origin is not defined", "write @ and ^ with G90");
        }
        let (from_there, from_its_angle) = if incremental { (from, bearing) } else { (0.0, 0.0) };
        let radius = distance.map_or(from, |d| from_there + d);
        let turned = angle.map_or(bearing, |a| from_its_angle + a.to_radians());
        let (sin, cos) = turned.sin_cos();
        Ok(Some([radius * cos, radius * sin]))
    }

    /// Polar words that no motion took.
    pub(in crate::rs274) fn no_polar_words_left(&mut self) -> Result<(), Fault> {
        match std::mem::take(&mut self.words.polar).into_iter().flatten().next() {
            Some((_, at)) => {
                let message = "polar words belong to a motion such as G0 or G1".to_owned();
                Err(fault("polar-words", at, message, "write X and Y"))
            }
            None => Ok(()),
        }
    }
}

/// Notes the word of a block; it stands there once.
pub(in crate::rs274) fn put(
    word: &mut PolarWord,
    sign: char,
    value: f64,
    at: usize,
) -> Result<(), Fault> {
    if word.is_some() {
        return Err(crate::execution::mistakes::repeated_word(sign, at));
    }
    if value.abs() > LARGEST {
        return Err(too_large(value, sign, at));
    }
    *word = Some((value, at));
    Ok(())
}
