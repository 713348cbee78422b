//! What a diagnostic means, why it comes and what to do.
//!
//! The pages are `docs/diagnostics/*.md`, one per part of the program, with one section per code.
//!
//! ```
//! use trueaxis::explain::explanations;
//! let all = explanations();
//! let found = all.iter().find(|e| e.code == "table-too-short").unwrap();
//! assert_eq!(found.title(), "An error table does not cover the travel of its axis.");
//! ```

use serde::Serialize;
use serde_json::Value;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Report, Section, Table, document};

/// In the order of the work: what everything shares first.
const PAGES: [&str; 14] = [
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
    include_str!("../../../docs/diagnostics/live.md"),
    include_str!("../../../docs/diagnostics/verify.md"),
    include_str!("../../../docs/diagnostics/serve.md"),
    include_str!("../../../docs/diagnostics/python.md"),
];

/// So many codes are proposed for one that is not known.
const MOST_PROPOSED: usize = 5;

/// One code and its section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// The code, such as `table-too-short`.
    pub code: &'static str,
    /// The heading of its page.
    pub page: &'static str,
    /// The section without its heading, Markdown.
    pub text: &'static str,
}

impl Explanation {
    /// The first paragraph, on one line.
    pub fn title(&self) -> String {
        let first = self.text.split("\n\n").next().unwrap_or_default();
        first.split_whitespace().collect::<Vec<_>>().join(" ")
    }
}

/// All codes in the order of their pages.
pub fn explanations() -> Vec<Explanation> {
    let mut all = Vec::new();
    for page in PAGES {
        let mut sections = page.split("\n## ");
        let heading = sections.next().unwrap_or_default();
        let page = heading.lines().next().unwrap_or_default().trim_start_matches("# ");
        for section in sections {
            let (code, text) = section.split_once('\n').unwrap_or((section, ""));
            all.push(Explanation { code, page, text: text.trim_matches('\n') });
        }
    }
    all
}

/// The codes that need the fewest changes, the nearest first.
pub fn nearest(wanted: &str, all: &[Explanation]) -> Vec<&'static str> {
    let mut ranked: Vec<(usize, &str)> =
        all.iter().map(|e| (edit_distance(wanted, e.code), e.code)).collect();
    ranked.sort_unstable();
    ranked.into_iter().take(MOST_PROPOSED).map(|(_, code)| code).collect()
}

/// Levenshtein's distance: letters inserted, deleted or replaced.
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

/// The meaning of one diagnostic.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExplainDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/explain/1"))]
    pub schema: &'static str,
    /// The code.
    pub code: &'static str,
    /// Its meaning in one sentence.
    pub title: String,
    /// Its meaning, its cause and what to do, Markdown.
    pub text: &'static str,
}

/// The codes of all diagnostics.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExplainListDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/explain/1"))]
    pub schema: &'static str,
    /// All codes.
    pub codes: Vec<CodeEntry>,
}

/// One code.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CodeEntry {
    /// The code.
    pub code: &'static str,
    /// The part of the program that reports it.
    pub room: &'static str,
    /// Its meaning in one sentence.
    pub title: String,
}

/// The document `trueaxis/explain/1` of one code.
pub fn explanation_json(e: &Explanation) -> Value {
    let (schema, title) = ("trueaxis/explain/1", e.title());
    document(&ExplainDocument { schema, code: e.code, title, text: e.text })
}

/// The document `trueaxis/explain/1` of all codes.
pub fn codes_json(all: &[Explanation]) -> Value {
    let codes = all.iter().map(|e| CodeEntry { code: e.code, room: e.page, title: e.title() });
    document(&ExplainListDocument { schema: "trueaxis/explain/1", codes: codes.collect() })
}

/// The list of all codes, one line each.
pub fn codes_report(all: &[Explanation]) -> Report<'static> {
    let pages = all.chunk_by(|a, b| a.page == b.page).map(|page| {
        let rows = page.iter().map(|e| (e.code, e.title()));
        let table = Table::pairs(rows).most_on_terminal(usize::MAX);
        Section::new(page.first().map_or("", |e| e.page)).table(table)
    });
    Report::new("Codes of diagnostics").sections(pages)
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
        for entry in explanations() {
            assert!(entry.title().ends_with('.'), "{}: {}", entry.code, entry.title());
            assert!(entry.title().len() > 10, "{}", entry.code);
        }
    }
}
