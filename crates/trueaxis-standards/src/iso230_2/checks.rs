//! What the standard asks of the test itself: positions, runs, directions; and readings that stand
//! out. Nothing is dropped; the parameters are those of all readings.
//!
//! The clauses are named from memory of ISO 230-2:2014; its text was not available.

use super::{Direction, Measurement, Reading, Target};
use std::collections::{BTreeMap, HashMap};
use trueaxis_geometry::AxisKind;
use trueaxis_input::{Diagnostics, Place};

/// Up to this travel, mm, a linear axis is tested with five runs (5.3.2).
pub const SHORT_AXIS_MM: f64 = 2000.0;
/// Runs in each direction that the standard asks for (5.3.2, 5.3.4).
pub const RUNS: usize = 5;
/// Average interval of an axis longer than that, mm (5.3.3).
const LONG_INTERVAL_MM: f64 = 250.0;
/// A run stands out if its distances from the medians of the targets are so many times the usual ones.
const OUTLIER_RUN: f64 = 4.0;
/// A reading stands out if it is so many standard deviations from the median of its target.
const OUTLIER_READING: f64 = 6.0;
/// Outlying readings that are named one by one.
const MOST_NAMED: usize = 10;
/// So many times wider than the usual gap is the gap between clusters of targets.
const CLUSTERED: f64 = 100.0;
/// Two runs of fewer readings may be equal by chance.
const LEAST_ALIKE: usize = 5;
/// A deviation larger than this, mm or rad, is more likely a mistake.
const LARGEST_DEVIATION: f64 = 1.0;

/// Reports what the measurement lacks of the standard's test, and its outliers.
pub fn check(measurement: &Measurement, file: &str, problems: &mut Diagnostics) {
    let place = Place::whole(file);
    let mut check = Check { m: measurement, place, problems };
    check.positions();
    check.targets();
    check.runs();
    check.copied_runs();
    check.deviations();
    check.outliers();
}

struct Check<'a> {
    m: &'a Measurement,
    place: Place,
    problems: &'a mut Diagnostics,
}

/// What the standard asks for: positions, runs, and the clause.
struct Asked {
    positions: usize,
    runs: usize,
    clause: &'static str,
}

fn asked(kind: AxisKind, length: f64) -> Asked {
    let per = |unit: f64| (length / unit - 1e-9).ceil().max(0.0) as usize;
    match kind {
        AxisKind::Linear if length <= SHORT_AXIS_MM => {
            // Five per metre.
            Asked { positions: per(200.0).max(5), runs: RUNS, clause: "5.3.2" }
        }
        AxisKind::Linear => {
            Asked { positions: per(LONG_INTERVAL_MM) + 1, runs: 1, clause: "5.3.3" }
        }
        AxisKind::Rotary => {
            let degrees = length.to_degrees();
            let turns = (degrees / 360.0 - 1e-9).ceil().max(1.0) as usize;
            match degrees {
                d if d <= 90.0 + 1e-9 => Asked { positions: 3, runs: RUNS, clause: "5.3.4" },
                d if d <= 180.0 + 1e-9 => Asked { positions: 5, runs: RUNS, clause: "5.3.4" },
                d if d <= 360.0 + 1e-9 => Asked { positions: 8, runs: RUNS, clause: "5.3.4" },
                _ => Asked { positions: 8 * turns, runs: 1, clause: "5.3.5" },
            }
        }
    }
}

fn least_count(m: &Measurement) -> usize {
    let counts = m.targets.iter().flat_map(|t| [t.up.len(), t.down.len()]);
    counts.filter(|n| *n > 0).min().unwrap_or(0)
}

impl Check<'_> {
    fn warn(&mut self, code: &'static str, message: String, hint: &str) {
        self.problems.warn(code, self.place.clone(), message, hint);
    }

    fn in_words(&self, position: f64) -> String {
        match self.m.kind {
            AxisKind::Linear => format!("{} mm", (position * 1e9).round() / 1e9),
            AxisKind::Rotary => format!("{} deg", (position.to_degrees() * 1e9).round() / 1e9),
        }
    }

    fn positions(&mut self) {
        let asked = asked(self.m.kind, self.m.length());
        let found = self.m.targets.len();
        if found < asked.positions {
            let message = format!(
                "{found} target positions over {}; ISO 230-2:2014 clause {} asks for {}",
                self.in_words(self.m.length()),
                asked.clause,
                asked.positions
            );
            let hint = "evaluated as it is; state this with the results";
            self.warn("few-positions", message, hint);
        }
        let runs = least_count(self.m);
        if runs < asked.runs {
            let message = format!(
                "only {runs} run{} at some target; ISO 230-2:2014 clause {} asks for {} in each \
                 direction",
                if runs == 1 { "" } else { "s" },
                asked.clause,
                asked.runs
            );
            let hint = match runs {
                1 => "one reading has no s: there R and A are left out, E, M, B are valid",
                _ => "evaluated as it is; s, R and A of few runs are uncertain",
            };
            self.warn("few-runs", message, hint);
        } else if asked.runs == 1 && runs < RUNS {
            let message = format!(
                "a long axis with {runs} run{} in each direction (clause {})",
                if runs == 1 { "" } else { "s" },
                asked.clause
            );
            let hint = "s, R and A are not applicable to one run (clause 6.2); E, M and B are";
            self.problems.note("long-axis", self.place.clone(), message, hint);
        }
    }

    fn targets(&mut self) {
        let positions: Vec<f64> = self.m.targets.iter().map(|t| t.position).collect();
        let gaps: Vec<f64> = positions.windows(2).map(|w| w[1] - w[0]).collect();
        let Some(middle) = median(gaps.clone()) else { return };
        if let Some(i) = gaps.iter().position(|gap| *gap < 0.01 * middle) {
            let message = format!(
                "targets {} and {} nearly coincide: the runs have unequal targets",
                self.in_words(positions[i]),
                self.in_words(positions[i + 1])
            );
            let hint = "every run goes to the same targets; write the programmed position, not the \
                        one on the display";
            self.warn("unequal-targets", message, hint);
        }
        let largest = gaps.iter().copied().fold(0.0, f64::max);
        let alone = self.m.targets.iter().all(|t| t.up.len() <= 1 && t.down.len() <= 1);
        if alone && largest > CLUSTERED * middle {
            let message =
                format!("{} targets form clusters, each with one reading", positions.len());
            let hint = "are the columns of targets and actual positions swapped?";
            self.warn("clustered-targets", message, hint);
        }
        let even = gaps.iter().all(|gap| (gap - middle).abs() <= 1e-6 * middle);
        if even && gaps.len() > 2 {
            let message = "the targets are equally spaced".to_owned();
            let hint = "ISO 230-2:2014 clause 5.3.1 adds a random part to each interval, so that \
                        periodic errors are seen";
            self.problems.note("equal-spacing", self.place.clone(), message, hint);
        }
    }

    fn runs(&mut self) {
        let t = &self.m.targets;
        let some_up = t.iter().any(|t| !t.up.is_empty());
        let some_down = t.iter().any(|t| !t.down.is_empty());
        if some_up != some_down {
            let message = "readings in one direction only: a unidirectional test".to_owned();
            let hint = "R, E, A of that direction are valid; B, B̄, M and the bidirectional A, E, R need \
                        both directions";
            self.warn("one-direction", message, hint);
        } else if let Some(lone) = t.iter().find(|t| t.up.is_empty() != t.down.is_empty()) {
            let message =
                format!("target {} was reached from one side only", self.in_words(lone.position));
            let hint = "B, M and R take the targets with both sides";
            self.warn("missing-side", message, hint);
        }
        let counts = || t.iter().flat_map(|t| [t.up.len(), t.down.len()]).filter(|n| *n > 0);
        if let (Some(least), Some(most)) = (counts().min(), counts().max())
            && least != most
        {
            let message = format!("unequal numbers of runs: {least} to {most}");
            let hint = "each target is evaluated with the readings it has";
            self.warn("unequal-runs", message, hint);
        }
        let readings = || t.iter().flat_map(|t| t.up.iter().chain(&t.down));
        if let Some(r) = readings().find(|r| r.run as usize > readings().count()) {
            let message = format!("run {} of {} readings", r.run, readings().count());
            let hint = "runs are counted 1, 2, 3 …; are the columns of runs and targets swapped?";
            self.warn("strange-run", message, hint);
        }
        let twice = |readings: &[Reading]| readings.windows(2).any(|w| w[0].run == w[1].run);
        if let Some(t) = t.iter().find(|t| twice(&t.up) || twice(&t.down)) {
            let message = format!(
                "target {} has two readings of one run and direction",
                self.in_words(t.position)
            );
            self.warn(
                "duplicate-reading",
                message,
                "both are used; are the runs numbered correctly?",
            );
        }
    }

    /// Runs that read the same at every target: a copy, or a display of few digits.
    fn copied_runs(&mut self) {
        let mut runs: BTreeMap<u32, Vec<(u64, bool, u64)>> = BTreeMap::new();
        for t in &self.m.targets {
            for (readings, is_up) in [(&t.up, true), (&t.down, false)] {
                for r in readings {
                    // −0 is 0.
                    let [at, read] = [t.position, r.deviation].map(|v| (v + 0.0).to_bits());
                    runs.entry(r.run).or_default().push((at, is_up, read));
                }
            }
        }
        let differs = |all: &[(u64, bool, u64)]| all.windows(2).any(|w| w[0].2 != w[1].2);
        let mut first: HashMap<Vec<(u64, bool, u64)>, u32> = HashMap::new();
        for (run, all) in runs {
            if all.len() < LEAST_ALIKE || !differs(&all) {
                continue;
            }
            let of = *first.entry(all).or_insert(run);
            if of != run {
                let message =
                    format!("run {run} reads as run {of} at every target, to the last digit");
                let hint = "a copy makes R and A too small: delete it; or does the display show too few \
                            digits?";
                self.warn("copied-run", message, hint);
            }
        }
    }

    fn deviations(&mut self) {
        // No axis is further off than it moves.
        let limit = match self.m.length() {
            length if length > 0.0 => LARGEST_DEVIATION.min(length),
            _ => LARGEST_DEVIATION,
        };
        let large = |r: &&Reading| r.deviation.abs() > limit;
        let of = |t: &Target| t.up.iter().chain(&t.down).find(large).copied();
        let found = self.m.targets.iter().find_map(|t| of(t).map(|r| (t.position, r)));
        if let Some((position, reading)) = found {
            let message = format!(
                "at {} the deviation is {}",
                self.in_words(position),
                self.in_words(reading.deviation)
            );
            let hint = "are the columns swapped, or is the unit of a heading wrong?";
            self.warn("large-deviation", message, hint);
        }
    }

    /// Runs and readings that stand out from the median of their target.
    fn outliers(&mut self) {
        for direction in [Direction::Up, Direction::Down] {
            let residuals = residuals(self.m, direction);
            let arrow = if direction == Direction::Up { "↑" } else { "↓" };
            if self.outlier_runs(&residuals, arrow).is_empty() {
                self.outlier_readings(&residuals, arrow);
            }
        }
    }

    fn outlier_runs(&mut self, residuals: &[Residual], arrow: &str) -> Vec<u32> {
        // Medians: one bad reading does not make a bad run.
        let by_run = by_run(residuals);
        let usual = median(residuals.iter().map(|r| r.value.abs()).collect()).unwrap_or(0.0);
        let runs = by_run.into_iter().filter(|(_, values)| values.len() >= 3);
        let medians = runs.filter_map(|(run, values)| Some((run, median(values)?)));
        let mut found = Vec::new();
        for (run, value) in medians {
            if usual > 0.0 && value > OUTLIER_RUN * usual && found.len() < MOST_NAMED {
                let message = format!(
                    "run {run} {arrow} stands out: {:.2} times as far from the median of its targets \
                     as usual",
                    value / usual
                );
                let hint = "was the machine warm, the beam interrupted? it is used like the others";
                self.warn("outlier-run", message, hint);
                found.push(run);
            }
        }
        found
    }

    fn outlier_readings(&mut self, residuals: &[Residual], arrow: &str) {
        // 1.4826 · median |x| is σ of a normal distribution, whatever a few outliers do.
        let Some(middle) = median(residuals.iter().map(|r| r.value.abs()).collect()) else {
            return;
        };
        let limit = OUTLIER_READING * 1.4826 * middle;
        let far = residuals.iter().filter(|r| limit > 0.0 && r.value.abs() > limit);
        for residual in far.take(MOST_NAMED) {
            let message = format!(
                "run {} {arrow} at {}: the reading is {:.1} standard deviations from the median of \
                 its target",
                residual.run,
                self.in_words(residual.position),
                residual.value.abs() / (1.4826 * middle)
            );
            self.warn("outlier-reading", message, "check it; it is used like the others");
        }
    }
}

/// The distances of every run, by its number.
fn by_run(residuals: &[Residual]) -> Vec<(u32, Vec<f64>)> {
    let mut runs: Vec<(u32, Vec<f64>)> = Vec::new();
    let mut places: HashMap<u32, usize> = HashMap::new();
    let mut next = 0;
    for r in residuals {
        // At every target the runs come in the same order: mostly it is the next one.
        if runs.get(next).is_none_or(|(run, _)| *run != r.run) {
            next = *places.entry(r.run).or_insert(runs.len());
        }
        if next == runs.len() {
            runs.push((r.run, Vec::new()));
        }
        runs[next].1.push(r.value.abs());
        next += 1;
    }
    runs.sort_by_key(|(run, _)| *run);
    runs
}

/// Distance of a reading from the median of its target and direction.
struct Residual {
    position: f64,
    run: u32,
    value: f64,
}

fn residuals(m: &Measurement, direction: Direction) -> Vec<Residual> {
    let mut all = Vec::new();
    // The median of less than four readings is not significant.
    for t in m.targets.iter().filter(|t| t.of(direction).len() >= 4) {
        let readings = t.of(direction);
        let middle = median(readings.iter().map(|r| r.deviation).collect()).unwrap_or(0.0);
        let residual = |r: &Reading| Residual {
            position: t.position,
            run: r.run,
            value: r.deviation - middle,
        };
        all.extend(readings.iter().map(residual));
    }
    all
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    if values.is_empty() {
        return None;
    }
    let middle = values.len() / 2;
    let (_, value, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    Some(*value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::iso230_2::read;

    fn codes(table: &str) -> Vec<&'static str> {
        let mut problems = Diagnostics::new();
        let measured = read("t.csv", table, &mut problems).unwrap();
        check(&measured, "t.csv", &mut problems);
        problems.iter().map(|d| d.code).collect()
    }

    /// Six targets, five runs, both directions; `change` may spoil a row or leave it out.
    fn table(change: impl Fn(usize, usize, &str, f64) -> Option<f64>) -> String {
        let mut text = "target_mm,run,direction,deviation_um\n".to_owned();
        for (i, target) in [0.0, 101.3, 195.0, 305.7, 398.2, 500.0].iter().enumerate() {
            for run in 1..=5 {
                for side in ["up", "down"] {
                    // Between −1 and 1, the same for every run over all targets.
                    let noise = ((i * 7 + run * 3) % 5) as f64 * 0.5 - 1.0;
                    if let Some(v) = change(i, run, side, noise) {
                        text += &format!("{target},{run},{side},{v}\n");
                    }
                }
            }
        }
        text
    }

    #[test]
    fn a_whole_test_has_nothing_to_tell() {
        assert!(codes(&table(|_, _, _, v| Some(v))).is_empty());
    }

    #[test]
    fn what_is_missing_is_named() {
        assert_eq!(codes(&table(|_, r, _, v| (r < 4).then_some(v))), ["few-runs"]);
        assert_eq!(codes(&table(|i, _, _, v| (i != 2).then_some(v))), Vec::<&str>::new());
        assert_eq!(codes(&table(|i, _, _, v| (i > 1).then_some(v))), ["few-positions"]);
        assert_eq!(codes(&table(|_, _, d, v| (d == "up").then_some(v))), ["one-direction"]);
        let hole = table(|i, _, d, v| (i != 1 || d == "up").then_some(v));
        assert_eq!(codes(&hole), ["missing-side"]);
        let few = table(|i, r, _, v| (i != 1 || r < 3).then_some(v));
        assert_eq!(codes(&few), ["few-runs", "unequal-runs"]);
    }

    /// Whatever is pasted again, and wherever, the parameters are those of the readings that were taken.
    #[test]
    fn copies_are_named_and_count_once() {
        let text = table(|_, _, _, v| Some(v));
        let (head, rows) = text.split_once('\n').unwrap();
        let targets = |text: &str| {
            let mut problems = Diagnostics::new();
            read("t.csv", text, &mut problems).unwrap().targets
        };
        let plain = targets(&text);
        let again = format!("{text}{rows}");
        assert_eq!(targets(&again), plain);
        assert_eq!(codes(&again), ["copied-rows"; 4]);
        let doubled: String = rows.lines().flat_map(|row| [row, "\n", row, "\n"]).collect();
        assert_eq!(targets(&format!("{head}\n{doubled}")), plain);
        // Without run numbers, too.
        let column = |row: &str| {
            let c: Vec<&str> = row.split(',').collect();
            format!("{},{},{}\n", c[0], c[2], c[3])
        };
        // Readings that differ at every target: what is equal was pasted.
        let text = table(|i, r, d, v| {
            Some(v + 0.01 * r as f64 + 0.001 * i as f64 + if d == "up" { 0.3 } else { 0.0 })
        });
        let rows: String = text.lines().skip(1).map(column).collect();
        let head = "target_mm,direction,deviation_um\n";
        assert_eq!(targets(&format!("{head}{rows}{rows}")), targets(&format!("{head}{rows}")));
    }

    #[test]
    fn a_run_that_is_a_copy_is_named() {
        let text = table(|_, r, _, v| (r < 5).then_some(v));
        let copy: String = text
            .lines()
            .filter(|row| row.split(',').nth(1) == Some("1"))
            .map(|row| row.replacen(",1,", ",5,", 1) + "\n")
            .collect();
        assert_eq!(codes(&format!("{text}{copy}")), ["copied-run"]);
    }

    #[test]
    fn what_stands_out_is_named() {
        let run = table(|_, r, d, v| Some(if r == 4 && d == "up" { v + 20.0 } else { v }));
        assert_eq!(codes(&run), ["outlier-run"]);
        let reading =
            table(|i, r, d, v| Some(if (i, r, d) == (2, 3, "down") { v + 9.0 } else { v }));
        assert_eq!(codes(&reading), ["outlier-reading"]);
        let swapped = table(|_, _, _, v| Some(v + 3000.0));
        assert!(codes(&swapped).contains(&"large-deviation"));
        let near = table(|_, _, _, v| Some(v)).replace("305.7,3,up", "305.71,3,up");
        assert!(codes(&near).contains(&"unequal-targets"));
        // Deviations in place of targets, targets in place of runs, readings in place of targets.
        let mut swapped = ["target_mm,run,direction,deviation_um\n"; 3].map(str::to_owned);
        for (i, target) in [0, 100, 200, 300, 400, 500].into_iter().enumerate() {
            for run in 1..=5 {
                let deviation = ((i * 7 + run * 3) % 5) as f64 - 2.0;
                swapped[0] += &format!("{},{run},up,{target}\n", deviation * 0.05);
                swapped[1] += &format!("{run},{target},up,{deviation}\n");
                let actual = f64::from(target) + deviation * 1e-3 + run as f64 * 1e-5;
                swapped[2] += &format!("{actual},{run},up,{}\n", -deviation);
            }
        }
        let codes = swapped.map(|table| codes(&table));
        assert!(codes[0].contains(&"large-deviation"), "{codes:?}");
        assert!(codes[1].contains(&"strange-run"), "{codes:?}");
        assert!(codes[2].contains(&"clustered-targets"), "{codes:?}");
    }

    #[test]
    fn the_clause_follows_the_travel() {
        assert_eq!(asked(AxisKind::Linear, 1500.0).positions, 8);
        assert_eq!(asked(AxisKind::Linear, 3000.0).positions, 13);
        assert_eq!(asked(AxisKind::Linear, 3000.0).runs, 1);
        assert_eq!(asked(AxisKind::Rotary, 120_f64.to_radians()).positions, 5);
        assert_eq!(asked(AxisKind::Rotary, 720_f64.to_radians()).positions, 16);
    }
}
