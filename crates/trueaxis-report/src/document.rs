//! An answer as one JSON document.

use crate::finite::first_not_finite;
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::Value;

/// The entry of a document with a number that is not finite; such a document is no answer.
const NOT_FINITE: &str = "not_finite";

/// The JSON of a document: its fields in their order, numbers in full double precision. JSON has no number that is
/// not finite: a document with one says where it is, see [`not_finite`].
pub fn document(answer: &impl Serialize) -> Value {
    // why: the documents are structures with texts as keys, which always have a JSON form.
    let mut document =
        serde_json::to_value(answer).expect("a document of texts, numbers and lists");
    if let (Some(entries), Some(place)) = (document.as_object_mut(), first_not_finite(answer)) {
        entries.insert(NOT_FINITE.to_owned(), Value::String(place));
    }
    document
}

/// Where a document has a number that is not finite, such as `axes.0.mean_um`.
pub fn not_finite(document: &Value) -> Option<&str> {
    match document {
        Value::Object(entries) => {
            let own = entries.get(NOT_FINITE).and_then(Value::as_str);
            own.or_else(|| entries.values().find_map(not_finite))
        }
        Value::Array(items) => items.iter().find_map(not_finite),
        _ => None,
    }
}

/// An object whose keys come with the data, such as names of axes; it keeps their order.
///
/// ```
/// use trueaxis_report::{Keyed, document};
/// let at: Keyed<f64> = [("X", 100.0), ("C", -90.0)].into_iter().collect();
/// assert_eq!(document(&at).to_string(), r#"{"X":100.0,"C":-90.0}"#);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Keyed<T>(pub Vec<(String, T)>);

impl<K: Into<String>, T> FromIterator<(K, T)> for Keyed<T> {
    fn from_iter<I: IntoIterator<Item = (K, T)>>(entries: I) -> Self {
        Self(entries.into_iter().map(|(key, value)| (key.into(), value)).collect())
    }
}

impl<T: Serialize> Serialize for Keyed<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (key, value) in &self.0 {
            map.serialize_entry(key, value)?;
        }
        map.end()
    }
}
