//! The readings of a positioning test: columns of a table to targets, runs and directions.

use std::collections::HashMap;
use std::f64::consts::TAU;
use trueaxis_geometry::AxisKind;
use trueaxis_input::sheet::{Cells, Column, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension, Unit};

/// From which side a target was reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// ↑, the axis moved in its positive direction.
    Up,
    /// ↓.
    Down,
}

/// One reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Which run (cycle), from 1.
    pub run: u32,
    /// Actual − target. Unit: mm or rad.
    pub deviation: f64,
}

/// The readings at one target.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Target {
    /// The position. Unit: mm or rad.
    pub position: f64,
    /// Rising, in the order of the runs.
    pub up: Vec<Reading>,
    /// Falling.
    pub down: Vec<Reading>,
}

impl Target {
    /// The readings of one direction.
    pub fn of(&self, direction: Direction) -> &Vec<Reading> {
        match direction {
            Direction::Up => &self.up,
            Direction::Down => &self.down,
        }
    }

    fn of_mut(&mut self, direction: Direction) -> &mut Vec<Reading> {
        match direction {
            Direction::Up => &mut self.up,
            Direction::Down => &mut self.down,
        }
    }
}

/// The readings of one axis, mm or rad.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// Linear (mm) or rotary (rad).
    pub kind: AxisKind,
    /// By position, rising.
    pub targets: Vec<Target>,
}

impl Measurement {
    /// From the first to the last target, mm or rad.
    pub fn length(&self) -> f64 {
        match (self.targets.first(), self.targets.last()) {
            (Some(first), Some(last)) => last.position - first.position,
            _ => 0.0,
        }
    }

    fn dimension(kind: AxisKind) -> Dimension {
        match kind {
            AxisKind::Linear => Dimension::Length,
            AxisKind::Rotary => Dimension::Angle,
        }
    }
}

/// `deviation_up_3`, `actual_down_1`, `up_2`: actual positions or not, direction, run.
fn wide_role(role: &str) -> Option<(bool, Direction, u32)> {
    let (actual, rest) = match role.strip_prefix("actual_") {
        Some(rest) => (true, rest),
        None => (false, role.strip_prefix("deviation_").unwrap_or(role)),
    };
    let (word, run) = rest.rsplit_once('_')?;
    let direction = match word {
        "up" => Direction::Up,
        "down" => Direction::Down,
        _ => return None,
    };
    Some((actual, direction, run.parse().ok().filter(|r| *r > 0)?))
}

/// What may be under a heading of a positioning test.
pub fn role_cells(name: &str) -> Cells {
    let (role, _) = heading(name);
    match role {
        "target" | "actual" | "deviation" | "time" | "temperature" => Cells::Numbers,
        _ if name == "run" => Cells::Numbers,
        _ if role.ends_with("_temperature") => Cells::Numbers,
        _ if wide_role(role).is_some() => Cells::Gaps,
        _ if name == "direction" || name == "diagonal" || name == "axis" => Cells::Words,
        _ => Cells::Unused,
    }
}

/// Reads a table of a positioning test; `None` with errors in `problems`.
pub fn read(file: &str, text: &str, problems: &mut Diagnostics) -> Option<Measurement> {
    let sheet = Sheet::parse(file, text, role_cells, problems)?.with_repeats(problems);
    warn_of_unused(&sheet, &["direction"], problems);
    crate::check_temperatures(&sheet, problems);
    crate::check_times(&sheet, false, problems);
    from_sheet(&sheet, problems)
}

/// As [`read`], but the deviations are lengths or angles whatever the axis is: straightness of a linear axis,
/// its tilt, the run-out of a rotary one.
pub fn read_deviations(
    file: &str,
    text: &str,
    deviation: Dimension,
    problems: &mut Diagnostics,
) -> Option<Measurement> {
    let sheet = Sheet::parse(file, text, role_cells, problems)?.with_repeats(problems);
    warn_of_unused(&sheet, &["direction"], problems);
    crate::check_temperatures(&sheet, problems);
    crate::check_times(&sheet, false, problems);
    of_dimension(&sheet, Some(deviation), problems)
}

/// As [`read`], of a table that is there already.
pub(crate) fn from_sheet(sheet: &Sheet, problems: &mut Diagnostics) -> Option<Measurement> {
    of_dimension(sheet, None, problems)
}

/// The deviations are of that dimension, or of that of the positions.
fn of_dimension(
    sheet: &Sheet,
    deviation: Option<Dimension>,
    problems: &mut Diagnostics,
) -> Option<Measurement> {
    let Some(target) = sheet.about("target") else {
        let message = "the table has no column of target positions".to_owned();
        let hint = "name it target_mm or target_deg";
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    };
    for role in ["target", "actual", "deviation"] {
        let of_role = sheet.columns.iter().filter(|c| c.role() == role).nth(1);
        if let Some(second) = of_role {
            let message = format!("column `{}`: there is another column of the same", second.name);
            problems.error("duplicate-column", second.place.clone(), message, "leave one of them");
            return None;
        }
    }
    one_axis(sheet, problems)?;
    let kind = match Unit::find(target.unit(), Dimension::Angle) {
        Ok(_) => AxisKind::Rotary,
        Err(_) => AxisKind::Linear,
    };
    let targets = sheet.inner(target, Measurement::dimension(kind), problems)?;
    let read = Deviations { positions: &targets, dimension: deviation, kind };
    let wide: Vec<&Column> =
        sheet.columns.iter().filter(|c| wide_role(c.role()).is_some()).collect();
    let targets = match wide.is_empty() {
        true => long(sheet, &read, problems)?,
        false => self::wide(sheet, &read, &wide, problems)?,
    };
    Some(Measurement { kind, targets })
}

/// Readings of several axes in one table would make one set of figures.
fn one_axis(sheet: &Sheet, problems: &mut Diagnostics) -> Option<()> {
    let Some(column) = sheet.columns.iter().find(|c| c.name == "axis" && c.cells == Cells::Words)
    else {
        return Some(());
    };
    let word = |row: usize| sheet.words[column.values[row] as usize].as_str();
    let other = (1..sheet.rows()).find(|row| !word(*row).eq_ignore_ascii_case(word(0)));
    let Some(row) = other else { return Some(()) };
    let message = format!("the readings are of the axes {} and {}", word(0), word(row));
    let hint = "a positioning test is that of one axis: one table for each";
    problems.error("several-axes", sheet.row_place(row), message, hint);
    None
}

/// Reports every column that is not used.
pub(crate) fn warn_of_unused(sheet: &Sheet, used: &[&str], problems: &mut Diagnostics) {
    for column in &sheet.columns {
        let words = matches!(column.cells, Cells::Words | Cells::Unused);
        if words && !used.contains(&column.name.as_str()) {
            let message = format!("column `{}` is not used", column.name);
            let hint = "known here: target_mm or _deg, run, direction, actual_… or deviation_…, \
                        or up_1_um, down_1_um, up_2_um …; time_…, temperature_degC";
            problems.warn("unused-column", column.place.clone(), message, hint);
        }
    }
}

/// Finds the target of a position; most rows ask for the last one or the one after it.
#[derive(Default)]
struct Targets {
    list: Vec<Target>,
    places: HashMap<u64, usize>,
    last: usize,
}

impl Targets {
    fn at(&mut self, position: f64) -> &mut Target {
        // + 0.0: −0 and 0 are one target.
        let position = position + 0.0;
        let near = [self.last, self.last + 1, self.last.wrapping_sub(1)];
        let known = |i: &usize| self.list.get(*i).is_some_and(|t| t.position == position);
        self.last = match near.iter().copied().find(known) {
            Some(i) => i,
            None => {
                let next = self.list.len();
                *self.places.entry(position.to_bits()).or_insert(next)
            }
        };
        if self.last == self.list.len() {
            self.list.push(Target { position, ..Target::default() });
        }
        &mut self.list[self.last]
    }

    fn sorted(mut self) -> Vec<Target> {
        self.list.sort_by(|a, b| a.position.total_cmp(&b.position));
        for target in &mut self.list {
            target.up.sort_by_key(|r| r.run);
            target.down.sort_by_key(|r| r.run);
        }
        self.list
    }
}

fn direction_of(word: &str) -> Option<Direction> {
    match word.to_ascii_lowercase().as_str() {
        "up" | "+" | "1" | "+1" | "↑" | "forward" | "positive" => Some(Direction::Up),
        "down" | "-" | "-1" | "−" | "−1" | "↓" | "backward" | "reverse" | "negative" => {
            Some(Direction::Down)
        }
        _ => None,
    }
}

/// The direction of every word of the sheet, and the row's direction through it.
fn directions(sheet: &Sheet, problems: &mut Diagnostics) -> Option<Vec<Direction>> {
    let Some(column) = sheet.columns.iter().find(|c| c.name == "direction") else {
        let message = "no column `direction`: every reading counts as rising (↑)".to_owned();
        let hint = "write up or down; a test from one side only cannot determine the reversal";
        problems.warn("missing-direction", sheet.headings_place(), message, hint);
        return Some(vec![Direction::Up; sheet.rows()]);
    };
    let known: Vec<Option<Direction>> = sheet.words.iter().map(|w| direction_of(w)).collect();
    let mut found = Vec::with_capacity(sheet.rows());
    for (row, value) in column.values.iter().enumerate() {
        let Some(direction) = known.get(*value as usize).copied().flatten() else {
            let message = format!("`{}` is not a direction", sheet.words[*value as usize]);
            let place = sheet.row_place(row);
            problems.error("bad-direction", place, message, "write up or down, or + or -");
            return None;
        };
        found.push(direction);
    }
    Some(found)
}

/// How the deviations of a sheet are read.
struct Deviations<'a> {
    /// The targets, row by row.
    positions: &'a [f64],
    /// Of the deviations, where it is not that of the positions.
    dimension: Option<Dimension>,
    kind: AxisKind,
}

impl Deviations<'_> {
    fn dimension(&self) -> Dimension {
        self.dimension.unwrap_or(Measurement::dimension(self.kind))
    }

    /// Actual − target; of a rotary axis the short way, as encoders begin again at 360°.
    fn less_target(&self, actual: f64, target: f64) -> f64 {
        let off = actual - target;
        match self.kind {
            AxisKind::Rotary => off - TAU * (off / TAU).round(),
            AxisKind::Linear => off,
        }
    }

    /// Actual positions are those of the axis itself.
    fn has_actual(&self, sheet: &Sheet, problems: &mut Diagnostics) -> bool {
        let is_own = self.dimension() == Measurement::dimension(self.kind);
        if !is_own {
            let message = "actual positions say nothing of this error".to_owned();
            let hint = "a column of deviations: deviation_um or deviation_urad";
            problems.error("wrong-column", sheet.headings_place(), message, hint);
        }
        is_own
    }
}

/// Actual − target, or the deviation as it is.
fn deviations(
    sheet: &Sheet,
    read: &Deviations<'_>,
    problems: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let dimension = read.dimension();
    match (sheet.about("deviation"), sheet.about("actual")) {
        (Some(column), None) => sheet.inner(column, dimension, problems),
        (None, Some(_)) if !read.has_actual(sheet, problems) => None,
        (None, Some(column)) => {
            let actual = sheet.inner(column, dimension, problems)?;
            let each = actual.iter().zip(read.positions);
            Some(each.map(|(a, t)| read.less_target(*a, *t)).collect())
        }
        (found, _) => {
            let (code, message) = match found {
                Some(_) => ("duplicate-column", "there are both deviations and actual positions"),
                None => ("missing-column", "there are neither deviations nor actual positions"),
            };
            let hint = "one column: deviation_um, actual_mm, deviation_arcsec, actual_deg …";
            problems.error(code, sheet.headings_place(), message.to_owned(), hint);
            None
        }
    }
}

fn long(sheet: &Sheet, read: &Deviations<'_>, problems: &mut Diagnostics) -> Option<Vec<Target>> {
    let deviations = deviations(sheet, read, problems)?;
    let directions = directions(sheet, problems)?;
    let runs = match sheet.columns.iter().find(|c| c.name == "run") {
        Some(column) => Some(run_numbers(sheet, column, problems)?),
        None => None,
    };
    let mut targets = Targets::default();
    for (row, position) in read.positions.iter().enumerate() {
        let readings = targets.at(*position).of_mut(directions[row]);
        let run = runs.as_ref().map_or(readings.len() as u32 + 1, |r| r[row]);
        readings.push(Reading { run, deviation: deviations[row] });
    }
    Some(targets.sorted())
}

fn run_numbers(sheet: &Sheet, column: &Column, problems: &mut Diagnostics) -> Option<Vec<u32>> {
    let mut runs = Vec::with_capacity(column.values.len());
    for (row, value) in column.values.iter().enumerate() {
        if value.fract() != 0.0 || !(0.0..=1e9).contains(value) {
            let message = format!("{value} is not a run number");
            problems.error("bad-run", sheet.row_place(row), message, "runs are counted 1, 2, 3 …");
            return None;
        }
        runs.push(*value as u32);
    }
    Some(runs)
}

fn wide(
    sheet: &Sheet,
    read: &Deviations<'_>,
    columns: &[&Column],
    problems: &mut Diagnostics,
) -> Option<Vec<Target>> {
    let mut targets = Targets::default();
    for column in columns {
        let (actual, direction, run) = wide_role(column.role())?;
        if actual && !read.has_actual(sheet, problems) {
            return None;
        }
        let values = sheet.inner(column, read.dimension(), problems)?;
        for (position, value) in read.positions.iter().zip(values) {
            let readings = targets.at(*position).of_mut(direction);
            // An empty cell is a reading that was not taken; the check reports unequal counts.
            if value.is_nan() {
                continue;
            }
            let deviation = if actual { read.less_target(value, *position) } else { value };
            readings.push(Reading { run, deviation });
        }
    }
    Some(targets.sorted())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_ok(text: &str) -> Measurement {
        let mut problems = Diagnostics::new();
        let read = read("t.csv", text, &mut problems);
        assert!(!problems.has_errors(), "{problems:?}");
        read.unwrap()
    }

    #[test]
    fn units_of_the_headings_hold() {
        let mm = read_ok("target_mm,direction,actual_mm\n100,up,100.003\n");
        assert!((mm.targets[0].up[0].deviation - 0.003).abs() < 1e-12);
        let arc = read_ok("target_deg,direction,deviation_arcsec\n90,down,3600\n");
        assert_eq!(arc.kind, AxisKind::Rotary);
        assert!((arc.targets[0].down[0].deviation.to_degrees() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn an_encoder_that_begins_again_at_360_degrees_reads_the_short_way() {
        let deg = |text: &str| {
            let read = read_ok(&format!("target_deg,direction,actual_deg\n{text}\n"));
            read.targets[0].up[0].deviation.to_degrees()
        };
        let cases = [("0,up,359.999", -1e-3), ("360,up,0.002", 2e-3), ("-90,up,270.001", 1e-3)];
        for (text, wanted) in cases {
            assert!((deg(text) - wanted).abs() < 1e-9, "{text}: {}", deg(text));
        }
        let wide = read_ok("target_deg,actual_up_1_deg\n0,359.999\n");
        assert!((wide.targets[0].up[0].deviation.to_degrees() + 1e-3).abs() < 1e-9);
        // A linear axis has no turns.
        let mm = read_ok("target_mm,direction,actual_mm\n0,up,359.999\n");
        assert_eq!(mm.targets[0].up[0].deviation, 359.999);
    }

    #[test]
    fn an_empty_cell_of_the_wide_table_is_no_reading() {
        let m = read_ok("target_mm,up_1_um,up_2_um\n0,1,\n5,1,2\n");
        assert_eq!((m.targets[0].up.len(), m.targets[1].up.len()), (1, 2));
    }

    #[test]
    fn bad_words_are_named() {
        for (text, code) in [
            ("target_mm,direction,deviation_um\n0,sideways,1\n", "bad-direction"),
            ("target_mm,run,direction,deviation_um\n0,1.5,up,1\n", "bad-run"),
            ("target_mm,direction\n0,up\n", "missing-column"),
            ("direction,deviation_um\nup,1\n", "missing-column"),
            ("target_mm,direction,deviation_arcsec\n0,up,1\n", "wrong-unit"),
            ("target_mm,direction,deviation_um\n0,up,nan\n", "not-a-number"),
        ] {
            let mut problems = Diagnostics::new();
            assert!(read("t.csv", text, &mut problems).is_none());
            assert!(problems.iter().any(|d| d.code == code), "{code}: {problems:?}");
        }
    }
}
