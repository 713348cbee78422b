//! A table before it is read: what separates its columns, where its headings stand, what they say.

use super::headings::{Heading, direction_named, split_unit, understand, unit_in_cell};
use super::mapping::{Mapping, Source, UsedAs};
use super::table::{cells, find_headings, rows};

/// What may separate columns; of equally good ones the first.
const SEPARATORS: [char; 5] = [';', '\t', ',', '|', ' '];
/// So many lines tell the separator.
const LINES: usize = 400;
/// Lines between headings and readings, such as units.
const MOST_BELOW: usize = 5;
/// Values of a column that are shown, and words that are listed.
const VALUES: usize = 4;
const WORDS: usize = 8;

/// A table as it stands in its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    /// What separates its columns; a space stands for any number of them.
    pub separator: char,
    /// The line of the headings, counted from 1; none where the first row is a reading.
    pub heading_line: Option<usize>,
    /// The line of the headings, or of the first reading.
    pub first_line: usize,
    /// Rows between the headings and the first reading.
    pub rows_below_headings: usize,
    /// Rows of readings.
    pub readings: usize,
    /// Its columns.
    pub columns: Vec<LookColumn>,
}

/// A column of it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LookColumn {
    /// Its heading; empty where there is none.
    pub heading: String,
    /// What it is, by its heading or the mapping file: `target`, `up_1`.
    pub role: Option<String>,
    /// Its unit, by its heading, a row below it, or the mapping file.
    pub unit: Option<&'static str>,
    /// Its sign is changed.
    pub negate: bool,
    /// Its first values.
    pub values: Vec<String>,
    /// Its words, or its values where they are few: each with what it is taken for (`up`, `cw`).
    pub words: Vec<(String, Option<String>)>,
}

/// What is known of a table beforehand.
#[derive(Debug, Clone, Copy, Default)]
pub struct LookAs<'m> {
    /// What separates the columns.
    pub separator: Option<char>,
    /// The line of the headings, counted from 1; 0 where there are none.
    pub heading_line: Option<usize>,
    /// What the mapping file says. One with blocks or equal steps is not shown as columns.
    pub mapping: Option<&'m Mapping>,
}

/// Looks at a table; none where it has no row of at least two cells.
///
/// ```
/// use trueaxis_input::foreign::{LookAs, look};
/// let found = look("Bank 7\nPos;dx\n0,5;1,25\n", &LookAs::default()).unwrap();
/// assert_eq!((found.separator, found.heading_line, found.readings), (';', Some(2), 1));
/// assert_eq!(found.columns[1].values, ["1,25"]);
/// ```
pub fn look(text: &str, known: &LookAs<'_>) -> Option<Look> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mapping = known.mapping.filter(|mapping| mapping.is_plain());
    let skipped = mapping.map_or(0, |mapping| mapping.blocks[0].skip_rows);
    let ends = |line: &str| {
        let mark = mapping.and_then(Mapping::until);
        mark.is_some_and(|mark| line.trim_start().starts_with(mark.trim()))
    };
    let rest = rows(text).skip_while(|(line, _)| *line <= skipped);
    let all: Vec<(usize, &str)> = rest.take_while(|(_, line)| !ends(line)).collect();
    let understood = find_headings(&all);
    let asked = known.separator.or(mapping.map(|mapping| mapping.separator));
    let separator = asked.or(understood.map(|(separator, _)| separator));
    let separator = separator.or_else(|| best_separator(&all))?;
    let (width, _) = usual_width(&all, separator)?;
    let first = match (known.heading_line, mapping, understood) {
        (Some(line @ 1..), ..) => all.iter().position(|(at, _)| *at >= line)?,
        (None, Some(_), _) => 0,
        (None, None, Some((of, at))) if of == separator => at,
        _ => all.iter().position(|(_, line)| cells(line, separator).len() == width)?,
    };
    let headed = match (known.heading_line, mapping) {
        (Some(line), _) => line > 0,
        (None, Some(mapping)) => mapping.has_headings,
        (None, None) => !is_reading(&cells(all[first].1, separator)),
    };
    let headings = if headed { cells(all[first].1, separator) } else { Vec::new() };
    let rest: Vec<Vec<String>> =
        all[first + usize::from(headed)..].iter().map(|(_, line)| cells(line, separator)).collect();
    let below = match mapping.filter(|_| known.heading_line.is_none()) {
        Some(mapping) => mapping.below.min(rest.len()),
        None if headed => rest.iter().take(MOST_BELOW).take_while(|row| !is_reading(row)).count(),
        None => 0,
    };
    // A table of words alone has no readings: then nothing stands between.
    let below = if below == MOST_BELOW.min(rest.len()) { 0 } else { below };
    let (units, readings) = rest.split_at(below);
    let mut columns: Vec<LookColumn> =
        (0..width.max(headings.len())).map(|at| column(at, &headings, units, readings)).collect();
    match mapping {
        Some(mapping) => mapped(&mut columns, mapping),
        None => leave_weak(&mut columns, &headings),
    }
    Some(Look {
        separator,
        heading_line: headed.then_some(all[first].0),
        first_line: all[first].0,
        rows_below_headings: below,
        readings: readings.len(),
        columns,
    })
}

/// The most frequent number of cells, at least two, and how many lines have it.
fn usual_width(all: &[(usize, &str)], separator: char) -> Option<(usize, usize)> {
    let mut counts = std::collections::BTreeMap::new();
    for (_, line) in all.iter().take(LINES) {
        *counts.entry(cells(line, separator).len()).or_insert(0_usize) += 1;
    }
    let several = counts.into_iter().filter(|(width, _)| *width >= 2);
    several.max_by_key(|(_, lines)| *lines)
}

/// The one that makes most lines equally wide, with numbers in their cells.
fn best_separator(all: &[(usize, &str)]) -> Option<char> {
    let score = |separator: char| {
        let (width, lines) = usual_width(all, separator)?;
        let same = all.iter().take(LINES).map(|(_, line)| cells(line, separator));
        let numbers: usize = same
            .filter(|row| row.len() == width)
            .map(|row| row.iter().filter(|cell| is_number(cell)).count())
            .sum();
        // The share of cells that are numbers, in all lines.
        Some((separator, numbers as f64 / width as f64 + 1e-3 * lines as f64))
    };
    let mut best: Option<(char, f64)> = None;
    for (separator, by) in SEPARATORS.into_iter().filter_map(score) {
        if best.is_none_or(|(_, most)| by > most) {
            best = Some((separator, by));
        }
    }
    best.map(|(separator, _)| separator)
}

/// Digits with signs of any notation.
fn is_number(cell: &str) -> bool {
    // Real minus signs, fixed gaps and apostrophes of thousands, too; a plain space may separate columns.
    let of_number =
        |c: char| c.is_ascii_digit() || ".,+-eE\u{2212}'\u{2019}\u{a0}\u{202f}".contains(c);
    cell.chars().any(|c| c.is_ascii_digit()) && cell.chars().all(of_number)
}

/// Half of its cells are numbers.
fn is_reading(row: &[String]) -> bool {
    let filled = row.iter().filter(|cell| !cell.is_empty()).count();
    let numbers = row.iter().filter(|cell| is_number(cell)).count();
    numbers > 0 && 2 * numbers >= filled
}

fn column(
    at: usize,
    headings: &[String],
    units: &[Vec<String>],
    readings: &[Vec<String>],
) -> LookColumn {
    let heading = headings.get(at).cloned().unwrap_or_default();
    let understood = understand(&heading);
    let below = || units.iter().filter_map(|row| row.get(at)).find_map(|cell| unit_in_cell(cell));
    let unit = split_unit(&heading).1.or_else(below);
    let there = || readings.iter().filter_map(|row| row.get(at)).filter(|cell| !cell.is_empty());
    let different = |of: &dyn Fn(&&String) -> bool| {
        let mut found: Vec<&String> = Vec::new();
        for cell in there().filter(of) {
            if !found.contains(&cell) {
                found.push(cell);
            }
            if found.len() > WORDS {
                break;
            }
        }
        found
    };
    // A few numbers may be words, too: 1 forwards, 2 back.
    let all = different(&|_| true);
    let words = if all.len() > WORDS { different(&|cell| !is_number(cell)) } else { all };
    let meant = |word: &&String| ((*word).clone(), direction_named(word).map(str::to_owned));
    let words = words.iter().take(WORDS).map(meant).collect();
    LookColumn {
        role: understood.map(|Heading { role, .. }| role),
        values: there().take(VALUES).cloned().collect(),
        heading,
        unit,
        negate: false,
        words,
    }
}

/// `position` means the target only where nothing else does.
fn leave_weak(columns: &mut [LookColumn], headings: &[String]) {
    let is_weak =
        |at: usize| headings.get(at).and_then(|h| understand(h)).is_some_and(|h| h.is_weak);
    let strong = |(at, column): (usize, &LookColumn)| {
        column.role.as_deref() == Some("target") && !is_weak(at)
    };
    if columns.iter().enumerate().any(strong) {
        for (_, column) in columns.iter_mut().enumerate().filter(|(at, _)| is_weak(*at)) {
            column.role = None;
        }
    }
}

/// What the mapping file says of the columns; those that it does not name are not used.
fn mapped(columns: &mut [LookColumn], mapping: &Mapping) {
    columns.iter_mut().for_each(|column| column.role = None);
    for named in &mapping.columns {
        let at = match &named.source {
            Source::Number(at) => Some(*at),
            Source::Heading(name) => {
                columns.iter().position(|c| c.heading.to_lowercase() == name.to_lowercase())
            }
            Source::Steps { .. } => None,
        };
        let Some(column) = at.and_then(|at| columns.get_mut(at)) else { continue };
        let UsedAs { role, unit, negate, words, .. } = named.used.clone();
        (column.role, column.unit, column.negate) = (Some(role), unit, negate);
        for (word, ours) in &mut column.words {
            let own = words.iter().find(|(theirs, _)| theirs == word);
            *ours = own.map(|(_, meant)| meant.clone()).or(ours.take());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Diagnostics;

    fn plain(text: &str) -> Look {
        look(text, &LookAs::default()).unwrap()
    }

    #[test]
    fn any_separator_shows_the_same_columns() {
        let rows = [["Pos", "dx"], ["mm", "µm"], ["0.5", "-1.25"], ["1.5", "0.75"]];
        for separator in [";", "\t", "|", " ", ","] {
            let lines: Vec<String> = rows.iter().map(|row| row.join(separator)).collect();
            let found = plain(&lines.join("\n"));
            assert_eq!(found.separator.to_string(), separator);
            assert_eq!(
                (found.heading_line, found.rows_below_headings, found.readings),
                (Some(1), 1, 2)
            );
            let [a, b] = &found.columns[..] else { panic!("{found:?}") };
            assert_eq!(
                (&a.values[..], a.unit),
                (&["0.5".to_owned(), "1.5".to_owned()][..], Some("mm"))
            );
            assert_eq!((&*b.heading, b.unit), ("dx", Some("um")));
        }
    }

    #[test]
    fn a_decimal_comma_separates_nothing() {
        for text in ["1,5;2,5\n2,5;3,5\n", "1,5 2,5\n2,5 3,5\n", "1,5\t2,5\n2,5\t3,5"] {
            let found = plain(text);
            assert_eq!(
                (found.columns.len(), found.heading_line, found.readings),
                (2, None, 2),
                "{text}"
            );
            assert_eq!(found.columns[0].values, ["1,5", "2,5"]);
        }
    }

    #[test]
    fn a_reading_with_real_minus_signs_and_gaps_is_one() {
        let found = plain("Pos;F1;F2\n0;−0,5;−0,4\n1\u{202f}000;0,5;0,4\n");
        assert_eq!((found.rows_below_headings, found.readings), (0, 2));
    }

    #[test]
    fn what_headings_say_is_proposed_and_can_be_replaced() {
        let text =
            "Maschine;7\n\nSollposition [mm];Position;Richtung;Wert\n0;1;V;3\n0;2;rückwärts;3\n";
        let found = plain(text);
        assert_eq!((found.heading_line, found.first_line), (Some(3), 3));
        let roles: Vec<_> = found.columns.iter().map(|c| c.role.as_deref()).collect();
        assert_eq!(roles, [Some("target"), None, Some("direction"), None]);
        let meant = [("V".to_owned(), None), ("rückwärts".to_owned(), Some("down".to_owned()))];
        assert_eq!(found.columns[2].words, meant);
        let other = LookAs { heading_line: Some(0), separator: Some(';'), ..LookAs::default() };
        assert_eq!(look(text, &other).unwrap().heading_line, None);
        assert_eq!(look("", &LookAs::default()), None);
        assert_eq!(look("alone\nlines\n", &LookAs::default()), None);
    }

    /// Texts of separators, signs, digits, quotes and ends of lines in any order: a table or none, never a panic.
    #[test]
    fn any_text_is_a_table_or_none() {
        const PARTS: [&str; 14] =
            [";", ",", "\t", " ", "|", "\n", "\r\n", "\"", "1", "-2,5", "Soll", "[mm]", "µ", "#"];
        let mut state = 7_u64;
        let mut next = |below: usize| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as usize % below
        };
        for _ in 0..20_000 {
            let text: String = (0..next(60)).map(|_| PARTS[next(PARTS.len())]).collect();
            let line = next(5);
            let separator = (next(2) == 0).then_some(';');
            let known =
                LookAs { separator, heading_line: (line < 4).then_some(line), mapping: None };
            if let Some(found) = look(&text, &known) {
                assert!(found.columns.len() >= 2, "{text:?}");
            }
        }
    }

    #[test]
    fn a_mapping_file_says_what_columns_are() {
        let text = "head\nA;B;C\n1;V;3\n2;R;4\n";
        let (mapping, _) = Mapping::parse(
            "m.toml",
            "separator = ';'\nskip_rows = 1\n[columns.target]\ncolumn = 'A'\nunit = 'mm'\n\
             [columns.direction]\ncolumn = 2\nwords = { up = 'V', down = 'R' }\n\
             [columns.deviation]\ncolumn = 'C'\nunit = 'um'\nsign = -1\n",
        );
        let mapping = mapping.unwrap();
        let found = look(text, &LookAs { mapping: Some(&mapping), ..LookAs::default() }).unwrap();
        assert_eq!((found.heading_line, found.readings), (Some(2), 2));
        let [a, b, c] = &found.columns[..] else { panic!("{found:?}") };
        assert_eq!((a.role.as_deref(), a.unit), (Some("target"), Some("mm")));
        assert_eq!(b.words[1], ("R".to_owned(), Some("down".to_owned())));
        assert_eq!((c.role.as_deref(), c.negate), (Some("deviation"), true));
        assert!(mapping.read("t.csv", text, &mut Diagnostics::new()).is_some());
    }
}
