//! Numbers, formulas and texts.

use super::line::Cursor;
use super::variables::{StoredValue, Variable};
use super::{Run, fault};
use crate::execution::mistakes;
use crate::execution::values::{self, finite, not_zero};
use crate::text::program::Fault;

/// Largest depth of nested brackets and functions: ample for programs, small for the stack.
const DEEPEST: usize = 60;

/// Functions of one value.
const FUNCTIONS: [&str; 16] = [
    "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SQRT", "SQ", "ABS", "INT", "FRAC", "NEG", "LN",
    "LOG", "EXP", "SGN",
];

impl Run<'_> {
    /// A number or parameter with signs, as words have it: `+1.5`, `-Q1`.
    pub(super) fn operand(&mut self, c: &mut Cursor<'_>) -> Result<Option<f64>, Fault> {
        let at = c.offset();
        let (mut negative, mut signed) = (false, false);
        while let Some(sign @ (b'+' | b'-')) = c.symbol() {
            negative ^= sign == b'-';
            signed = true;
            c.accept_symbol(sign);
        }
        let value = match c.number()? {
            Some(number) => Some(number),
            None => match self.variable(c)? {
                Some(variable) => {
                    let read = self.read(variable, at)?;
                    let value = if negative { -read } else { read };
                    self.core.report_computed(at..c.taken_to(), Some(value));
                    Some(read)
                }
                None => None,
            },
        };
        match value {
            Some(value) => Ok(Some(if negative { -value } else { value })),
            None if signed || c.is("NAN") => Err(missing(c)),
            None => Ok(None),
        }
    }

    /// A number or parameter that must stand here.
    pub(super) fn value(&mut self, c: &mut Cursor<'_>) -> Result<f64, Fault> {
        self.operand(c)?.ok_or_else(|| missing(c))
    }

    /// `Q1 = …`: a formula, or a text for QS.
    pub(super) fn assign(&mut self, target: Variable, c: &mut Cursor<'_>) -> Result<(), Fault> {
        let at = c.offset();
        if !c.accept_symbol(b'=') {
            return Err(mistakes::missing_equals("a parameter", "write Q1 = 5", at));
        }
        if let Variable::Text(number) = target {
            let text = self.text(c)?;
            return self.variables.store_text(number, text, at);
        }
        if c.accept("SET") {
            if !c.accept("UNDEFINED") {
                return Err(c.unknown());
            }
            self.undefine(target);
            return Ok(());
        }
        let value = self.formula(c)?;
        self.variables.store(target, StoredValue::Number(value));
        Ok(())
    }

    /// A formula up to the end of what belongs to it.
    pub(super) fn formula(&mut self, c: &mut Cursor<'_>) -> Result<f64, Fault> {
        let at = c.offset();
        let value = self.sum(c)?;
        finite(value, at)
    }

    fn sum(&mut self, c: &mut Cursor<'_>) -> Result<f64, Fault> {
        c.depth += 1;
        if c.depth > DEEPEST {
            return Err(mistakes::too_deep(c.offset()));
        }
        let mut left = self.product(c)?;
        loop {
            if c.accept_symbol(b'+') {
                left += self.product(c)?;
            } else if c.accept_symbol(b'-') {
                left -= self.product(c)?;
            } else {
                c.depth -= 1;
                return Ok(left);
            }
        }
    }

    fn product(&mut self, c: &mut Cursor<'_>) -> Result<f64, Fault> {
        let mut left = self.power(c)?;
        loop {
            let at = c.offset();
            if c.accept_symbol(b'*') {
                left *= self.power(c)?;
            } else if c.accept_symbol(b'/') {
                left /= not_zero(self.power(c)?, at)?;
            } else if c.accept_symbol(b'%') {
                left %= not_zero(self.power(c)?, at)?;
            } else {
                return Ok(left);
            }
        }
    }

    fn power(&mut self, c: &mut Cursor<'_>) -> Result<f64, Fault> {
        let mut negative = false;
        while let Some(sign @ (b'+' | b'-')) = c.symbol() {
            negative ^= sign == b'-';
            c.accept_symbol(sign);
        }
        let mut value = self.primary(c)?;
        let at = c.offset();
        while c.accept_symbol(b'^') {
            let sign = if c.accept_symbol(b'-') { -1.0 } else { 1.0 };
            let exponent = sign * self.primary(c)?;
            value = value.powf(exponent);
            if value.is_nan() {
                let message = "the power is not a real number";
                return Err(fault("out-of-domain", at, message, "check the base and the exponent"));
            }
        }
        Ok(if negative { -value } else { value })
    }

    fn primary(&mut self, c: &mut Cursor<'_>) -> Result<f64, Fault> {
        let at = c.offset();
        if let Some(number) = c.number()? {
            return Ok(number);
        }
        if c.accept_symbol(b'(') {
            let value = self.sum(c)?;
            c.close(at)?;
            return Ok(value);
        }
        if let Some(variable) = self.variable(c)? {
            return self.read(variable, at);
        }
        if c.accept("PI") {
            return Ok(std::f64::consts::PI);
        }
        if let Some(index) = c.accept_any(&FUNCTIONS) {
            c.depth += 1;
            if c.depth > DEEPEST {
                return Err(mistakes::too_deep(at));
            }
            let negative = c.accept_symbol(b'-');
            let _ = !negative && c.accept_symbol(b'+');
            let x = self.primary(c)?;
            c.depth -= 1;
            return function(index, if negative { -x } else { x }, at);
        }
        if let Some(index) = c.accept_any(&["TONUMB", "STRLEN", "INSTR", "STRCOMP"]) {
            return self.number_of_text(index, c);
        }
        Err(missing(c))
    }

    /// `TONUMB(SRC_QS1)`, `STRLEN(SRC_QS1)` …
    fn number_of_text(&mut self, index: usize, c: &mut Cursor<'_>) -> Result<f64, Fault> {
        let at = c.offset();
        let open = c.accept_symbol(b'(');
        let first = self.source_text(c)?;
        let value = match index {
            0 => first.trim().replace(',', ".").parse().ok().filter(|v: &f64| v.is_finite()),
            1 => Some(first.chars().count() as f64),
            _ => {
                let wanted = if c.accept("SEA_QS") || c.accept("SEA_") || c.is("QS") {
                    self.text_by_number(c)?
                } else {
                    self.text_piece(c)?
                };
                let found = first.find(&wanted).map_or(first.len(), |i| i);
                Some(if index == 2 { found as f64 } else { f64::from(first.cmp(&wanted) as i8) })
            }
        };
        if !open || !c.accept_symbol(b')') {
            return Err(mistakes::unclosed_bracket(at));
        }
        value.ok_or_else(|| {
            let message = format!("the text `{first}` is not a number");
            fault("out-of-domain", at, message, "check the text")
        })
    }

    /// `SRC_QS1` or `QS1`.
    fn source_text(&mut self, c: &mut Cursor<'_>) -> Result<String, Fault> {
        if c.accept("SRC_QS") {
            return self.text_by_number(c);
        }
        self.text_piece(c)
    }

    fn text_by_number(&mut self, c: &mut Cursor<'_>) -> Result<String, Fault> {
        let at = c.offset();
        c.accept("QS");
        match c.whole()? {
            Some(number) => self.read_text(number, at),
            None => Err(missing(c)),
        }
    }

    /// `"a" || QS1 || TOCHAR(DAT+Q1 DECIMALS3)`.
    pub(super) fn text(&mut self, c: &mut Cursor<'_>) -> Result<String, Fault> {
        let mut text = self.text_piece(c)?;
        while c.accept_symbol(b'|') {
            c.accept_symbol(b'|');
            text.push_str(&self.text_piece(c)?);
        }
        Ok(text)
    }

    fn text_piece(&mut self, c: &mut Cursor<'_>) -> Result<String, Fault> {
        if let Some(text) = c.text() {
            return Ok(text);
        }
        let at = c.offset();
        if c.accept("QS") {
            return self.text_by_number(c);
        }
        if let Some(kind) = c.accept_any(&["TOCHAR", "SUBSTR"]) {
            c.accept_symbol(b'(');
            let text = if kind == 0 { self.number_as_text(c)? } else { self.part_of_text(c)? };
            c.close(at)?;
            return Ok(text);
        }
        if c.accept_any(&["SYSSTR", "CFGREAD", "FGREAD"]).is_some() {
            let message = "the value of this text is known only to the machine";
            return Err(fault("unknown-value", at, message, "write the text into the program"));
        }
        let message = "a text is missing".to_owned();
        Err(fault("missing-value", at, message, "write \"text\", QS1 or TOCHAR(DAT+Q1)"))
    }

    fn number_as_text(&mut self, c: &mut Cursor<'_>) -> Result<String, Fault> {
        c.accept("DAT");
        let value = self.value(c)?;
        let decimals = if c.accept("DECIMALS") { c.whole()?.unwrap_or(0) } else { 0 };
        Ok(format!("{value:.*}", decimals.min(16) as usize))
    }

    fn part_of_text(&mut self, c: &mut Cursor<'_>) -> Result<String, Fault> {
        let text = self.source_text(c)?;
        let (mut begin, mut length) = (0.0, f64::MAX);
        while let Some(index) = c.accept_any(&["BEG", "LEN"]) {
            let value = self.value(c)?.max(0.0);
            if index == 0 { begin = value } else { length = value }
        }
        Ok(text.chars().skip(begin as usize).take(length as usize).collect())
    }
}

fn function(index: usize, x: f64, at: usize) -> Result<f64, Fault> {
    let name = FUNCTIONS[index];
    let value = match name {
        "ATAN" => x.atan().to_degrees(),
        "SQ" => x * x,
        "INT" => x.trunc(),
        "FRAC" => x.fract(),
        "NEG" => -x,
        "LOG" if x > 0.0 => x.log10(),
        "SGN" if x == 0.0 => 0.0,
        "SGN" => x.signum(),
        _ => values::function(name, x, at)?.unwrap_or(f64::NAN),
    };
    if value.is_finite() { Ok(value) } else { Err(values::out_of_domain(name, x, at)) }
}

pub(super) fn missing(c: &Cursor<'_>) -> Fault {
    let message = format!("a number is missing before `{}`", c.shown());
    let hint = "write a number, a parameter such as Q1, a bracket or a function";
    if c.symbol() == Some(b')') {
        return fault("unbalanced-brackets", c.offset(), message, hint);
    }
    if c.is("NAN") {
        return fault(
            "not-a-number",
            c.offset(),
            "`nan` is not a number",
            "check the post-processor",
        );
    }
    fault("missing-value", c.offset(), message, hint)
}
