//! What requests say of errors, settings and controls, as the library takes it.

use crate::body::{Body, short};
use crate::refusal::Refusal;
use serde_json::Value;
use trueaxis::input::{Dimension, parse_quantity};
use trueaxis::machine::errors::ErrorName;
use trueaxis::nc::Control;
use trueaxis::predict::ErrorChange;
use trueaxis::simulate::{CONTROLS, control_named};

/// `{"EC0Y": {"factor": 0, "add": "5 urad"}}`; each part may be left out.
pub(super) fn errors(body: &Body<'_>, key: &str) -> Result<Vec<ErrorChange>, Refusal> {
    let Some(value) = body.optional(key) else { return Ok(Vec::new()) };
    let map = value.as_object();
    let map =
        map.ok_or_else(|| Refusal::bad(format!("`{key}` is due as names with changes"), ""))?;
    map.iter().map(|(name, change)| error(name, change)).collect()
}

fn error(name: &str, change: &Value) -> Result<ErrorChange, Refusal> {
    let Some(parsed) = ErrorName::parse(name) else {
        let message = format!("`{}` is no error name of ISO 230-1", short(name));
        return Err(Refusal::bad(message, "such as EC0Y, EXX, EX0t"));
    };
    let body = Body::of(change, &["factor", "add"])?;
    let rotation = parsed.component.is_rotation();
    let dimension = if rotation { Dimension::Angle } else { Dimension::Length };
    let add = body.optional_text("add")?.map(|text| parse_quantity(text, dimension)).transpose();
    let add = add.map_err(|e| Refusal::new(400, e.code(), format!("{name}: {e}"), &e.hint()))?;
    let factor = body.optional_number("factor")?.unwrap_or(1.0);
    Ok(ErrorChange { name: parsed, factor, add: add.unwrap_or(0.0) })
}

/// `{"C": 90}`, deg.
pub(super) fn setting(body: &Body<'_>, key: &str) -> Result<Vec<(String, f64)>, Refusal> {
    let angles = body.numbers(key)?.into_iter();
    Ok(angles.map(|(letter, deg)| (letter.to_owned(), deg.to_radians())).collect())
}

/// `dialect`, as `--control` of the command line.
pub(super) fn control(body: &Body<'_>) -> Result<Control, Refusal> {
    let name = body.optional_text("dialect")?.unwrap_or("sinumerik");
    control_named(name).ok_or_else(|| {
        Refusal::bad(format!("`{}` is no control that is known", short(name)), CONTROLS)
    })
}
