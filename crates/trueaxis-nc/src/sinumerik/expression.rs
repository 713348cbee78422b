//! Values of expressions, as they are read.

use super::reader::Reader;
use super::values::{LONGEST_TEXT, Value};
use super::{Run, fault};
use crate::execution::mistakes;
use crate::execution::values::{finite, not_zero};
use crate::text::lexer::TokenKind;
use crate::text::program::Fault;

/// Largest depth of nested brackets, functions and signs: ample for programs, small for the stack.
const DEEPEST: usize = 60;

/// Operators of two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Operator {
    Times,
    Divide,
    WholeDivide,
    Modulo,
    Chain,
    Plus,
    Minus,
    BitAnd,
    BitXor,
    BitOr,
    And,
    Xor,
    Or,
    Join,
    Equal,
    NotEqual,
    Greater,
    GreaterEqual,
    Less,
    LessEqual,
}

impl Operator {
    /// How strongly it binds.
    ///
    /// # Source
    /// Programming Manual "Job Planning", priority of the operations: comparisons bind least.
    fn strength(self) -> u8 {
        match self {
            Self::Times | Self::Divide | Self::WholeDivide | Self::Modulo | Self::Chain => 10,
            Self::Plus | Self::Minus => 9,
            Self::BitAnd => 8,
            Self::BitXor => 7,
            Self::BitOr => 6,
            Self::And => 5,
            Self::Xor => 4,
            Self::Or => 3,
            Self::Join => 2,
            _ => 1,
        }
    }
}

/// The operator that begins here, and how many tokens it takes.
fn operator(reader: &Reader<'_>) -> Option<(Operator, usize)> {
    if let Some(word) = reader.word() {
        let found = match word.as_str() {
            "DIV" => Operator::WholeDivide,
            "MOD" => Operator::Modulo,
            "B_AND" => Operator::BitAnd,
            "B_XOR" => Operator::BitXor,
            "B_OR" => Operator::BitOr,
            "AND" => Operator::And,
            "XOR" => Operator::Xor,
            "OR" => Operator::Or,
            _ => return None,
        };
        return Some((found, 1));
    }
    let double = match reader.pair(0) {
        Some([b'=', b'=']) => Some(Operator::Equal),
        Some([b'<', b'>']) => Some(Operator::NotEqual),
        Some([b'<', b'=']) => Some(Operator::LessEqual),
        Some([b'>', b'=']) => Some(Operator::GreaterEqual),
        Some([b'<', b'<']) => Some(Operator::Join),
        _ => None,
    };
    if let Some(found) = double {
        return Some((found, 2));
    }
    let found = match reader.symbol()? {
        b'*' => Operator::Times,
        b'/' => Operator::Divide,
        b':' => Operator::Chain,
        b'+' => Operator::Plus,
        b'-' => Operator::Minus,
        b'<' => Operator::Less,
        b'>' => Operator::Greater,
        _ => return None,
    };
    Some((found, 1))
}

impl Run<'_> {
    /// An expression and its number.
    pub(super) fn number(&mut self, reader: &mut Reader<'_>) -> Result<f64, Fault> {
        let at = reader.here();
        self.expression(reader)?.number(at)
    }

    pub(super) fn text(&mut self, reader: &mut Reader<'_>) -> Result<String, Fault> {
        let at = reader.here();
        self.expression(reader)?.text(at)
    }

    pub(super) fn expression(&mut self, reader: &mut Reader<'_>) -> Result<Value, Fault> {
        self.operations(reader, 0)
    }

    /// Values with operators between them that bind stronger than `least`.
    fn operations(&mut self, reader: &mut Reader<'_>, least: u8) -> Result<Value, Fault> {
        let start = reader.here();
        let mut left = self.signed(reader)?;
        while let Some((operator, length)) = operator(reader) {
            if operator.strength() <= least {
                break;
            }
            let at = reader.here();
            reader.at += length;
            // The depth is bounded: there are ten strengths.
            let right = self.operations(reader, operator.strength())?;
            left = combine(operator, &left, &right, [start, at])?;
        }
        Ok(left)
    }

    fn signed(&mut self, reader: &mut Reader<'_>) -> Result<Value, Fault> {
        let at = reader.here();
        if self.depth >= DEEPEST {
            return Err(mistakes::too_deep(at));
        }
        self.depth += 1;
        let value = if reader.accept(b'-') {
            self.signed(reader).and_then(|v| Ok(Value::Number(-v.number(at)?)))
        } else if reader.accept(b'+') {
            self.signed(reader)
        } else if reader.accept_word("NOT") {
            self.signed(reader).and_then(|v| Ok(Value::truth(v.number(at)? == 0.0)))
        } else if reader.accept_word("B_NOT") {
            self.signed(reader).and_then(|v| Ok(Value::Number(!bits(v.number(at)?, at)? as f64)))
        } else {
            self.primary(reader)
        };
        self.depth -= 1;
        value
    }

    fn primary(&mut self, reader: &mut Reader<'_>) -> Result<Value, Fault> {
        let Some(token) = reader.peek() else { return Err(missing_value(reader)) };
        match token.kind {
            TokenKind::Number => {
                let number = reader.number().unwrap_or_else(|| Err(missing_value(reader)))?;
                Ok(Value::Number(number))
            }
            TokenKind::Text => {
                reader.quoted().map(Value::Text).ok_or_else(|| missing_value(reader))
            }
            TokenKind::Symbol => match reader.source[token.start] {
                b'(' => {
                    reader.advance();
                    let value = self.expression(reader)?;
                    reader.close(token.start)?;
                    Ok(value)
                }
                b'$' => self.system_value(reader),
                b'\'' => quoted_number(reader),
                _ => Err(missing_value(reader)),
            },
            TokenKind::Letter | TokenKind::Word => self.named_value(reader),
            _ => Err(missing_value(reader)),
        }
    }

    fn named_value(&mut self, reader: &mut Reader<'_>) -> Result<Value, Fault> {
        let at = reader.here();
        if reader.letter() == Some(b'R')
            && (reader.number_ahead(1).is_some() || reader.symbol_ahead(1) == Some(b'['))
        {
            reader.advance();
            let index = self.r_index(reader)?;
            return Ok(Value::Number(self.r_value(index, at)));
        }
        if let Some(axis) = reader.letter().and_then(super::variables::axis_of) {
            reader.advance();
            return Ok(Value::Axis(axis));
        }
        let Some(word) = reader.word() else { return Err(missing_value(reader)) };
        match word.as_str() {
            "TRUE" => {
                reader.advance();
                return Ok(Value::Number(1.0));
            }
            "FALSE" => {
                reader.advance();
                return Ok(Value::Number(0.0));
            }
            _ => {}
        }
        if let Some(value) = technology(&word).filter(|_| !self.has_variable(&word)) {
            reader.advance();
            return Ok(Value::Number(value));
        }
        if reader.symbol_ahead(1) == Some(b'(') && super::functions::is_function(&word) {
            reader.advance();
            return self.function(&word, reader, at);
        }
        self.variable_value(&word, reader)
    }

    /// `( … )` with values between commas; an omitted value is `None`.
    pub(super) fn arguments(
        &mut self,
        reader: &mut Reader<'_>,
    ) -> Result<Vec<Option<Value>>, Fault> {
        let open = reader.here();
        let mut found = Vec::new();
        if !reader.accept(b'(') {
            return Ok(found);
        }
        if reader.accept(b')') {
            return Ok(found);
        }
        loop {
            match reader.symbol() {
                Some(b',' | b')') => found.push(None),
                _ => found.push(Some(self.expression(reader)?)),
            }
            if reader.accept(b')') {
                return Ok(found);
            }
            if !reader.accept(b',') {
                return Err(mistakes::unclosed_bracket(open));
            }
        }
    }
}

/// The named values of the second parameter of CYCLE832.
///
/// # Source
/// SINUMERIK Programming Manual, "Programming cycles externally", CYCLE832: units 0 to 4, tens 1 with a
/// tolerance of the orientation; the names are those of the operating manuals.
fn technology(word: &str) -> Option<f64> {
    Some(match word {
        "_OFF" => 0.0,
        "_FINISH" => 1.0,
        "_SEMIFIN" => 2.0,
        "_ROUGH" => 3.0,
        "_PRECISION" => 4.0,
        "_ORI_FINISH" => 11.0,
        "_ORI_SEMIFIN" => 12.0,
        "_ORI_ROUGH" => 13.0,
        "_ORI_PRECISION" => 14.0,
        "_TOP_SURFACE_SMOOTH_OFF" => 1e6,
        "_TOP_SURFACE_SMOOTH_ON" => 2e6,
        _ => return None,
    })
}

pub(super) fn missing_value(reader: &Reader<'_>) -> Fault {
    let hint = "write a number, R1, a variable, a function such as SIN( ), or ( )";
    fault("missing-value", reader.here(), "a value is missing here", hint)
}

/// `'H1F'` and `'B101'`.
fn quoted_number(reader: &mut Reader<'_>) -> Result<Value, Fault> {
    let at = reader.here();
    let rest = &reader.source[at + 1..];
    let end = rest.iter().take(70).position(|b| *b == b'\'');
    let text = end.and_then(|end| std::str::from_utf8(&rest[..end]).ok()).unwrap_or("");
    let base = match text.as_bytes().first() {
        Some(b'H' | b'h') => 16,
        Some(b'B' | b'b') => 2,
        _ => 10,
    };
    let digits = if base == 10 { text } else { &text[1..] };
    let Some(value) = i64::from_str_radix(digits, base).ok() else {
        let hint = "write 'HFF' or 'B1010'";
        return Err(fault("bad-number", at, "expected a number", hint));
    };
    let close = at + 1 + text.len();
    while reader.peek().is_some_and(|t| t.start <= close) {
        reader.advance();
    }
    Ok(Value::Number(value as f64))
}

fn bits(value: f64, at: usize) -> Result<i64, Fault> {
    if value.fract() == 0.0 && value.abs() < 9e15 {
        return Ok(value as i64);
    }
    Err(fault(
        "wrong-type",
        at,
        format!("{value} is not a whole number, as bit operations need"),
        "write a whole number",
    ))
}

/// The value of `left operator right`; `at` is where the left one begins and the operator stands.
fn combine(
    operator: Operator,
    left: &Value,
    right: &Value,
    at: [usize; 2],
) -> Result<Value, Fault> {
    use Operator as O;
    let [start, at] = at;
    match operator {
        O::Chain => {
            if let (Value::Frame(a), Value::Frame(b)) = (left, right) {
                return Ok(Value::frame(a.after(b)));
            }
            let (x, y) = (left.number(start)?, right.number(at)?);
            return finite(x / not_zero(y, at)?, at).map(Value::Number);
        }
        O::Join => {
            let text = left.text(start)? + &right.text(at)?;
            if text.len() > LONGEST_TEXT {
                return Err(mistakes::text_too_long(LONGEST_TEXT, at));
            }
            return Ok(Value::Text(text));
        }
        O::Equal | O::NotEqual => {
            let equal = match (left, right) {
                (Value::Text(_), _) | (_, Value::Text(_)) => left.text(start)? == right.text(at)?,
                (Value::Axis(a), Value::Axis(b)) => a == b,
                (Value::Frame(a), Value::Frame(b)) => a == b,
                _ => left.number(start)? == right.number(at)?,
            };
            return Ok(Value::truth(equal == (operator == O::Equal)));
        }
        O::Greater | O::GreaterEqual | O::Less | O::LessEqual => {
            return compare(operator, left, right, [start, at]);
        }
        _ => {}
    }
    let (x, y) = (left.number(start)?, right.number(at)?);
    let value = match operator {
        O::Times => x * y,
        O::Divide => x / not_zero(y, at)?,
        O::WholeDivide => finite(x / not_zero(y, at)?, at)?.trunc(),
        O::Modulo => x % not_zero(y, at)?,
        O::Plus => x + y,
        O::Minus => x - y,
        O::BitAnd => (bits(x, start)? & bits(y, at)?) as f64,
        O::BitXor => (bits(x, start)? ^ bits(y, at)?) as f64,
        O::BitOr => (bits(x, start)? | bits(y, at)?) as f64,
        O::And => return Ok(Value::truth(x != 0.0 && y != 0.0)),
        O::Xor => return Ok(Value::truth((x != 0.0) != (y != 0.0))),
        _ => return Ok(Value::truth(x != 0.0 || y != 0.0)),
    };
    finite(value, at).map(Value::Number)
}

fn compare(
    operator: Operator,
    left: &Value,
    right: &Value,
    at: [usize; 2],
) -> Result<Value, Fault> {
    let order = match (left, right) {
        (Value::Text(a), Value::Text(b)) => a.cmp(b),
        _ => {
            let (x, y) = (left.number(at[0])?, right.number(at[1])?);
            x.total_cmp(&(y + 0.0))
        }
    };
    Ok(Value::truth(match operator {
        Operator::Greater => order.is_gt(),
        Operator::GreaterEqual => order.is_ge(),
        Operator::Less => order.is_lt(),
        _ => order.is_le(),
    }))
}
