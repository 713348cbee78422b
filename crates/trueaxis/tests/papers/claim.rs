//! The records beside this file: claims, differences, open questions.

use crate::shop;
use std::path::Path;
use toml::{Table, Value};

/// One number (or a few of one kind) that an independent source states.
pub struct Claim {
    pub id: String,
    /// What is compared.
    pub what: String,
    /// Where it is stated.
    pub source: String,
    pub unit: String,
    pub theirs: Vec<f64>,
    /// The largest |ours − theirs|, in the unit.
    pub allowed: f64,
    /// Why that much.
    pub why: String,
}

/// Where we do not do what a source says.
pub struct Difference {
    /// The erratum: document, number.
    pub id: String,
    pub source_says: String,
    pub we_do: String,
    pub why: String,
}

/// What has not been checked, and what would settle it.
pub struct Unknown {
    pub what: String,
    pub why: String,
    pub settled_by: String,
}

/// What came out on the files of others, which are not part of the project.
pub struct Outside {
    pub files: String,
    pub found: String,
    pub differs: String,
    pub test: String,
}

/// One TOML file.
pub struct Record {
    pub title: String,
    pub text: String,
    pub claims: Vec<Claim>,
    pub differences: Vec<Difference>,
    pub unknowns: Vec<Unknown>,
    pub outsides: Vec<Outside>,
}

/// One table of a record; every key must be asked for.
struct Entry {
    place: String,
    table: Table,
}

impl Entry {
    fn take(&mut self, key: &str) -> Value {
        let value = self.table.remove(key);
        value.unwrap_or_else(|| panic!("{}: `{key}` is missing", self.place))
    }

    fn text(&mut self, key: &str) -> String {
        match self.take(key) {
            Value::String(text) => text.split_whitespace().collect::<Vec<_>>().join(" "),
            other => panic!("{}: `{key}` is no text: {other:?}", self.place),
        }
    }

    fn numbers(&mut self, key: &str) -> Vec<f64> {
        let number = |value: &Value| match value {
            Value::Float(v) if v.is_finite() => *v,
            Value::Integer(v) => *v as f64,
            other => panic!("`{key}` is no number: {other:?}"),
        };
        match self.take(key) {
            Value::Array(list) => list.iter().map(number).collect(),
            one => vec![number(&one)],
        }
    }

    fn list(&mut self, key: &str) -> Vec<Entry> {
        let Some(value) = self.table.remove(key) else { return Vec::new() };
        let Value::Array(list) = value else { panic!("{}: `{key}` is no list", self.place) };
        let entry = |(i, value)| match value {
            Value::Table(table) => {
                Entry { place: format!("{} {key} {}", self.place, i + 1), table }
            }
            other => panic!("{}: {other:?} is no table", self.place),
        };
        list.into_iter().enumerate().map(entry).collect()
    }

    fn finish(self) {
        let left: Vec<_> = self.table.keys().collect();
        assert!(left.is_empty(), "{}: unknown keys {left:?}", self.place);
    }
}

/// Every TOML file beside this one, by name.
pub fn records() -> Vec<Record> {
    let folder = shop::root().join("crates/trueaxis/tests/papers");
    let entries = std::fs::read_dir(folder).expect("this folder").flatten().map(|e| e.path());
    let mut paths: Vec<_> =
        entries.filter(|p| p.extension().is_some_and(|e| e == "toml")).collect();
    paths.sort();
    paths.iter().map(|path| record(path)).collect()
}

fn record(path: &Path) -> Record {
    let name = path.file_name().expect("a file").display().to_string();
    let text = std::fs::read_to_string(path).expect("a record");
    let table = text.parse::<Table>().unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut entry = Entry { place: name, table };
    let record = Record {
        title: entry.text("title"),
        text: entry.text("text"),
        claims: entry.list("claim").into_iter().map(claim).collect(),
        differences: entry.list("difference").into_iter().map(difference).collect(),
        unknowns: entry.list("unknown").into_iter().map(unknown).collect(),
        outsides: entry.list("outside").into_iter().map(outside).collect(),
    };
    entry.finish();
    record
}

fn claim(mut entry: Entry) -> Claim {
    let theirs = match entry.table.remove("theirs_from") {
        Some(places) => places
            .as_array()
            .into_iter()
            .flatten()
            .map(|p| number_in_file(p.as_str().expect("FILE /pointer")))
            .collect(),
        None => entry.numbers("theirs"),
    };
    let claim = Claim {
        id: entry.text("id"),
        what: entry.text("what"),
        source: entry.text("source"),
        unit: entry.text("unit"),
        allowed: entry.numbers("allowed")[0],
        why: entry.text("why"),
        theirs,
    };
    assert!(claim.allowed > 0.0 && !claim.theirs.is_empty(), "{}", entry.place);
    entry.finish();
    claim
}

/// `nas979-xkas2525.json /indices_mm/volumetric_max/value` in crates/trueaxis/tests/data.
fn number_in_file(place: &str) -> f64 {
    let (file, pointer) = place.split_once(' ').expect("FILE /pointer");
    let path = shop::root().join("crates/trueaxis/tests/data").join(file);
    let text = std::fs::read_to_string(path).expect("a committed oracle file");
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let number = json.pointer(pointer).and_then(serde_json::Value::as_f64);
    number.unwrap_or_else(|| panic!("no number at {place}"))
}

fn difference(mut entry: Entry) -> Difference {
    let difference = Difference {
        id: entry.text("id"),
        source_says: entry.text("source_says"),
        we_do: entry.text("we_do"),
        why: entry.text("why"),
    };
    entry.finish();
    difference
}

fn outside(mut entry: Entry) -> Outside {
    let outside = Outside {
        files: entry.text("files"),
        found: entry.text("found"),
        differs: entry.text("differs"),
        test: entry.text("test"),
    };
    entry.finish();
    outside
}

fn unknown(mut entry: Entry) -> Unknown {
    let unknown = Unknown {
        what: entry.text("what"),
        why: entry.text("why"),
        settled_by: entry.text("settled_by"),
    };
    entry.finish();
    unknown
}
