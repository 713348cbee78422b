//! One block through every stage of the walk.

use super::{Batch, Job, Node, Observer, Options, Run, SetUp, Stamp, simulate};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::{Deviation, Machine};
use trueaxis_nc::Program;
use trueaxis_nc::moves::{Event, Frame, Move, OrientationPath, Position, Step};

/// A place of the traced block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracedNode {
    /// What the control commands.
    pub node: Node,
    /// When and how fast.
    pub stamp: Stamp,
    /// From which side the axes come.
    pub approach: Approach,
    /// Nominal tool and its deviation.
    pub deviation: Deviation,
    /// The deviation of the tip along feed, normal and binormal, mm.
    pub along_path_mm: Vec3,
}

/// What one block does, stage by stage; its first execution.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// The line, from 1.
    pub line: usize,
    /// The text of the block.
    pub text: String,
    /// What the interpreter made of it.
    pub steps: Vec<Step>,
    /// The program frame that its moves are read with.
    pub frame: Frame,
    /// The tip of the tool is programmed.
    pub tool_centre: bool,
    /// The frame is tied to a swivelled plane.
    pub tilted: bool,
    /// How the tool axis moves.
    pub orientation: OrientationPath,
    /// The tool in the spindle.
    pub tool: u32,
    /// The tool length that is on.
    pub tool_length: Position,
    /// Its places, in order.
    pub nodes: Vec<TracedNode>,
    /// When the block before it ended, s.
    pub from_s: f64,
    /// How often it was executed.
    pub executions: u64,
    /// The machine at its end, with its tool and at its temperatures; none if it moves nothing.
    pub machine: Option<Machine>,
}

impl Trace {
    /// The moves of the block.
    pub fn moves(&self) -> impl Iterator<Item = &Move> {
        self.steps.iter().filter_map(|step| match step {
            Step::Move(m) => Some(m),
            Step::Event(..) => None,
        })
    }

    /// The errors of a machine are known within its travel only: beyond it those of its end are taken.
    pub fn warn_outside_travel(&self, job: &Job, problems: &mut Diagnostics) {
        for (index, axis) in job.machine.axes().iter().enumerate() {
            let beyond = |command: &Command| {
                (command[index] - job.machine.nearest_in_travel(command)[index]).abs()
            };
            let commands = self.nodes.iter().map(|n| &n.node.command);
            let furthest = commands.max_by(|a, b| beyond(a).total_cmp(&beyond(b)));
            let outside = furthest.map(|command| command[index]);
            let Some(outside) = outside.filter(|q| !axis.travel.contains(*q)) else { continue };
            let shown = match axis.kind {
                AxisKind::Linear => format!("{outside:.3} mm"),
                AxisKind::Rotary => format!("{:.4} deg", outside.to_degrees()),
            };
            let message = format!(
                "{} goes to {shown} in this block, outside its travel: the errors of the machine are not known there, \
                 the deviations are those of the errors at the end of the travel",
                axis.name
            );
            let hint = "correct the work offset, the tool length or the program, then read the deviations again";
            let place = Place { line: self.line, column: 1, ..Place::whole(job.program.file()) };
            problems.warn("deviation-outside-travel", place, message, hint);
        }
    }
}

/// More places of one block than this are not kept; a block rarely has a hundred.
const MOST_NODES: usize = 100_000;

/// The lines of a block: those with the block number N, else the line of that number, from 1.
pub fn block_lines(program: &Program, block: usize) -> Vec<usize> {
    let lines = || program.source().split(|b| *b == b'\n');
    let numbered = |line: &[u8]| {
        let text: &[u8] = line.trim_ascii_start();
        let text = text.strip_prefix(b"/").unwrap_or(text).trim_ascii_start();
        let digits = match text.first() {
            Some(b'N' | b'n') => &text[1..],
            // HEIDENHAIN numbers its blocks without a letter.
            Some(b'0'..=b'9') => text,
            _ => return false,
        };
        let length = digits.iter().take_while(|b| b.is_ascii_digit()).count();
        let number = std::str::from_utf8(&digits[..length]).ok().and_then(|d| d.parse().ok());
        number == Some(block)
    };
    let mut found: Vec<usize> =
        lines().enumerate().filter(|(_, line)| numbered(line)).map(|(i, _)| i + 1).collect();
    if found.is_empty() && block >= 1 && block <= lines().count() {
        found.push(block);
    }
    found
}

/// Simulates the program and keeps the path of one line.
pub fn trace(
    machine: &Machine,
    program: &Program,
    setup: &SetUp,
    options: &Options,
    line: usize,
) -> (Trace, Run) {
    let text = program.source().split(|b| *b == b'\n').nth(line.wrapping_sub(1));
    let mut tracer = Tracer {
        trace: Trace {
            line,
            text: String::from_utf8_lossy(text.unwrap_or_default()).trim().to_owned(),
            steps: Vec::new(),
            frame: Frame::IDENTITY,
            tool_centre: false,
            tilted: false,
            orientation: OrientationPath::Axes,
            tool: 0,
            tool_length: Position::default(),
            nodes: Vec::new(),
            from_s: 0.0,
            executions: 0,
            machine: None,
        },
        inside: false,
        path_inside: false,
        done: false,
    };
    let run = simulate(machine, program, setup, options, &mut [&mut tracer]);
    (tracer.trace, run)
}

struct Tracer {
    trace: Trace,
    /// The interpreter is in the block.
    inside: bool,
    /// The path is in the block.
    path_inside: bool,
    /// The first execution is over, on the path.
    done: bool,
}

impl Tracer {
    fn is_here(&self, program: u32, line: u32) -> bool {
        program == 0 && line as usize == self.trace.line
    }

    fn note_mode(&mut self, event: &Event) {
        let trace = &mut self.trace;
        match event {
            Event::Frame(frame) => trace.frame = *frame,
            Event::ToolCentre(on) => trace.tool_centre = *on,
            Event::TiltedPlane(on) => trace.tilted = *on,
            Event::Orientation(path) => trace.orientation = *path,
            Event::ToolChange(number) => trace.tool = *number,
            Event::ToolLength(length) => trace.tool_length = *length,
            _ => {}
        }
    }
}

impl Observer for Tracer {
    fn step(&mut self, step: &Step) {
        let origin = match step {
            Step::Move(m) => m.origin,
            Step::Event(_, origin) => *origin,
        };
        let here = self.is_here(origin.program, origin.line);
        if here && !self.inside {
            self.trace.executions += 1;
        }
        self.inside = here;
        if self.trace.executions > 1 || (self.trace.executions == 1 && !here) {
            return;
        }
        if let Step::Event(event, _) = step {
            self.note_mode(event);
        }
        if here {
            self.trace.steps.push(step.clone());
        }
    }

    fn path(&mut self, batch: &Batch<'_>) {
        if self.done {
            return;
        }
        let mut here = false;
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            if !self.is_here(node.origin.program, node.origin.line) {
                if self.path_inside {
                    self.done = true;
                    return;
                }
                self.trace.from_s = stamp.time_s;
                continue;
            }
            self.path_inside = true;
            // Once a batch: the last one counts.
            if !std::mem::replace(&mut here, true) {
                self.trace.machine = Some(batch.machine.clone());
            }
            if self.trace.nodes.len() < MOST_NODES {
                self.trace.nodes.push(TracedNode {
                    node: *node,
                    stamp: *stamp,
                    approach: batch.approach(i),
                    deviation: batch.deviation(i),
                    along_path_mm: batch.along_path_mm[i],
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_nc::Control;

    #[test]
    fn blocks_are_found_by_number_then_by_line() {
        let text = b"%\nN10 G0 X0\n/ N20 G1 X1\nM30\n".to_vec();
        let program = Program::new("a.nc", text, Control::Fanuc);
        assert_eq!(block_lines(&program, 20), [3]);
        assert_eq!(block_lines(&program, 4), [4]);
        assert!(block_lines(&program, 99).is_empty());
    }
}
