//! A table is read by its mapping file.

use super::headings::Holds;
use super::mapping::{Block, Mapping, Source};
use super::notation::Notation;
use super::table::{Beside, Layout, Used, cells, heading_row, notation, put_rows};
use crate::{Diagnostics, Place};

/// Lines of a block: number and text.
type Lines<'t> = Vec<(usize, &'t str)>;

/// One block, split into cells.
struct Part<'m> {
    block: &'m Block,
    layout: Layout,
    rows: Vec<(usize, Vec<String>)>,
}

impl Mapping {
    /// Reads a table as this file says, into ours; none with errors in `problems`.
    pub fn read(&self, file: &str, text: &str, problems: &mut Diagnostics) -> Option<String> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut parts = Vec::new();
        for block in &self.blocks {
            let lines = self.lines_of(block, file, text, problems)?;
            parts.push(self.part(block, file, &lines, problems)?);
        }
        let notation = self.notation(file, &parts, problems)?;
        let mut ours = Beside::default();
        for (i, part) in parts.iter().enumerate() {
            if i == 0 {
                ours.row(part.layout.heading_line, &heading_row(&part.layout));
            } else if heading_row(&part.layout) != heading_row(&parts[0].layout) {
                let message = "the blocks do not have the same columns".to_owned();
                let hint = "state direction and run in every [[block]], or in none";
                problems.error("ragged-row", Place::whole(&self.file), message, hint);
                return None;
            }
            put_rows(file, &part.layout, notation, &part.rows, &mut ours, problems)?;
        }
        Some(ours.into_text())
    }

    /// The lines of a block that are not empty.
    fn lines_of<'t>(
        &self,
        block: &Block,
        file: &str,
        text: &'t str,
        problems: &mut Diagnostics,
    ) -> Option<Lines<'t>> {
        let mut lines: Lines<'t> = text.lines().enumerate().map(|(i, l)| (i + 1, l)).collect();
        let find = |lines: &Lines<'t>, mark: &str| {
            lines.iter().position(|(_, line)| line.trim_start().starts_with(mark.trim()))
        };
        let mut missing = |mark: &str| {
            let message = format!("no line begins with `{mark}`");
            let hint = format!("`{}` says that readings begin or end there", self.file);
            problems.error("missing-mark", Place::whole(file), message, &hint);
        };
        if let Some(mark) = &block.after {
            let Some(at) = find(&lines, mark) else {
                missing(mark);
                return None;
            };
            lines.drain(..=at);
        }
        if let Some(mark) = &block.until {
            let Some(at) = find(&lines, mark) else {
                missing(mark);
                return None;
            };
            lines.truncate(at);
        }
        lines.drain(..block.skip_rows.min(lines.len()));
        let is_empty = |line: &str| line.trim_matches([';', ',', '\t', ' ', '|', '\r']).is_empty();
        lines.retain(|(_, line)| !is_empty(line) && !line.trim_start().starts_with('#'));
        if lines.is_empty() {
            let message = "no reading is left where the mapping file looks for them".to_owned();
            let hint = format!("skip_rows, after and until of `{}`", self.file);
            problems.error("empty-table", Place::whole(file), message, &hint);
            return None;
        }
        Some(lines)
    }

    fn part<'m>(
        &self,
        block: &'m Block,
        file: &str,
        lines: &Lines<'_>,
        problems: &mut Diagnostics,
    ) -> Option<Part<'m>> {
        let heading_line = lines[0].0;
        let place = Place { file: file.to_owned(), line: heading_line, column: 1 };
        let headings =
            if self.has_headings { cells(lines[0].1, self.separator) } else { Vec::new() };
        let first = if self.has_headings { 1 + self.below } else { 0 };
        let below = lines.get(first..).unwrap_or(&[]);
        let mut rows: Vec<(usize, Vec<String>)> =
            below.iter().map(|(line, text)| (*line, cells(text, self.separator))).collect();
        let mut columns = Vec::new();
        for column in &self.columns {
            let at = match &column.source {
                Source::Number(at) => *at,
                Source::Heading(name) => {
                    let same = |h: &String| h.to_lowercase() == name.to_lowercase();
                    let mut found = headings.iter().enumerate().filter(|(_, h)| same(h));
                    let (Some((at, _)), None) = (found.next(), found.next()) else {
                        no_heading(name, &headings, place, problems);
                        return None;
                    };
                    at
                }
                Source::Steps { from_deg, step_deg } => {
                    let (from, step) = block.steps.unwrap_or((*from_deg, *step_deg));
                    add_steps(&mut rows, from, step, self.decimal.unwrap_or('.'))
                }
            };
            columns.push(column.used.at(at));
        }
        let separator = self.separator;
        let is_constant = |c: &Used| block.constants.iter().any(|(name, _)| *name == c.role);
        if let Some(twice) = columns.iter().find(|c| is_constant(c)) {
            let message = format!("`{}` is a column and a constant", twice.role);
            problems.error(
                "duplicate-column",
                Place::whole(&self.file),
                message,
                "leave one of them",
            );
            return None;
        }
        // One column may hold a word and a direction, but not two numbers.
        let is_number = |c: &Used| matches!(c.holds, Holds::Large | Holds::Small);
        let twice = columns.iter().enumerate().find_map(|(i, c)| {
            let before = columns[..i].iter().find(|b| b.at == c.at && is_number(b))?;
            is_number(c).then(|| (before.role.clone(), c.role.clone()))
        });
        if let Some((first, second)) = twice {
            let message = format!("`{first}` and `{second}` are the same column of the table");
            let hint = "each reading has a column of its own: correct one `column`";
            problems.error("duplicate-column", Place::whole(&self.file), message, hint);
            return None;
        }
        // Where there are no headings the first reading takes that line: ours stands before it.
        let heading_line = if self.has_headings { heading_line } else { heading_line.max(2) - 1 };
        let layout =
            Layout { separator, columns, heading_line, constants: block.constants.clone() };
        Some(Part { block, layout, rows })
    }

    fn notation(
        &self,
        file: &str,
        parts: &[Part<'_>],
        problems: &mut Diagnostics,
    ) -> Option<Notation> {
        if let Some(decimal) = self.decimal {
            return Some(Notation { decimal, thousands: self.thousands });
        }
        let mut found: Option<Notation> = None;
        for part in parts {
            let steps = part.block.steps.is_some();
            let notation = notation(file, &part.layout, &part.rows, problems)?;
            if let Some(other) = found.filter(|n| n.decimal != notation.decimal && !steps) {
                let message = format!(
                    "one block has a decimal `{}`, another `{}`",
                    other.decimal, notation.decimal
                );
                let hint = "state it in the mapping file: decimal = \",\"";
                problems.error("mixed-decimals", Place::whole(file), message, hint);
                return None;
            }
            found = Some(notation);
        }
        found
    }
}

fn no_heading(name: &str, headings: &[String], place: Place, problems: &mut Diagnostics) {
    let shown: Vec<String> = headings.iter().map(|h| format!("`{h}`")).collect();
    let message =
        format!("no single column is headed `{name}`; the headings are {}", shown.join(", "));
    let hint = "as it stands in the file, or column = 3, counted from 1; is skip_rows right?";
    problems.error("missing-column", place, message, hint);
}

/// Adds a column of angles in equal steps, deg; returns where it stands.
fn add_steps(rows: &mut [(usize, Vec<String>)], from: f64, step: f64, decimal: char) -> usize {
    let width = rows.iter().map(|(_, row)| row.len()).max().unwrap_or(0);
    let mut count = 0.0;
    for (_, row) in rows {
        row.resize(width, String::new());
        row.push((from + count * step).to_string().replace('.', &decimal.to_string()));
        count += 1.0;
    }
    width
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mapping(text: &str) -> Mapping {
        let (mapping, problems) = Mapping::parse("m.toml", text);
        mapping.unwrap_or_else(|| panic!("{problems:?}"))
    }

    #[test]
    fn blocks_with_directions_and_angles_in_equal_steps() {
        let mapping = mapping(
            "headings = false\nseparator = 'spaces'\ndecimal = ','\n\
             [columns.angle]\nfrom = '0 deg'\nstep = '90 deg'\n\
             [columns.deviation]\ncolumn = 2\nunit = 'mm'\nsign = -1\n\
             [[block]]\nafter = 'Run 1'\nuntil = 'Run 2'\ndirection = 'ccw'\n\
             [[block]]\nafter = 'Run 2'\ndirection = 'im Uhrzeigersinn'\nangle_from = '360 deg'\n\
             angle_step = '-90 deg'\n",
        );
        let text = "Gerät 7\nRun 1 CCW\n1 0,001\n2 -0,002\n\nRun 2 CW\n1 0,003\n2 0,004\n";
        let ours = mapping.read("b.txt", text, &mut Diagnostics::new()).unwrap();
        let expected = "\nangle_deg,deviation_um,direction\n0e0,-0.001e3,ccw\n90e0,0.002e3,ccw\n\n\n\
                        360e0,-0.003e3,cw\n270e0,-0.004e3,cw\n";
        assert_eq!(ours, expected);
    }

    #[test]
    fn columns_by_heading_with_words_of_their_own() {
        let mapping = mapping(
            "separator = ';'\nrows_below_headings = 1\nskip_rows = 1\n\
             [columns.target]\ncolumn = 'Pos'\nunit = 'm'\n[columns.direction]\ncolumn = 'R'\n\
             words = { up = ['V', 'W'], down = 'Z' }\n[columns.deviation]\ncolumn = 'F'\nunit = 'nm'\n",
        );
        let text = "head\nPos;x;R;F\nm;;;nm\n0.1;;V;5\n0.1;;Z;-5\n";
        let ours = mapping.read("b.csv", text, &mut Diagnostics::new()).unwrap();
        assert_eq!(ours, "\ntarget_mm,direction,deviation_um\n\n0.1e3,up,5e-3\n0.1e3,down,-5e-3\n");
        let mut problems = Diagnostics::new();
        assert_eq!(mapping.read("b.csv", "head\nA;B\n1;2\n", &mut problems), None);
        assert_eq!(problems.iter().next().unwrap().code, "missing-column");
    }

    #[test]
    fn a_bad_mapping_is_named() {
        for (text, code) in [
            ("separator = 'x'\n[columns.target]\ncolumn = 1\nunit = 'mm'", "unknown-word"),
            ("[columns.target]\ncolumn = 1", "missing-unit"),
            ("[columns.target]\ncolumn = 0\nunit = 'mm'", "unknown-word"),
            ("encoding = 'klingon'\n[columns.run]\ncolumn = 1", "unknown-word"),
            ("decimal = ','", "missing-key"),
            ("[columns.target]\ncolumn = 1\nunit = 'mm'\ncolour = 3", "unknown-key"),
        ] {
            let (_, problems) = Mapping::parse("m.toml", text);
            assert!(problems.iter().any(|d| d.code == code), "{code}: {problems:?}");
        }
    }
}
