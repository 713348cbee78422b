//! An answer as one JSON document.

use crate::finite::first_not_finite;
use schemars::generate::SchemaSettings;
use schemars::transform::transform_subschemas;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::Value;
use std::borrow::Cow;
use std::collections::BTreeMap;

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

/// A document's name with its JSON Schema: keys, types and, from the comments in the source, meanings and units.
pub type NamedSchema = (&'static str, Schema);

/// The JSON Schema of a document under its name, such as `predict`.
pub fn named_schema<T: JsonSchema>(name: &'static str) -> NamedSchema {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    open_branches(&mut schema);
    (name, schema)
}

/// A branch of a flattened enumeration knows only its own keys: what it says of all others would hold for
/// those of the object around it, too.
fn open_branches(schema: &mut Schema) {
    let mut named = Vec::new();
    open_branches_below(schema, &mut named);
    for name in named {
        let definition = schema.get_mut("$defs").and_then(|d| d.get_mut(&name));
        if let Some(definition) = definition.and_then(Value::as_object_mut) {
            definition.remove("additionalProperties");
        }
    }
}

/// The same of a part of the schema; `named` are branches that stand among the definitions.
fn open_branches_below(schema: &mut Schema, named: &mut Vec<String>) {
    if let Some(map) = schema.as_object_mut().filter(|map| map.contains_key("properties")) {
        for key in ["anyOf", "oneOf"] {
            let branches = map.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten();
            for branch in branches.filter_map(Value::as_object_mut) {
                branch.remove("additionalProperties");
                let name = branch.get("$ref").and_then(Value::as_str);
                named.extend(name.and_then(|n| n.strip_prefix("#/$defs/")).map(str::to_owned));
            }
        }
    }
    transform_subschemas(&mut |inner: &mut Schema| open_branches_below(inner, named), schema);
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

impl<T: JsonSchema> JsonSchema for Keyed<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        BTreeMap::<String, T>::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        BTreeMap::<String, T>::json_schema(generator)
    }
}
