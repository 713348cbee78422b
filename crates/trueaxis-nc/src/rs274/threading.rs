//! G76 of LinuxCNC: a thread in several passes.

use super::{Run, fault};
use crate::moves::{Axis, MoveKind, Plane};
use crate::text::program::Fault;
use trueaxis_cycles::thread::Thread;

impl Run<'_> {
    /// G76 P Z I J K, with R Q H E L: from the place of the tool in the plane of X and Z.
    ///
    /// # Source
    /// LinuxCNC 2.9 user manual, "G76 Threading Cycle". I, J and K are diameters with G7.
    pub(super) fn thread(&mut self, at: usize) -> Result<(), Fault> {
        let now = self.frames.position;
        let target = self.target();
        let unit = self.core.modes.unit_mm();
        let radial = if self.core.modes.diameter { unit / 2.0 } else { unit };
        let words = &mut self.words;
        let given = [b'P', b'I', b'J', b'K'].map(|letter| words.take(letter));
        let [Some(pitch), Some(crest), Some(first), Some(height)] = given else {
            let message = "G76 needs P, I, J and K";
            return Err(fault("missing-value", at, message, "write G76 P1.5 Z-20 I-2 J0.3 K1"));
        };
        let mut or = |letter: u8, value: f64| words.take(letter).unwrap_or(value);
        let (degression, compound_deg) = (or(b'R', 1.0), or(b'Q', 0.0));
        let (springs, taper, ends) = (or(b'H', 0.0), or(b'E', 0.0), or(b'L', 0.0));
        let wrong = [
            (self.core.modes.plane != Plane::Zx, "the plane is not G18"),
            (pitch <= 0.0, "P, the pitch, is not above 0"),
            (crest == 0.0, "I, the way to the crest, is 0"),
            (first <= 0.0 || height <= 0.0, "J or K, the depths, are not above 0"),
            (!(0.0..=3.0).contains(&ends) || ends.fract() != 0.0, "L is not 0, 1, 2 or 3"),
            (!(0.0..=1000.0).contains(&springs), "H is not a number of passes"),
            (!(0.0..80.0).contains(&compound_deg), "Q is not an angle from 0 to 80 degrees"),
        ];
        if let Some((_, why)) = wrong.iter().find(|(found, _)| *found) {
            let message = format!("the threading cycle is not possible: {why}");
            return Err(fault(
                "bad-thread",
                at,
                message,
                "write G18 and G76 P1.5 Z-20 I-2 J0.3 K1",
            ));
        }
        let ends = ends as u32;
        let thread = Thread {
            from: [now[Axis::X], now[Axis::Z]],
            end_mm: target[Axis::Z],
            pitch_mm: pitch * unit,
            crest_mm: crest * radial,
            first_mm: first * radial,
            height_mm: height * radial,
            degression,
            compound_deg,
            spring_passes: springs as u32,
            taper_mm: taper * unit,
            tapers: [ends & 1 != 0, ends & 2 != 0],
        };
        let Some(moves) = thread.moves() else {
            let message = "the thread has more than 10000 passes";
            return Err(fault("too-many-pecks", at, message, "check J and K"));
        };
        for m in moves {
            let mut to = now;
            (to[Axis::X], to[Axis::Z]) = (m.to[0], m.to[1]);
            let kind = m.pitch_mm.map_or(MoveKind::Rapid, |pitch_mm| MoveKind::Thread { pitch_mm });
            self.step(kind, to);
        }
        self.step(MoveKind::Rapid, target);
        Ok(())
    }
}
