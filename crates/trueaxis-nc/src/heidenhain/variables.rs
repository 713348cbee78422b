//! Q, QL, QR and QS parameters: what is stored, and what the control itself knows.

use std::collections::HashMap;

use super::line::Cursor;
use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::{Axis, SpindleDirection};
use crate::text::program::Fault;

/// Characters of a text parameter.
const LONGEST_TEXT: usize = 255;

/// Which parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Variable {
    /// Q, for all programs.
    Global(u32),
    /// QL, within a program.
    Local(u32),
    /// QR, kept over power off.
    Retained(u32),
    /// QS, a text.
    Text(u32),
}

/// A number, or why there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StoredValue {
    Number(f64),
    /// Only the machine knows it: what was asked for.
    Unknown(&'static str),
}

#[derive(Debug, Default)]
pub(super) struct Variables {
    numbers: HashMap<Variable, StoredValue>,
    texts: HashMap<u32, String>,
    /// QL of the programs that wait for the present one.
    outer: Vec<HashMap<Variable, StoredValue>>,
}

impl Variables {
    /// A program is called: its QL are its own.
    pub fn enter(&mut self) {
        let local = |v: &Variable| matches!(v, Variable::Local(_));
        let (kept, rest) = self.numbers.drain().partition(|(v, _)| local(v));
        self.outer.push(kept);
        self.numbers = rest;
    }

    /// The called program is at its end.
    pub fn leave(&mut self) {
        self.numbers.retain(|v, _| !matches!(v, Variable::Local(_)));
        self.numbers.extend(self.outer.pop().unwrap_or_default());
    }

    pub fn store(&mut self, variable: Variable, value: StoredValue) {
        self.numbers.insert(variable, value);
    }

    pub fn store_text(&mut self, number: u32, mut text: String, at: usize) -> Result<(), Fault> {
        if text.chars().count() > LONGEST_TEXT {
            return Err(mistakes::text_too_long(LONGEST_TEXT, at));
        }
        text.shrink_to_fit();
        self.texts.insert(number, text);
        Ok(())
    }
}

impl Run<'_> {
    /// The parameter that stands here, if one does.
    pub(super) fn variable(&mut self, c: &mut Cursor<'_>) -> Result<Option<Variable>, Fault> {
        if !matches!(c.letters().first(), Some(b'Q' | b'q')) {
            return Ok(None);
        }
        let at = c.offset();
        let Some(kind) = c.accept_any(&["Q", "QL", "QR", "QS"]) else { return Ok(None) };
        let Some(number) = c.whole()? else {
            let message = "the number of the parameter is missing";
            return Err(fault("missing-value", c.offset(), message, "write Q1"));
        };
        let most = if matches!(kind, 1 | 2) { 499 } else { 1999 };
        if number > most {
            let hint = "use Q0 to Q1999, QS0 to QS1999, QL0 to QL499, QR0 to QR499";
            return Err(mistakes::no_parameter(number, hint, at));
        }
        Ok(Some(match kind {
            0 => Variable::Global(number),
            1 => Variable::Local(number),
            2 => Variable::Retained(number),
            _ => Variable::Text(number),
        }))
    }

    /// The value of a parameter.
    pub(super) fn read(&mut self, variable: Variable, at: usize) -> Result<f64, Fault> {
        if let Variable::Text(number) = variable {
            let message = format!("QS{number} is a text, not a number");
            return Err(fault("text-for-number", at, message, "write TONUMB(SRC_QS1)"));
        }
        match self.variables.numbers.get(&variable) {
            Some(StoredValue::Number(value)) => Ok(*value),
            Some(StoredValue::Unknown(what)) => {
                let message = format!("the value of {} is not known: {what}", show(variable));
                let hint = "write the number into the program";
                Err(fault("unknown-value", at, message, hint))
            }
            None => self.assigned_by_control(variable, at),
        }
    }

    pub(super) fn is_defined(&self, variable: Variable) -> bool {
        match variable {
            Variable::Text(number) => self.variables.texts.contains_key(&number),
            _ => matches!(self.variables.numbers.get(&variable), Some(StoredValue::Number(_))),
        }
    }

    /// Forgets a value: SET UNDEFINED.
    pub(super) fn undefine(&mut self, variable: Variable) {
        self.variables.numbers.remove(&variable);
        if let Variable::Text(number) = variable {
            self.variables.texts.remove(&number);
        }
    }

    pub(super) fn read_text(&self, number: u32, at: usize) -> Result<String, Fault> {
        self.variables
            .texts
            .get(&number)
            .cloned()
            .ok_or_else(|| mistakes::no_value_yet(format_args!("QS{number}"), at))
    }

    /// Q108 to Q122, as far as they follow from the program.
    fn assigned_by_control(&mut self, variable: Variable, at: usize) -> Result<f64, Fault> {
        let undefined = || mistakes::no_value_yet(show(variable), at);
        let Variable::Global(number) = variable else { return Err(undefined()) };
        let length = |mm: f64, inches: bool| if inches { mm / 25.4 } else { mm };
        let inches = self.core.modes.inches;
        match number {
            108 => self.modes.tool_radius_mm.map(|r| length(r, inches)).ok_or_else(|| {
                let message = "Q108: the radius of the tool is not known";
                fault("unknown-value", at, message, "write TOOL DEF with R before TOOL CALL")
            }),
            109 => Ok(match self.modes.tool_axis {
                None => -1.0,
                Some(Axis::U) => 6.0,
                Some(Axis::V) => 7.0,
                Some(Axis::W) => 8.0,
                Some(axis) => f64::from(axis as u8),
            }),
            110 => Ok(match self.core.modes.turning {
                SpindleDirection::Stopped => -1.0,
                SpindleDirection::Clockwise => 0.0,
                SpindleDirection::CounterClockwise => 1.0,
            }),
            111 => Ok(f64::from(u8::from(self.modes.coolant))),
            113 => Ok(f64::from(u8::from(inches))),
            114 => Ok(length(self.modes.tool_length_mm, inches)),
            120..=122 if self.frames.is_tilted() => {
                let message =
                    format!("Q{number}: the rotary angles of the plane depend on the machine");
                let hint = "interpret the program with a machine that can reach the plane";
                Err(fault("unknown-value", at, message, hint))
            }
            100..=107 | 112 | 115..=199 => {
                let message =
                    format!("the value of Q{number} is set by the control and not known here");
                let hint = "write the number into the program";
                Err(fault("unknown-value", at, message, hint))
            }
            _ => Err(undefined()),
        }
    }
}

fn show(variable: Variable) -> String {
    match variable {
        Variable::Global(n) => format!("Q{n}"),
        Variable::Local(n) => format!("QL{n}"),
        Variable::Retained(n) => format!("QR{n}"),
        Variable::Text(n) => format!("QS{n}"),
    }
}
