//! Parameters by number and by name, those of the control among them.

use std::rc::Rc;

use super::values::out_of_range;
use super::{Passage, Run, fault};
use crate::moves::{Axis, Position};
use crate::text::program::{Fault, Node, NodeId, Program};

/// The parameters of one call: `#1` to `#30` (`#33` on FANUC) and its own names.
#[derive(Debug, Clone)]
pub(super) struct Locals {
    pub numbers: [Option<f64>; 34],
    pub named: std::collections::HashMap<String, f64>,
}

impl Default for Locals {
    fn default() -> Self {
        Self { numbers: [None; 34], named: std::collections::HashMap::new() }
    }
}

/// A parameter that is meant: by number or by name.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Parameter {
    Number(u32),
    Name(String),
}

impl Run<'_> {
    /// Which parameter a node means.
    pub(super) fn parameter(&self, passage: Passage<'_>, node: NodeId) -> Result<Parameter, Fault> {
        match &passage.block.nodes[node as usize] {
            Node::Named(span) => {
                let name = String::from_utf8_lossy(&passage.program.source()[span.clone()]);
                let plain = name.chars().filter(|c| !c.is_whitespace());
                Ok(Parameter::Name(plain.collect::<String>().to_ascii_lowercase()))
            }
            Node::Parameter(number) => {
                let value = self.value(passage, *number)?;
                let number = value.round();
                if (value - number).abs() > 1e-4 || !(0.0..1e9).contains(&number) {
                    let message = format!("{value} is not a parameter number");
                    let hint = "write a whole number from 1";
                    return Err(fault("bad-parameter", passage.block.span.start, message, hint));
                }
                Ok(Parameter::Number(number as u32))
            }
            _ => Err(fault(
                "bad-parameter",
                passage.block.span.start,
                "expected a parameter",
                "write #1",
            )),
        }
    }

    fn locals(&self) -> &Locals {
        // why: the stack is never empty while a block is executed.
        &self.stack.last().expect("every block belongs to a frame").locals
    }

    /// The value of a parameter; `None` if it never got one.
    pub(super) fn read(&self, parameter: &Parameter) -> Option<f64> {
        match parameter {
            Parameter::Number(number) => self.read_number(*number),
            Parameter::Name(name) => self.read_name(name),
        }
    }

    /// Whether a number belongs to this control at all.
    pub(super) fn is_in_range(&self, number: u32) -> bool {
        number <= self.core.programs[0].dialect().parameters
    }

    fn read_number(&self, number: u32) -> Option<f64> {
        let numbers = &self.locals().numbers;
        let own = if self.is_fanuc() { 33 } else { 30 };
        match number {
            0 => None,
            n if n <= own => numbers[n as usize],
            n => self.system(n).or_else(|| self.globals.get(&n).copied()),
        }
    }

    fn system(&self, number: u32) -> Option<f64> {
        if self.is_fanuc() {
            return self.fanuc_variable(number);
        }
        let frames = &self.frames;
        let of = |position: &Position, first: u32| self.shown(position, (number - first) as usize);
        match number {
            5021..=5029 => of(&self.axis_positions(), 5021),
            5061..=5069 => of(&self.modes.skip, 5061),
            5161..=5169 => of(&frames.references[0], 5161),
            5181..=5189 => of(&frames.references[1], 5181),
            5210 => Some(f64::from(u8::from(frames.shift_on))),
            5211..=5219 => of(&frames.shift, 5211),
            5220 => Some(frames.active as f64 + 1.0),
            5221..=5400 => {
                let (index, axis) = ((number - 5221) / 20, (number - 5221) % 20);
                match axis {
                    9 => frames.offsets.get(index as usize).map(|o| o.rotation_deg),
                    _ if number == 5400 => Some(f64::from(self.core.modes.tool)),
                    _ => self.shown(&frames.offsets.get(index as usize)?.offset, axis as usize),
                }
            }
            5401..=5409 => of(&frames.tool_length(self.core.modes.tool), 5401),
            5420..=5428 => of(&frames.position, 5420),
            _ => None,
        }
    }

    /// An axis value in the units of the program.
    pub(super) fn shown(&self, position: &Position, axis: usize) -> Option<f64> {
        let value = position.0.get(axis)?;
        Some(if Axis::ALL[axis].is_rotary() { *value } else { *value / self.core.modes.unit_mm() })
    }

    fn read_name(&self, name: &str) -> Option<f64> {
        if !name.starts_with('_') {
            return self.locals().named.get(name).copied();
        }
        let axis = |letter: &str, position: &Position| {
            let index = "xyzabcuvw".find(letter).filter(|_| letter.len() == 1)?;
            self.shown(position, index)
        };
        let yes = |flag: bool| Some(f64::from(u8::from(flag)));
        let known = match name {
            "_line" => Some(f64::from(self.core.origin.line)),
            "_value" => Some(self.returned.unwrap_or(0.0)),
            "_value_returned" => yes(self.returned.is_some()),
            "_metric" => yes(!self.core.modes.inches),
            "_imperial" => yes(self.core.modes.inches),
            "_absolute" => yes(!self.core.modes.incremental),
            "_incremental" => yes(self.core.modes.incremental),
            "_current_tool" => Some(f64::from(self.core.modes.tool)),
            "_selected_tool" => Some(f64::from(self.core.modes.selected)),
            "_coord_system" => Some(540.0 + 10.0 * self.frames.active as f64),
            "_feed" => Some(self.core.modes.feed.value / self.core.modes.unit_mm()),
            "_rpm" => Some(self.core.modes.speed),
            "_call_level" => Some(self.stack.len() as f64 - 1.0),
            _ => match name.strip_prefix("_abs_") {
                Some(letter) => axis(letter, &self.axis_positions()),
                None => axis(&name[1..], &self.frames.position),
            },
        };
        known
            .or_else(|| self.core.settings.constants.get(name).copied())
            .or_else(|| self.named.get(name).copied())
    }

    /// Gives a parameter a value.
    pub(super) fn write(
        &mut self,
        parameter: Parameter,
        value: f64,
        offset: usize,
    ) -> Result<(), Fault> {
        match parameter {
            Parameter::Number(number) => {
                let own = if self.is_fanuc() { 33 } else { 30 };
                if number == 0 || !self.is_in_range(number) {
                    return Err(out_of_range(number, offset));
                }
                if own == 33 && number > own && self.write_system(number, value, offset)? {
                    return Ok(());
                }
                if number > own && self.system(number).is_some() {
                    let message = format!(
                        "#{number} belongs to the control: the value is stored, but has no effect"
                    );
                    let hint = "set offsets by G10";
                    self.core.warn("system-parameter", number, offset, message, hint);
                }
                match self.stack.last_mut() {
                    Some(frame) if number <= own => {
                        frame.locals.numbers[number as usize] = Some(value).filter(|v| !v.is_nan());
                    }
                    _ if value.is_nan() => {
                        self.globals.remove(&number);
                    }
                    _ => {
                        self.globals.insert(number, value);
                    }
                }
            }
            Parameter::Name(name) => {
                let fixed = name.starts_with('_') && !self.named.contains_key(&name);
                if name.starts_with("_ini[") || fixed && self.read_name(&name).is_some() {
                    let message = format!("#<{name}> is read-only");
                    let hint = "use another name";
                    return Err(fault("read-only-parameter", offset, message, hint));
                }
                match self.stack.last_mut() {
                    Some(frame) if !name.starts_with('_') => {
                        frame.locals.named.insert(name, value);
                    }
                    _ => {
                        self.named.insert(name, value);
                    }
                }
            }
        }
        Ok(())
    }

    /// The program that is being executed.
    pub(super) fn current(&self) -> Rc<Program> {
        Rc::clone(&self.core.programs[self.core.origin.program as usize])
    }
}
