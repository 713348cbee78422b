//! The words of a request.

use crate::refusal::Refusal;
use serde_json::{Map, Value};

/// The body of a request: a JSON object with known keys.
pub(crate) struct Body<'a>(&'a Map<String, Value>);

impl<'a> Body<'a> {
    /// Only these keys are understood; any other is refused by name.
    pub(crate) fn of(value: &'a Value, known: &[&str]) -> Result<Self, Refusal> {
        let Some(map) = value.as_object() else {
            return Err(Refusal::bad("the body is no JSON object", "such as {}"));
        };
        match map.keys().find(|key| !known.contains(&key.as_str())) {
            Some(key) => {
                let hint = format!("known here: {}", known.join(", "));
                Err(Refusal::bad(format!("`{}` is not understood", short(key)), &hint))
            }
            None => Ok(Self(map)),
        }
    }

    fn due(key: &str, what: &str) -> Refusal {
        Refusal::bad(format!("`{key}` is due as {what}"), "")
    }

    pub(crate) fn optional(&self, key: &str) -> Option<&'a Value> {
        self.0.get(key).filter(|value| !value.is_null())
    }

    pub(crate) fn text(&self, key: &str) -> Result<&'a str, Refusal> {
        self.optional_text(key)?.ok_or_else(|| Self::due(key, "a text"))
    }

    pub(crate) fn optional_text(&self, key: &str) -> Result<Option<&'a str>, Refusal> {
        let text = |v: &'a Value| v.as_str().ok_or_else(|| Self::due(key, "a text"));
        self.optional(key).map(text).transpose()
    }

    pub(crate) fn number(&self, key: &str) -> Result<f64, Refusal> {
        self.optional_number(key)?.ok_or_else(|| Self::due(key, "a number"))
    }

    pub(crate) fn optional_number(&self, key: &str) -> Result<Option<f64>, Refusal> {
        let number = |v: &Value| v.as_f64().ok_or_else(|| Self::due(key, "a number"));
        self.optional(key).map(number).transpose()
    }

    pub(crate) fn count(&self, key: &str) -> Result<usize, Refusal> {
        let whole = self.optional(key).and_then(Value::as_u64);
        whole.map(|n| n as usize).ok_or_else(|| Self::due(key, "a whole number"))
    }

    /// True or false, or what it is if nothing is said.
    pub(crate) fn flag(&self, key: &str, usual: bool) -> Result<bool, Refusal> {
        let flag = |v: &Value| v.as_bool().ok_or_else(|| Self::due(key, "true or false"));
        self.optional(key).map_or(Ok(usual), flag)
    }

    /// A list of texts.
    pub(crate) fn texts(&self, key: &str) -> Result<Vec<&'a str>, Refusal> {
        let texts = |v: &'a Value| v.as_array()?.iter().map(Value::as_str).collect();
        self.optional(key).and_then(texts).ok_or_else(|| Self::due(key, "a list of texts"))
    }

    /// Names with numbers; none is an empty list.
    pub(crate) fn numbers(&self, key: &str) -> Result<Vec<(&'a str, f64)>, Refusal> {
        let Some(value) = self.optional(key) else { return Ok(Vec::new()) };
        let what = "names with numbers";
        let map = value.as_object().ok_or_else(|| Self::due(key, what))?;
        let one = |(name, value): (&'a String, &Value)| {
            value.as_f64().map(|x| (name.as_str(), x)).ok_or_else(|| Self::due(key, what))
        };
        map.iter().map(one).collect()
    }
}

/// What somebody sent, not longer than a message should be.
pub(crate) fn short(text: &str) -> String {
    text.chars().take(60).collect()
}
