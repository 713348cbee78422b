//! CYCL DEF and CYCL CALL: transformations at once, machining when it is called.

use std::collections::BTreeMap;

use super::line::Cursor;
use super::milling::MILLING;
use super::variables::{StoredValue, Variable};
use super::words::Words;
use super::{Language, Run, fault};
use crate::execution::Next;
use crate::execution::mistakes;
use crate::moves::chain::Transformation;
use crate::moves::turns;
use crate::moves::{Axis, Event, Frame, MoveKind, PathControl};
use crate::text::program::Fault;

/// The machining cycle that a call executes.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cycle {
    /// A drilling or milling cycle with its parameters: Q numbers, or the numbers of the lines of old cycles.
    Drilling(u32, BTreeMap<u32, f64>),
    /// Cycle 12.
    Program(String),
    /// Known to the control, not executed here.
    Missing,
}

/// Cycles that are executed by `drilling.rs`.
const DRILLING: [u32; 13] = [1, 2, 17, 200, 201, 202, 203, 205, 206, 207, 209, 240, 241];

impl Run<'_> {
    pub(super) fn cycle_statement(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        match c.accept_any(&["DEF", "CALL"]) {
            Some(0) => self.define_cycle(c).map(|()| Next::Following),
            Some(_) => self.call_cycle(c),
            None => Err(c.unknown()),
        }
    }

    fn define_cycle(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        let Some(written) = c.number()? else {
            let message = "the number of the cycle is missing";
            return Err(fault("missing-value", at, message, "write CYCL DEF 200"));
        };
        let number = written as u32;
        let part = ((written - f64::from(number)) * 10.0).round() as u32;
        match number {
            7..=13 | 19 | 26 | 32 if part == 0 => {
                c.leave();
                Ok(())
            }
            7 => self.datum_shift(c),
            8 => self.mirror(c),
            9 => {
                let seconds = self.labelled_value(c)?;
                self.dwell(seconds, at)
            }
            10 => self.rotation(c),
            11 | 26 => self.scale(c),
            12 => {
                c.accept("PGM");
                self.cycle = Some(Cycle::Program(c.rest()));
                Ok(())
            }
            13 => {
                let angle_deg = self.labelled_value(c)?;
                self.core.emit(Event::SpindleOrient { angle_deg });
                Ok(())
            }
            19 => self.cycle_19(c),
            32 => self.tolerance(part, c),
            1 | 2 | 17 => self.old_cycle(number, part, c),
            _ => self.new_cycle(number, c, at),
        }
    }

    /// The number of a line such as `DEPTH-20` or `FQ3`, whatever word stands before it.
    fn labelled_value(&mut self, c: &mut Cursor<'_>) -> Result<f64, Fault> {
        loop {
            let letters = c.letters().to_ascii_uppercase();
            let parameter = ["Q", "QL", "QR"].iter().find(|q| letters.ends_with(q.as_bytes()));
            let count = letters.len() - parameter.map_or(0, |q| q.len());
            if count == 0 {
                return self.value(c);
            }
            c.take_letters(count);
            while c.accept_symbol(b'.') || c.accept_point() {}
        }
    }

    /// CYCL DEF 7.1 X+10, or IX; #5 is a line of a datum table.
    fn datum_shift(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        if c.accept_symbol(b'#') {
            self.value(c)?;
            let message = "the datum is in a table that is not read";
            let hint = "write the values into the program";
            self.core.warn("not-applied", "datum table", at, message, hint);
            return Ok(());
        }
        let words = self.words(c)?;
        words.only_axes(&Axis::ALL)?;
        let mut shift = self.frames.shift();
        for axis in Axis::ALL {
            if let Some(word) = words.axes[axis as usize] {
                shift[axis] = word.from(shift[axis]);
            }
        }
        let neutral = shift.0 == [0.0; 9];
        self.transform(Transformation::Shift(shift), neutral, at)
    }

    fn transform(&mut self, new: Transformation, neutral: bool, at: usize) -> Result<(), Fault> {
        let tilted = self.frames.is_tilted();
        let set = self.frames.set(new, neutral);
        if set.is_none() || !self.frames.position.0.iter().all(|v| v.abs() < 1e9) {
            return Err(mistakes::flat_frame(at));
        }
        if tilted {
            self.core.emit(Event::Note("transformation within the tilted plane"));
        }
        self.emit_frame();
        Ok(())
    }

    /// CYCL DEF 8.1 X Y: the axes that are mirrored; none ends it.
    fn mirror(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        let mut axes = [false; 3];
        while let Some(index) = c.accept_any(&["X", "Y", "Z"]) {
            axes[index] = true;
        }
        self.transform(Transformation::Mirror(axes), axes == [false; 3], at)
    }

    /// CYCL DEF 10.1 ROT+30 or IROT+30: about the axis of the tool.
    fn rotation(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        let [first, second, third] = self.core.modes.plane.axes();
        let before = self.frames.rotation_deg(first as usize, second as usize);
        let angle = match c.accept_any(&["ROT", "IROT"]) {
            Some(0) => self.value(c)?,
            Some(_) => before + self.value(c)?,
            None => return Err(c.unknown()),
        };
        let turn = Transformation::Rotation(turns::about(third as usize, angle));
        self.transform(turn, angle == 0.0, at)
    }

    /// CYCL DEF 11.1 SCL0.9; 26.1 X1.4 Y0.6 CCX+15 CCY+20.
    fn scale(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        let (mut factors, mut fixed) = ([1.0; 3], [0.0; 3]);
        if c.accept("SCL") {
            factors = [self.value(c)?; 3];
        }
        while !c.done() {
            if let Some(index) = c.accept_any(&["CCX", "CCY", "CCZ"]) {
                fixed[index] = self.value(c)? * self.core.modes.unit_mm();
            } else if let Some(index) = c.accept_any(&["X", "Y", "Z"]) {
                factors[index] = self.value(c)?;
            } else {
                return Err(c.unknown());
            }
        }
        if !factors.iter().all(|f| (1e-6..=1e6).contains(f)) {
            return Err(mistakes::bad_scale(at));
        }
        self.transform(Transformation::Scale(factors, fixed), factors == [1.0; 3], at)
    }

    /// TRANS DATUM, MIRROR, ROTATION and SCALE: the same without cycles.
    pub(super) fn transformation(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        let Some(kind) = c.accept_any(&["DATUM", "MIRROR", "ROTATION", "SCALE"]) else {
            return Err(c.unknown());
        };
        if c.accept("RESET") {
            let like = match kind {
                0 => Transformation::Shift(Default::default()),
                1 => Transformation::Mirror([false; 3]),
                2 => Transformation::Rotation(Frame::IDENTITY),
                _ => Transformation::Scale([1.0; 3], [0.0; 3]),
            };
            let _ = self.frames.forget(&like);
            self.emit_frame();
            return Ok(());
        }
        if c.accept("TABLE") {
            c.leave();
            self.core.left_out("TRANS DATUM TABLE", at);
            return Ok(());
        }
        c.accept("AXIS");
        match kind {
            0 => self.datum_shift(c),
            1 => self.mirror(c),
            2 => self.rotation(c),
            _ => self.scale(c),
        }
    }

    /// CYCL DEF 32.1 T0.05; 32.2 HSC-MODE:1 TA5.
    fn tolerance(&mut self, part: u32, c: &mut Cursor<'_>) -> Result<(), Fault> {
        if part == 1 {
            let tolerance_mm =
                if c.accept("T") { self.value(c)? * self.core.modes.unit_mm() } else { 0.0 };
            let control =
                if tolerance_mm > 0.0 { PathControl::Continuous } else { PathControl::ExactPath };
            self.core.emit(Event::Path { control, tolerance_mm });
            return Ok(());
        }
        c.leave();
        self.core.emit(Event::Note("cycle 32: HSC mode and angular tolerance"));
        Ok(())
    }

    /// The cycles with a line for each parameter.
    fn old_cycle(&mut self, number: u32, part: u32, c: &mut Cursor<'_>) -> Result<(), Fault> {
        if part == 0 {
            c.leave();
            self.cycle = Some(Cycle::Drilling(number, BTreeMap::new()));
            return Ok(());
        }
        let value = self.labelled_value(c)?;
        match &mut self.cycle {
            Some(Cycle::Drilling(active, values)) if *active == number => {
                values.insert(part, value);
                Ok(())
            }
            _ => {
                let message = format!("the first line of cycle {number} is missing");
                let hint = "write CYCL DEF 1.0 before CYCL DEF 1.1";
                Err(fault("missing-cycle", c.start, message, hint))
            }
        }
    }

    /// The cycles with Q parameters in one block.
    fn new_cycle(&mut self, number: u32, c: &mut Cursor<'_>, at: usize) -> Result<(), Fault> {
        let mut values = BTreeMap::new();
        while !c.done() {
            let mut ahead = c.clone();
            let variable = if c.is("Q") { self.variable(&mut ahead)? } else { None };
            match variable {
                Some(Variable::Global(q)) if ahead.accept_symbol(b'=') => {
                    *c = ahead;
                    if let Some(value) = self.cycle_value(c)? {
                        values.insert(q, value);
                        self.variables.store(Variable::Global(q), StoredValue::Number(value));
                    }
                }
                // The name of the cycle.
                _ => c.skip(),
            }
        }
        if number == 247 {
            return self.preset(values.get(&339).copied(), at);
        }
        if matches!(number, 220 | 221) {
            return self.hole_pattern(number, &values, at);
        }
        if DRILLING.contains(&number) || MILLING.contains(&number) {
            self.cycle = Some(Cycle::Drilling(number, values));
            return Ok(());
        }
        if matches!(number, 239 | 332 | 392) {
            self.core.emit(Event::Note("tuning of the drives to the load"));
            return Ok(());
        }
        let message =
            format!("cycle {number} is not executed: its moves are missing from the path");
        let hint = "let the CAM system write the moves of the cycle";
        self.core.warn("cycle-not-executed", number, at, &message, hint);
        if !matches!(number, 14 | 20 | 400..=499) {
            self.cycle = Some(Cycle::Missing);
        }
        Ok(())
    }

    fn cycle_value(&mut self, c: &mut Cursor<'_>) -> Result<Option<f64>, Fault> {
        if c.accept_any(&["AUTO", "FAUTO"]).is_some() {
            return Ok(Some(self.modes.feed_of_tool));
        }
        if c.accept_any(&["MAX", "FMAX"]).is_some() {
            return Ok(Some(99_999.0));
        }
        if c.accept_any(&["PREDEF", "FU", "FZ"]).is_some() || c.text().is_some() {
            return Ok(None);
        }
        let at = c.offset();
        let value = self.formula(c)?;
        if c.names_since(at) {
            self.core.report_computed(at..c.taken_to(), Some(value));
        }
        Ok(Some(value))
    }

    /// Cycle 247: preset n is the work offset n of the settings.
    fn preset(&mut self, number: Option<f64>, at: usize) -> Result<(), Fault> {
        let Some(number) = number.filter(|n| (0.0..1e6).contains(n)) else {
            let message = "cycle 247 needs Q339, the number of the preset";
            return Err(fault("bad-work-offset", at, message, "write Q339=+1"));
        };
        let index = number as u32;
        let frame = self.core.settings.work_offsets.get(&index).copied();
        self.core.unknown_offset(index, format_args!("{index} (preset)"), at);
        let frame = frame.unwrap_or(Frame::IDENTITY);
        if self.frames.set_preset(frame).is_none() {
            return Err(mistakes::flat_frame(at));
        }
        let rotation_deg = turns::rotation_deg(&frame);
        self.core.emit(Event::WorkOffset { index, offset: frame.shift, rotation_deg });
        self.emit_frame();
        Ok(())
    }

    /// CYCL CALL, CYCL CALL POS, CYCL CALL PAT.
    fn call_cycle(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let at = c.start;
        let kind = c.accept_any(&["POS", "PAT"]);
        let mut words = self.words(c)?;
        let rapid = self.feed(&words);
        if self.functions(&words, false)? {
            return Ok(Next::Finished);
        }
        if kind == Some(1) {
            self.call_pattern(rapid, at)?;
            let ends = self.functions(&words, true)?;
            return Ok(if ends { Next::Finished } else { Next::Following });
        }
        if kind == Some(0) {
            let along = self.along();
            if words.axes[along as usize].take().is_some_and(|w| w.value != 0.0) {
                self.core.left_out("the height in CYCL CALL POS", at);
            }
            let target = words.target(&self.frames.position);
            let kind = if rapid { MoveKind::Rapid } else { MoveKind::Linear };
            if !rapid {
                self.core.modes.check_feed(at)?;
            }
            self.step(kind, target, at)?;
        } else if words.has_axis() {
            let message = "axis words need CYCL CALL POS";
            return Err(fault("unexpected-sign", words.at, message, "write CYCL CALL POS X… Y…"));
        }
        let next = self.execute_cycle(at)?;
        if next == Next::Following && self.functions(&words, true)? {
            return Ok(Next::Finished);
        }
        Ok(next)
    }

    /// M99 calls the cycle after the move of its block, M89 after each.
    pub(super) fn cycle_of_block(&mut self, words: &Words) -> Result<Next, Fault> {
        if words.calls(99) {
            self.modes.cycle_everywhere = false;
        }
        let moved = words.has_axis() || words.radius.or(words.angle).is_some();
        let modal = self.modes.cycle_everywhere && moved;
        if words.calls(99) || modal { self.execute_cycle(words.at) } else { Ok(Next::Following) }
    }

    fn execute_cycle(&mut self, at: usize) -> Result<Next, Fault> {
        match self.cycle.clone() {
            Some(Cycle::Drilling(number, values)) => {
                self.machine_hole(number, &values, at)?;
                Ok(Next::Following)
            }
            Some(Cycle::Program(name)) => self.call_program(&name, at),
            Some(Cycle::Missing) => Ok(Next::Following),
            None => {
                let message = "no cycle is defined";
                Err(fault("missing-cycle", at, message, "write CYCL DEF before the call"))
            }
        }
    }
}
