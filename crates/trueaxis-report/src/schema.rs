//! The JSON Schema of a document, made of its types.

use crate::Keyed;
use schemars::generate::SchemaSettings;
use schemars::transform::transform_subschemas;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::Value;
use std::borrow::Cow;
use std::collections::BTreeMap;

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
