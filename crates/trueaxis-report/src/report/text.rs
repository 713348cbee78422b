//! A report on the terminal.

use super::{Item, Labels, Report, Section, Table, filled};

/// Paragraphs are broken here; with their indent they fit into 100 columns.
const WIDTH: usize = 98;

pub(super) fn text(report: &Report<'_>) -> String {
    let mut out = format!("{}\n", report.title);
    for line in &report.lines {
        put(&mut out, line);
    }
    if let Some(verdict) = &report.verdict {
        let joint = if verdict.sentence.is_empty() { "" } else { ": " };
        out += &format!("\n{}{joint}{}\n", verdict.word, verdict.sentence);
    }
    for section in report.sections.iter().filter(|s| s.shows(true)) {
        write_section(&mut out, section, &report.labels);
    }
    out
}

fn write_section(out: &mut String, section: &Section<'_>, labels: &Labels) {
    out.push('\n');
    if !section.title.is_empty() {
        out.push_str(&section.title);
        out.push('\n');
    }
    for (i, item) in section.items.iter().enumerate() {
        match item {
            Item::Paragraph(text) | Item::Note(text) => wrapped(out, text, ""),
            Item::List(lines) => lines.iter().for_each(|line| wrapped(out, line, "- ")),
            Item::Code(lines) => {
                if i > 0 {
                    out.push('\n');
                }
                lines.lines().for_each(|line| put(out, line));
            }
            Item::Table(table) if table.rows.is_empty() => {}
            Item::Table(table) => {
                if section.items[..i].iter().any(|item| matches!(item, Item::Table(_))) {
                    out.push('\n');
                }
                write_table(out, table, labels);
            }
            Item::Figures(..) => {}
        }
    }
}

/// One line, two columns from the left.
fn put(out: &mut String, line: &str) {
    match line.trim_end() {
        "" => {}
        line => {
            out.push_str("  ");
            out.push_str(line);
        }
    }
    out.push('\n');
}

/// A paragraph, broken between words.
fn wrapped(out: &mut String, text: &str, mark: &str) {
    let indent = " ".repeat(mark.len());
    let mut line = mark.to_owned();
    let mut is_empty = true;
    for word in text.split_whitespace() {
        // Chinese has no blanks: it is broken between any two signs.
        for (i, piece) in pieces(word).into_iter().enumerate() {
            let blank = usize::from(i == 0 && !is_empty);
            if !is_empty && width(&line) + blank + width(piece) > WIDTH {
                put(out, &line);
                line = indent.clone();
                is_empty = true;
            }
            if i == 0 && !is_empty {
                line.push(' ');
            }
            line.push_str(piece);
            is_empty = false;
        }
    }
    if !is_empty {
        put(out, &line);
    }
}

fn write_table(out: &mut String, table: &Table, labels: &Labels) {
    let headings = (!table.headings.is_empty()).then_some(&table.headings);
    let rows = table.rows.iter().take(table.most_on_terminal).map(|row| &row.cells);
    let shown: Vec<&Vec<String>> = headings.into_iter().chain(rows).collect();
    let columns = table.columns();
    let wide = |column: usize| {
        let widths = shown.iter().filter_map(|row| row.get(column)).map(|cell| width(cell));
        widths.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(wide).collect();
    let words: Vec<bool> = (0..columns).map(|i| table.has_words(i)).collect();
    for row in &shown {
        let mut line = String::new();
        for (i, cell) in row.iter().enumerate() {
            let gap = " ".repeat(widths[i] - width(cell));
            let between = if i == 0 { "" } else { "   " };
            let (before, after) = if words[i] { ("", &gap[..]) } else { (&gap[..], "") };
            for part in [between, before, cell, after] {
                line.push_str(part);
            }
        }
        put(out, &line);
    }
    if let Some(more) = table.rows.len().checked_sub(table.most_on_terminal).filter(|n| *n > 0) {
        put(out, &filled(&labels.more_rows, &[&more.to_string()]));
    }
    wrapped(out, &table.note, "");
}

/// A word in the pieces between which it may be broken: after each Chinese sign that no punctuation follows.
fn pieces(word: &str) -> Vec<&str> {
    let signs: Vec<(usize, char)> = word.char_indices().collect();
    let mut from = 0;
    let mut pieces = Vec::new();
    for pair in signs.windows(2) {
        let ((_, sign), (at, next)) = (pair[0], pair[1]);
        if is_wide(sign) && !"，。：；、）！？”".contains(next) {
            pieces.push(&word[from..at]);
            from = at;
        }
    }
    pieces.push(&word[from..]);
    pieces
}

/// Columns on a terminal: the bar above B̄ takes none, a Chinese sign two.
fn width(text: &str) -> usize {
    text.chars().map(|c| if c == '\u{304}' { 0 } else { 1 + usize::from(is_wide(c)) }).sum()
}

/// Chinese signs and their punctuation (Unicode Standard Annex 11, wide and full-width).
fn is_wide(c: char) -> bool {
    matches!(c, '\u{2e80}'..='\u{9fff}' | '\u{f900}'..='\u{faff}' | '\u{fe30}'..='\u{fe4f}' | '\u{ff00}'..='\u{ff60}')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table_text(table: &Table) -> String {
        let mut out = String::new();
        write_table(&mut out, table, &Labels::default());
        out
    }

    #[test]
    fn numbers_stand_right_and_words_left() {
        let table = Table::new(["name", "µm", "at"])
            .row(["a", "1.00", "X 5"])
            .row(["bcdefg", "-12.00", "Y"]);
        assert_eq!(
            table_text(&table),
            "  name         µm   at\n  a          1.00   X 5\n  bcdefg   -12.00   Y\n"
        );
    }

    #[test]
    fn long_tables_are_cut_and_say_so() {
        let table = Table::new(["n"]).rows((0..5).map(|i| [i.to_string()])).most_on_terminal(2);
        assert_eq!(table_text(&table), "  n\n  0\n  1\n  … and 3 more; --format json has all\n");
    }

    #[test]
    fn chinese_stands_in_columns_and_breaks_anywhere_but_before_punctuation() {
        let table = Table::new(["量", "µm"]).row(["反向误差", "2.50"]).row(["EXX", "-1.00"]);
        let text = table_text(&table);
        assert_eq!(text, "  量            µm\n  反向误差    2.50\n  EXX        -1.00\n");
        let mut out = String::new();
        wrapped(&mut out, &"偏差，".repeat(40), "");
        assert!(out.lines().all(|line| width(line) <= WIDTH + 2 && !line.trim().starts_with('，')));
        assert_eq!(out.lines().count(), 3);
    }

    #[test]
    fn paragraphs_break_between_words() {
        let mut out = String::new();
        wrapped(&mut out, &"word ".repeat(30), "- ");
        let lines: Vec<&str> = out.lines().collect();
        assert_eq!(lines.len(), 2);
        assert!(lines[0].starts_with("  - word") && lines[1].starts_with("    word"));
        assert!(lines.iter().all(|line| line.chars().count() <= WIDTH + 2));
    }
}
