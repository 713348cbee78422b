//! Lists the JSON Schemas in docs/schemas, so that the command carries them in itself.
//!
//! The types that they describe would say the same (a test of trueaxis-serve compares the two), but what makes schemas of
//! types is larger than their texts.

use std::env;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

fn main() {
    let schemas = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/schemas");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed={}", schemas.display());
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let listed = list(&schemas).and_then(|text| fs::write(out.join("schemas.rs"), text));
    if let Err(why) = listed {
        println!("cargo::error={}: {why}", schemas.display());
    }
}

/// The schemas by name, without those of the requests and answers of the page.
fn list(folder: &Path) -> std::io::Result<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let Some(name) = name.strip_suffix(".json").filter(|n| !n.starts_with("serve-")) else {
            continue;
        };
        found.push((name.to_owned(), one_line(&fs::read_to_string(&path)?)));
    }
    found.sort();
    let mut text = format!("const SCHEMAS: [(&str, &str); {}] = [\n", found.len());
    for (name, schema) in found {
        let _ = writeln!(text, "    ({name:?}, {schema:?}),");
    }
    Ok(text + "];\n")
}

/// JSON without the line ends and indents between its parts; inside a string there are none.
fn one_line(json: &str) -> String {
    json.lines().map(str::trim_start).collect()
}
