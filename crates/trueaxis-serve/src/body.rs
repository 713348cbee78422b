//! The body of a request: JSON that becomes a type, or a refusal that names the wrong part.

use crate::refusal::Refusal;
use serde::de::{DeserializeOwned, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};
use std::fmt;

/// Characters of a message that quotes what was sent.
const MOST_QUOTED: usize = 300;

/// What a body says as JSON; a name that stands twice in one object is refused, as the second value would count in silence.
pub(crate) fn parse(body: &[u8]) -> Result<Value, Refusal> {
    let Unique(value) = serde_json::from_slice(body)
        .map_err(|e| Refusal::bad(format!("the body is no JSON: {e}"), "such as {}"))?;
    Ok(value)
}

/// JSON whose names stand once each.
struct Unique(Value);

impl<'de> Deserialize<'de> for Unique {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(UniqueVisitor).map(Self)
    }
}

struct UniqueVisitor;

impl<'de> Visitor<'de> for UniqueVisitor {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_string<E>(self, value: String) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Value, A::Error> {
        let mut all = Vec::new();
        while let Some(Unique(value)) = seq.next_element()? {
            all.push(value);
        }
        Ok(all.into())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Value, A::Error> {
        let mut all = Map::new();
        while let Some(name) = map.next_key::<String>()? {
            let Unique(value) = map.next_value()?;
            if all.contains_key(&name) {
                return Err(A::Error::custom(format!("`{}` stands twice", short(&name))));
            }
            all.insert(name, value);
        }
        Ok(all.into())
    }
}

/// The request in a body; unknown names and wrong types are refused by their place.
pub(crate) fn read<T: DeserializeOwned>(body: Value) -> Result<T, Refusal> {
    if !body.is_object() {
        return Err(Refusal::bad("the body is not a JSON object", "such as {}"));
    }
    serde_path_to_error::deserialize(body).map_err(|error| {
        let place = short(&error.path().to_string());
        let problem: String = error.inner().to_string().chars().take(MOST_QUOTED).collect();
        Refusal::bad(
            match &*place {
                "." => problem,
                place => format!("`{place}`: {problem}"),
            },
            "",
        )
    })
}

/// A name that the request needs in its present form.
pub(crate) fn needed<T>(value: Option<T>, name: &str) -> Result<T, Refusal> {
    value.ok_or_else(|| Refusal::bad(format!("missing field `{name}`"), ""))
}

/// The beginning of a text from a request, for a message.
pub(crate) fn short(text: &str) -> String {
    text.chars().take(60).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[derive(serde::Deserialize, Debug)]
    #[serde(deny_unknown_fields)]
    struct Position {
        #[allow(dead_code)]
        at: std::collections::BTreeMap<String, f64>,
    }

    #[test]
    fn a_name_stands_once_in_an_object() {
        let body = br#"{"at": {"X": 1, "Y": -2.5, "Z": null}, "list": [{"X": "a"}, {"X": true}]}"#;
        assert_eq!(parse(body).unwrap(), serde_json::from_slice::<Value>(body).unwrap());
        for body in [r#"{"at": {"X": 1, "X": 500}}"#, r#"{"X": [], "Y": 1, "X": []}"#] {
            let refused = crate::refusal::tests::message(&parse(body.as_bytes()).unwrap_err());
            assert!(refused.starts_with("the body is no JSON: `X` stands twice"), "{refused}");
        }
    }

    #[test]
    fn the_wrong_part_is_named() {
        let refused = |body| crate::refusal::tests::message(&read::<Position>(body).unwrap_err());
        assert!(refused(json!({ "at": { "X": "1" } })).starts_with("`at.X`: invalid type"));
        assert!(refused(json!({ "at": {}, "to": 1 })).contains("unknown field `to`"));
        assert_eq!(refused(json!({})), "missing field `at`");
        assert_eq!(refused(json!([])), "the body is not a JSON object");
    }
}
