//! R parameters, declared variables, arrays.

use std::collections::HashMap;

use super::reader::Reader;
use super::values::{Kind, LONGEST_TEXT, Value, Variable};
use super::{Run, fault};
use crate::execution::mistakes;
use crate::moves::Axis;
use crate::text::lexer::TokenKind;
use crate::text::program::Fault;

/// R0 to this.
const LAST_R: usize = 32_767;
/// Cells of all variables that live at the same time.
const MOST_CELLS: usize = 1_000_000;

/// Where a value is kept.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Slot {
    R(usize),
    /// A variable of the running program, and which cell of it.
    Cell(String, usize),
}

#[inline]
pub(super) fn axis_of(letter: u8) -> Option<Axis> {
    Axis::ALL.into_iter().find(|a| a.letter() == letter)
}

/// An axis by its name.
pub(super) fn axis_named(name: &str) -> Option<Axis> {
    let [letter] = name.trim().as_bytes() else { return None };
    axis_of(letter.to_ascii_uppercase())
}

impl Run<'_> {
    /// `12` or `[expression]` after an R.
    pub(super) fn r_index(&mut self, reader: &mut Reader<'_>) -> Result<usize, Fault> {
        let at = reader.here();
        let index = if reader.accept(b'[') {
            let index = self.number(reader)?;
            reader.require(b']', "write one ] for each [")?;
            index
        } else {
            reader.number().unwrap_or_else(|| Err(super::expression::missing_value(reader)))?
        };
        if index.fract() != 0.0 || !(0.0..=LAST_R as f64).contains(&index) {
            let name = format_args!("R{index}");
            return Err(mistakes::no_parameter(name, "use R0 to R32767", at));
        }
        Ok(index as usize)
    }

    pub(super) fn r_value(&mut self, index: usize, at: usize) -> f64 {
        if let Some(Some(value)) = self.r.get(index) {
            return *value;
        }
        let message = format!("R{index} is read before it is set: 0 is assumed");
        let hint = "the control would use the value of an earlier program";
        self.core.warn("unset-parameter", format!("R{index}"), at, message, hint);
        0.0
    }

    fn variables(&mut self) -> Option<&mut HashMap<String, Variable>> {
        self.stack.last_mut().map(|top| &mut top.variables)
    }

    pub(super) fn has_variable(&self, name: &str) -> bool {
        self.stack.last().is_some_and(|top| top.variables.contains_key(name))
    }

    /// The argument of ISVAR.
    pub(super) fn is_variable(&mut self, reader: &mut Reader<'_>) -> Result<bool, Fault> {
        reader.require(b'(', "write ISVAR(\"NAME\")")?;
        let name = match reader.quoted() {
            Some(name) => name.to_ascii_uppercase(),
            None => {
                let name = reader.word().unwrap_or_default();
                reader.advance();
                name
            }
        };
        reader.require(b')', "write one ) for each (")?;
        Ok(self.has_variable(name.split('[').next().unwrap_or("")))
    }

    /// The value of a name, with its indices.
    pub(super) fn variable_value(
        &mut self,
        word: &str,
        reader: &mut Reader<'_>,
    ) -> Result<Value, Fault> {
        let at = reader.here();
        if self.has_variable(word) {
            let slot = self.slot(reader)?;
            return self.read(&slot, at);
        }
        if let Some(value) = self.core.settings.constants.get(&word.to_ascii_lowercase()) {
            reader.advance();
            return Ok(Value::Number(*value));
        }
        if reader.symbol_ahead(1) == Some(b'(') {
            let message = format!("unknown function {word}");
            let hint = "known: SIN COS TAN ASIN ACOS ATAN2 SQRT ABS POT TRUNC ROUND LN EXP MINVAL \
                MAXVAL BOUND and functions of texts and frames";
            return Err(fault("function-not-known", at, message, hint));
        }
        Err(undeclared(word, at))
    }

    /// The place that a name with its indices means: `R5`, `R[1]`, `NAME`, `NAME[1,2]`.
    pub(super) fn slot(&mut self, reader: &mut Reader<'_>) -> Result<Slot, Fault> {
        let at = reader.here();
        if reader.letter() == Some(b'R') {
            reader.advance();
            return Ok(Slot::R(self.r_index(reader)?));
        }
        let name = reader.word().unwrap_or_default();
        reader.advance();
        let mut indices = Vec::new();
        if reader.accept(b'[') {
            loop {
                indices.push(self.number(reader)?);
                if !reader.accept(b',') {
                    break;
                }
            }
            reader.require(b']', "write one ] for each [")?;
        }
        let sizes = match self.variables().and_then(|v| v.get(&name)) {
            Some(variable) => variable.sizes.clone(),
            None => Vec::new(),
        };
        let wrong = |message: String| {
            fault("index-out-of-range", at, message, "indices count from 0 to the size less 1")
        };
        if indices.len() > sizes.len() {
            return Err(wrong(format!("{name} is an array with {} dimensions", sizes.len())));
        }
        let mut cell = 0;
        for (place, size) in sizes.iter().enumerate() {
            let index = indices.get(place).copied().unwrap_or(0.0).round();
            if !(0.0..*size as f64).contains(&index) {
                return Err(wrong(format!("{name} has no element {index}")));
            }
            cell = cell * size + index as usize;
        }
        Ok(Slot::Cell(name, cell))
    }

    pub(super) fn read(&mut self, slot: &Slot, at: usize) -> Result<Value, Fault> {
        match slot {
            Slot::R(index) => Ok(Value::Number(self.r_value(*index, at))),
            Slot::Cell(name, cell) => {
                let found = self.variables().and_then(|v| v.get(name));
                let value = found.and_then(|v| v.values.get(*cell)).cloned();
                value.ok_or_else(|| undeclared(name, at))
            }
        }
    }

    pub(super) fn write(&mut self, slot: &Slot, value: Value, at: usize) -> Result<(), Fault> {
        match slot {
            Slot::R(index) => {
                let number = value.number(at)?;
                if self.r.len() <= *index {
                    self.r.resize(index + 1, None);
                }
                self.r[*index] = Some(number);
            }
            Slot::Cell(name, cell) => {
                let Some(variable) = self.variables().and_then(|v| v.get_mut(name)) else {
                    return Err(undeclared(name, at));
                };
                let converted = variable.kind.convert(value, at)?;
                if let Some(place) = variable.values.get_mut(*cell) {
                    *place = converted;
                }
            }
        }
        Ok(())
    }

    /// `slot = expression`, `slot = SET(…)`, `slot = REP(…)`; the sign `=` comes next.
    pub(super) fn assignment(&mut self, slot: &Slot, reader: &mut Reader<'_>) -> Result<(), Fault> {
        reader.require(b'=', "write R1=2")?;
        let at = reader.here();
        let list = match reader.word().as_deref() {
            Some("SET") if reader.symbol_ahead(1) == Some(b'(') => true,
            Some("REP") if reader.symbol_ahead(1) == Some(b'(') => false,
            _ if reader.symbol() == Some(b'(') && self.is_list(slot, reader) => {
                return self.fill(slot, reader, true, at);
            }
            _ => {
                let value = self.expression(reader)?;
                return self.write(slot, value, at);
            }
        };
        reader.advance();
        self.fill(slot, reader, list, at)
    }

    /// Whether the bracket holds a list for an array: `(1,2,3)`.
    fn is_list(&mut self, slot: &Slot, reader: &Reader<'_>) -> bool {
        let Slot::Cell(name, _) = slot else { return false };
        let array = self.variables().and_then(|v| v.get(name)).is_some_and(|v| !v.sizes.is_empty());
        let (mut depth, mut at) = (0, 0);
        while let Some(token) = reader.ahead(at) {
            match (token.kind, reader.source[token.start]) {
                (TokenKind::Symbol, b'(') => depth += 1,
                (TokenKind::Symbol, b')') => depth -= 1,
                (TokenKind::Symbol, b',') if depth == 1 => return array,
                _ => {}
            }
            if depth == 0 {
                break;
            }
            at += 1;
        }
        false
    }

    /// Sets the cells of an array from one on: by a list, or all by one value.
    fn fill(
        &mut self,
        slot: &Slot,
        reader: &mut Reader<'_>,
        list: bool,
        at: usize,
    ) -> Result<(), Fault> {
        let values = self.arguments(reader)?;
        let Slot::Cell(name, first) = slot else {
            let message = "SET and REP fill arrays only";
            return Err(fault("wrong-type", at, message, "set R parameters one by one"));
        };
        let count = self.variables().and_then(|v| v.get(name)).map_or(0, |v| v.values.len());
        let left = count.saturating_sub(*first);
        if list && values.len() > left {
            let message = format!("{name} is too small for {} values", values.len());
            return Err(fault("index-out-of-range", at, message, "declare a larger array"));
        }
        if !list {
            let value = values.first().cloned().flatten().unwrap_or(Value::Number(0.0));
            let most = match values.get(1) {
                Some(Some(count)) => count.number(at)?.max(0.0) as usize,
                _ => left,
            };
            for cell in 0..most.min(left) {
                self.write(&Slot::Cell(name.clone(), first + cell), value.clone(), at)?;
            }
            return Ok(());
        }
        for (cell, value) in values.into_iter().enumerate() {
            if let Some(value) = value {
                self.write(&Slot::Cell(name.clone(), first + cell), value, at)?;
            }
        }
        Ok(())
    }

    /// `DEF type name[size] = value, …`; the type comes next.
    pub(super) fn define(&mut self, reader: &mut Reader<'_>) -> Result<(), Fault> {
        while let Some("NCK" | "CHAN" | "SYNR" | "SYNW" | "SYNRW") = reader.word().as_deref() {
            reader.advance();
        }
        let kind = self.kind(reader)?;
        loop {
            let at = reader.here();
            let Some(name) = reader.word() else {
                let message = "expected the name of a variable";
                let hint = "write a name that begins with two letters or _";
                return Err(fault("bad-definition", at, message, hint));
            };
            reader.advance();
            let sizes = self.sizes(reader)?;
            self.declare(&name, kind, sizes, at)?;
            if reader.equals_ahead(0) {
                self.assignment(&Slot::Cell(name, 0), reader)?;
            }
            if !reader.accept(b',') {
                break;
            }
        }
        if reader.is_empty() {
            return Ok(());
        }
        let message = "expected a comma or the end of the block";
        Err(fault("bad-definition", reader.here(), message, "write DEF REAL A, B=2"))
    }

    pub(super) fn kind(&mut self, reader: &mut Reader<'_>) -> Result<Kind, Fault> {
        let kind = reader.word().as_deref().and_then(Kind::of);
        let Some(kind) = kind else {
            let hint = "INT REAL BOOL CHAR STRING[n] AXIS FRAME";
            return Err(fault("bad-definition", reader.here(), "expected a type", hint));
        };
        reader.advance();
        if let Kind::Text(_) = kind
            && reader.accept(b'[')
        {
            let longest = self.number(reader)?.clamp(0.0, LONGEST_TEXT as f64);
            reader.require(b']', "write one ] for each [")?;
            return Ok(Kind::Text(longest as usize));
        }
        Ok(kind)
    }

    /// `[3]`, `[3,2]` or nothing; `[]` has no size.
    pub(super) fn sizes(&mut self, reader: &mut Reader<'_>) -> Result<Vec<usize>, Fault> {
        let mut sizes = Vec::new();
        let at = reader.here();
        if !reader.accept(b'[') {
            return Ok(sizes);
        }
        while !reader.accept(b']') {
            if reader.accept(b',') {
                continue;
            }
            let size = self.number(reader)?.round();
            if !(1.0..=MOST_CELLS as f64).contains(&size) || sizes.len() >= 3 {
                let message = format!("an array of {size} elements is not possible");
                return Err(fault("bad-definition", at, message, "use at most three dimensions"));
            }
            sizes.push(size as usize);
            if !matches!(reader.symbol(), Some(b',' | b']')) {
                return Err(mistakes::unclosed_bracket(at));
            }
        }
        Ok(sizes)
    }

    pub(super) fn declare(
        &mut self,
        name: &str,
        kind: Kind,
        sizes: Vec<usize>,
        at: usize,
    ) -> Result<(), Fault> {
        let count = sizes.iter().fold(1_usize, |a, b| a.saturating_mul(*b));
        if self.cells.saturating_add(count) > MOST_CELLS {
            let message = format!("more than {MOST_CELLS} values are declared");
            let fault = fault("too-many-variables", at, message, "declare smaller arrays");
            return Err(self.core.for_good(fault));
        }
        self.cells += count;
        let freed = self.variables().and_then(|variables| {
            let values = vec![kind.initial(); count];
            variables.insert(name.to_owned(), Variable { kind, sizes, values })
        });
        self.cells -= freed.map_or(0, |old| old.values.len());
        Ok(())
    }

    /// The variables of a subprogram are gone.
    pub(super) fn forget(&mut self, variables: &HashMap<String, Variable>) {
        let count: usize = variables.values().map(|v| v.values.len()).sum();
        self.cells = self.cells.saturating_sub(count);
    }

    /// The name of an axis, as a letter or as a variable; `None` for an axis not known here.
    pub(super) fn axis_or_other(&mut self, reader: &mut Reader<'_>) -> Result<Option<Axis>, Fault> {
        let at = reader.here();
        if let Some((name, length)) = reader.name()
            && !self.has_variable(&name)
        {
            reader.at += length;
            return Ok(axis_named(&name));
        }
        match self.expression(reader)? {
            Value::Axis(axis) => Ok(Some(axis)),
            Value::Text(name) => Ok(axis_named(&name)),
            _ => Err(mistakes::unknown_axis(at)),
        }
    }

    pub(super) fn axis(&mut self, reader: &mut Reader<'_>) -> Result<Axis, Fault> {
        let at = reader.here();
        self.axis_or_other(reader)?.ok_or_else(|| mistakes::unknown_axis(at))
    }
}

fn undeclared(name: &str, at: usize) -> Fault {
    let message = format!("the variable {name} is not declared");
    let hint = "declare it with DEF, or state it as a constant of the machine";
    fault("undefined-parameter", at, message, hint)
}
