//! `trueaxis explain`: what a diagnostic means, why it comes and what to do.
//!
//! The pages are `docs/diagnostics/*.md`, one per room of the program, with one section per code;
//! `tests/explain.rs` holds them against the sources.

use crate::output::{Answer, Format, Outcome, show, tell};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;

/// In the order of the work: what everything shares first.
const PAGES: [&str; 12] = [
    include_str!("../../../docs/diagnostics/input.md"),
    include_str!("../../../docs/diagnostics/machine-file.md"),
    include_str!("../../../docs/diagnostics/temperatures.md"),
    include_str!("../../../docs/diagnostics/nc.md"),
    include_str!("../../../docs/diagnostics/cutter-locations.md"),
    include_str!("../../../docs/diagnostics/simulate.md"),
    include_str!("../../../docs/diagnostics/predict.md"),
    include_str!("../../../docs/diagnostics/measure-plan.md"),
    include_str!("../../../docs/diagnostics/identify.md"),
    include_str!("../../../docs/diagnostics/compensate.md"),
    include_str!("../../../docs/diagnostics/verify.md"),
    include_str!("../../../docs/diagnostics/serve.md"),
];

/// So many codes are proposed for one that is not known.
const MOST_PROPOSED: usize = 5;

/// Which code to explain.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis explain table-too-short
  trueaxis explain
  trueaxis explain arc-does-not-fit --format json

The code is the word in brackets of a message: error[table-too-short]: …
Without a code all of them are listed, with one line each.
Exit status: 0 explained, 2 there is no such code.")]
pub struct Arguments {
    /// The code; without one all codes are listed
    code: Option<String>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// One code and what is written about it.
#[derive(Clone, Copy)]
struct Entry<'p> {
    code: &'p str,
    /// The heading of its page.
    room: &'p str,
    /// The section without its heading.
    text: &'p str,
}

impl Entry<'_> {
    /// The first paragraph, on one line.
    fn title(&self) -> String {
        let first = self.text.split("\n\n").next().unwrap_or_default();
        first.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    fn json(&self) -> Value {
        json!({
            "schema": "trueaxis/explain/1",
            "code": self.code,
            "title": self.title(),
            "text": self.text,
        })
    }
}

pub fn run(arguments: &Arguments) -> Outcome {
    let all = entries();
    let Some(code) = &arguments.code else { return show(&list(&all, arguments.format)) };
    // People copy the brackets, too.
    let wanted = code.trim_matches(|c: char| !c.is_ascii_lowercase());
    let Some(entry) = all.iter().find(|e| e.code == wanted || e.code == code) else {
        let near = nearest(code, &all).join(", ");
        tell(&format!("error: no diagnostic has the code `{code}`\n  hint: near to it are {near}"));
        return Outcome::Unusable;
    };
    show(&match arguments.format {
        Format::Text => Answer::Text(format!("{}\n\n{}\n", entry.code, entry.text)),
        Format::Json => Answer::Json(entry.json()),
    })
}

fn entries() -> Vec<Entry<'static>> {
    let mut all = Vec::new();
    for page in PAGES {
        let mut sections = page.split("\n## ");
        let heading = sections.next().unwrap_or_default();
        let room = heading.lines().next().unwrap_or_default().trim_start_matches("# ");
        for section in sections {
            let (code, text) = section.split_once('\n').unwrap_or((section, ""));
            all.push(Entry { code, room, text: text.trim_matches('\n') });
        }
    }
    all
}

fn list(all: &[Entry<'_>], format: Format) -> Answer {
    if format == Format::Json {
        let one = |e: &Entry<'_>| json!({ "code": e.code, "room": e.room, "title": e.title() });
        let codes: Vec<Value> = all.iter().map(one).collect();
        return Answer::Json(json!({ "schema": "trueaxis/explain/1", "codes": codes }));
    }
    let width = all.iter().map(|e| e.code.len()).max().unwrap_or(0);
    let (mut text, mut room) = (String::new(), "");
    for entry in all {
        if entry.room != room {
            let gap = if room.is_empty() { "" } else { "\n" };
            room = entry.room;
            let _ = writeln!(text, "{gap}{room}");
        }
        let _ = writeln!(text, "  {:width$}  {}", entry.code, entry.title());
    }
    Answer::Text(text)
}

/// The codes that need the fewest changes, the nearest first.
fn nearest<'p>(wanted: &str, all: &[Entry<'p>]) -> Vec<&'p str> {
    let mut ranked: Vec<(usize, &str)> =
        all.iter().map(|e| (edit_distance(wanted, e.code), e.code)).collect();
    ranked.sort_unstable();
    ranked.into_iter().take(MOST_PROPOSED).map(|(_, code)| code).collect()
}

/// Levenshtein's distance: letters put in, taken out or changed.
fn edit_distance(a: &str, b: &str) -> usize {
    // An argument may be of any length, a code is short.
    let a: Vec<char> = a.chars().take(100).collect();
    let mut row: Vec<usize> = (0..=a.len()).collect();
    for (i, letter) in b.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (k, other) in a.iter().enumerate() {
            let changed = diagonal + usize::from(*other != letter);
            diagonal = row[k + 1];
            row[k + 1] = changed.min(row[k] + 1).min(diagonal + 1);
        }
    }
    row[a.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_of_words() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("same", "same"), 0);
    }

    #[test]
    fn each_section_has_a_title() {
        for entry in entries() {
            assert!(entry.title().ends_with('.'), "{}: {}", entry.code, entry.title());
            assert!(entry.title().len() > 10, "{}", entry.code);
        }
    }
}
