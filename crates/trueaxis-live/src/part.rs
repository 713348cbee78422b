//! The record of one part: what acted at the end of each block and wherever X and Y have stood.
//!
//! ```text
//!     time_s,date_s,program,block,followed,known,tcp,X_mm,…,X_acted_um,X_target_um,X_left_um,…,scale_x_degC,…
//! ```
//!
//! Where a sensor is lost the target and the temperatures are the last known ones, and `known` is 0: what acted is known all the same.
//!
//! A row is of the last cycle of its block, so a hole that is drilled has the offset that acted at its place, whether each hole is
//! a block or a cycle makes many. `trueaxis predict` reads it: `[compensation] acted = "…"`.

use crate::control::{Block, Seen};
use crate::cycle::{Correction, STANDS};
use crate::file::{AxisPlan, Plan};
use crate::governor::{Reason, State};
use crate::pose::Frame;
use crate::run::{Cycle, Run};
use crate::status::is_linear;
use std::fmt::Write;
use trueaxis::machine::axis::{AxisKind, Command};
use trueaxis::predict::acted::is_lateral;

/// Makes the rows of a part out of the cycles of a run.
#[derive(Debug, Clone, Default)]
pub struct PartRecorder {
    block: Option<Open>,
    /// The last targets and temperatures that were known.
    known: Option<Known>,
    stood: Option<Command>,
    /// X and Y have not moved for so many cycles.
    still: u32,
    /// This standing has a row already.
    is_noted: bool,
}

/// The block that is executed.
#[derive(Debug, Clone)]
struct Open {
    block: Block,
    followed: bool,
    /// In its last cycle slew or step held an axis back.
    is_behind: bool,
    /// The largest that was off, with the offset, of each live axis; in the unit of its column.
    largest: Vec<f64>,
    /// The row as of its last cycle; none before anything was known.
    row: Option<Row>,
    /// Why something was not known.
    lacks: String,
}

/// Of each live axis the target, in the unit of its column; of each sensor °C.
#[derive(Debug, Clone)]
struct Known {
    targets: Vec<f64>,
    celsius: Vec<f64>,
}

#[derive(Debug, Clone)]
struct Row {
    time_s: f64,
    date_s: u64,
    tcp: bool,
    is_known: bool,
    at: Vec<f64>,
    /// Of each live axis: what acted, the target, their difference.
    axes: Vec<[f64; 3]>,
    celsius: Vec<f64>,
}

impl PartRecorder {
    /// One cycle; the line that it ends. A dry run follows nothing.
    pub fn add(
        &mut self,
        plan: &Plan,
        cycle: &Cycle,
        (correction, is_dry): (&Correction, bool),
    ) -> Option<String> {
        // Without a link nothing is known; what is read next shows where it went on.
        let Ok(seen) = &cycle.input.seen else {
            self.block.as_mut().into_iter().for_each(|open| open.followed = false);
            return None;
        };
        let programmed = cycle.output.programmed?;
        let leaves = self.leaves(plan, &programmed);
        let block = seen.block.unwrap_or_default();
        let ends = self.block.as_ref().is_some_and(|open| open.block != block);
        let due = ends || (leaves && !self.is_noted);
        if leaves {
            self.is_noted = false;
        }
        let line = if due { self.end() } else { None };
        // A block that ends while X and Y stand is the one of this place.
        self.is_noted |= ends && self.still > 0;
        let now = known(plan, cycle);
        let is_known = now.is_ok();
        let lacks = now.map(|now| self.known = Some(now)).err().unwrap_or_default();
        let row = self.known.as_ref().map(|known| {
            let row = row(plan, cycle, (seen, correction, &programmed), known);
            Row { is_known, ..row }
        });
        let new = || Open {
            block,
            followed: true,
            is_behind: false,
            largest: vec![0.0; plan.axes.len()],
            row: None,
            lacks: String::new(),
        };
        let open = self.block.get_or_insert_with(new);
        let order = &cycle.output.order;
        open.followed &= !is_dry && order.state == State::Run && order.reason != Reason::Limit;
        open.is_behind = correction.governor().is_behind();
        if let (Some(row), true) = (&row, is_known) {
            for (most, [.., left]) in open.largest.iter_mut().zip(&row.axes) {
                *most = most.max(left.abs());
            }
        }
        (open.row, open.lacks) = (row, lacks);
        line
    }

    /// The line of the block that is executed now: a row, or a remark where nothing was known.
    pub fn end(&mut self) -> Option<String> {
        let open = self.block.take()?;
        Some(match open.row {
            Some(row) => row.text(open.block, open.followed && !open.is_behind, &open.largest),
            None => {
                let Block { program, number } = open.block;
                format!("# program {program}, block {number}: {}", open.lacks)
            }
        })
    }

    /// Whether X and Y go on after they have stood.
    fn leaves(&mut self, plan: &Plan, programmed: &Command) -> bool {
        let before = self.stood.replace(*programmed);
        let axes = plan.machine.axes().iter().enumerate().filter(|(_, axis)| is_lateral(axis));
        let stands = before.is_some_and(|before| {
            axes.map(|(i, _)| i).all(|i| (programmed[i] - before[i]).abs() < STANDS)
        });
        let stood = self.still;
        self.still = if stands { stood.saturating_add(1) } else { 0 };
        !stands && stood > 0
    }
}

/// Which part is made, and its recorder.
#[derive(Debug, Clone, Default)]
pub struct PartOfRun {
    name: Option<String>,
    recorder: PartRecorder,
    /// A line was lost, and the journal says so.
    has_gap: bool,
}

impl PartOfRun {
    /// The part.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// One cycle of a run.
    pub fn cycle(&mut self, plan: &Plan, cycle: &Cycle, run: &mut Run<'_>) {
        if self.name.is_some()
            && let Some(line) = self.recorder.add(plan, cycle, (run.correction(), run.is_dry()))
        {
            self.put(cycle.input.now_s, line, run);
        }
    }

    /// Asks which part is made now: another one begins, the last one ends.
    pub fn ask(&mut self, plan: &Plan, now_s: f64, run: &mut Run<'_>) {
        let asked = run.store().part();
        if asked == self.name {
            return;
        }
        self.end(now_s, run);
        let heading = part_heading(plan, asked.as_deref().unwrap_or_default());
        match run.store().open_part(asked.as_deref(), &heading) {
            Ok(()) => {
                if let Some(name) = &asked {
                    run.say(now_s, PART, format!("the record of {name} begins"));
                }
                *self = Self { name: asked, ..Self::default() };
            }
            Err(why) => {
                let name = asked.as_deref().unwrap_or_default();
                run.say(now_s, PART_LOST, format!("the record of {name} cannot be filled: {why}"));
                // Asked for once, not each second.
                *self = Self { name: asked, has_gap: true, ..Self::default() };
            }
        }
    }

    /// The part that is made ends.
    pub fn end(&mut self, now_s: f64, run: &mut Run<'_>) {
        if let Some(line) = self.recorder.end() {
            self.put(now_s, line, run);
        }
        if let Some(name) = self.name.take() {
            run.say(now_s, PART, format!("the record of {name} ends"));
        }
    }

    fn put(&mut self, now_s: f64, line: String, run: &mut Run<'_>) {
        let put = run.store().part_line(line);
        if let (Err(why), false) = (put, self.has_gap) {
            self.has_gap = true;
            let name = self.name.clone().unwrap_or_default();
            run.say(
                now_s,
                PART_LOST,
                format!("the record of {name} lacks lines from here on: {why}"),
            );
        }
    }
}

/// The record of a part begins or ends.
pub const PART: &str = "part";
/// It lacks lines.
pub const PART_LOST: &str = "part-lost";

/// How far the tool is moved by so many increments of a live axis, in the unit of its column.
pub(crate) fn scale(plan: &Plan, axis: &AxisPlan) -> f64 {
    axis.sign * axis.increment * if is_linear(plan, axis) { 1e3 } else { 1e6 }
}

/// Targets and temperatures of a cycle.
///
/// # Errors
/// What is not known.
fn known(plan: &Plan, cycle: &Cycle) -> Result<Known, String> {
    let target = cycle.output.target.as_ref();
    let target = target.ok_or_else(|| format!("no target: {}", cycle.output.order.reason))?;
    let sensors = plan.sensors.iter().zip(&cycle.output.sensors);
    let celsius = sensors.map(|(sensor, judged)| {
        let celsius = judged.celsius.as_ref().copied();
        celsius.map_err(|fault| format!("{}: {fault}", sensor.settings.name))
    });
    let celsius = celsius.collect::<Result<_, String>>()?;
    let axes = plan.axes.iter().zip(&target.here);
    Ok(Known { targets: axes.map(|(axis, n)| n * scale(plan, axis)).collect(), celsius })
}

fn row(
    plan: &Plan,
    cycle: &Cycle,
    (seen, correction, programmed): (&Seen, &Correction, &Command),
    known: &Known,
) -> Row {
    let acting = correction.acting_at(seen, programmed);
    let axes = plan.axes.iter().zip(acting).zip(&known.targets).map(|((axis, n), target)| {
        let acted = n * scale(plan, axis);
        [acted, *target, acted - target]
    });
    let at = plan.machine.axes().iter().zip(programmed);
    let at = at.map(|(axis, q)| if axis.kind == AxisKind::Linear { *q } else { q.to_degrees() });
    Row {
        time_s: cycle.input.now_s,
        date_s: crate::clock::date_s(),
        tcp: seen.frame == Frame::Workpiece,
        is_known: true,
        at: at.collect(),
        axes: axes.collect(),
        celsius: known.celsius.clone(),
    }
}

impl Row {
    fn text(&self, block: Block, followed: bool, largest: &[f64]) -> String {
        let Block { program, number } = block;
        let [followed, known, tcp] = [followed, self.is_known, self.tcp].map(u8::from);
        let mut text = format!(
            "{:.3},{},{program},{number},{followed},{known},{tcp}",
            self.time_s, self.date_s
        );
        let mut put = |value: f64, digits: usize| {
            // A text in memory takes everything; + 0.0: no minus before a zero.
            let _ = write!(text, ",{:.digits$}", value + 0.0);
        };
        self.at.iter().for_each(|q| put(*q, 4));
        for (values, most) in self.axes.iter().zip(largest) {
            values.iter().chain([most]).for_each(|v| put(*v, 2));
        }
        self.celsius.iter().for_each(|t| put(*t, 3));
        text
    }
}

/// The plan and machine file that a record was begun with, by its first lines.
pub fn plan_hash_of(record: &str) -> Option<&str> {
    let line =
        record.lines().take_while(|l| l.starts_with('#')).find(|l| l.starts_with("# plan "))?;
    let (plan, _) = line.rsplit_once("; machine ")?;
    plan.rsplit_once(", ").map(|(_, hash)| hash)
}

/// The headings among the lines of a record.
pub fn headings_of(record: &str) -> Option<&str> {
    record.lines().find(|line| !line.starts_with('#'))
}

/// Blocks of a record of which nothing was known: they have no row.
pub fn unknown_blocks_of(record: &str) -> usize {
    record.lines().filter(|line| line.starts_with("# program ")).count()
}

/// The first lines of a record: what it is of, and the headings.
pub fn part_heading(plan: &Plan, part: &str) -> String {
    let clean = |text: &str| text.replace(['\n', '\r'], " ");
    let mut text = format!(
        "# {part}: what acted at the end of each block and where X and Y stood\n\
         # plan {}, {}; machine {}\n\
         # followed 1: the correction followed its target throughout the block, within its limits, and was there at its end; known 0: target and temperatures are the last \
         known ones; tcp 1: the offset was added to tip and angles\n\
         time_s,date_s,program,block,followed,known,tcp",
        clean(&plan.name),
        plan.hash,
        clean(plan.machine.name())
    );
    for axis in plan.machine.axes() {
        let unit = if axis.kind == AxisKind::Linear { "mm" } else { "deg" };
        let _ = write!(text, ",{}_{unit}", axis.name);
    }
    for axis in &plan.axes {
        let (unit, name) = (if is_linear(plan, axis) { "um" } else { "urad" }, &axis.name);
        let _ = write!(
            text,
            ",{name}_acted_{unit},{name}_target_{unit},{name}_left_{unit},{name}_left_largest_{unit}"
        );
    }
    for sensor in &plan.sensors {
        let _ = write!(text, ",{}_degC", sensor.settings.input);
    }
    text
}
