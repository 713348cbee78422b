//! What the program is made of: the list that it prints, and the software bill of materials.

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Name and version of every package in Cargo.lock that comes from elsewhere.
fn locked() -> BTreeSet<(String, String)> {
    let lock = fs::read_to_string(root().join("Cargo.lock")).expect("Cargo.lock");
    let value = |entry: &str, key: &str| {
        let line = entry.lines().find_map(|l| l.strip_prefix(key)?.strip_prefix(" = "));
        line.map(|text| text.trim_matches('"').to_owned())
    };
    let entries = lock.split("[[package]]").filter(|entry| entry.contains("\nsource = "));
    entries.filter_map(|entry| Some((value(entry, "name")?, value(entry, "version")?))).collect()
}

/// The lines below a heading of the list: what stands before the licence, and the licence.
fn listed(text: &str, heading: &str) -> Vec<(String, String, String)> {
    let part = text.split_once(heading).expect(heading).1;
    let lines = part.lines().skip_while(|l| !l.starts_with("  "));
    let entry = |line: &str| {
        let (package, licence) = line.trim().split_once(": ").unwrap_or((line.trim(), ""));
        let (name, version) = package.split_once(' ').expect("name and version");
        (name.to_owned(), version.to_owned(), licence.to_owned())
    };
    lines.take_while(|l| l.starts_with("  ")).map(entry).collect()
}

#[test]
fn the_program_lists_every_locked_package_with_its_licence() {
    let done = Command::new(env!("CARGO_BIN_EXE_trueaxis")).arg("--licenses").output().unwrap();
    assert!(done.status.success());
    let text = String::from_utf8(done.stdout).unwrap();
    let inside = listed(&text, "In the program");
    let outside = listed(&text, "Not in the program");
    let packages = inside.iter().chain(&outside).map(|(n, v, _)| (n.clone(), v.clone()));
    assert_eq!(packages.collect::<BTreeSet<_>>(), locked(), "run scripts/sbom --licenses");
    let page = listed(&text, "In the page");
    let names: Vec<&str> = page.iter().map(|(name, ..)| &**name).collect();
    assert_eq!(names, ["three", "uplot"]);
    let deny = fs::read_to_string(root().join("deny.toml")).unwrap();
    for (name, _, licence) in inside.iter().chain(&page) {
        let spdx = licence.split_once(" (http").map_or(&**licence, |(spdx, _)| spdx);
        let words = spdx.split([' ', '(', ')']).filter(|w| !["", "OR", "AND"].contains(w));
        let allowed = words.into_iter().any(|word| deny.contains(&format!("\"{word}")));
        assert!(allowed, "{name}: {licence}");
    }
    for name in ["axum", "clap", "nalgebra", "toml"] {
        assert!(inside.iter().any(|(n, ..)| n == name), "{name}");
    }
    assert!(outside.iter().any(|(n, ..)| n == "proptest"));
}

/// The fields that CycloneDX 1.5 requires, and that every component of the program has.
#[test]
fn the_bill_of_materials_has_its_fields() {
    let script = root().join("scripts/sbom");
    let Ok(done) = Command::new("python3").arg(script).arg("--here").output() else {
        return; // without Python there is no script to check
    };
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let bill: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!((&bill["bomFormat"], &bill["specVersion"]), (&"CycloneDX".into(), &"1.5".into()));
    assert!(bill["version"].as_u64() >= Some(1));
    assert_eq!(bill["metadata"]["component"]["name"], "trueaxis");
    let components = bill["components"].as_array().unwrap();
    let mut references: BTreeSet<&str> = BTreeSet::new();
    for component in components {
        for key in ["type", "name", "version", "bom-ref"] {
            assert!(component[key].as_str().is_some_and(|text| !text.is_empty()), "{component}");
        }
        assert!(["library", "application"].contains(&component["type"].as_str().unwrap()));
        assert!(component["licenses"][0]["expression"].is_string(), "{component}");
        assert!(references.insert(component["bom-ref"].as_str().unwrap()), "{component}");
        let purl = component["purl"].as_str().unwrap_or_default();
        if purl.starts_with("pkg:cargo/") {
            assert_eq!(component["hashes"][0]["content"].as_str().map(str::len), Some(64));
        }
    }
    assert!(components.iter().any(|c| c["name"] == "axum"));
    assert!(!components.iter().any(|c| c["name"] == "proptest"));
    references.insert(bill["metadata"]["component"]["bom-ref"].as_str().unwrap());
    for link in bill["dependencies"].as_array().unwrap() {
        let used = link["dependsOn"].as_array().unwrap().iter().chain([&link["ref"]]);
        for reference in used {
            assert!(references.contains(reference.as_str().unwrap()), "{reference}");
        }
    }
}
