//! What a block begins with, and the statements that move nothing.

use super::line::Cursor;
use super::variables::{StoredValue, Variable};
use super::words::{Words, split_address};
use super::{Run, fault};
use crate::execution::values::{self, finite, not_zero};
use crate::execution::{Next, mistakes};
use crate::moves::{Axis, Event, MoveKind, OrientationPath};
use crate::text::program::Fault;

/// Functions of contours without dimensions: their path is not computed.
const FREE_CONTOUR: [&str; 9] =
    ["FL", "FLT", "FC", "FCT", "FPOL", "FSELECT", "SPL", "FN_", "FPOLAR"];

/// Known, of no effect on the path of the tool: the whole block is noted.
const NOTED: [&str; 10] = [
    "POLARKIN",
    "TCH",
    "PRESET",
    "CONTOUR",
    "OPEN",
    "TABDATA",
    "CORR",
    "MONITORING",
    "ADAPTIVE",
    "SECTION",
];

impl Run<'_> {
    /// Executes one block.
    pub(super) fn statement(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        if let Some(variable) = self.variable(c)? {
            self.assign(variable, c)?;
            return Ok(Next::Following);
        }
        if let Some(next) = self.path_statement(c)? {
            return Ok(next);
        }
        let at = c.offset();
        match c.accept_any(&["BEGIN", "END", "LBL", "CALL", "SEL", "FN", "CYCL", "CYCLE", "STOP"]) {
            Some(0) => return self.begin(c),
            Some(1) if c.accept("PGM") => {
                c.leave();
                return self.end(at);
            }
            Some(1) => return Err(c.unknown()),
            Some(2) => return self.label(c),
            Some(3) => return self.call(c),
            Some(4) => return self.select(c),
            Some(5) => return self.fn_statement(c),
            Some(6 | 7) => return self.cycle_statement(c),
            Some(_) => {
                self.core.emit(Event::Stop { optional: false });
                let words = self.words(c)?;
                return self.block_without_move(&words);
            }
            None => {}
        }
        if c.accept("DECLARE") {
            c.accept("STRING");
            return match self.variable(c)? {
                Some(variable) => self.assign(variable, c).map(|()| Next::Following),
                None => Err(c.unknown()),
            };
        }
        self.setting(c)?;
        Ok(Next::Following)
    }

    /// Statements that set something; an unknown one is an error.
    fn setting(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        match c.accept_any(&["TOOL", "BLK", "PLANE", "TRANS", "PATTERN", "FUNCTION"]) {
            Some(0) => return self.tool_statement(c),
            Some(1) => return self.blank_form(c),
            Some(2) => return self.plane(c),
            Some(3) => return self.transformation(c),
            Some(4) => return self.define_pattern(c),
            Some(_) => return self.control_function(c),
            None => {}
        }
        if c.accept_any(&FREE_CONTOUR).is_some() {
            let message = "free contour programming and splines are not interpreted";
            return Err(fault("not-interpreted", at, message, "write L, C, CR or CT blocks"));
        }
        if c.accept_any(&["ELSE", "FOR", "WHILE", "IF"]).is_some() {
            let message = "structured control statements are not interpreted";
            return Err(fault("not-interpreted", at, message, "write FN 9 to FN 12 with labels"));
        }
        if NOTED.iter().any(|word| c.is(word)) {
            let name = c.shown().to_ascii_uppercase();
            c.leave();
            self.core.left_out(&name, at);
            return Ok(());
        }
        Err(c.unknown())
    }

    /// FN n: …
    fn fn_statement(&mut self, c: &mut Cursor<'_>) -> Result<Next, Fault> {
        let at = c.start;
        let Some(number) = c.whole()? else { return Err(super::values::missing(c)) };
        c.accept_symbol(b':');
        match number {
            0..=8 | 13 => {
                self.calculation(number, c)?;
                Ok(Next::Following)
            }
            9..=12 => self.branch(c),
            14 => {
                let shown = c.rest();
                Err(mistakes::alarm(&shown, at))
            }
            15 | 16 => {
                let text = c.rest();
                self.core.emit(Event::Log(text));
                Ok(Next::Following)
            }
            18 => {
                self.system_datum(c)?;
                Ok(Next::Following)
            }
            28 => {
                c.accept("TABREAD");
                c.accept_symbol(b':');
                if let Some(target) = self.variable(c)? {
                    self.variables.store(target, StoredValue::Unknown("it is in a table"));
                }
                c.leave();
                Ok(Next::Following)
            }
            17 | 19 | 20 | 26 | 27 | 29 | 32 | 37 | 38 => {
                c.leave();
                self.core.left_out(&format!("FN {number}"), at);
                Ok(Next::Following)
            }
            _ => {
                let message = format!("unknown function FN {number}");
                Err(fault("unknown-word", at, message, "use FN 0 to FN 38"))
            }
        }
    }

    /// FN 0 to FN 8 and FN 13: `Q1 = +Q2 DIV +5`.
    fn calculation(&mut self, number: u32, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        let Some(target) = self.variable(c)? else { return Err(super::values::missing(c)) };
        if number == 0 && matches!(target, Variable::Text(_)) || !c.accept_symbol(b'=') {
            return Err(mistakes::missing_equals("a parameter", "write FN 0: Q1 = 5", c.offset()));
        }
        if c.accept("SET") && c.accept("UNDEFINED") {
            self.undefine(target);
            return Ok(());
        }
        let one = match number {
            5 => c.accept("SQRT"),
            6 => c.accept("SIN"),
            7 => c.accept("COS"),
            _ => true,
        };
        if !one {
            return Err(c.unknown());
        }
        let a = self.value(c)?;
        let mut second = |run: &mut Self, sign: u8, word: &str| {
            let found = if sign == 0 { c.accept(word) } else { c.accept_symbol(sign) };
            if found { run.value(c) } else { Err(c.unknown()) }
        };
        let value = match number {
            1 => a + second(self, b'+', "")?,
            2 => a - second(self, b'-', "")?,
            3 => a * second(self, b'*', "")?,
            4 => a / not_zero(second(self, 0, "DIV")?, at)?,
            5..=7 => {
                let name = ["SQRT", "SIN", "COS"][number as usize - 5];
                values::function(name, a, at)?.unwrap_or(a)
            }
            8 => a.hypot(second(self, 0, "LEN")?),
            13 => a.atan2(second(self, 0, "ANG")?).to_degrees().rem_euclid(360.0),
            _ => a,
        };
        self.variables.store(target, StoredValue::Number(finite(value, at)?));
        Ok(())
    }

    /// FN 18: SYSREAD: what follows from the program is given, all else is unknown until it is used.
    ///
    /// The numbers are those of the TNC 426/430 technical manual: ID220 NR2 the datum shift, ID240
    /// NR1 the nominal place in the machine, ID270 NR1 the place in the program, by axis in IDX.
    fn system_datum(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        c.accept("SYSREAD");
        let Some(target) = self.variable(c)? else { return Err(super::values::missing(c)) };
        if !c.accept_symbol(b'=') || !c.accept("ID") {
            return Err(c.unknown());
        }
        let id = self.value(c)?;
        let mut detail = [0.0; 2];
        while let Some(index) = c.accept_any(&["NR", "IDX"]) {
            detail[index] = self.value(c)?;
        }
        let axis = Axis::ALL.get((detail[1] as usize).wrapping_sub(1)).copied();
        let place = match (id as u32, detail[0] as u32) {
            (220, 2) => Some(self.frames.shift()),
            (240, 1) if !self.core.modes.tool_centre && !self.frames.is_tilted() => {
                Some(self.machine_place())
            }
            (270, 1) => Some(self.frames.position),
            _ => None,
        };
        let stored = match place.zip(axis) {
            Some((place, axis)) => {
                let scale = if axis.is_rotary() { 1.0 } else { self.core.modes.unit_mm() };
                StoredValue::Number(place[axis] / scale)
            }
            None => StoredValue::Unknown("FN 18 reads it from the machine"),
        };
        self.variables.store(target, stored);
        Ok(())
    }

    /// FUNCTION TCPM and its relatives.
    fn control_function(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.start;
        if c.accept("RESET") {
            if c.accept("TCPM") {
                self.tool_centre(false, None);
            } else {
                let name = format!("FUNCTION RESET {}", c.rest());
                self.core.left_out(&name, at);
            }
            return Ok(());
        }
        if c.accept("TCPM") {
            return self.tcpm(c);
        }
        if c.accept("DWELL") && c.accept("TIME") {
            let seconds = self.value(c)?;
            return self.dwell(seconds, at);
        }
        if c.accept("MODE") && c.accept("MILL") {
            c.leave();
            self.core.emit(Event::Note("FUNCTION MODE MILL"));
            return Ok(());
        }
        let name = format!("FUNCTION {}", c.rest());
        self.core.left_out(&name, at);
        Ok(())
    }

    /// FUNCTION TCPM F TCP|CONT AXIS POS|SPAT PATHCTRL AXIS|VECTOR REFPNT … F….
    fn tcpm(&mut self, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.start;
        let mut path = None;
        let mut space_angles = false;
        while !c.done() {
            if c.accept("AXIS") {
                match c.accept_any(&["POS", "SPAT"]) {
                    Some(index) => space_angles = index == 1,
                    None => return Err(c.unknown()),
                }
            } else if c.accept("PATHCTRL") {
                match c.accept_any(&["AXIS", "VECTOR"]) {
                    Some(0) => path = Some(OrientationPath::Axes),
                    Some(_) => path = Some(OrientationPath::GreatCircle),
                    None => return Err(c.unknown()),
                }
            } else if c.accept("REFPNT") {
                let centre = c.is("CENTER");
                let tip = c.is("TIP");
                c.take_letters(6);
                c.accept_symbol(b'-');
                if !tip && !centre || c.accept_any(&["TIP", "CENTER"]) != Some(0) {
                    self.core.left_out("REFPNT CENTER-CENTER", at);
                    c.leave();
                }
            } else if split_address(c) == Some("F") {
                if c.accept_any(&["TCP", "CONT"]).is_none() && !c.accept("MAX") {
                    // The limit of the compensating moves.
                    self.value(c)?;
                }
            } else {
                return Err(c.unknown());
            }
        }
        self.tool_centre(true, path);
        self.modes.space_angles = space_angles;
        Ok(())
    }

    pub(super) fn dwell(&mut self, seconds: f64, at: usize) -> Result<(), Fault> {
        if !(0.0..1e6).contains(&seconds) {
            return Err(mistakes::bad_dwell(at));
        }
        self.step(MoveKind::Dwell { seconds }, self.frames.position, at)
    }

    /// M functions without a move.
    pub(super) fn block_without_move(&mut self, words: &Words) -> Result<Next, Fault> {
        words.only_functions()?;
        if self.functions(words, false)? || self.functions(words, true)? {
            return Ok(Next::Finished);
        }
        self.cycle_of_block(words)
    }
}
