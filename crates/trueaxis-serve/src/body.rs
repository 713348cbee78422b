//! The body of a request: JSON that becomes a type, or a refusal that names the wrong part.

use crate::refusal::Refusal;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Characters of a message that quotes what was sent.
const MOST_QUOTED: usize = 300;

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
    fn the_wrong_part_is_named() {
        let refused = |body| crate::refusal::tests::message(&read::<Position>(body).unwrap_err());
        assert!(refused(json!({ "at": { "X": "1" } })).starts_with("`at.X`: invalid type"));
        assert!(refused(json!({ "at": {}, "to": 1 })).contains("unknown field `to`"));
        assert_eq!(refused(json!({})), "missing field `at`");
        assert_eq!(refused(json!([])), "the body is not a JSON object");
    }
}
