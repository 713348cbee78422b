//! The proof: both programs simulated on the actual machine, against what was programmed.

use super::found::{Found, Want};
use super::stand::Stand;
use std::ops::Range;
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Travel;
use trueaxis_motion::{
    Batch, Densify, IssueKind, IssueList, Log, Observer, Options, SetUp, Timing, simulate,
};
use trueaxis_nc::Program;

/// A largest value and the line of the program as it was.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Largest {
    /// The value. Unit: mm or rad.
    pub value: f64,
    /// From 1.
    pub line: u32,
}

impl Largest {
    pub(super) fn take(&mut self, value: f64, line: u32) {
        // NaN counts as the worst.
        if value > self.value || value.is_nan() {
            *self = Self { value, line };
        }
    }
}

/// What the actual tool misses, tip in mm and tool axis in rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residual {
    /// The tip at the ends of blocks.
    pub tip_end: Largest,
    /// The tool axis there.
    pub axis_end: Largest,
    /// The tip anywhere on the way, with feed.
    pub tip: Largest,
    /// The tool axis there.
    pub axis: Largest,
    /// Root mean square of the tip at the ends of blocks, mm.
    pub tip_end_rms_mm: f64,
    /// Of the tool axis there, rad.
    pub axis_end_rms_rad: f64,
}

/// One block before and after.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BlockResidual {
    /// The line of the program as it was.
    pub line: u32,
    /// The largest deviation of the tip anywhere in the block before, mm.
    pub tip_before_mm: f64,
    /// And after.
    pub tip_after_mm: f64,
    /// Of the tool axis before, rad.
    pub axis_before_rad: f64,
    /// And after.
    pub axis_after_rad: f64,
}

impl BlockResidual {
    /// Takes what is larger in another block; its line stays.
    fn take(&mut self, other: &Self) {
        self.tip_before_mm = self.tip_before_mm.max(other.tip_before_mm);
        self.tip_after_mm = self.tip_after_mm.max(other.tip_after_mm);
        self.axis_before_rad = self.axis_before_rad.max(other.axis_before_rad);
        self.axis_after_rad = self.axis_after_rad.max(other.axis_after_rad);
    }
}

/// What the written program does on the actual machine.
#[derive(Debug, Clone, Default)]
pub struct Proof {
    /// The program as it was.
    pub before: Residual,
    /// The program that was written.
    pub after: Residual,
    /// The worst blocks, by the residual error of the tip.
    pub worst: Vec<BlockResidual>,
    /// All blocks along the program; of a long one stretches of blocks, each with its largest deviations under its
    /// first line.
    pub along: Vec<BlockResidual>,
    /// Pieces compared at their ends.
    pub compared: u64,
    /// Axes that leave their travel.
    pub issues: IssueList,
    /// What was found while the written program was read.
    pub problems: Diagnostics,
}

/// Blocks in the list of the worst.
const WORST: usize = 20;

/// Entries along the program.
const ALONG: usize = 2000;

/// Simulates the program as it was and the one that was written; `limits` of its tip, mm, and its axis, rad, between the ends of blocks.
pub(super) fn prove(
    machine: &Machine,
    programs: [&Program; 2],
    setup: &SetUp,
    found: &Found,
    numbers: &[u32],
    (densify, limits): (Densify, [f64; 2]),
) -> Proof {
    let [was, is] = programs;
    // Places and travel count, not times.
    let options = Options { densify, timing: Timing::Untimed, ..Options::default() };
    let mut before = Compare::of(found, numbers, None);
    let mut after = Compare::of(found, numbers, Some(limits));
    let mut watch = TravelWatch { machine, log: Log::default() };
    let (_, run) = rayon::join(
        || simulate(machine, was, setup, &options, &mut [&mut before]),
        || simulate(machine, is, setup, &options, &mut [&mut after, &mut watch]),
    );
    Proof {
        before: before.residual(),
        after: after.residual(),
        worst: worst(&before.rows, &after.rows),
        along: along(&before.rows, &after.rows),
        compared: after.compared,
        issues: IssueList::of([watch.log]),
        problems: run.problems,
    }
}

/// Watches the travel of the axes.
struct TravelWatch<'m> {
    machine: &'m Machine,
    log: Log,
}

impl Observer for TravelWatch<'_> {
    fn path(&mut self, batch: &Batch<'_>) {
        for (node, stamp) in batch.nodes.iter().zip(batch.stamps) {
            for (axis, q) in node.command.iter().enumerate().take(self.machine.axes().len()) {
                let travel = self.machine.axes()[axis].travel;
                if let Travel::Between(low, high) = travel
                    && !travel.contains(*q)
                {
                    let limit = if *q > high { high } else { low };
                    self.log.note(IssueKind::OverTravel { axis }, node, stamp, *q, limit);
                }
            }
        }
    }
}

/// The blocks of both runs that were passed, in the order of their lines.
fn blocks<'r>(
    before: &'r [Missed],
    after: &'r [Missed],
) -> impl Iterator<Item = BlockResidual> + 'r {
    let both = before.iter().zip(after).enumerate();
    let passed = both.filter(|(_, (before, after))| **before != UNSEEN || **after != UNSEEN);
    passed.map(|(line, (before, after))| BlockResidual {
        line: line as u32,
        tip_before_mm: before[0].max(0.0),
        tip_after_mm: after[0].max(0.0),
        axis_before_rad: before[1].max(0.0),
        axis_after_rad: after[1].max(0.0),
    })
}

/// The worst blocks of both runs; of equal ones those that come first.
fn worst(before: &[Missed], after: &[Missed]) -> Vec<BlockResidual> {
    let mut worst: Vec<BlockResidual> = Vec::with_capacity(WORST + 1);
    for row in blocks(before, after) {
        let is_before = |other: &BlockResidual| {
            let by = other.tip_after_mm.total_cmp(&row.tip_after_mm);
            by.then(other.tip_before_mm.total_cmp(&row.tip_before_mm)).is_ge()
        };
        let at = worst.partition_point(is_before);
        if at < WORST {
            worst.insert(at, row);
            worst.truncate(WORST);
        }
    }
    worst
}

/// All blocks of both runs, or the largest of stretches of equally many.
fn along(before: &[Missed], after: &[Missed]) -> Vec<BlockResidual> {
    let each = blocks(before, after).count().div_ceil(ALONG).max(1);
    let mut along: Vec<BlockResidual> = Vec::new();
    for (i, row) in blocks(before, after).enumerate() {
        match along.last_mut().filter(|_| i % each > 0) {
            Some(stretch) => stretch.take(&row),
            None => along.push(row),
        }
    }
    along
}

/// The largest deviations in a block: of the tip, mm, and of the tool axis, rad.
type Missed = [f64; 2];

/// Of a block that was not passed.
const UNSEEN: Missed = [-1.0; 2];

/// The line of a want in the program that is simulated.
fn simulated(want: &Want, numbers: Option<&[u32]>) -> u32 {
    numbers.map_or(want.line, |numbers| numbers[want.line as usize - 1] + want.piece())
}

/// The first want of each line, counted from 1; 0 if there is none.
fn first_of_lines(wants: &[Want], line_of: impl Fn(&Want) -> u32, lines: usize) -> Vec<u32> {
    let mut first = vec![0; lines];
    for (i, want) in wants.iter().enumerate() {
        let number = line_of(want) as usize;
        if first.len() <= number {
            first.resize(number + 1, 0);
        }
        // A block that is executed again goes to the same places.
        if first[number] == 0 {
            first[number] = i as u32 + 1;
        }
    }
    first
}

struct Compare<'f> {
    found: &'f Found,
    /// Of the written program: what its tip, mm, and its axis, rad, may miss between the ends of blocks.
    limits: Option<[f64; 2]>,
    /// The first want of each line of the simulated program, counted from 1, 0 if there is none; empty where the wants are in
    /// the order of these lines.
    at_line: Vec<u32>,
    /// The wants of the last line.
    last: Range<usize>,
    /// Of the written program: the lines that those of the program as it was became.
    numbers: Option<&'f [u32]>,
    line: u32,
    ended: bool,
    rows: Vec<Missed>,
    residual: Residual,
    /// Sums of the squares of tip, mm, and tool axis, rad, at the ends of blocks.
    squares: [f64; 2],
    compared: u64,
}

impl<'f> Compare<'f> {
    fn of(found: &'f Found, numbers: &'f [u32], limits: Option<[f64; 2]>) -> Self {
        let numbers_of_run = limits.map(|_| numbers);
        let line_of = |want: &Want| simulated(want, numbers_of_run);
        let at_line = match found.wants.is_sorted_by_key(line_of) {
            true => Vec::new(),
            false => first_of_lines(&found.wants, line_of, numbers.len() + 1),
        };
        let rows = vec![UNSEEN; numbers.len() + 1];
        Self {
            found,
            limits,
            at_line,
            last: 0..0,
            numbers: numbers_of_run,
            line: 0,
            ended: false,
            rows,
            residual: Residual::default(),
            squares: [0.0; 2],
            compared: 0,
        }
    }

    fn residual(&self) -> Residual {
        let rms = self.squares.map(|sum| (sum / self.compared.max(1) as f64).sqrt());
        Residual { tip_end_rms_mm: rms[0], axis_end_rms_rad: rms[1], ..self.residual }
    }

    /// The wants of a line.
    fn wants_of(&self, line: u32) -> Range<usize> {
        let wants = &self.found.wants;
        let line_of = |want: &Want| simulated(want, self.numbers);
        let from = match self.at_line.get(line as usize) {
            Some(0) => return 0..0,
            Some(first) => *first as usize - 1,
            None if !self.at_line.is_empty() => return 0..0,
            // Mostly they follow those of the line before.
            None => {
                let next = self.last.end;
                let begins = |at: usize| {
                    let is_before = |at: usize| wants.get(at).is_some_and(|w| line_of(w) < line);
                    at.checked_sub(1).is_none_or(is_before) && !is_before(at)
                };
                match begins(next) {
                    true => next,
                    false => wants.partition_point(|want| line_of(want) < line),
                }
            }
        };
        let others = |want: &Want| line_of(want) != line;
        let count = wants[from..].iter().position(others).unwrap_or(wants.len() - from);
        from..from + count
    }

    /// How far a place is from the way of a piece.
    fn missed(&self, want: &Want, is: &Stand) -> [f64; 2] {
        let stands = &self.found.stands[want.from as usize..want.to as usize];
        // The programmed way bends between its stands as it does around them.
        let bend = |k: usize| match stands.len() {
            0..3 => Vec3::zeros(),
            n => {
                let k = k.clamp(1, n - 2);
                stands[k - 1].tip - stands[k].tip * 2.0 + stands[k + 1].tip
            }
        };
        let bent = |k: usize, w: &[Stand]| {
            let chord = (w[1].tip - w[0].tip).norm();
            let bend = bend(k);
            // A corner is no bend.
            if bend.norm() <= 0.2 * chord { bend } else { Vec3::zeros() }
        };
        let pairs = || stands.windows(2).enumerate();
        let each = pairs().map(|(k, w)| is.off_segment(&w[0], &w[1], &bent(k, w)));
        let nearest = each.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap_or([0.0, 0.0]);
        let Some([tip_mm, _]) = self.limits.filter(|[_, axis_rad]| nearest[1] > *axis_rad) else {
            return nearest;
        };
        // Where the tool turns fast a micrometre along the path is many microradians: another place within the residual of the tip.
        let axes = pairs()
            .filter_map(|(k, w)| is.axis_off_segment(&w[0], &w[1], &bent(k, w), tip_mm))
            .fold(nearest[1], f64::min);
        [nearest[0], axes]
    }

    fn end(&mut self, want: &Want, is: &Stand) {
        let Some(wanted) = self.found.stands.get(want.to as usize - 1) else { return };
        let [tip, axis] = is.from(wanted);
        self.residual.tip_end.take(tip, want.line);
        self.residual.axis_end.take(axis, want.line);
        self.squares = [self.squares[0] + tip * tip, self.squares[1] + axis * axis];
        self.compared += 1;
        self.row(want.line, [tip, axis]);
    }

    fn row(&mut self, line: u32, [tip, axis]: [f64; 2]) {
        let row = &mut self.rows[line as usize];
        // Not a number counts as passed.
        *row = [row[0].max(0.0).max(tip), row[1].max(0.0).max(axis)];
    }
}

impl Observer for Compare<'_> {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, node) in batch.nodes.iter().enumerate() {
            let line = if node.origin.program == 0 { node.origin.line } else { 0 };
            if line != self.line {
                (self.line, self.ended) = (line, false);
                let found = self.wants_of(line);
                // A line without wants does not lead away from those that come next.
                self.last = if found.is_empty() { self.last.end..self.last.end } else { found };
            }
            let wants = &self.found.wants[self.last.clone()];
            let (Some(first), Some(last)) = (wants.first(), wants.last()) else { continue };
            if self.ended {
                continue;
            }
            let [tip, axis, tip_off, axis_off] = batch.poses.vectors_at(i);
            let is = Stand { tip: tip + tip_off, axis: axis + axis_off };
            if node.last {
                self.ended = true;
                self.end(last, &is);
            } else if !first.is_end_only() {
                let each = wants.iter().map(|w| self.missed(w, &is));
                let missed = each.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap_or([0.0, 0.0]);
                self.residual.tip.take(missed[0], first.line);
                self.residual.axis.take(missed[1], first.line);
                self.row(first.line, missed);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn along_a_long_program_each_stretch_has_its_largest() {
        let mut before = vec![UNSEEN; 5001];
        let mut after = before.clone();
        for line in 1..=5000 {
            before[line] = [line as f64, 0.0];
            after[line] = [1.0 / line as f64, 0.5];
        }
        after[7] = UNSEEN;
        let along = along(&before, &after);
        // 5000 blocks in stretches of three.
        assert_eq!(along.len(), 1667);
        let row = |i: usize| (along[i].line, along[i].tip_before_mm, along[i].tip_after_mm);
        assert_eq!([row(0), row(2)], [(1, 3.0, 1.0), (7, 9.0, 1.0 / 8.0)]);
        assert_eq!(along[1666].axis_after_rad, 0.5);
        let few = super::along(&before[..3], &after[..3]);
        assert_eq!(few.iter().map(|b| b.line).collect::<Vec<_>>(), [1, 2]);
    }

    /// With gaps between lines and with several pieces of a line, asked for in order and across it.
    #[test]
    fn law_wants_in_the_order_of_lines_are_found_without_a_table() {
        let lines = [2, 3, 3, 3, 7, 8, 12, 12, 20];
        let mut found = Found::default();
        let pieces = [0, 0, 1, 2, 0, 0, 0, 1, 0];
        found.wants = lines.iter().zip(pieces).map(|(l, p)| Want::of(*l, p, false)).collect();
        let numbers: Vec<u32> = (1..=20).map(|line| 1 + 4 * line).collect();
        for limits in [None, Some([1.0; 2])] {
            let mut sorted = Compare::of(&found, &numbers, limits);
            let mut by_table = Compare::of(&found, &numbers, limits);
            assert!(sorted.at_line.is_empty());
            let line_of = |want: &Want| simulated(want, by_table.numbers);
            by_table.at_line = first_of_lines(&found.wants, line_of, numbers.len() + 1);
            let last = if limits.is_some() { 90 } else { 22 };
            for line in (0..last).chain((0..last).rev()).chain((0..last).map(|k| k * 37 % last)) {
                let range = sorted.wants_of(line);
                assert_eq!(range.len(), by_table.wants_of(line).len(), "{line}");
                assert!(range.is_empty() || range == by_table.wants_of(line), "{line}");
                let nowhere = sorted.last.end..sorted.last.end;
                sorted.last = if range.is_empty() { nowhere } else { range };
            }
        }
    }
}
