//! Each rule is one function that lists its violations; the test shows all of them at once.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const MAX_LINES_BEFORE_TESTS: usize = 600;
const MAX_CRATES: usize = 14;

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

fn crates_beyond_the_plan() -> Vec<String> {
    let crates: BTreeSet<_> =
        fs::read_dir(root().join("crates")).expect("crates").flatten().map(|e| e.path()).collect();
    if crates.len() <= MAX_CRATES {
        return Vec::new();
    }
    vec![format!("{} crates: a ninth needs a decision record", crates.len())]
}

/// Machine, part and nc never see each other; nothing but the loop reads files.
fn forbidden_arrows() -> Vec<String> {
    let nouns = ["trueaxis-machine", "trueaxis-part", "trueaxis-nc", "trueaxis-geometry"];
    let mut found = Vec::new();
    for noun in nouns {
        let manifest = read(&root().join("crates").join(noun).join("Cargo.toml"));
        let dependencies = manifest.split("[dev-dependencies]").next().unwrap_or("").to_owned();
        for other in nouns.iter().filter(|o| **o != noun && **o != "trueaxis-geometry") {
            if dependencies.contains(&format!("\n{other}")) {
                found.push(format!("{noun} depends on {other}"));
            }
        }
    }
    for (path, text) in sources() {
        let noun = nouns.iter().any(|n| path.components().any(|c| c.as_os_str() == *n));
        let reads = ["std::fs", "std::net", "SystemTime", "Instant::now"];
        if noun && reads.iter().any(|r| before_tests(&text).contains(r)) {
            found.push(format!("{}: a noun reads no file, clock or socket", shown(&path)));
        }
    }
    found
}

/// `docs/decisions/README.md` names each decision with its title.
fn unlisted_decisions() -> Vec<String> {
    let folder = root().join("docs/decisions");
    let index = read(&folder.join("README.md"));
    let mut found = Vec::new();
    for path in files(&folder) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let text = read(&path);
        let Some((_, title)) = text.lines().next().and_then(|l| l.split_once(". ")) else {
            continue;
        };
        if !index.lines().any(|l| l.contains(&format!("({name})")) && l.contains(title)) {
            found.push(format!("{}: not in docs/decisions/README.md", shown(&path)));
        }
    }
    found
}

/// Every example says what it asks, where its data come from and one number to check by hand.
fn unexplained_examples() -> Vec<String> {
    let folders = fs::read_dir(root().join("examples")).expect("examples").flatten();
    let readme = |folder: PathBuf| folder.join("README.md");
    let asked = folders.map(|e| e.path()).filter(|p| p.is_dir()).map(readme);
    let bare = asked.filter(|p| !read(p).contains("**By hand:**"));
    bare.map(|p| format!("{}: say it, with one number checked by hand", shown(&p))).collect()
}

/// Lists what breaks the rule.
type Rule = fn() -> Vec<String>;

#[test]
fn house_rules() {
    let rules: [(&str, Rule); 10] = [
        ("files are short", long_files),
        ("names say what is inside", vague_names),
        ("no panic without `// why:`", unexplained_panics),
        ("cited equations exist", lost_equations),
        ("no place of a developer's machine", foreign_places),
        ("machines name their source", machines_without_source),
        ("eight crates", crates_beyond_the_plan),
        ("arrows point one way", forbidden_arrows),
        ("decisions are listed", unlisted_decisions),
        ("examples have a README", unexplained_examples),
    ];
    let broken: Vec<String> = rules
        .iter()
        .flat_map(|(rule, find)| find().into_iter().map(move |v| format!("{rule}: {v}")))
        .collect();
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}
