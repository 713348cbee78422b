//! From block to block, as a control does in single-block mode: it stops where a block ends.

use super::columns::Columns;

/// Where blocks end; consecutive nodes of one line are one block.
#[derive(Debug)]
pub(super) struct Blocks {
    /// The last node of each.
    ends: Vec<u32>,
    /// Program, line, and the last node of its first execution, in order.
    lines: Vec<(u32, u32, u32)>,
}

impl Blocks {
    pub fn of(columns: &Columns) -> Self {
        let origin = |i: usize| (columns.program[i], columns.line[i]);
        let count = columns.len();
        let is_end = |i: &usize| i + 1 == count || origin(*i) != origin(i + 1);
        let ends: Vec<u32> = (0..count).filter(is_end).map(|i| i as u32).collect();
        let line = |end: &u32| {
            let (program, line) = origin(*end as usize);
            (program, line, *end)
        };
        let mut lines: Vec<_> = ends.iter().map(line).collect();
        lines.sort_unstable();
        lines.dedup_by_key(|(program, line, _)| (*program, *line));
        Self { ends, lines }
    }

    /// The first end after a time.
    pub fn next(&self, columns: &Columns, time_s: f64) -> Option<f64> {
        let time = |end: &u32| columns.time_s[*end as usize];
        let after = self.ends.partition_point(|end| time(end) <= time_s);
        self.ends.get(after).map(time)
    }

    /// The last end before a time.
    pub fn previous(&self, columns: &Columns, time_s: f64) -> Option<f64> {
        let time = |end: &u32| columns.time_s[*end as usize];
        let after = self.ends.partition_point(|end| time(end) < time_s);
        after.checked_sub(1).map(|before| time(&self.ends[before]))
    }

    pub fn of_line(&self, columns: &Columns, program: u32, line: u32) -> Option<f64> {
        let at = self.lines.partition_point(|(p, l, _)| (*p, *l) < (program, line));
        let (_, _, end) = self.lines.get(at).filter(|(p, ..)| *p == program)?;
        Some(columns.time_s[*end as usize])
    }
}
