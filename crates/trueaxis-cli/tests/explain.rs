//! The pages of `trueaxis explain` against the sources: every code has a section, every section a
//! code, and the messages that the pages show are messages of the program.

mod command;

use command::{root, trueaxis};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Words of the sources that look like codes: names of shapes, files, HTTP headers, choices.
const OTHER_WORDS: &str = "monte-carlo latin-hypercube opc-ua sign-and-encrypt part-lost program-line datum-asked datum-cleared datum-refused ask-hold ramp-down ta-heartbeat tool-length points-on-circle points-on-cylinder points-on-line points-on-plane points-on-sphere ball-centre chi-square gross-readings ball-bar cyclic-error iso14253-1 lateral-play reversal-spike scale-mismatch servo-mismatch target-count cache-control content-security-policy content-type \
    counter-clockwise cross-origin-opener-policy cross-origin-resource-policy cut-piece ecmc-md \
    follows-xyz four-hits four-hits-corrected gbt17421-2 head-head iso230-1 iso230-10 iso230-2 iso230-3 iso230-4 iso230-6 iso230-7 laser-angle \
    laser-line least-squares length-tracker linuxcnc-trims no-referrer no-store not-a-knot on-axis on-cone \
    over-fitted probe-ball referrer-policy ring-corrected ring-hits surface-hits z-datum z-datum-corrected same-origin sans-serif save-made set-error set-up simulation-at \
    compensate-adapt compensate-program compensate-tables compensate-targets compensate-values measure-check measure-sheet new-machine readings-columns readings-text \
    simulation-block simulation-curves simulation-path simulation-source simulation-stock small-angle stages-contradict instruments-contradict below-noise set-up-contradicted table-table \
    test-piece three-axis head-table touch-probe-ball touch-probe-face turns-with-axis utf-8 what-if w-offset \
    x-content-type-options x-rot x-rot-point x-www-browser x-www-form-urlencoded \
    axis-limit inverse-time kebab-case serve-socket-request xdg-open xyzac-trt-kins xyzbc-trt-kins y-rot y-rot-point z-offset z-rot-point numbers";

/// Codes of one word where no call shows that they are codes: matched to a kind of issue or passed
/// to a closure.
const SINGLE_WORDS: [&str; 2] = ["collision", "gouge"];

/// What stands before a code of one word.
const CALLS: [&str; 9] = [
    "error(",
    "warn(",
    "note(",
    "fault(",
    "refuse(",
    "unusable(",
    "code:",
    "Refusal::new(",
    "warn_once(",
];

/// A text of a source with what stands before it, blanks left out.
struct Literal {
    before: String,
    text: String,
}

/// All string literals of a source before its unit tests.
fn literals(source: &str) -> Vec<Literal> {
    let source = source.split("#[cfg(test)]").next().unwrap_or_default();
    let chars: Vec<char> = source.chars().collect();
    let (mut found, mut before, mut i) = (Vec::new(), String::new(), 0);
    while i < chars.len() {
        let rest = &chars[i..];
        match rest {
            ['/', '/', ..] => i += rest.iter().take_while(|c| **c != '\n').count(),
            ['\'', '"', '\'', ..] => i += 3,
            ['\'', '\\', '"', '\'', ..] => i += 4,
            ['"', ..] => {
                let (text, length) = quoted(&rest[1..]);
                found.push(Literal { before: before.clone(), text });
                before.clear();
                i += length + 1;
            }
            [c, ..] => {
                if !c.is_whitespace() {
                    before.push(*c);
                }
                i += 1;
            }
            [] => break,
        }
    }
    found
}

/// The text up to the closing quote as the compiler takes it, and its length in the source.
fn quoted(chars: &[char]) -> (String, usize) {
    let (mut text, mut i) = (String::new(), 0);
    while i < chars.len() && chars[i] != '"' {
        if chars[i] != '\\' {
            text.push(chars[i]);
            i += 1;
            continue;
        }
        match chars.get(i + 1) {
            // A line that goes on: its indent does not count.
            Some('\n') => {
                let blanks = chars[i + 1..].iter().take_while(|c| c.is_whitespace()).count();
                i += 1 + blanks;
            }
            Some('n') => {
                text.push('\n');
                i += 2;
            }
            Some(c) => {
                text.push(*c);
                i += 2;
            }
            None => break,
        }
    }
    (text, i + 1)
}

fn sources(folder: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(fs::read_to_string(&path).expect("a source"));
        }
    }
}

/// Every literal of the libraries and the program.
fn all_literals() -> Vec<Literal> {
    let mut texts = Vec::new();
    for entry in fs::read_dir(root().join("crates")).expect("crates").flatten() {
        sources(&entry.path().join("src"), &mut texts);
    }
    texts.iter().flat_map(|text| literals(text)).collect()
}

fn is_code(literal: &Literal) -> bool {
    let parts: Vec<&str> = literal.text.split('-').collect();
    let plain = |part: &&str| {
        !part.is_empty() && part.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit())
    };
    let begins = literal.text.starts_with(|c: char| c.is_ascii_lowercase());
    if !begins || !parts.iter().all(plain) || OTHER_WORDS.split(' ').any(|w| w == literal.text) {
        return false;
    }
    // Names of documents: `named_schema::<PoseRowsDocument>("pose-rows")`.
    if literal.before.contains("named_schema::<") {
        return false;
    }
    let before = literal.before.trim_end_matches(|c: char| c.is_ascii_digit() || c == ',');
    let called = CALLS.iter().any(|call| before.ends_with(call)) && !before.ends_with("#[error(");
    parts.len() > 1 || called || SINGLE_WORDS.contains(&literal.text.as_str())
}

fn codes_of(literals: &[Literal]) -> BTreeSet<String> {
    let mut codes: BTreeSet<String> =
        literals.iter().filter(|l| is_code(l)).map(|l| l.text.clone()).collect();
    // Standard output itself fails: this one is written by hand.
    let written = literals.iter().filter_map(|l| l.text.strip_prefix("error[")?.split_once("]: "));
    codes.extend(written.map(|(code, _)| code.to_owned()).filter(|code| !code.contains('{')));
    codes
}

/// The sections of the pages by their codes.
fn sections() -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(root().join("docs/diagnostics")).expect("pages").flatten() {
        let page = fs::read_to_string(entry.path()).expect("a page");
        for section in page.split("\n## ").skip(1) {
            let (code, text) = section.split_once('\n').expect("a heading");
            let old = found.insert(code.to_owned(), text.to_owned());
            assert!(old.is_none(), "{code} has two sections");
        }
    }
    found
}

#[test]
fn every_code_has_a_page_and_every_page_a_code() {
    let codes = codes_of(&all_literals());
    let pages: BTreeSet<String> = sections().into_keys().collect();
    let bare: Vec<_> = codes.difference(&pages).collect();
    let dead: Vec<_> = pages.difference(&codes).collect();
    assert!(
        bare.is_empty(),
        "no section in docs/diagnostics (or a word for OTHER_WORDS): {bare:?}"
    );
    assert!(dead.is_empty(), "sections of docs/diagnostics that no source has: {dead:?}");
    assert!(codes.len() > 500, "{}: were the sources read?", codes.len());
}

/// Whether a text is what a format string prints: its fixed parts follow each other.
fn prints(format: &str, text: &str) -> bool {
    let (format, mut parts, mut rest) = (format.replace("{{", "\u{1}"), Vec::new(), String::new());
    let mut inside = false;
    for c in format.chars() {
        match c {
            '{' => {
                parts.push(std::mem::take(&mut rest));
                inside = true;
            }
            '}' => inside = false,
            '\u{1}' => rest.push('{'),
            c if !inside => rest.push(c),
            _ => {}
        }
    }
    if parts.iter().chain([&rest]).flat_map(|p| p.chars()).filter(|c| c.is_alphabetic()).count() < 4
    {
        return false;
    }
    if parts.is_empty() {
        return rest == text;
    }
    let Some(mut left) = text.strip_prefix(parts[0].as_str()) else { return false };
    for part in &parts[1..] {
        let Some(at) = left.find(part.as_str()) else { return false };
        left = &left[at + part.len()..];
    }
    left.ends_with(rest.as_str())
}

#[test]
fn the_messages_of_the_pages_are_those_of_the_program() {
    let literals = all_literals();
    let mut foreign = Vec::new();
    for (code, text) in sections() {
        for severity in ["error", "warning", "note"] {
            let begin = format!("    {severity}[{code}]: ");
            for line in text.lines() {
                let Some(message) = line.strip_prefix(&begin) else { continue };
                let ours = |l: &&Literal| prints(&l.text, message) || prints(&l.text, line.trim());
                if !literals.iter().any(|l| ours(&l)) {
                    foreign.push(line.trim().to_owned());
                }
            }
        }
    }
    assert!(foreign.is_empty(), "no source prints what a page shows:\n{}", foreign.join("\n"));
}

#[test]
fn a_code_is_explained() {
    let ran = trueaxis(&["explain", "table-too-short"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    assert!(ran.out.starts_with("table-too-short\n\nAn error table does not cover"), "{}", ran.out);
    assert!(ran.out.contains("**To do:**"), "{}", ran.out);
    // As it is copied from a message.
    assert_eq!(trueaxis(&["explain", "[table-too-short]"]).out, ran.out);
    let json = trueaxis(&["explain", "table-too-short", "--format", "json"]).json();
    assert_eq!(json["schema"], "trueaxis/explain/1");
    assert_eq!(json["code"], "table-too-short");
    assert_eq!(json["title"], "An error table does not cover the travel of its axis.");
    assert!(ran.out.contains(json["text"].as_str().expect("a text")), "{json}");
}

#[test]
fn all_codes_are_listed() {
    let ran = trueaxis(&["explain"]);
    assert_eq!(ran.status, 0);
    for code in sections().keys() {
        assert!(ran.out.contains(&format!("\n  {code} ")), "{code} is not listed");
    }
    let json = trueaxis(&["explain", "--format", "json"]).json();
    assert_eq!(json["codes"].as_array().map(Vec::len), Some(sections().len()));
}

#[test]
fn an_unknown_code_gives_its_neighbours() {
    let ran = trueaxis(&["explain", "tabel-to-short"]);
    assert_eq!((ran.status, ran.out.as_str()), (2, ""));
    assert!(ran.err.contains("hint: similar codes are table-too-short"), "{}", ran.err);
}
