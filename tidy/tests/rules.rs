//! Each rule is one function that lists its violations; the test shows all of them at once.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use tidy::arrows::{Modules, arrows, circles, module_of, read_source};
use tidy::before_tests;
use tidy::units::without_unit;

const MAX_LINES_BEFORE_TESTS: usize = 600;
const MAX_LINES_OF_A_CRATE: usize = 20_000;
const MAX_LINES_OF_A_CIRCLE: usize = 1_500;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Every file of the project below a folder, without build outputs, version control and the virtual environment `v` of the README.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        let skipped = ["target", ".git", "node_modules", "fuzz", "v"];
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

fn shown(path: &Path) -> String {
    path.strip_prefix(root()).unwrap_or(path).display().to_string()
}

fn long_files() -> Vec<String> {
    let long = |text: &str| before_tests(text).lines().count();
    let too_long = |(_, text): &&(PathBuf, String)| long(text) > MAX_LINES_BEFORE_TESTS;
    let line = |(p, text): &(PathBuf, String)| format!("{}: {} lines", shown(p), long(text));
    sources().iter().filter(too_long).map(line).collect()
}

/// The first line of a source says what is in it.
fn without_head() -> Vec<String> {
    let bare = sources().into_iter().filter(|(_, text)| !text.starts_with("//! "));
    bare.map(|(p, _)| format!("{}: begin with a line `//! What is in here.`", shown(&p))).collect()
}

fn vague_names() -> Vec<String> {
    let vague = ["utils", "util", "helpers", "helper", "common", "misc", "core"];
    let named = |p: &&PathBuf| p.file_stem().is_some_and(|s| vague.iter().any(|v| s == *v));
    let all: Vec<_> = sources().into_iter().map(|(p, _)| p).collect();
    all.iter().filter(named).map(|p| format!("{}: name what is in it", shown(p))).collect()
}

/// Types that are copied.
const COPIED: [&str; 9] =
    ["Position", "Vec3", "Point", "Stand", "Move", "Command", "Frame", "Target", "Node"];

/// `|mut place: Position| …`, called twice with one local, changes this local with optimisation: rustc 1.95 hands a
/// large argument of a closure on without a copy (rust-lang/rust#155241).
fn closures_with_changed_arguments() -> Vec<String> {
    let copied = |argument: &str| {
        argument.split_once(": ").is_some_and(|(_, name)| COPIED.contains(&name.trim()))
    };
    let mut found = Vec::new();
    for (path, text) in sources() {
        for (number, line) in text.lines().enumerate() {
            let arguments = line.split_once("|mut ").and_then(|(_, rest)| rest.split_once('|'));
            if arguments.is_some_and(|(all, _)| all.split(',').any(copied)) {
                found.push(format!("{}:{}: take it by reference", shown(&path), number + 1));
            }
        }
    }
    found
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

/// Every `unsafe` has its reason in the lines before it.
fn unsafe_without_reason() -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in sources() {
        let lines: Vec<&str> = text.lines().collect();
        for (i, line) in lines.iter().enumerate() {
            let code = line.split("//").next().unwrap_or("");
            let is_block = code.contains("unsafe {") || code.contains("unsafe impl");
            let reason = (i.saturating_sub(3)..=i).any(|k| lines[k].contains("// SAFETY: "));
            if is_block && !reason {
                found.push(format!("{}:{}: why is it sound? // SAFETY: …", shown(&path), i + 1));
            }
        }
    }
    found
}

/// Public numbers of the crates whose unit is neither in their name nor in their doc comment.
fn numbers_without_unit() -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in sources() {
        for (line, name) in without_unit(before_tests(&text)) {
            found.push(format!(
                "{}:{line}: `{name}`: end the name with its unit, or its doc comment with “Unit: mm.”",
                shown(&path)
            ));
        }
    }
    found
}

/// Equations of docs/model.md that the code cites must exist there.
fn lost_equations() -> Vec<String> {
    let model = read(&root().join("docs/model.md"));
    let mut lost = Vec::new();
    let mut seen = BTreeSet::new();
    for line in model.lines().filter(|line| line.starts_with("**(")) {
        let number = line[3..].split(')').next().unwrap_or_default();
        if !seen.insert(number) {
            lost.push(format!("docs/model.md: ({number}) stands twice"));
        }
    }
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
const CRATES: [(&str, &[&str]); 35] = [
    ("trueaxis-input", &[]),
    ("trueaxis-geometry", &[]),
    ("trueaxis-form", &["geometry"]),
    ("trueaxis-cut", &["geometry"]),
    ("trueaxis-schemaless", &[]),
    ("trueaxis-report", &["schemaless"]),
    ("trueaxis-machine", &["input", "geometry"]),
    ("trueaxis-moves", &[]),
    ("trueaxis-contour", &[]),
    ("trueaxis-cycles", &["contour"]),
    ("trueaxis-blocks", &["input", "moves"]),
    ("trueaxis-files", &["input", "machine"]),
    ("trueaxis-nc", &["blocks", "input", "contour", "cycles", "moves"]),
    ("trueaxis-writer", &["nc"]),
    ("trueaxis-cl", &["input", "nc"]),
    ("trueaxis-templates", &["report"]),
    ("trueaxis-part", &["input", "form", "geometry"]),
    ("trueaxis-standards", &["input", "form", "geometry", "report"]),
    ("trueaxis-thermal", &["input", "geometry", "machine", "report"]),
    ("trueaxis-motion", &["cut", "input", "geometry", "machine", "nc", "report"]),
    ("trueaxis-measure", &["input", "geometry", "machine", "motion", "report"]),
    ("trueaxis-condition", &["input", "geometry", "machine", "measure", "report", "standards"]),
    (
        "trueaxis-calibrate",
        &["cl", "input", "geometry", "machine", "measure", "nc", "motion", "report", "writer"],
    ),
    (
        "trueaxis-rtcp",
        &[
            "calibrate",
            "input",
            "geometry",
            "machine",
            "measure",
            "nc",
            "motion",
            "report",
            "writer",
        ],
    ),
    (
        "trueaxis-predict",
        &["cut", "input", "geometry", "machine", "nc", "part", "motion", "report"],
    ),
    (
        "trueaxis-correct",
        &["cl", "input", "geometry", "machine", "nc", "part", "motion", "predict", "report"],
    ),
    ("trueaxis-post", &["cl", "input", "geometry", "machine", "nc", "motion", "writer"]),
    (
        "trueaxis",
        &[
            "post",
            "input",
            "cut",
            "files",
            "form",
            "geometry",
            "machine",
            "nc",
            "part",
            "standards",
            "thermal",
            "motion",
            "measure",
            "calibrate",
            "rtcp",
            "cl",
            "condition",
            "predict",
            "correct",
            "report",
            "writer",
        ],
    ),
    ("trueaxis-words", &["report"]),
    ("trueaxis-paper", &["condition", "input", "report"]),
    ("trueaxis-study", &["", "report"]),
    ("trueaxis-python", &["", "paper", "study", "words"]),
    ("trueaxis-live", &["", "report"]),
    ("trueaxis-serve", &["", "live", "paper", "templates", "words"]),
    ("trueaxis-cli", &["", "live", "paper", "serve", "study", "templates", "words"]),
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

/// Where the disk, sockets and clocks may be used.
const PLACES: [(&[&str], &[&str]); 3] = [
    (
        &["std::fs"],
        &[
            "crates/trueaxis-files/src/",
            "crates/trueaxis-serve/src/project.rs",
            "crates/trueaxis-live/src/store/",
        ],
    ),
    (
        &["std::net"],
        &[
            "crates/trueaxis-serve/src/",
            "crates/trueaxis-cli/src/serve.rs",
            "crates/trueaxis-live/src/",
        ],
    ),
    (
        &["SystemTime", "Instant::now"],
        &[
            "crates/trueaxis-live/src/clock.rs",
            "crates/trueaxis-live/src/focas/wire.rs",
            "crates/trueaxis-live/src/mock/server.rs",
        ],
    ),
];

/// The disk belongs to the files of the facade, to the list of files of serve and to the journal of live; sockets to serve and live; clocks to live: elsewhere the same input gives the same answer at any time.
fn disk_sockets_and_clocks() -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in sources() {
        let name = shown(&path);
        let code = before_tests(&text).lines().filter(|l| !l.trim_start().starts_with("//"));
        let code: Vec<&str> = code.collect();
        for (words, places) in PLACES {
            let used = words.iter().find(|w| code.iter().any(|line| line.contains(*w)));
            if let Some(word) = used.filter(|_| !places.iter().any(|p| name.starts_with(p))) {
                found.push(format!("{name}: {word} is allowed in {places:?} only"));
            }
        }
    }
    found
}

/// The rooms of a crate from below; a room uses only those before it.
const ROOMS: [(&str, &[&str]); 6] = [
    ("trueaxis-measure", &["instruments", "unknowns", "measure", "report"]),
    ("trueaxis-calibrate", &["plan", "identify", "report"]),
    ("trueaxis-rtcp", &["rtcp", "report"]),
    ("trueaxis-predict", &["predict", "report"]),
    ("trueaxis-correct", &["compensate", "report"]),
    ("trueaxis", &["files", "verify", "explain", "report", "questions", "schemas"]),
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

/// Phrases that engineers do not use in this sense, each with the usual term of the field.
const DIALECT: [(&str, &str); 59] = [
    ("told", "stated, reported, named, given"),
    ("tell apart", "separate, distinguish"),
    ("tells apart", "separates, distinguishes"),
    ("tell them apart", "separate them"),
    ("tells them apart", "separates them"),
    ("tells how", "shows how, describes how"),
    ("will tell", "will determine, will show"),
    ("tell most", "give the most information"),
    ("blame", "error budget, contribution of each error"),
    ("mend", "correct, fix"),
    ("mended", "corrected, fixed"),
    ("behind", "after, beyond, inserted after"),
    ("hidden error", "unobservable error"),
    ("hidden errors", "unobservable errors"),
    ("hidden combination", "unobservable combination"),
    ("grave", "critical"),
    ("trouble", "issue, problem"),
    ("troubles", "issues, problems"),
    ("left over", "residual, remaining"),
    ("what is left", "residual error, what remains"),
    ("is left of", "remains of"),
    ("seed of chance", "random seed"),
    ("is due here", "is expected here"),
    ("out of luck", "not possible"),
    ("document 000", "Wu et al. 2022"),
    ("documents 000", "Wu et al. 2022"),
    ("document 001", "Zhang et al. 2019"),
    ("document 002", "Jiang et al."),
    ("document 003", "Zhang et al. 2023"),
    ("document 004", "Lei and Hsu 2003"),
    ("at hand", "available"),
    ("taken off", "subtracted"),
    ("takes off", "subtracts"),
    ("looked at", "checked, examined"),
    ("anew", "again"),
    ("turns round", "reverses"),
    ("turned round", "reversed"),
    ("somebody", "an independent source, a user"),
    ("nobody", "no one, not known, not measured"),
    ("machine as it is", "actual machine"),
    ("really there", "actual"),
    ("as it really is", "actual"),
    ("honest", "realistic, reliable"),
    ("from people", "from users"),
    ("for people", "in text output, for users"),
    ("in the shop knows", "is known in practice"),
    ("feels", "is subject to, sees"),
    ("goes by", "moves by, changes by"),
    ("has gone by", "has moved by"),
    ("sought", "unknown, to be determined"),
    ("beside it", "for comparison, in addition"),
    ("beside them", "for comparison, in addition"),
    ("shown beside", "shown for comparison"),
    ("how sure", "with what uncertainty, with what confidence"),
    ("in kind", "in the manner of"),
    ("will do", "is sufficient"),
    ("has it", "as in"),
    ("put right", "corrected"),
    ("who is to", "which error, which contribution"),
];

/// Kinds of files whose words are checked: of sources their comments and strings (`prose_of_source`).
const PROSE: [&str; 3] = ["md", "rs", "ts"];

/// Not checked: the first is generated from texts in `crates/trueaxis/tests/papers` and from doc
/// comments of tests, the second names the modules of the code, the third is the list itself.
const UNCHECKED: [&str; 3] = ["docs/real-programs.md", "docs/validation.md", "tidy/tests/rules.rs"];

/// The prose of a Markdown text: without fenced code and without what stands between backquotes.
fn prose_of_markdown(text: &str) -> String {
    let (mut prose, mut fenced) = (String::new(), false);
    for line in text.lines() {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        if !fence && !fenced {
            line.split('`').step_by(2).for_each(|piece| prose = format!("{prose}{piece} "));
        }
        prose.push('\n');
    }
    prose
}

/// The comments and strings of a Rust or TypeScript source. A string without a blank is a key or a
/// name, and what a string has in braces is code.
fn prose_of_source(text: &str) -> String {
    let (mut prose, mut rest) = (String::new(), text);
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").unwrap_or(rest.len())
        } else if first == '"' || first == '`' {
            string_length(rest, first)
        } else if rest.starts_with("'\"'") || rest.starts_with("'`'") {
            3
        } else {
            prose.push(if first == '\n' { '\n' } else { ' ' });
            rest = &rest[first.len_utf8()..];
            continue;
        };
        let (piece, after) = rest.split_at(length);
        let key = !first.is_ascii_punctuation() || (first != '/' && !piece.contains(' '));
        let mut depth = 0_usize;
        for c in piece.chars() {
            depth += usize::from(c == '{' && first != '/');
            let code = key || depth > 0;
            prose.push(if code && c != '\n' { ' ' } else { c });
            depth -= usize::from(c == '}' && depth > 0);
        }
        rest = after;
    }
    prose
}

/// Bytes of a string with its quotes; a backslash hides the character after it.
fn string_length(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        if c == quote && !escaped {
            return at + c.len_utf8();
        }
        escaped = c == '\\' && !escaped;
    }
    text.len()
}

/// The words of the prose of a file in lower case, each with its line.
fn words(path: &Path) -> Vec<(String, usize)> {
    let markdown = has_extension(path, &["md"]);
    let prose = if markdown { prose_of_markdown } else { prose_of_source }(&read(path));
    let mut found = Vec::new();
    for (i, line) in prose.lines().enumerate() {
        let parts = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        found.extend(parts.filter(|w| !w.is_empty()).map(|w| (w.to_lowercase(), i + 1)));
    }
    found
}

fn dialect() -> Vec<String> {
    let mut found = Vec::new();
    for path in files(&root()).into_iter().filter(|p| has_extension(p, &PROSE)) {
        let name = shown(&path);
        if UNCHECKED.iter().any(|u| name == *u) {
            continue;
        }
        let words = words(&path);
        for (phrase, usual) in DIALECT {
            let parts: Vec<&str> = phrase.split(' ').collect();
            let same = |w: &&[(String, usize)]| w.iter().zip(&parts).all(|(a, b)| a.0 == *b);
            let line = |w: &[(String, usize)]| format!("{name}:{}: “{phrase}”: {usual}", w[0].1);
            found.extend(words.windows(parts.len()).filter(same).map(line));
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
fn prose_is_parted_from_code() {
    let source =
        "let told = 1; // a comment\nsay(\"{told} of two \\\" errors\"); put(\"blame\", '\"');\n";
    let found = prose_of_source(source);
    let lines: Vec<Vec<&str>> = found.lines().map(|l| l.split_whitespace().collect()).collect();
    assert_eq!(lines[0], ["//", "a", "comment"]);
    assert_eq!(lines[1], ["\"", "of", "two", "\\\"", "errors\""]);
    assert_eq!(
        prose_of_markdown("one `two` three\n```\nfour\n```\n").split_whitespace().count(),
        2
    );
}

#[test]
fn house_rules() {
    let rules: [(&str, Rule); 18] = [
        ("files are short", long_files),
        ("every source says what is in it", without_head),
        ("names say what is inside", vague_names),
        ("no closure changes its argument", closures_with_changed_arguments),
        ("no panic without `// why:`", unexplained_panics),
        ("no `unsafe` without `// SAFETY:`", unsafe_without_reason),
        ("public numbers name their unit", numbers_without_unit),
        ("cited equations exist, each once", lost_equations),
        ("no place of a developer's machine", foreign_places),
        ("machines name their source", machines_without_source),
        ("crates use what is below them", forbidden_arrows),
        ("rooms use what is below them", upward_uses),
        ("files, sockets and clocks have one place", disk_sockets_and_clocks),
        ("crates are small", large_crates),
        ("circles are small", large_circles),
        ("the words are the field's", dialect),
        ("decisions are listed", unlisted_decisions),
        ("examples have a README", unexplained_examples),
    ];
    let broken: Vec<String> = rules
        .iter()
        .flat_map(|(rule, find)| find().into_iter().map(move |v| format!("{rule}: {v}")))
        .collect();
    assert!(broken.is_empty(), "\n{}", broken.join("\n"));
}
