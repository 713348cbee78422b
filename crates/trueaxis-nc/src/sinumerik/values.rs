//! What variables hold and expressions give.

use crate::execution::mistakes;
use crate::moves::{Axis, Frame};
use crate::text::program::Fault;

use super::fault;

/// A text is never longer.
pub(super) const LONGEST_TEXT: usize = 10_000;

/// A value; truth is 1 or 0, a character its number.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Number(f64),
    Text(String),
    Axis(Axis),
    Frame(Box<Frame>),
}

impl Value {
    pub fn truth(value: bool) -> Self {
        Self::Number(if value { 1.0 } else { 0.0 })
    }

    pub fn frame(frame: Frame) -> Self {
        Self::Frame(Box::new(frame))
    }

    pub fn number(&self, at: usize) -> Result<f64, Fault> {
        match self {
            Self::Number(value) => Ok(*value),
            Self::Text(_) => Err(wrong(at, "expected a number, found a text")),
            Self::Axis(axis) => Err(wrong(at, format!("expected a number, found the axis {axis}"))),
            Self::Frame(_) => Err(wrong(at, "expected a number, found a frame")),
        }
    }

    pub fn text(&self, at: usize) -> Result<String, Fault> {
        match self {
            Self::Text(text) => Ok(text.clone()),
            Self::Number(value) => Ok(shown(*value)),
            Self::Axis(axis) => Ok(axis.to_string()),
            Self::Frame(_) => Err(wrong(at, "expected a text, found a frame")),
        }
    }

    pub fn as_frame(&self, at: usize) -> Result<Frame, Fault> {
        match self {
            Self::Frame(frame) => Ok(**frame),
            _ => Err(wrong(at, "expected a frame such as CTRANS(X,1)")),
        }
    }
}

/// A number as the control writes it into texts.
pub(super) fn shown(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        return format!("{value:.0}");
    }
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn wrong(at: usize, message: impl Into<String>) -> Fault {
    fault("wrong-type", at, message, "check the types of the variables")
}

/// The type of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Int,
    Real,
    Bool,
    Char,
    Text(usize),
    Axis,
    Frame,
}

impl Kind {
    pub fn of(word: &str) -> Option<Self> {
        Some(match word {
            "INT" => Self::Int,
            "REAL" => Self::Real,
            "BOOL" => Self::Bool,
            "CHAR" => Self::Char,
            "STRING" => Self::Text(LONGEST_TEXT),
            "AXIS" => Self::Axis,
            "FRAME" => Self::Frame,
            _ => return None,
        })
    }

    pub fn initial(self) -> Value {
        match self {
            Self::Text(_) => Value::Text(String::new()),
            Self::Axis => Value::Axis(Axis::X),
            Self::Frame => Value::frame(Frame::IDENTITY),
            _ => Value::Number(0.0),
        }
    }

    /// The value as a variable of this type holds it.
    pub fn convert(self, value: Value, at: usize) -> Result<Value, Fault> {
        Ok(match (self, value) {
            (Self::Int, value) => {
                let number = value.number(at)?.round();
                if number.abs() > 2_147_483_648.0 {
                    return Err(mistakes::too_large(number, "INT", at));
                }
                Value::Number(number)
            }
            (Self::Real, value) => Value::Number(value.number(at)?),
            (Self::Bool, value) => Value::truth(value.number(at)? != 0.0),
            (Self::Char, Value::Text(text)) => {
                Value::Number(text.chars().next().map_or(0.0, |c| f64::from(c as u32)))
            }
            (Self::Char, value) => Value::Number(value.number(at)?.round()),
            (Self::Text(longest), value) => {
                let text = value.text(at)?;
                if text.chars().count() > longest {
                    return Err(mistakes::text_too_long(longest, at));
                }
                Value::Text(text)
            }
            (Self::Axis, Value::Axis(axis)) => Value::Axis(axis),
            (Self::Axis, _) => return Err(wrong(at, "expected the name of an axis")),
            (Self::Frame, value) => Value::frame(value.as_frame(at)?),
        })
    }
}

/// A variable, single or an array.
#[derive(Debug, Clone)]
pub(super) struct Variable {
    pub kind: Kind,
    /// The sizes of its dimensions; empty for a single value.
    pub sizes: Vec<usize>,
    pub values: Vec<Value>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_texts() {
        assert_eq!(shown(3.0), "3");
        assert_eq!(shown(-0.25), "-0.25");
    }

    #[test]
    fn integers_are_rounded() {
        assert_eq!(Kind::Int.convert(Value::Number(2.6), 0), Ok(Value::Number(3.0)));
    }
}
