//! What does one block do?

use super::words::argument;
use super::{Answer, MachineChoice, ProgramChoice, Question, Tell};
use crate::report::{self, TraceReport};
use serde_json::Value;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_motion::{Job, Trace, block_lines, trace};
use trueaxis_report::{Report, document};

/// One block of a program through every stage of the simulation.
#[derive(Debug, Clone)]
pub struct TraceBlock {
    /// The machine.
    pub machine: MachineChoice,
    /// The program.
    pub program: ProgramChoice,
    /// The number of the block, else its line.
    pub block: usize,
}

/// A block with what it does.
pub struct TraceAnswer {
    job: Job,
    block: usize,
    found: Trace,
}

impl Question for TraceBlock {
    type Input = (Job, usize);
    type Answer = TraceAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let job = self.program.read(&self.machine, files, problems)?;
        let lines = block_lines(&job.program, self.block);
        let line = lines.first().copied();
        if lines.len() > 1 {
            let places: Vec<String> = lines.iter().map(ToString::to_string).collect();
            let message = format!(
                "the block number {} stands in the lines {}: the first is shown",
                self.block,
                places.join(", ")
            );
            let hint = "take the block number out of the others, or their lines into a program of their own";
            problems.warn("repeated-block-number", argument("--block"), message, hint);
        }
        if line.is_none() {
            let message = format!("the program has no block {}", self.block);
            let hint = "give a block number N, or a line of the program";
            problems.error("no-such-block", argument("--block"), message, hint);
        }
        Some((job, line?))
    }

    fn answer(
        &self,
        (job, line): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<TraceAnswer> {
        let (found, run) = trace(&job.machine, &job.program, &job.setup, &job.options, line);
        problems.append(run.problems);
        if found.executions == 0 && !problems.has_errors() {
            let message = format!("line {line} is never executed, or does nothing: {}", found.text);
            problems.warn("nothing-to-trace", argument("--block"), message, "choose another block");
        }
        found.warn_outside_travel(&job, problems);
        Some(TraceAnswer { job, block: self.block, found })
    }
}

impl TraceAnswer {
    fn shown(&self) -> TraceReport<'_> {
        TraceReport::of(&self.job, self.block, &self.found)
    }
}

impl Answer for TraceAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        document(&report::TraceDocument::from(&self.shown()))
    }

    fn report(&self) -> Report<'_> {
        report::trace_report(&self.shown())
    }
}
