//! docs/schemas holds the JSON Schema of every document, as the types of the source state it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Set to 1, the files are written instead of compared.
const WRITE: &str = "TRUEAXIS_WRITE_SCHEMAS";

#[test]
fn the_schemas_in_docs_are_those_of_the_types() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/schemas");
    let all = trueaxis::schemas().into_iter().chain(trueaxis_serve::schemas());
    let all = all.chain(trueaxis_live::schemas()).chain(trueaxis_study::schemas());
    let all = all.chain(trueaxis_templates::schemas());
    let mut due = BTreeMap::new();
    for (name, schema) in all {
        let text = serde_json::to_string_pretty(&schema).expect("a schema") + "\n";
        assert!(due.insert(format!("{name}.json"), text).is_none(), "{name} stands twice");
    }
    let there = files(&folder);
    if std::env::var(WRITE).is_ok_and(|value| value == "1") {
        for name in there.keys().filter(|name| !due.contains_key(*name)) {
            fs::remove_file(folder.join(name)).expect("a file that can be removed");
        }
        for (name, text) in due.iter().filter(|(name, text)| there.get(*name) != Some(text)) {
            fs::write(folder.join(name), text).expect("a file that can be written");
        }
        return;
    }
    let mut stale: Vec<&String> = due
        .iter()
        .filter(|(name, text)| there.get(*name) != Some(text))
        .map(|(name, _)| name)
        .collect();
    stale.extend(there.keys().filter(|name| !due.contains_key(*name)));
    assert!(
        stale.is_empty(),
        "docs/schemas: {stale:?} differ from the types; {WRITE}=1 cargo test -p trueaxis-serve --test schemas \
         writes them, then `npm run types` in web/"
    );
}

/// The schemas in the folder by file name.
fn files(folder: &Path) -> BTreeMap<String, String> {
    let entries = fs::read_dir(folder).expect("docs/schemas").flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names
        .filter(|name| name.ends_with(".json"))
        .map(|name| {
            let text = fs::read_to_string(folder.join(&name)).expect("a schema");
            (name, text)
        })
        .collect()
}
