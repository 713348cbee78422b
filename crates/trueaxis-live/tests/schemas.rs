//! docs/schemas holds the JSON Schemas of the documents of this crate; `TRUEAXIS_WRITE_SCHEMAS=1` writes them.

use std::fs;
use std::path::Path;

#[test]
fn the_schemas_in_docs_are_those_of_the_types() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/schemas");
    for (name, schema) in trueaxis_live::schemas() {
        let text = serde_json::to_string_pretty(&schema).expect("a schema") + "\n";
        let path = folder.join(format!("{name}.json"));
        if std::env::var("TRUEAXIS_WRITE_SCHEMAS").is_ok_and(|value| value == "1") {
            fs::write(&path, &text).expect("written");
        }
        assert!(fs::read_to_string(&path).unwrap_or_default() == text, "{name}");
    }
}
