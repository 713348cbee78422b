//! Finds in the sources what the page tells: judged tests by name, and stated differences.

use crate::{errata_in, shop};
use std::fs;
use std::path::{Path, PathBuf};

/// A test whose name says who the judge is.
pub struct JudgedTest {
    /// Its file, from the root of the repository.
    pub file: String,
    /// law_…, oracle_… or paper_….
    pub name: String,
    /// The first sentence of its comment, or else its name in words.
    pub sentence: String,
}

/// The tests of all crates that laws, other programs or papers judge; without this folder.
pub fn judged_tests() -> Vec<JudgedTest> {
    let tests = rust_files().into_iter().filter(|p| p.contains("/tests/"));
    tests.flat_map(|path| tests_in(&path)).collect()
}

/// The errata that stand beside the word DIFFERENCE in the sources and in docs/model.md.
pub fn differences() -> Vec<String> {
    let files = rust_files().into_iter().chain(["docs/model.md".to_owned()]);
    let texts = files.map(|path| read(&path));
    texts.flat_map(|text| differences_in(&text)).collect()
}

fn read(path: &str) -> String {
    fs::read_to_string(shop::root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// From each DIFFERENCE to the end of its paragraph.
fn differences_in(text: &str) -> Vec<String> {
    let empty = |line: &&str| line.trim_matches(['/', '!', ' ']).is_empty();
    let lines: Vec<&str> = text.lines().collect();
    let starts = (0..lines.len()).filter(|i| lines[*i].contains("DIFFERENCE"));
    let paragraphs = starts.map(|i| {
        let paragraph = lines[i..].iter().take(4).take_while(|l| !empty(l)).copied();
        paragraph.collect::<Vec<_>>().join(" ")
    });
    paragraphs.flat_map(|p| errata_in(&p)).collect()
}

/// All Rust files of the crates, from the root of the repository, by name, without this folder.
fn rust_files() -> Vec<String> {
    let mut found = Vec::new();
    collect(&shop::root().join("crates"), &mut found);
    let root = shop::root();
    let relative = |path: &PathBuf| {
        let parts = path.strip_prefix(&root).expect("below the root").components();
        parts.map(|c| c.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
    };
    let mut names: Vec<String> = found.iter().map(relative).collect();
    names.retain(|name| !name.starts_with("crates/trueaxis/tests/papers/"));
    names.sort();
    names
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).expect("a folder").flatten().map(|e| e.path()) {
        if path.is_dir() && path.file_name().is_some_and(|n| n != "target") {
            collect(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

fn tests_in(path: &str) -> Vec<JudgedTest> {
    let text = read(path);
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let mut tests = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let Some(name) = line.strip_prefix("fn ").and_then(|l| l.split('(').next()) else {
            continue;
        };
        if ["law_", "oracle_", "paper_"].iter().any(|prefix| name.starts_with(prefix)) {
            let sentence = comment_above(&lines[..i]).unwrap_or_else(|| in_words(name));
            tests.push(JudgedTest { file: path.to_owned(), name: name.to_owned(), sentence });
        }
    }
    tests
}

/// The first sentence of the `///` lines that end right above, attributes between them aside.
fn comment_above(lines: &[&str]) -> Option<String> {
    let above = lines.iter().rev().take_while(|l| l.starts_with("///") || l.starts_with("#["));
    let mut comment: Vec<&str> = above.filter_map(|l| l.strip_prefix("///")).collect();
    comment.reverse();
    let text = comment.iter().flat_map(|l| l.split_whitespace()).collect::<Vec<_>>().join(" ");
    // The point of `et al.` ends no sentence.
    let end = text.match_indices(". ").map(|(i, _)| i).find(|i| !text[..*i].ends_with("et al"));
    let sentence = text[..end.unwrap_or(text.len())].trim_end_matches('.');
    (!sentence.is_empty()).then(|| sentence.to_owned())
}

/// `law_small_errors_superpose` says: Small errors superpose.
fn in_words(name: &str) -> String {
    let words = name.split('_').skip(1).collect::<Vec<_>>().join(" ");
    let mut letters = words.chars();
    let first = letters.next().map_or(String::new(), |c| c.to_uppercase().to_string());
    first + letters.as_str()
}
