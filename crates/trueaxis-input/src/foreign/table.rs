//! A table of others becomes ours, row by row.

use super::headings::{Heading, Holds, direction_named, understand, unit_in_cell};
use super::notation::{Notation, Numbers, notation_of};
use crate::{Diagnostics, Place};

/// Headings stand within so many lines that are not empty.
const MOST_LINES_BEFORE: usize = 200;
/// So many bad rows are reported, then it is another kind of file.
const MOST_BAD_ROWS: usize = 20;
/// What separates columns, in the order in which it is looked for, with its name.
const SEPARATORS: [(char, &str); 4] =
    [(';', "semicolons"), ('\t', "tabs"), (',', "commas"), ('|', "bars")];

/// A text that is written line by line with its source.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Beside {
    text: String,
    lines: usize,
}

impl Beside {
    /// Puts a row on a line of the source, or on the next that is free.
    pub fn row(&mut self, line: usize, row: &str) {
        while self.lines + 1 < line {
            self.text.push('\n');
            self.lines += 1;
        }
        self.text += row;
        self.text.push('\n');
        self.lines += 1;
    }

    /// The text.
    pub fn into_text(self) -> String {
        self.text
    }
}

/// Whether a text is a table in our own form: headings without spaces or brackets between commas, units after underscores.
pub fn is_ours(text: &str) -> bool {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let Some((_, heading)) = rows(text).next() else { return true };
    let is_name = |cell: &str| {
        cell.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '+' | '-' | '/' | '.' | '°'))
    };
    let mut cells = heading.split(',').map(str::trim);
    cells.clone().all(is_name) && cells.any(|c| c.contains('_'))
}

/// Lines that are neither empty nor comments, with their numbers.
pub(super) fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let numbered = text.lines().enumerate().map(|(i, line)| (i + 1, line));
    numbered.filter(|(_, line)| {
        let start = line.trim_start();
        !start.trim_matches([';', ',', '\t']).trim().is_empty() && !start.starts_with('#')
    })
}

/// The cells of a line; quotes keep what they enclose together, doubled quotes are one.
pub(super) fn cells(line: &str, separator: char) -> Vec<String> {
    if separator == ' ' {
        return line.split_whitespace().map(str::to_owned).collect();
    }
    let mut found = vec![String::new()];
    let mut quoted = false;
    let mut chars = line.trim_end_matches('\r').chars().peekable();
    while let Some(c) = chars.next() {
        // why: there is one from the beginning
        let cell = found.last_mut().expect("a cell");
        match c {
            // A quote within a cell is a second of arc or an inch.
            '"' if quoted && chars.peek() == Some(&'"') => {
                chars.next();
                cell.push('"');
            }
            '"' if quoted => quoted = false,
            '"' if cell.trim().is_empty() => {
                cell.clear();
                quoted = true;
            }
            _ if c == separator && !quoted => found.push(String::new()),
            _ => cell.push(c),
        }
    }
    for cell in &mut found {
        *cell = cell.trim().to_owned();
    }
    found
}

/// A column that is used.
#[derive(Debug, Clone)]
pub(super) struct Used {
    /// Where it stands, from 0.
    pub at: usize,
    pub role: String,
    pub holds: Holds,
    pub unit: Option<&'static str>,
    pub negate: bool,
    /// Words for directions besides the usual ones.
    pub words: Vec<(String, String)>,
}

impl Used {
    /// Our unit for it, and the power of ten that leads there.
    pub fn our_unit(&self) -> (&'static str, i32) {
        let unit = self.unit.unwrap_or("");
        let small = self.holds == Holds::Small;
        match unit {
            "mm" if small => ("um", 3),
            "um" if !small => ("mm", -3),
            "nm" => {
                if small {
                    ("um", -3)
                } else {
                    ("mm", -6)
                }
            }
            "cm" => {
                if small {
                    ("um", 4)
                } else {
                    ("mm", 1)
                }
            }
            "m" => {
                if small {
                    ("um", 6)
                } else {
                    ("mm", 3)
                }
            }
            "rad" if small => ("urad", 6),
            "mrad" => {
                if small {
                    ("urad", 3)
                } else {
                    ("rad", -3)
                }
            }
            "urad" if !small => ("rad", -6),
            "ms" => ("s", -3),
            other => (other, 0),
        }
    }

    fn heading(&self) -> String {
        match self.our_unit().0 {
            "" => self.role.clone(),
            unit => format!("{}_{unit}", self.role),
        }
    }

    fn is_number(&self) -> bool {
        matches!(self.holds, Holds::Large | Holds::Small | Holds::Count)
    }
}

/// A table whose layout is known.
pub(super) struct Layout {
    pub separator: char,
    pub columns: Vec<Used>,
    /// The line of the headings.
    pub heading_line: usize,
    /// Constant columns: heading and word.
    pub constants: Vec<(String, String)>,
}

/// Reads a table of others by its headings; none with errors in `problems`. A note says what was assumed.
pub fn read(file: &str, text: &str, problems: &mut Diagnostics) -> Option<String> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let all: Vec<(usize, &str)> = rows(text).collect();
    let Some((separator, at)) = find_headings(&all) else {
        return unknown_headings(file, &all, problems);
    };
    let (heading_line, line) = all[at];
    let headings = cells(line, separator);
    let understood: Vec<Option<Heading>> = headings.iter().map(|h| understand(h)).collect();
    let place = |line: usize| Place { file: file.to_owned(), line, column: 1 };
    let mut columns = used(&headings, understood, &place(heading_line), problems)?;
    let mut below = &all[at + 1..];
    if let Some((line, units)) = below.first()
        && take_units(&mut columns, &cells(units, separator), &place(*line), problems)?
    {
        below = &below[1..];
    }
    for column in &columns {
        if column.unit.is_none() && matches!(column.holds, Holds::Large | Holds::Small) {
            let message = format!("the column `{}` has no unit", headings[column.at]);
            let hint = "write it in the heading (`Position [mm]`), in a row below, or in a mapping file (--map)";
            problems.error("missing-unit", place(heading_line), message, hint);
        }
    }
    if problems.has_errors() {
        return None;
    }
    let layout = Layout { separator, columns, heading_line, constants: Vec::new() };
    let split: Vec<(usize, Vec<String>)> =
        below.iter().map(|(line, text)| (*line, cells(text, separator))).collect();
    let notation = notation(file, &layout, &split, problems)?;
    say(file, &layout, notation, &headings, problems);
    let mut ours = Beside::default();
    ours.row(heading_line, &heading_row(&layout));
    put_rows(file, &layout, notation, &split, &mut ours, problems)?;
    Some(ours.into_text())
}

/// The separator and the row of headings with the most that is understood.
pub(super) fn find_headings(all: &[(usize, &str)]) -> Option<(char, usize)> {
    let mut best: Option<(usize, char, usize)> = None;
    for (at, (_, line)) in all.iter().take(MOST_LINES_BEFORE).enumerate() {
        for (separator, _) in SEPARATORS {
            let found = cells(line, separator);
            let count = found.iter().filter(|c| understand(c).is_some()).count();
            if count >= 2 && best.is_none_or(|(most, ..)| count > most) {
                best = Some((count, separator, at));
            }
        }
    }
    best.map(|(_, separator, at)| (separator, at))
}

fn unknown_headings(
    file: &str,
    all: &[(usize, &str)],
    problems: &mut Diagnostics,
) -> Option<String> {
    let place = all.first().map_or(Place::whole(file), |(line, _)| Place {
        file: file.to_owned(),
        line: *line,
        column: 1,
    });
    if all.is_empty() {
        let hint = "one line of headings, each with its unit, then one row for each reading";
        problems.error("empty-table", place, "the table has no row".to_owned(), hint);
        return None;
    }
    let shown: String = all[0].1.chars().take(80).collect();
    let message =
        format!("no line of headings was understood; the first line is `{}`", shown.trim());
    let hint = "headings such as `Target position [mm]`, `Direction`, `Deviation [µm]` in English, German, Chinese, \
                French or Italian; or say in a mapping file (--map) which column is what";
    problems.error("unknown-headings", place, message, hint);
    None
}

/// The columns that are used, each role once.
fn used(
    headings: &[String],
    understood: Vec<Option<Heading>>,
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<Vec<Used>> {
    let strong = understood.iter().flatten().any(|h| h.role == "target" && !h.is_weak);
    let mut columns: Vec<Used> = Vec::new();
    for (at, heading) in understood.into_iter().enumerate() {
        let Some(Heading { role, unit, holds, is_weak }) = heading else { continue };
        if is_weak && strong {
            continue;
        }
        if let Some(other) = columns.iter().find(|c| c.role == role) {
            let message =
                format!("the columns `{}` and `{}` say the same", headings[other.at], headings[at]);
            let hint = "name the one that counts in a mapping file (--map)";
            problems.error("duplicate-column", place.clone(), message, hint);
            return None;
        }
        columns.push(Used { at, role, holds, unit, negate: false, words: Vec::new() });
    }
    Some(columns)
}

/// Units in a row of their own; whether there is one.
fn take_units(
    columns: &mut [Used],
    row: &[String],
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<bool> {
    let cell = |c: &Used| row.get(c.at).map_or("", |s| s.as_str());
    let mut found = 0;
    for column in columns.iter().filter(|c| !cell(c).is_empty()) {
        match unit_in_cell(cell(column)) {
            Some(_) => found += 1,
            // `-` stands for "no unit".
            None if !column.is_number() || matches!(cell(column), "-" | "[-]") => {}
            None => return Some(false),
        }
    }
    if found == 0 {
        return Some(false);
    }
    for column in columns {
        let Some(unit) = unit_in_cell(row.get(column.at).map_or("", |s| s.as_str())) else {
            continue;
        };
        if let Some(other) = column.unit.filter(|u| *u != unit) {
            let message =
                format!("`{}` is in {other} by its heading, and in {unit} below it", column.role);
            problems.error("wrong-unit", place.clone(), message, "leave one of them");
            return None;
        }
        if matches!(column.holds, Holds::Large | Holds::Small) {
            column.unit = Some(unit);
        }
    }
    Some(true)
}

/// How the numbers of the columns in use are written.
pub(super) fn notation(
    file: &str,
    layout: &Layout,
    split: &[(usize, Vec<String>)],
    problems: &mut Diagnostics,
) -> Option<Notation> {
    let numbers: Vec<&Used> = layout.columns.iter().filter(|c| c.is_number()).collect();
    let place = |line: usize| Place { file: file.to_owned(), line, column: 1 };
    let of_row = |(line, row): &'_ (usize, Vec<String>)| -> Vec<(usize, usize)> {
        let there = numbers.iter().filter(|c| c.at < row.len());
        there.map(|c| (*line, c.at)).collect()
    };
    let mut cells = Vec::new();
    for row in split {
        for (line, at) in of_row(row) {
            cells.push((place(line), row.1[at].as_str()));
        }
    }
    notation_of(&Numbers { cells, separated_by_commas: layout.separator == ',' }, problems)
}

/// Our heading.
pub(super) fn heading_row(layout: &Layout) -> String {
    let names = layout.columns.iter().map(Used::heading);
    names.chain(layout.constants.iter().map(|(name, _)| name.clone())).collect::<Vec<_>>().join(",")
}

/// Every row in our form; none with errors.
pub(super) fn put_rows(
    file: &str,
    layout: &Layout,
    notation: Notation,
    split: &[(usize, Vec<String>)],
    ours: &mut Beside,
    problems: &mut Diagnostics,
) -> Option<()> {
    let mut bad = 0;
    for (line, row) in split {
        let mut written = Vec::new();
        for column in &layout.columns {
            let cell = row.get(column.at).map_or("", |s| s.as_str());
            match our_cell(column, cell, notation) {
                Some(text) => written.push(text),
                None => {
                    bad += 1;
                    if bad <= MOST_BAD_ROWS {
                        not_a_number(file, *line, cell, &column.role, notation, problems);
                    }
                    break;
                }
            }
        }
        written.extend(layout.constants.iter().map(|(_, value)| value.clone()));
        ours.row(*line, &written.join(","));
    }
    (bad == 0).then_some(())
}

fn not_a_number(
    file: &str,
    line: usize,
    cell: &str,
    role: &str,
    notation: Notation,
    problems: &mut Diagnostics,
) {
    let sign = if notation.decimal == ',' { "comma" } else { "point" };
    let message =
        format!("`{cell}` is not a number with a decimal {sign}, in the column of `{role}`");
    let hint = "a row that is no reading is left out by skip_rows, after or until in a mapping file (--map)";
    let place = Place { file: file.to_owned(), line, column: 1 };
    problems.error("not-a-number", place, message, hint);
}

fn our_cell(column: &Used, cell: &str, notation: Notation) -> Option<String> {
    let cell = cell.trim();
    if !column.is_number() {
        let own =
            column.words.iter().find(|(theirs, _)| theirs == cell).map(|(_, ours)| ours.clone());
        let named = || direction_named(cell).filter(|_| column.holds == Holds::Direction);
        let plain = || cell.replace([',', '\n'], " ");
        return Some(own.or_else(|| named().map(str::to_owned)).unwrap_or_else(plain));
    }
    if cell.is_empty() {
        return Some(String::new());
    }
    let (_, shift) = column.our_unit();
    let number = notation.canonical(cell, shift, column.negate)?;
    // A run is counted, not measured.
    Some(match column.holds {
        Holds::Count => number.strip_suffix("e0").unwrap_or(&number).to_owned(),
        _ => number,
    })
}

/// What was assumed.
fn say(
    file: &str,
    layout: &Layout,
    notation: Notation,
    headings: &[String],
    problems: &mut Diagnostics,
) {
    let separator = SEPARATORS.iter().find(|(c, _)| *c == layout.separator);
    let columns: Vec<String> = layout
        .columns
        .iter()
        .map(|c| match c.unit {
            Some(unit) => format!("`{}` is {} in {unit}", headings[c.at], c.role),
            None => format!("`{}` is {}", headings[c.at], c.role),
        })
        .collect();
    let is_used = |at: usize| layout.columns.iter().any(|c| c.at == at);
    let unused: Vec<String> = headings
        .iter()
        .enumerate()
        .filter(|(at, name)| !is_used(*at) && !name.is_empty())
        .map(|(_, name)| format!("`{name}`"))
        .collect();
    let sign = if notation.decimal == ',' { "comma" } else { "point" };
    let mut message = format!(
        "read with {} between columns and a decimal {sign}: {}",
        separator.map_or("spaces", |(_, name)| *name),
        columns.join(", ")
    );
    if !unused.is_empty() {
        message += &format!("; not used: {}", unused.join(", "));
    }
    let place = Place { file: file.to_owned(), line: layout.heading_line, column: 1 };
    problems.note("read-as", place, message, "if this is wrong, say it in a mapping file (--map)");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> &'static str {
        let mut problems = Diagnostics::new();
        assert_eq!(read("t.csv", text, &mut problems), None);
        problems.iter().find(|d| d.severity == crate::Severity::Error).map_or("", |d| d.code)
    }

    #[test]
    fn cells_between_quotes_and_separators() {
        assert_eq!(cells("a; \"b;c\" ;\"d\"\"e\";\r", ';'), ["a", "b;c", "d\"e", ""]);
        assert_eq!(cells("Winkel 3\";x", ';'), ["Winkel 3\"", "x"]);
        assert_eq!(cells(" 1   2\t3", ' '), ["1", "2", "3"]);
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        assert_eq!(code("Position;Abweichung [µm]\n1;2\n"), "missing-unit");
        assert_eq!(code("Position [mm];Abweichung [µm]\n1,234;2\n"), "ambiguous-number");
        assert_eq!(code("Position [mm];Abweichung [µm]\n1,5;x\n"), "not-a-number");
        assert_eq!(code("Target [mm];Soll [mm];Abweichung [µm]\n1;1;2\n"), "duplicate-column");
        assert_eq!(code("foo;bar\n1;2\n"), "unknown-headings");
        assert_eq!(code("\n# only a remark\n"), "empty-table");
        assert_eq!(code("Soll [mm];Fehler [µm]\n[m];[µm]\n1;2\n"), "wrong-unit");
    }

    #[test]
    fn units_may_stand_in_a_row_of_their_own_below_a_head_of_words() {
        let text = "Maschine: Mühle\nDatum: 2026-11-24\n\nSoll;Lauf;Richtung;Fehler\n[mm];;;[mm]\n\
                    0,5;1;+;0,0017\n";
        let ours = read("t.csv", text, &mut Diagnostics::new());
        let expected = "\n\n\ntarget_mm,run,direction,deviation_um\n\n0.5e0,1,up,0.0017e3\n";
        assert_eq!(ours.as_deref(), Some(expected));
    }

    #[test]
    fn our_own_form_is_known() {
        assert!(is_ours("# x\ntarget_mm,run,direction,deviation_um\n0,1,up,0\n"));
        assert!(is_ours("") && is_ours("x_mm,y_mm\n"));
        assert!(!is_ours("target_mm;run\n") && !is_ours("Position [mm],Error [um]\n"));
        assert!(!is_ours("a,b\n"));
    }
}
