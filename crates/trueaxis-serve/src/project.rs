//! The project folder: the only files that the page sees, and the examples among them.

use crate::body::short;
use crate::refusal::Refusal;
use crate::watch::Stamps;
use serde::Serialize;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::Read;
use std::path::{Component, Path, PathBuf};
use trueaxis::JsonSchema;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Item, Section, SourceText};

/// A folder with more files than this is no project; the list ends there and says so.
const MOST_FILES: usize = 5000;

/// Folders in folders that are looked into.
const DEPTH: usize = 8;

/// Bytes of a TOML file that tell its kind.
const LOOKED_AT: u64 = 1 << 20;

/// Larger files count as changed by their size and time alone.
const MOST_COMPARED: u64 = 16 << 20;

/// Where the examples are listed.
const INDEX: &str = "examples/index.toml";

/// What the page may write: the files that people edit in it.
const WRITTEN: [&str; 2] = ["toml", "csv"];

/// A file that the page has a use for.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct FileEntry {
    /// Its path below the project folder, with `/`.
    path: String,
    /// What it contains.
    kind: FileKind,
    /// Its size in bytes.
    bytes: u64,
}

/// The content of a file, by its ending and, for TOML, by its sections.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum FileKind {
    /// A machine file.
    Machine,
    /// A test piece or holes on a machine.
    Study,
    /// Instruments, paths and readings.
    Campaign,
    /// An NC program.
    Program,
    /// Readings of an instrument.
    Readings,
    /// The set-up of a program.
    Setup,
    /// Cutter locations.
    Cl,
    /// The plan of a live run.
    Live,
    /// Readings compared with a machine file.
    Comparison,
    /// The certificate of a compensation.
    Certificate,
    /// A test piece that was measured.
    Measured,
    /// A path on a measured blank.
    Blank,
    /// Readings from which the rotary centres in a control follow.
    Rtcp,
    /// The heading of a report.
    Heading,
    /// Another TOML file.
    Other,
}

/// An example of the project.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct ExampleEntry {
    /// The tab that shows it.
    tab: String,
    /// Its title.
    title: String,
    /// What it shows, in a sentence.
    what: String,
    /// Its file.
    path: String,
    /// The machine file that it needs.
    #[serde(skip_serializing_if = "Option::is_none")]
    machine: Option<String>,
    /// The standard by which its readings are evaluated.
    #[serde(skip_serializing_if = "Option::is_none")]
    standard: Option<String>,
}

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

    /// The files with these endings in a folder of the project, by name; a file as it is named.
    pub(crate) fn in_folder(&self, name: &str, endings: &[&str]) -> Result<Vec<PathBuf>, Refusal> {
        let path = self.path(name)?;
        let inside = path.canonicalize().is_ok_and(|whole| whole.starts_with(&self.root));
        let Some(entries) = fs::read_dir(&path).ok().filter(|_| inside) else {
            return Ok(vec![path]);
        };
        let is_file = |entry: &fs::DirEntry| entry.file_type().is_ok_and(|kind| kind.is_file());
        let files = entries.flatten().filter(is_file).map(|entry| path.join(entry.file_name()));
        let is_one = |p: &PathBuf| p.extension().is_some_and(|e| endings.iter().any(|x| e == *x));
        let mut found: Vec<PathBuf> = files.filter(is_one).collect();
        found.sort();
        Ok(found)
    }

    /// The name of a folder beside a machine file that is not there, for files that a command would write.
    pub(crate) fn new_folder(&self, machine: &str, target: &str) -> PathBuf {
        let machine = Path::new(machine);
        let above = machine.parent().and_then(Path::file_name).or(machine.file_stem());
        let name = format!("{}-{target}", above.unwrap_or_default().to_string_lossy());
        let numbered = |n: usize| if n == 1 { name.clone() } else { format!("{name}-{n}") };
        let free = (1..).map(numbered).find(|name| !self.root.join(name).exists());
        PathBuf::from(free.unwrap_or(name))
    }

    /// The name of a file of the project that the library calls by any path; none if it lies outside.
    pub(crate) fn name_of(&self, path: &Path) -> Option<String> {
        let path = path.canonicalize().ok()?;
        Some(path.strip_prefix(&self.root).ok()?.to_string_lossy().replace('\\', "/"))
    }

    /// The name of the folder.
    pub(crate) fn name(&self) -> String {
        self.root.file_name().map_or("/".into(), |n| n.to_string_lossy().into_owned())
    }

    /// The files in the order of their paths, and whether there are more than are listed.
    pub(crate) fn files(&self) -> (Vec<FileEntry>, bool) {
        let mut files = Vec::new();
        self.walk(&self.root, DEPTH, &mut |path, file| {
            if let Some(kind) = kind_of(&file.path()) {
                let bytes = file.metadata().map_or(0, |m| m.len());
                files.push(FileEntry { path, kind, bytes });
            }
            files.len() < MOST_FILES
        });
        files.sort_by(|a, b| a.path.cmp(&b.path));
        let more = files.len() >= MOST_FILES;
        (files, more)
    }

    /// What tells that a file may have changed: its size and time, of all files whose ending has a use. No file is opened.
    pub(crate) fn stamps(&self) -> Stamps {
        let mut stamps = Stamps::new();
        self.walk(&self.root, DEPTH, &mut |path, file| {
            if let (true, Ok(data)) = (has_use(&file.path()), file.metadata()) {
                let mut hasher = DefaultHasher::new();
                (data.len(), data.modified().ok()).hash(&mut hasher);
                stamps.insert(path, hasher.finish());
            }
            stamps.len() < MOST_FILES
        });
        stamps
    }

    /// Each file with its path below the project folder, until `each` says no; links and pipes are none. Whether it went to the end.
    fn walk(
        &self,
        folder: &Path,
        depth: usize,
        each: &mut dyn FnMut(String, &fs::DirEntry) -> bool,
    ) -> bool {
        let Ok(entries) = fs::read_dir(folder) else { return true };
        entries.flatten().all(|entry| {
            let name = entry.file_name();
            let name = name.to_string_lossy();
            let is_skipped = name.starts_with('.') || ["target", "node_modules"].contains(&&*name);
            let Ok(kind) = entry.file_type() else { return true };
            let path = entry.path();
            match path.strip_prefix(&self.root) {
                _ if is_skipped => true,
                Ok(_) if kind.is_dir() => depth == 0 || self.walk(&path, depth - 1, each),
                Ok(below) if kind.is_file() => {
                    each(below.to_string_lossy().replace('\\', "/"), &entry)
                }
                _ => true,
            }
        })
    }

    /// The version of a file; none if it is gone, or too large to be read at every change.
    pub(crate) fn version_of(&self, name: &str) -> Option<String> {
        let path = self.root.join(name);
        let is_small = fs::metadata(&path).is_ok_and(|data| data.len() <= MOST_COMPARED);
        is_small.then(|| fs::read(&path).ok()).flatten().map(|content| version(&content))
    }

    /// The examples of the folder, if it has any.
    pub(crate) fn examples(&self) -> (Vec<ExampleEntry>, Diagnostics) {
        let index = self.root.join(INDEX);
        let text = disk().is_file(&index).then(|| disk().read_text(&index).ok()).flatten();
        let Some(text) = text else {
            return (Vec::new(), Diagnostics::new());
        };
        let source = SourceText::new(INDEX, &text);
        let examples = source.read(|root| {
            let list = root.get("example").and_then(|item| item.list()).unwrap_or_default();
            let one = |item: Item<'_>| item.section("example", ExampleEntry::read).flatten();
            list.into_iter().filter_map(one).collect()
        });
        (examples, source.finish())
    }
}

impl ExampleEntry {
    fn read(section: &Section<'_>) -> Option<Self> {
        let text = |key| section.require(key, "a text")?.text().map(str::to_owned);
        Some(Self {
            tab: text("tab")?,
            title: text("title")?,
            what: text("what")?,
            path: text("path")?,
            machine: section.text("machine").map(str::to_owned),
            standard: section.text("standard").map(str::to_owned),
        })
    }
}

/// Files that are not listed, but named by others: surfaces, calibrations, readings of instruments.
const NAMED_BY_OTHERS: [&str; 4] = ["stl", "json", "rtl", "rta"];

/// Whether the ending of a file is one that [`kind_of`] knows, or that of files that others name.
fn has_use(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    ending.is_some_and(|ending| {
        ending == "toml" || kind_by_ending(&ending).is_some() || NAMED_BY_OTHERS.contains(&&*ending)
    })
}

/// What a file is, by its ending and, for TOML, by its sections; none if the page has no use for it.
fn kind_of(path: &Path) -> Option<FileKind> {
    let ending = path.extension()?.to_string_lossy().to_ascii_lowercase();
    match &*ending {
        "toml" => Some(kind_of_toml(&path.to_string_lossy(), &beginning_of(path)?)),
        ending => kind_by_ending(ending),
    }
}

fn kind_by_ending(ending: &str) -> Option<FileKind> {
    Some(match ending {
        "csv" | "qif" => FileKind::Readings,
        "mpf" | "spf" | "nc" | "ngc" | "h" | "tap" | "eia" | "gcode" => FileKind::Program,
        "cls" | "apt" | "cl" => FileKind::Cl,
        _ => return None,
    })
}

/// As much of a file as tells its kind.
fn beginning_of(path: &Path) -> Option<String> {
    let mut bytes = Vec::new();
    fs::File::open(path).ok()?.take(LOOKED_AT).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

fn kind_of_toml(name: &str, text: &str) -> FileKind {
    let begins = |words: &[&str]| {
        text.lines().any(|line| words.iter().any(|word| line.trim_start().starts_with(word)))
    };
    match () {
        () if name.ends_with(".setup.toml") => FileKind::Setup,
        () if begins(&["[machine]"]) => FileKind::Machine,
        // Before studies: it names a test piece, too.
        () if begins(&["[cmm]", "[measured]"]) => FileKind::Measured,
        () if begins(&["test_piece", "[holes]"]) => FileKind::Study,
        () if begins(&["[instrument.", "[[path]]"]) => FileKind::Campaign,
        // After studies, which may compare with a paper.
        () if begins(&["[compare]"]) => FileKind::Comparison,
        () if begins(&["[control]"]) && begins(&["[readings."]) => FileKind::Rtcp,
        () if begins(&["[report]"]) => FileKind::Heading,
        () if begins(&["[determination]"]) => FileKind::Certificate,
        () if begins(&["[layer]"]) && begins(&["[wall]"]) => FileKind::Blank,
        () if begins(&["[correction]"]) && begins(&["[control]"]) => FileKind::Live,
        // A part that is cut: after the plan of a live run, which has a `part` of its own.
        () if begins(&["part ="]) && begins(&["program ="]) => FileKind::Study,
        () => FileKind::Other,
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
