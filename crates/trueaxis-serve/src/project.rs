//! The project folder: the only files that the page sees, and the examples among them.

use crate::body::short;
use crate::refusal::Refusal;
use serde_json::{Value, json};
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Component, Path, PathBuf};
use trueaxis::input::{Diagnostics, Section, SourceText};

/// A folder with more files than this is no project; the list ends there and says so.
const MOST_FILES: usize = 5000;

/// Folders in folders that are looked into.
const DEPTH: usize = 8;

/// Where the examples are listed.
const INDEX: &str = "examples/index.toml";

/// What the page may write: the files that people edit in it.
const WRITTEN: [&str; 2] = ["toml", "csv"];

/// The folder, and how files in it are named.
#[derive(Debug, Clone)]
pub(crate) struct Project {
    /// Without links in it.
    root: PathBuf,
}

impl Project {
    /// # Errors
    /// If it is no folder.
    pub(crate) fn of(folder: &Path) -> std::io::Result<Self> {
        let root = folder.canonicalize()?;
        match root.is_dir() {
            true => Ok(Self { root }),
            false => Err(std::io::Error::other("this is no folder")),
        }
    }

    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// The path of a file in the folder by the name that the page gives it, relative to the folder.
    /// Names lead down only; hidden files have none. Links are looked through when the file is
    /// opened (`trueaxis::files::within`).
    pub(crate) fn path(&self, name: &str) -> Result<PathBuf, Refusal> {
        let outside = || {
            let message = format!("`{}` names no file of the project", short(name));
            let hint = "a path below the project folder, such as machines/mill/machine.toml";
            Refusal::new(403, "outside-project", message, hint)
        };
        let path = Path::new(name);
        let plain = |part: Component<'_>| match part {
            Component::Normal(part) => !part.to_string_lossy().starts_with('.'),
            _ => false,
        };
        let parts = path.components();
        let sound =
            !name.is_empty() && !name.contains(['\0', '\\']) && parts.into_iter().all(plain);
        if sound { Ok(path.to_owned()) } else { Err(outside()) }
    }

    /// The same for a file that is to be written.
    pub(crate) fn writable_path(&self, name: &str) -> Result<PathBuf, Refusal> {
        let path = self.path(name)?;
        let known = path.extension().is_some_and(|e| WRITTEN.iter().any(|w| e == *w));
        match known {
            true => Ok(path),
            false => {
                let message = format!("`{}` is not written from here", short(name));
                Err(Refusal::new(403, "not-written", message, "TOML and CSV files only"))
            }
        }
    }

    /// The name of a file of the project that the library calls by any path; none if it lies outside.
    pub(crate) fn name_of(&self, path: &Path) -> Option<String> {
        let path = path.canonicalize().ok()?;
        Some(path.strip_prefix(&self.root).ok()?.to_string_lossy().replace('\\', "/"))
    }

    /// Everything that the first page shows.
    pub(crate) fn json(&self) -> Value {
        let mut files = Vec::new();
        self.collect(&self.root, DEPTH, &mut files);
        files.sort_by(|a, b| a["path"].as_str().cmp(&b["path"].as_str()));
        let (examples, problems) = self.examples();
        json!({
            "folder": self.root.file_name().map_or("/".into(), |n| n.to_string_lossy()),
            "version": env!("CARGO_PKG_VERSION"),
            "examples": examples,
            "files": files,
            "more_files": files.len() >= MOST_FILES,
            "diagnostics": crate::refusal::diagnostics_json(&problems),
        })
    }

    fn collect(&self, folder: &Path, depth: usize, files: &mut Vec<Value>) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        for entry in entries.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let skipped = name.starts_with('.') || ["target", "node_modules"].contains(&&*name);
            let Ok(kind) = entry.file_type() else { continue };
            if skipped || kind.is_symlink() || files.len() >= MOST_FILES {
                continue;
            }
            let path = entry.path();
            if kind.is_dir() && depth > 0 {
                self.collect(&path, depth - 1, files);
            } else if let (Some(kind), Ok(shown)) = (kind_of(&path), path.strip_prefix(&self.root))
            {
                let shown = shown.to_string_lossy().replace('\\', "/");
                let bytes = entry.metadata().map_or(0, |m| m.len());
                files.push(json!({ "path": shown, "kind": kind, "bytes": bytes }));
            }
        }
    }

    /// The examples of the folder, if it has any.
    fn examples(&self) -> (Vec<Value>, Diagnostics) {
        let Ok(text) = fs::read_to_string(self.root.join(INDEX)) else {
            return (Vec::new(), Diagnostics::new());
        };
        let source = SourceText::new(INDEX, &text);
        let examples = source.read(|root| {
            let list = root.get("example").and_then(|item| item.list()).unwrap_or_default();
            let one = |item: trueaxis::input::Item<'_>| {
                item.section("example", |section| example(section))
            };
            list.into_iter().filter_map(one).flatten().collect()
        });
        (examples, source.finish())
    }
}

/// One example: the tab that shows it and the files that it needs.
fn example(section: &Section<'_>) -> Option<Value> {
    let mut words = serde_json::Map::new();
    for key in ["tab", "title", "what", "path"] {
        let text = section.require(key, "a text")?.text()?;
        words.insert(key.to_owned(), json!(text));
    }
    for key in ["machine", "standard"] {
        if let Some(text) = section.text(key) {
            words.insert(key.to_owned(), json!(text));
        }
    }
    Some(Value::Object(words))
}

/// What a file is, by its ending and, for TOML, by its sections; none if the page has no use for it.
fn kind_of(path: &Path) -> Option<&'static str> {
    let ending = path.extension()?.to_string_lossy().to_ascii_lowercase();
    Some(match &*ending {
        "csv" | "qif" => "readings",
        "mpf" | "spf" | "nc" | "ngc" | "h" | "tap" | "eia" | "gcode" => "program",
        "cls" | "apt" | "cl" => "cl",
        "toml" => kind_of_toml(&path.to_string_lossy(), &fs::read_to_string(path).ok()?),
        _ => return None,
    })
}

fn kind_of_toml(name: &str, text: &str) -> &'static str {
    let begins = |words: &[&str]| {
        text.lines().any(|line| words.iter().any(|word| line.trim_start().starts_with(word)))
    };
    match () {
        () if name.ends_with(".setup.toml") => "setup",
        () if begins(&["[machine]"]) => "machine",
        () if begins(&["test_piece", "[holes]"]) => "study",
        () if begins(&["[instrument.", "[[path]]"]) => "campaign",
        () => "other",
    }
}

/// What tells whether a file has changed.
pub(crate) fn version(content: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    content.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_down_only() {
        let project = Project::of(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
        for bad in
            ["", "..", "a/../../b", "/etc/passwd", ".git/config", "a/.b", "a\\b", "a\0b", "."]
        {
            assert_eq!(project.path(bad).unwrap_err().status, 403, "{bad:?}");
        }
        assert_eq!(project.path("src/lib.rs").unwrap(), Path::new("src/lib.rs"));
        assert_eq!(project.writable_path("src/lib.rs").unwrap_err().status, 403);
    }
}
