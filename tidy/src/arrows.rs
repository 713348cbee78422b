//! Which source file uses which: read from `use` lines and paths, so that the order of crates and rooms is
//! a rule and not a habit.

use crate::before_tests;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Modules of one crate: the path of a module, such as `["plan", "program"]`, and its source.
pub type Modules = BTreeMap<Vec<String>, Source>;

/// One source file.
#[derive(Debug, Clone)]
pub struct Source {
    /// Its path as it is shown.
    pub file: String,
    /// Its lines without those of its tests.
    pub lines: usize,
    /// Paths below `crate` that it uses, outside tests and comments.
    pub uses: Vec<Vec<String>>,
    /// Names that it hands on from a child (`pub use child::Name`), with the path of the child.
    hands_on: BTreeMap<String, Vec<String>>,
}

/// The module that a source file below `src` is.
pub fn module_of(relative: &Path) -> Vec<String> {
    let mut parts: Vec<String> = relative
        .with_extension("")
        .components()
        .map(|c| c.as_os_str().to_string_lossy().into_owned())
        .collect();
    if parts.last().is_some_and(|last| last == "lib" || last == "main") {
        parts.pop();
    }
    parts
}

/// Reads what a source file uses of its own crate.
pub fn read_source(file: &str, module: &[String], text: &str) -> Source {
    let code = before_tests(text);
    let plain: String = code
        .lines()
        .filter(|l| !l.trim_start().starts_with("//"))
        .fold(String::new(), |all, l| all + l + "\n");
    let mut source = Source {
        file: file.to_owned(),
        lines: code.lines().count(),
        uses: Vec::new(),
        hands_on: BTreeMap::new(),
    };
    for path in paths(&plain) {
        if let Some(absolute) = absolute(module, &path.segments) {
            source.uses.push(absolute);
        }
        if let (true, Some((name, child))) = (path.is_public, path.segments.split_last())
            && child.first().is_some_and(|c| c != "crate" && c != "super")
        {
            let full = module.iter().chain(child).cloned().collect();
            source.hands_on.insert(name.clone(), full);
        }
    }
    source
}

struct UsedPath {
    segments: Vec<String>,
    is_public: bool,
}

/// All paths of `use` declarations, and all others that begin with `crate::` or `super::`.
fn paths(code: &str) -> Vec<UsedPath> {
    let mut found = Vec::new();
    let mut rest = String::new();
    let mut text = code;
    while let Some(at) = find_use(text) {
        rest.push_str(&text[..at]);
        let Some(end) = text[at..].find(';') else { break };
        let declaration = &text[at..at + end];
        let is_public = declaration.starts_with("pub");
        let tree = declaration.split_once("use ").map_or("", |(_, tree)| tree);
        expand(tree, &mut Vec::new(), &mut |segments| {
            found.push(UsedPath { segments: segments.to_vec(), is_public });
        });
        text = &text[at + end..];
    }
    rest.push_str(text);
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    for word in rest.split(|c| !is_name(c)) {
        if word.starts_with("crate::") || word.starts_with("super::") {
            let segments = word.split("::").filter(|s| !s.is_empty()).map(str::to_owned).collect();
            found.push(UsedPath { segments, is_public: false });
        }
    }
    found
}

/// Where the next `use` declaration of a line begins, with its visibility.
fn find_use(text: &str) -> Option<usize> {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let trimmed = line.trim_start();
        let bare = trimmed.strip_prefix("pub").map_or(trimmed, |rest| {
            let rest = rest.trim_start();
            match rest.strip_prefix('(').and_then(|r| r.split_once(')')) {
                Some((_, rest)) => rest.trim_start(),
                None => rest,
            }
        });
        if bare.starts_with("use ") {
            return Some(at + line.len() - trimmed.len());
        }
        at += line.len();
    }
    None
}

/// The paths of a tree such as `a::{b, c::d as e}`.
fn expand(tree: &str, prefix: &mut Vec<String>, found: &mut dyn FnMut(&[String])) {
    let tree = tree.trim();
    let (own, inner) = match tree.find('{') {
        Some(at) => (&tree[..at], tree.rfind('}').map(|end| &tree[at + 1..end])),
        None => (tree, None),
    };
    let own = own.split(" as ").next().unwrap_or(own);
    let before = prefix.len();
    prefix.extend(
        own.split("::").map(str::trim).filter(|s| !s.is_empty() && *s != "self").map(str::to_owned),
    );
    match inner {
        None => found(prefix),
        Some(inner) => parts(inner).iter().for_each(|part| expand(part, prefix, found)),
    }
    prefix.truncate(before);
}

/// The parts of a list between commas, braces kept together.
fn parts(list: &str) -> Vec<String> {
    let mut all = vec![String::new()];
    let mut depth = 0;
    for c in list.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                all.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(last) = all.last_mut() {
            last.push(c);
        }
    }
    all.retain(|part| !part.trim().is_empty());
    all
}

/// A path below `crate`, if it is one.
fn absolute(module: &[String], segments: &[String]) -> Option<Vec<String>> {
    match segments.first()?.as_str() {
        "crate" => Some(segments[1..].to_vec()),
        "super" => {
            let up = segments.iter().take_while(|s| *s == "super").count();
            let base = &module[..module.len().checked_sub(up)?];
            Some(base.iter().chain(&segments[up..]).cloned().collect())
        }
        _ => None,
    }
}

/// The file in which a path is defined: the longest module of it, or the child that hands the name on.
fn defined_in(modules: &Modules, path: &[String]) -> Option<Vec<String>> {
    let length = (0..=path.len()).rev().find(|n| modules.contains_key(&path[..*n]))?;
    let module = path[..length].to_vec();
    let child = path.get(length).and_then(|name| modules[&module].hands_on.get(name));
    match child {
        Some(child) if child != &module && modules.contains_key(child) => {
            let rest = [child.as_slice(), &path[length..]].concat();
            defined_in(modules, &rest)
        }
        _ => Some(module),
    }
}

/// Who uses whom, by modules of one crate.
pub fn arrows(modules: &Modules) -> BTreeMap<Vec<String>, BTreeSet<Vec<String>>> {
    let mut all = BTreeMap::new();
    for (module, source) in modules {
        let to = source.uses.iter().filter_map(|path| defined_in(modules, path));
        let to: BTreeSet<Vec<String>> = to.filter(|to| to != module).collect();
        all.insert(module.clone(), to);
    }
    all
}

/// Groups of files each of which reaches every other, with more than one member.
pub fn circles(modules: &Modules) -> Vec<Vec<Vec<String>>> {
    let arrows = arrows(modules);
    let reached: BTreeMap<&Vec<String>, BTreeSet<Vec<String>>> =
        arrows.keys().map(|from| (from, reach(&arrows, from))).collect();
    let mut circles: Vec<Vec<Vec<String>>> = Vec::new();
    for from in arrows.keys() {
        if circles.iter().flatten().any(|m| m == from) {
            continue;
        }
        let with = |to: &&Vec<String>| reached[from].contains(*to) && reached[*to].contains(from);
        let circle: Vec<Vec<String>> = arrows.keys().filter(with).cloned().collect();
        if circle.len() > 1 {
            circles.push(circle);
        }
    }
    circles
}

fn reach(
    arrows: &BTreeMap<Vec<String>, BTreeSet<Vec<String>>>,
    from: &Vec<String>,
) -> BTreeSet<Vec<String>> {
    let mut seen = BTreeSet::new();
    let mut open = vec![from];
    while let Some(next) = open.pop() {
        for to in arrows.get(next).into_iter().flatten() {
            if seen.insert(to.clone()) {
                open.push(to);
            }
        }
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crate_of(files: &[(&str, &str)]) -> Modules {
        let read = |(file, text): &(&str, &str)| {
            let module = module_of(Path::new(file));
            (module.clone(), read_source(file, &module, text))
        };
        files.iter().map(read).collect()
    }

    #[test]
    fn names_are_followed_through_what_hands_them_on() {
        let modules = crate_of(&[
            ("lib.rs", "pub mod plan;\n"),
            ("plan.rs", "mod file;\nmod choose;\npub use file::{Limit, Plan};\n"),
            ("plan/file.rs", "pub struct Plan;\n"),
            (
                "plan/choose.rs",
                "use super::{Plan, file::Limit};\nfn f() { crate::plan::choose::g() }\n",
            ),
        ]);
        let name = |text: &str| text.split('/').map(str::to_owned).collect::<Vec<_>>();
        let arrows = arrows(&modules);
        assert_eq!(arrows[&name("plan/choose")], BTreeSet::from([name("plan/file")]));
        assert!(circles(&modules).is_empty());
    }

    #[test]
    fn a_circle_of_three_is_found() {
        let modules = crate_of(&[
            ("a.rs", "use crate::b::B;"),
            ("b.rs", "pub(crate) use crate::c::{self, C};"),
            ("c.rs", "fn f() -> super::a::A {}\n#[cfg(test)]\nmod tests { use crate::d::D; }"),
            ("d.rs", "// use crate::a::A;\n"),
        ]);
        assert_eq!(circles(&modules).len(), 1);
        assert_eq!(circles(&modules)[0].len(), 3);
    }
}
