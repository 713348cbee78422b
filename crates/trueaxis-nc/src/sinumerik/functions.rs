//! The functions of expressions; angles are degrees.

use super::reader::Reader;
use super::transform;
use super::values::{LONGEST_TEXT, Value, shown};
use super::{Run, fault};
use crate::execution::mistakes;
use crate::execution::values::{self, finite};
use crate::moves::{Axis, Frame};
use crate::text::program::Fault;

const FUNCTIONS: [&str; 43] = [
    "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN2", "SQRT", "ABS", "POT", "TRUNC", "ROUND",
    "ROUNDUP", "LN", "EXP", "MINVAL", "MAXVAL", "BOUND", "STRLEN", "TOUPPER", "TOLOWER", "INDEX",
    "RINDEX", "MINDEX", "SUBSTR", "NUMBER", "ISNUMBER", "ISVAR", "AXNAME", "AXSTRING", "CTRANS",
    "CFINE", "CROT", "CRPL", "CROTS", "CSCALE", "CMIRROR", "INVFRAME", "INT", "REAL", "ISFILE",
    "CALCDAT", "MATCH", "GETMDACT",
];

pub(super) fn is_function(word: &str) -> bool {
    FUNCTIONS.contains(&word)
}

/// The arguments of a function, asked for one by one.
struct Arguments<'a> {
    values: &'a [Option<Value>],
    at: usize,
}

impl Arguments<'_> {
    fn value(&self, index: usize) -> Result<&Value, Fault> {
        self.values.get(index).and_then(Option::as_ref).ok_or_else(|| {
            let message = format!("argument {} of the function is missing", index + 1);
            fault("missing-argument", self.at, message, "write all arguments between commas")
        })
    }

    fn number(&self, index: usize) -> Result<f64, Fault> {
        self.value(index)?.number(self.at)
    }

    fn text(&self, index: usize) -> Result<String, Fault> {
        self.value(index)?.text(self.at)
    }
}

impl Run<'_> {
    /// A function whose bracket comes next.
    pub(super) fn function(
        &mut self,
        word: &str,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<Value, Fault> {
        if word == "ISVAR" {
            let found = self.is_variable(reader);
            return Ok(Value::truth(found?));
        }
        if let "CTRANS" | "CFINE" | "CROT" | "CROTS" | "CSCALE" | "CMIRROR" | "CRPL" = word {
            return self.frame_function(word, reader, at).map(Value::frame);
        }
        let values = self.arguments(reader)?;
        let arguments = Arguments { values: &values, at };
        if let Some(number) = number_function(word, &arguments)? {
            return finite(number, at).map(Value::Number);
        }
        match word {
            "INVFRAME" => {
                let frame = arguments.value(0)?.as_frame(at)?;
                let flat = || mistakes::flat_frame(at);
                transform::inverse(&frame).map(Value::frame).ok_or_else(flat)
            }
            "AXNAME" => {
                let name = arguments.text(0)?;
                super::variables::axis_named(&name)
                    .map(Value::Axis)
                    .ok_or_else(|| mistakes::unknown_axis(at))
            }
            "AXSTRING" => Ok(Value::Text(arguments.text(0)?)),
            "ISFILE" => Ok(Value::truth(self.core.library.text(&arguments.text(0)?).is_ok())),
            _ => text_function(word, &arguments)?.ok_or_else(|| {
                let message = format!("{word} is not evaluated");
                fault("function-not-known", at, message, "replace it by its value")
            }),
        }
    }

    /// CTRANS(X,1,Y,2) and its like.
    fn frame_function(
        &mut self,
        word: &str,
        reader: &mut Reader<'_>,
        at: usize,
    ) -> Result<Frame, Fault> {
        let mut entries: Vec<(Axis, f64)> = Vec::new();
        if word == "CRPL" {
            let values = self.arguments(reader)?;
            let arguments = Arguments { values: &values, at };
            // 0 is the active plane, 1 to 3 are G17 to G19.
            let axis = match arguments.number(0)? as i64 {
                1 => Axis::Z,
                2 => Axis::Y,
                3 => Axis::X,
                _ => self.core.modes.plane.axes()[2],
            };
            return Ok(transform::turned(axis, arguments.number(1)?));
        }
        reader.require(b'(', "write CTRANS(X,1)")?;
        while !reader.accept(b')') {
            let place = reader.here();
            let axis = self.axis_or_other(reader)?;
            let with_value = reader.accept(b',');
            let mut value = None;
            if with_value && (word != "CMIRROR" || reader.number_ahead(0).is_some()) {
                value = Some(self.number(reader)?);
                reader.accept(b',');
            }
            let neutral = if word == "CSCALE" { 1.0 } else { 0.0 };
            match axis {
                Some(axis) => entries.push((axis, value.unwrap_or(neutral))),
                None if value.unwrap_or(neutral) == neutral => {}
                None => {
                    let hint = "use the axes X Y Z A B C U V W";
                    self.core.not_applied("the frame of an unknown axis", place, hint);
                }
            }
            if reader.is_empty() {
                return Err(mistakes::unclosed_bracket(at));
            }
        }
        transform::from_entries(word.trim_start_matches('C'), &entries, at)
    }
}

/// Functions of numbers; `None` for others.
fn number_function(word: &str, arguments: &Arguments<'_>) -> Result<Option<f64>, Fault> {
    let at = arguments.at;
    let x = || arguments.number(0);
    if let "SIN" | "COS" | "TAN" | "ASIN" | "ACOS" | "SQRT" | "ABS" | "LN" | "EXP" = word {
        return values::function(word, x()?, at);
    }
    Ok(Some(match word {
        "ATAN2" => x()?.atan2(arguments.number(1)?).to_degrees(),
        "POT" => x()?.powi(2),
        "TRUNC" => x()?.trunc(),
        "ROUND" => x()?.round(),
        "ROUNDUP" => x()?.ceil(),
        "MINVAL" => x()?.min(arguments.number(1)?),
        "MAXVAL" => x()?.max(arguments.number(1)?),
        "BOUND" => arguments.number(2)?.min(arguments.number(1)?).max(x()?),
        "INT" => x()?.round(),
        "REAL" => x()?,
        _ => return Ok(None),
    }))
}

/// Functions of texts; `None` for others.
fn text_function(word: &str, arguments: &Arguments<'_>) -> Result<Option<Value>, Fault> {
    let at = arguments.at;
    let found = match word {
        "STRLEN" => Value::Number(arguments.text(0)?.chars().count() as f64),
        "TOUPPER" => Value::Text(arguments.text(0)?.to_uppercase()),
        "TOLOWER" => Value::Text(arguments.text(0)?.to_lowercase()),
        "INDEX" | "RINDEX" | "MINDEX" => {
            let (text, wanted) = (arguments.text(0)?, arguments.text(1)?);
            let is_wanted = |c: char| match word {
                "MINDEX" => wanted.contains(c),
                _ => wanted.starts_with(c),
            };
            let mut places = text.chars().enumerate().filter(|(_, c)| is_wanted(*c));
            let place = if word == "RINDEX" { places.last() } else { places.next() };
            Value::Number(place.map_or(-1.0, |(i, _)| i as f64))
        }
        "MATCH" => {
            let (text, wanted) = (arguments.text(0)?, arguments.text(1)?);
            let place = text.find(&wanted).map(|byte| text[..byte].chars().count() as f64);
            Value::Number(place.unwrap_or(-1.0))
        }
        "SUBSTR" => {
            let from = arguments.number(1)?.max(0.0) as usize;
            let count = match arguments.values.get(2) {
                Some(Some(count)) => count.number(at)?.max(0.0) as usize,
                _ => LONGEST_TEXT,
            };
            Value::Text(arguments.text(0)?.chars().skip(from).take(count).collect())
        }
        "NUMBER" => {
            let text = arguments.text(0)?;
            let number = text.trim().parse().ok().filter(|v: &f64| v.is_finite());
            let number = number.ok_or_else(|| {
                fault(
                    "bad-number",
                    at,
                    format!("`{text}` is not a number"),
                    "check the text with ISNUMBER before",
                )
            })?;
            Value::Number(number)
        }
        "ISNUMBER" => {
            let text = arguments.text(0)?;
            Value::truth(text.trim().parse().is_ok_and(|v: f64| v.is_finite()))
        }
        _ => return Ok(None),
    };
    Ok(Some(found))
}

/// The value of a message: numbers are written as the control does.
pub(super) fn message(value: &Value) -> String {
    match value {
        Value::Number(number) => shown(*number),
        Value::Text(text) => text.clone(),
        Value::Axis(axis) => axis.to_string(),
        Value::Frame(_) => "frame".into(),
    }
}
