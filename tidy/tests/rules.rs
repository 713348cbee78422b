//! Each rule is one function that lists its violations; the test shows all of them at once.

use std::fs;
use std::path::{Path, PathBuf};
use tidy::arrows::{Modules, arrows, circles, module_of, read_source};

const MAX_LINES_BEFORE_TESTS: usize = 600;
const MAX_LINES_OF_A_CRATE: usize = 20_000;
const MAX_LINES_OF_A_CIRCLE: usize = 1_500;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Every file of the project below a folder, without build outputs and version control.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        let skipped = ["target", ".git", "node_modules", "fuzz"];
        if path.is_dir() && !skipped.iter().any(|s| name == *s) {
            found.extend(files(&path));
        } else if path.is_file() {
            found.push(path);
        }
    }
    found
}

fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    path.extension().is_some_and(|e| extensions.iter().any(|x| e == *x))
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_default()
}

/// Library and program sources, without tests and benches.
fn sources() -> Vec<(PathBuf, String)> {
    let all = files(&root().join("crates"));
    let inner = all.into_iter().filter(|p| has_extension(p, &["rs"]));
    let inner = inner.filter(|p| p.components().any(|c| c.as_os_str() == "src"));
    inner.map(|p| (p.clone(), read(&p))).collect()
}

/// The part of a source before its unit tests.
fn before_tests(text: &str) -> &str {
    text.split("#[cfg(test)]").next().unwrap_or(text)
}

fn shown(path: &Path) -> String {
    path.strip_prefix(root()).unwrap_or(path).display().to_string()
}

fn long_files() -> Vec<String> {
    let long = |text: &str| before_tests(text).lines().count();
    let too_long = |(_, text): &&(PathBuf, String)| long(text) > MAX_LINES_BEFORE_TESTS;
    let line = |(p, text): &(PathBuf, String)| format!("{}: {} lines", shown(p), long(text));
    sources().iter().filter(too_long).map(line).collect()
}

fn vague_names() -> Vec<String> {
    let vague = ["utils", "util", "helpers", "helper", "common", "misc", "core"];
    let named = |p: &&PathBuf| p.file_stem().is_some_and(|s| vague.iter().any(|v| s == *v));
    let all: Vec<_> = sources().into_iter().map(|(p, _)| p).collect();
    all.iter().filter(named).map(|p| format!("{}: name what is in it", shown(p))).collect()
}

fn unexplained_panics() -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in sources() {
        let lines: Vec<&str> = before_tests(&text).lines().collect();
        for (i, line) in lines.iter().enumerate() {
            let code = line.split("//").next().unwrap_or("");
            let panics = [".unwrap()", ".expect(", "panic!(", "unreachable!("];
            let explained = (i.saturating_sub(2)..=i).any(|k| lines[k].contains("// why:"));
            let doc = line.trim_start().starts_with("//");
            if !doc && !explained && panics.iter().any(|p| code.contains(p)) {
                found.push(format!("{}:{}: {}", shown(&path), i + 1, line.trim()));
            }
        }
    }
    found
}

/// Equations of docs/model.md that the code cites must exist there.
fn lost_equations() -> Vec<String> {
    let model = read(&root().join("docs/model.md"));
    let mut lost = Vec::new();
    for (path, text) in sources() {
        for (i, line) in text.lines().enumerate() {
            let Some(at) = line.find("docs/model.md eq. ") else { continue };
            let rest = &line[at + "docs/model.md eq. ".len()..];
            let numbers = rest.split(|c: char| !c.is_ascii_digit()).filter(|n| !n.is_empty());
            for number in numbers.take(3) {
                if !model.contains(&format!("**({number})**")) {
                    lost.push(format!("{}:{}: no equation ({number})", shown(&path), i + 1));
                }
            }
        }
    }
    lost
}

/// Traces of the machine that somebody worked on.
fn foreign_places() -> Vec<String> {
    // Written in two halves, so that this file does not break its own rule.
    let words = [["/wo", "rk/"], ["/ro", "ot/"], ["/ho", "me/"]].map(|halves| halves.concat());
    let kinds = ["rs", "md", "toml", "csv", "py", "json", "sh", "html"];
    let mut found = Vec::new();
    for path in files(&root()).into_iter().filter(|p| has_extension(p, &kinds)) {
        let text = read(&path);
        for word in words.iter().filter(|w| text.contains(*w)) {
            found.push(format!("{}: contains {word}", shown(&path)));
        }
    }
    found
}

fn machines_without_source() -> Vec<String> {
    let all = files(&root().join("machines")).into_iter();
    let machines = all.filter(|p| p.file_name().is_some_and(|n| n == "machine.toml"));
    let bare = machines.filter(|p| !read(p).contains("\nsource = \""));
    bare.map(|p| format!("{}: say where its numbers come from", shown(&p))).collect()
}

/// Lines of Rust in the sources of a crate; a larger one has a wall in the wrong place.
fn large_crates() -> Vec<String> {
    let mut found = Vec::new();
    for (name, _) in CRATES {
        let folder = root().join("crates").join(name).join("src");
        let lines: usize = files(&folder).iter().map(|p| read(p).lines().count()).sum();
        if lines > MAX_LINES_OF_A_CRATE {
            found.push(format!("{name}: {lines} lines, at most {MAX_LINES_OF_A_CRATE}"));
        }
    }
    found
}

/// Every crate, and which of the others it may use. An arrow that is not here needs a decision record.
const CRATES: [(&str, &[&str]); 13] = [
    ("trueaxis-input", &[]),
    ("trueaxis-geometry", &[]),
    ("trueaxis-report", &[]),
    ("trueaxis-machine", &["input", "geometry"]),
    ("trueaxis-nc", &["input"]),
    ("trueaxis-part", &["input", "geometry"]),
    ("trueaxis-standards", &["input", "geometry", "part", "report"]),
    ("trueaxis-motion", &["input", "geometry", "machine", "nc", "report"]),
    ("trueaxis-calibrate", &["input", "geometry", "machine", "nc", "motion", "report"]),
    ("trueaxis-correct", &["input", "geometry", "machine", "nc", "part", "motion", "report"]),
    (
        "trueaxis",
        &[
            "input",
            "geometry",
            "machine",
            "nc",
            "part",
            "standards",
            "motion",
            "calibrate",
            "correct",
            "report",
        ],
    ),
    ("trueaxis-serve", &[""]),
    ("trueaxis-cli", &["", "serve"]),
];

/// A crate uses only those that are named for it, and none is missing from the list.
fn forbidden_arrows() -> Vec<String> {
    let mut found = Vec::new();
    for folder in fs::read_dir(root().join("crates")).expect("crates").flatten() {
        let name = folder.file_name().to_string_lossy().into_owned();
        let Some((_, allowed)) = CRATES.iter().find(|(known, _)| *known == name) else {
            found.push(format!("{name}: a new crate needs a decision record and its arrows here"));
            continue;
        };
        let manifest = read(&folder.path().join("Cargo.toml"));
        let dependencies = manifest.split("[dev-dependencies]").next().unwrap_or("");
        for line in dependencies.lines().filter(|l| l.starts_with("trueaxis")) {
            let other = line.split(['.', ' ', '=']).next().unwrap_or("");
            let short = other.strip_prefix("trueaxis").unwrap_or(other).trim_start_matches('-');
            if !allowed.contains(&short) {
                found.push(format!("{name} uses {other}"));
            }
        }
    }
    found
}

/// Only the facade touches the disk, only serve opens sockets, nothing in the library reads a clock.
fn disk_sockets_and_clocks() -> Vec<String> {
    let allowed = |path: &str| match path {
        _ if path.starts_with("crates/trueaxis-cli")
            || path.starts_with("crates/trueaxis-serve") =>
        {
            true
        }
        _ => {
            path == "crates/trueaxis/src/files.rs" || path.starts_with("crates/trueaxis/src/files/")
        }
    };
    let mut found = Vec::new();
    for (path, text) in sources() {
        let name = shown(&path);
        for word in ["std::fs", "std::net", "SystemTime", "Instant::now"] {
            let used = before_tests(&text)
                .lines()
                .any(|l| !l.trim_start().starts_with("//") && l.contains(word));
            if used && !allowed(&name) {
                found.push(format!(
                    "{name}: {word} belongs to the facade's files, to serve or to the command"
                ));
            }
        }
    }
    found
}

/// The rooms of a crate from below; a room uses only those before it.
const ROOMS: [(&str, &[&str]); 3] = [
    ("trueaxis-calibrate", &["instruments", "unknowns", "measure", "plan", "identify", "report"]),
    ("trueaxis-correct", &["predict", "compensate", "report"]),
    ("trueaxis", &["files", "verify", "report"]),
];

fn modules_of(crate_name: &str) -> Modules {
    let folder = root().join("crates").join(crate_name).join("src");
    let sources = files(&folder).into_iter().filter(|p| has_extension(p, &["rs"]));
    sources
        .map(|path| {
            let module = module_of(path.strip_prefix(&folder).unwrap_or(&path));
            (module.clone(), read_source(&shown(&path), &module, &read(&path)))
        })
        .collect()
}

/// No room uses one that stands above it.
fn upward_uses() -> Vec<String> {
    let mut found = Vec::new();
    for (name, rooms) in ROOMS {
        let floor =
            |module: &[String]| rooms.iter().position(|r| module.first().is_some_and(|m| m == r));
        let modules = modules_of(name);
        for (module, uses) in arrows(&modules) {
            let own = floor(&module);
            if own.is_none() && !module.is_empty() {
                found.push(format!("{}: no room of {name} is called so", modules[&module].file));
            }
            for to in uses.iter().filter(|to| own.is_some() && floor(to) > own) {
                found.push(format!(
                    "{} uses {}, which stands above it",
                    modules[&module].file, modules[to].file
                ));
            }
        }
    }
    found
}

/// Files that use each other in a circle are one file to whoever reads them.
fn large_circles() -> Vec<String> {
    let mut found = Vec::new();
    for (name, _) in CRATES {
        let modules = modules_of(name);
        for circle in circles(&modules) {
            let lines: usize = circle.iter().map(|m| modules[m].lines).sum();
            if lines > MAX_LINES_OF_A_CIRCLE {
                let members: Vec<_> = circle.iter().map(|m| modules[m].file.as_str()).collect();
                found.push(format!("{lines} lines use each other: {}", members.join(", ")));
            }
        }
    }
    found
}

/// Lists what breaks the rule.
type Rule = fn() -> Vec<String>;

#[test]
fn house_rules() {
    let rules: [(&str, Rule); 11] = [
        ("files are short", long_files),
        ("names say what is inside", vague_names),
        ("no panic without `// why:`", unexplained_panics),
        ("cited equations exist", lost_equations),
        ("no place of a developer's machine", foreign_places),
        ("machines name their source", machines_without_source),
        ("crates use what is below them", forbidden_arrows),
        ("rooms use what is below them", upward_uses),
        ("files, sockets and clocks have one place", disk_sockets_and_clocks),
        ("crates are small", large_crates),
        ("circles are small", large_circles),
    ];
    let broken: Vec<String> = rules
        .iter()
        .flat_map(|(rule, find)| find().into_iter().map(move |v| format!("{rule}: {v}")))
        .collect();
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}
