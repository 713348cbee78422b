//! The campaign file that `measure` and `identify` read after a choice of poses: the text of the campaign, in
//! which the chosen poses stand for the candidates.
//!
//! The lines and comments of the campaign stay as they are. Changed are only the places of its files (the new file
//! stands in another folder), the tables of readings (which are still to be made), and what was chosen from.

use super::Plan;
use std::fmt::Write as _;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};
use trueaxis_machine::describe::replacement::quoted;
use trueaxis_measure::measure::readings_file;

/// The name of the file.
pub const READY_CAMPAIGN: &str = "campaign.toml";
/// The folder next to it where the readings belong.
pub const READINGS_FOLDER: &str = "readings";
/// The sections that the chosen poses replace.
const CHOSEN_FROM: [&str; 3] = ["candidates", "limit", "want"];

/// The path of the chosen poses as the new campaign names it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChosenTable<'a> {
    /// The table of poses, in the folder of the campaign.
    pub file: &'a str,
    /// The instrument that reads at them.
    pub instrument: &'a str,
    /// How long the machine stands before a reading, s.
    pub dwell_s: f64,
    /// How far an axis goes beyond a station, as the campaign writes it.
    pub overrun: Option<&'a str>,
}

/// Some bytes of a text, and what stands there instead.
type Edit = (Range<usize>, String);

/// The campaign of a plan with chosen poses; `moved` names a file of the campaign from the folder of the new one.
///
/// # Errors
/// In words, why the text cannot be edited.
pub fn ready_campaign(
    text: &str,
    plan: &Plan,
    chosen: Option<&ChosenTable<'_>>,
    moved: &dyn Fn(&str) -> String,
) -> Result<String, String> {
    let root = parsed(text)?;
    let mut edits = moved_files(root.get_ref(), moved);
    edits.extend(readings(text, root.get_ref(), plan));
    let mut added = String::new();
    if let Some(chosen) = chosen {
        edits.extend(sections(text, root.get_ref()));
        match inline_list(text, root.get_ref().get("path")) {
            Some(at) => edits.push((at..at, format!("{{ {} }}, ", path_lines(chosen).join(", ")))),
            None => added = format!("\n[[path]]\n{}\n", path_lines(chosen).join("\n")),
        }
    }
    edits.sort_by_key(|(range, _)| range.start);
    let mut ready = heading(plan);
    let mut at = 0;
    for (range, new) in edits {
        // What lies in a section that is removed needs no change.
        let Some(kept) = text.get(at..range.start) else { continue };
        ready += kept;
        ready += &new;
        at = range.end;
    }
    ready += text.get(at..).unwrap_or_default();
    if !ready.ends_with('\n') {
        ready.push('\n');
    }
    ready += &added;
    parsed(&ready).map(|_| ())?;
    Ok(ready)
}

/// What the file is, and what to do with it.
fn heading(plan: &Plan) -> String {
    let name = plan.campaign.path.file_name().unwrap_or_default().to_string_lossy();
    let mut text = format!("# written by trueaxis plan from {name}: the poses are chosen\n");
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "#   trueaxis measure {READY_CAMPAIGN} -o {READINGS_FOLDER}    virtual readings; or put your own tables there\n\
         #   trueaxis identify {READY_CAMPAIGN}\n"
    );
    text
}

fn parsed(text: &str) -> Result<Spanned<DeTable<'_>>, String> {
    DeTable::parse(text).map_err(|error| error.message().to_owned())
}

fn path_lines(chosen: &ChosenTable<'_>) -> Vec<String> {
    let mut lines = vec![
        "name = \"chosen\"".to_owned(),
        "kind = \"table\"".to_owned(),
        format!("instrument = {}", quoted(chosen.instrument)),
        format!("table = {}", quoted(chosen.file)),
        format!("dwell = \"{} s\"", chosen.dwell_s),
    ];
    lines.extend(chosen.overrun.map(|overrun| format!("overrun = {}", quoted(overrun))));
    lines
}

/// Where the first entry of a list in brackets begins; none for `[[path]]` sections.
fn inline_list(text: &str, list: Option<&Spanned<DeValue<'_>>>) -> Option<usize> {
    let span = list.filter(|l| l.get_ref().is_array())?.span();
    let value = text.get(span.clone())?;
    (value.starts_with('[') && !value.starts_with("[[")).then_some(span.start + 1)
}

/// The files that the campaign reads, as they are named from the new folder.
fn moved_files(root: &DeTable<'_>, moved: &dyn Fn(&str) -> String) -> Vec<Edit> {
    let of = |item: Option<&Spanned<DeValue<'_>>>| {
        let item = item?;
        Some((item.span(), quoted(&moved(item.get_ref().as_str()?))))
    };
    let within = |section: &str, key: &str| root.get(section)?.get_ref().get(key);
    let mut edits: Vec<Edit> =
        ["machine", "prior"].iter().filter_map(|k| of(root.get(*k))).collect();
    edits.extend(of(within("truth", "machine")));
    edits.extend(of(within("disturb", "temperature_log")));
    let paths = root.get("path").and_then(|p| p.get_ref().as_array());
    edits.extend(paths.into_iter().flatten().filter_map(|p| of(p.get_ref().get("table"))));
    edits
}

/// Every table of readings in the folder of readings, under the name that `measure` gives it.
fn readings(text: &str, root: &DeTable<'_>, plan: &Plan) -> Vec<Edit> {
    let inside = |name: &str| quoted(&format!("{READINGS_FOLDER}/{name}"));
    let mut edits = Vec::new();
    for instrument in &plan.campaign.instruments {
        let own = root.get("instrument").and_then(|i| i.get_ref().get(instrument.name.as_str()));
        let Some(own) = own.and_then(|own| own.get_ref().as_table()) else { continue };
        let file = inside(&readings_file(&instrument.name));
        match (own.get("readings"), own.get_key_value("kind")) {
            (Some(readings), _) => edits.push((readings.span(), file)),
            (None, Some((kind, _))) => {
                let at = kind.span().start;
                edits.push((at..at, before_key(text, at, &format!("readings = {file}"))));
            }
            (None, None) => {}
        }
    }
    let stages = root.get("stage").and_then(|s| s.get_ref().as_array());
    for stage in stages.into_iter().flatten() {
        for (section, key) in [("zero", "readings"), ("ball", "points")] {
            let table = stage.get_ref().get(section).and_then(|s| s.get_ref().get(key));
            let Some((span, table)) = table.and_then(|t| Some((t.span(), t.get_ref().as_str()?)))
            else {
                continue;
            };
            let name = std::path::Path::new(table).file_name().unwrap_or_default();
            edits.push((span, inside(&name.to_string_lossy())));
        }
    }
    edits
}

/// An entry before a key: on a line of its own with the same beginning, or before it in braces.
fn before_key(text: &str, at: usize, entry: &str) -> String {
    let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let beginning = &text[line..at];
    match beginning.contains(['{', ',']) {
        true => format!("{entry}, "),
        false => format!("{entry}\n{beginning}"),
    }
}

/// The sections that the choice replaces, with the comments before them.
fn sections(text: &str, root: &DeTable<'_>) -> Vec<Edit> {
    let mut values = Vec::new();
    table_values(text, root, &mut values);
    let mut edits: Vec<Edit> = Vec::new();
    // Where the section that is removed begins; where the comments before this line begin.
    let (mut gone, mut comments, mut at) = (None, None, 0);
    for line in text.split_inclusive('\n') {
        let (from, end) = (at, at + line.len());
        at = end;
        if values.iter().any(|v: &Range<usize>| v.start < from && from < v.end) {
            continue;
        }
        let bare = line.trim();
        let is_heading = bare.starts_with('[');
        let is_chosen = CHOSEN_FROM.contains(&first_name(bare).as_str());
        if is_heading {
            let begins = comments.unwrap_or(from);
            if let Some(start) = gone.take() {
                edits.push((start..begins, String::new()));
            }
            gone = is_chosen.then_some(begins);
        } else if is_chosen && gone.is_none() {
            // An entry `limit = { … }` or `limit.minutes = …`, over several lines of text where it goes on.
            let value =
                values.iter().filter(|v| (from..end).contains(&v.start)).map(|v| v.end).max();
            let rest = value.and_then(|v| text[v..].find('\n').map(|n| v + n + 1));
            edits.push((from..rest.unwrap_or(end).max(end), String::new()));
        }
        comments = match bare.starts_with('#') {
            true => comments.or(Some(from)),
            false => None,
        };
    }
    if let Some(start) = gone {
        edits.push((start..text.len(), String::new()));
    }
    edits
}

/// The first name of a heading or of the key of an entry.
fn first_name(line: &str) -> String {
    let inner = line.trim_start_matches(['[', ' ', '\t']);
    let name = inner.split(['.', '=', ']']).next().unwrap_or_default();
    name.replace([' ', '\t', '"', '\''], "")
}

/// The spans of all values that are no sections.
fn table_values(text: &str, table: &DeTable<'_>, spans: &mut Vec<Range<usize>>) {
    for (_, value) in table {
        let is_inline = |with: char| text[value.span()].starts_with(with);
        match value.get_ref() {
            DeValue::Table(inner) => {
                spans.extend(is_inline('{').then(|| value.span()));
                table_values(text, inner, spans);
            }
            DeValue::Array(list) => {
                let sections = list.iter().all(|v| v.get_ref().is_table());
                spans.extend((!sections).then(|| value.span()));
                for inner in list {
                    match inner.get_ref() {
                        DeValue::Table(table) => table_values(text, table, spans),
                        _ => spans.push(inner.span()),
                    }
                }
            }
            _ => spans.push(value.span()),
        }
    }
}
