//! PATTERN DEF and CYCL CALL PAT: the cycle at each place of a pattern.

use super::cycles::Cycle;
use super::line::Cursor;
use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::MoveKind;
use crate::text::program::Fault;
use trueaxis_cycles::Point;
use trueaxis_cycles::pattern::{Circle, Lattice, MOST_HOLES, Row};

/// A place of a pattern, and what its surface adds to Q203, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PatternPlace {
    place: Point,
    surface: f64,
}

const KINDS: [&str; 6] = ["POS", "ROW", "PAT", "FRAME", "CIRC", "PITCHCIRC"];

/// The words within brackets; longer ones first.
const WORDS: [&str; 13] =
    ["START", "NUMX", "NUMY", "ROTX", "ROTY", "STEP", "NUM", "ROT", "END", "DX", "DY", "D", "Z"];

/// Values of one element of a pattern as they are written.
#[derive(Default)]
struct Element {
    place: [Option<f64>; 2],
    words: [Option<f64>; 13],
}

impl Element {
    fn get(&self, word: &str) -> Option<f64> {
        WORDS.iter().position(|w| *w == word).and_then(|i| self.words[i])
    }

    fn or_zero(&self, word: &str) -> f64 {
        self.get(word).unwrap_or(0.0)
    }

    fn count(&self, word: &str, at: usize) -> Result<u32, Fault> {
        match self.or_zero(word) {
            n if (1.0..=f64::from(MOST_HOLES)).contains(&n) => Ok(n as u32),
            n => {
                let message = format!("expected a number of places in {word}, found {n}");
                Err(fault("bad-repeats", at, message, "write for example NUM5"))
            }
        }
    }
}

impl Run<'_> {
    /// PATTERN DEF POS1 (X Y Z), ROW1 (X Y D NUM ROT Z), PAT1 and FRAME1 (X Y DX DY NUMX NUMY ROT ROTX ROTY Z), CIRC1 (X Y
    /// D START NUM Z), PITCHCIRC1 (X Y D START STEP or END, NUM Z), several of them one after the other.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`. The order within a grid and a frame is ours.
    pub(super) fn define_pattern(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.start;
        c.accept("DEF");
        let mut places = Vec::new();
        while !c.done() {
            let here = c.offset();
            let Some(kind) = c.accept_any(&KINDS) else { return Err(c.unknown()) };
            c.number()?;
            let element = self.pattern_element(c, here)?;
            let surface = element.or_zero("Z") * self.core.modes.unit_mm();
            for place in self.pattern_places(kind, &element, here)? {
                places.push(PatternPlace { place, surface });
            }
            if places.len() > MOST_HOLES as usize {
                let message = format!("more than {MOST_HOLES} places in a pattern");
                return Err(fault("bad-repeats", at, message, "check NUM, NUMX and NUMY"));
            }
        }
        if places.is_empty() {
            return Err(super::values::missing(c));
        }
        self.pattern = places;
        Ok(())
    }

    fn pattern_element(&mut self, c: &mut Cursor<'_>, at: usize) -> Result<Element, Fault> {
        let mut element = Element::default();
        if !c.accept_symbol(b'(') {
            let message = "expected ( after the name of the pattern";
            return Err(fault("missing-sign", c.offset(), message, "write POS1 (X+10 Y+5 Z+0)"));
        }
        while !c.accept_symbol(b')') {
            if c.done() {
                return Err(mistakes::unclosed_bracket(at));
            }
            let letters = c.letters().to_ascii_uppercase();
            let plain = |count: usize| matches!(&letters[count..], b"" | b"Q" | b"QL" | b"QR");
            if let [first @ (b'X' | b'Y'), ..] = letters[..]
                && plain(1)
            {
                c.take_letters(1);
                element.place[usize::from(first == b'Y')] = Some(self.value(c)?);
                continue;
            }
            let found =
                WORDS.iter().position(|w| letters.starts_with(w.as_bytes()) && plain(w.len()));
            let Some(index) = found else { return Err(c.unknown()) };
            c.take_letters(WORDS[index].len());
            element.words[index] = Some(self.value(c)?);
        }
        Ok(element)
    }

    fn pattern_places(&self, kind: usize, e: &Element, at: usize) -> Result<Vec<Point>, Fault> {
        let mm = self.core.modes.unit_mm();
        let [Some(x), Some(y)] = e.place else {
            let message = "X or Y of the pattern is missing";
            return Err(fault("missing-value", at, message, "write POS1 (X+10 Y+5 Z+0)"));
        };
        let from = [x * mm, y * mm];
        let radius_mm = e.or_zero("D").abs() * mm / 2.0;
        let start_deg = e.or_zero("START");
        Ok(match kind {
            0 => vec![from],
            1 => {
                let (angle_deg, spacing_mm) = (e.or_zero("ROT"), e.or_zero("D") * mm);
                Row { from, angle_deg, first_mm: 0.0, spacing_mm, count: e.count("NUM", at)? }
                    .holes()
            }
            2 | 3 => {
                let turn = e.or_zero("ROT");
                let lattice = Lattice {
                    from,
                    angles_deg: [turn + e.or_zero("ROTX"), turn + e.or_zero("ROTY") + 90.0],
                    spacing_mm: [e.or_zero("DX") * mm, e.or_zero("DY") * mm],
                    counts: [e.count("NUMX", at)?, e.count("NUMY", at)?],
                };
                if kind == 2 { lattice.places() } else { lattice.frame() }
            }
            _ => {
                let count = e.count("NUM", at)?;
                let step_deg = match (kind, e.get("STEP"), e.get("END")) {
                    (4, ..) => 360.0 / f64::from(count),
                    (_, Some(step), _) => step,
                    (_, None, end) => {
                        let gaps = f64::from((count - 1).max(1));
                        (end.unwrap_or(start_deg) - start_deg) / gaps
                    }
                };
                Circle { center: from, radius_mm, start_deg, step_deg, count }.holes()
            }
        })
    }

    /// CYCL CALL PAT: between the places at the clearance height, the height of the tool at the call or the second
    /// set-up clearance, whichever is higher.
    pub(super) fn call_pattern(&mut self, rapid: bool, at: usize) -> Result<(), Fault> {
        let places = self.pattern.clone();
        if places.is_empty() {
            self.core.left_out("CYCL CALL PAT: holes of a pattern", at);
            return Ok(());
        }
        let (number, values) = match self.cycle.clone() {
            Some(Cycle::Drilling(number, values)) => (number, values),
            Some(_) => {
                self.core.left_out("CYCL CALL PAT of a program or cycle that is not executed", at);
                return Ok(());
            }
            None => {
                let message = "no cycle is defined";
                return Err(fault("missing-cycle", at, message, "write CYCL DEF before the call"));
            }
        };
        let mm = self.core.modes.unit_mm();
        let [first, second, along] = self.core.modes.plane.axes();
        let begin = self.frames.position[along];
        let of = |q: u32| values.get(&q).copied().unwrap_or(0.0) * mm;
        let kind = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
        if !rapid {
            self.core.modes.check_feed(at)?;
        }
        for PatternPlace { place, surface } in places {
            self.core.count(at)?;
            let clear = of(203) + surface + of(200).abs().max(of(204));
            let height = if number < 200 { begin } else { begin.max(clear) };
            let mut to = self.frames.position;
            if to[along] != height {
                to[along] = height;
                self.step(MoveKind::Rapid, to, at)?;
            }
            if [to[first], to[second]] != place {
                (to[first], to[second]) = (place[0], place[1]);
                self.step(kind, to, at)?;
            }
            let mut own = values.clone();
            if number >= 200 {
                *own.entry(203).or_insert(0.0) += surface / mm;
            }
            self.machine_hole(number, &own, at)?;
        }
        Ok(())
    }
}
