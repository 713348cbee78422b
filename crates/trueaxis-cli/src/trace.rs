//! `trueaxis trace`: every stage of the simulation for one block.

use crate::arguments::{MachineArguments, argument};
use crate::output::{Answer, Format, Outcome, finish};
use crate::simulate::ProgramArguments;
use clap::Args;
use trueaxis::input::Diagnostics;
use trueaxis::report::{TraceReport, trace_json, trace_report};
use trueaxis::simulate::{block_line, trace};

/// The block to trace.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis trace machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf --block 120
  trueaxis trace MACHINE.toml PART.ngc --block 42 --format json

--block is the block number N; if there is no such block, the line number. Exit status: 0 done, 2 unusable
input.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    program: ProgramArguments,
    /// The block: its number N, else its line
    #[arg(long, value_name = "N")]
    block: usize,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let mut problems = Diagnostics::new();
    let answer = answer(arguments, &mut problems);
    finish(problems, answer)
}

fn answer(arguments: &Arguments, problems: &mut Diagnostics) -> Option<Answer> {
    let machine = arguments.machine.read_from(&arguments.program.log, problems)?;
    let job = arguments.program.read(machine, false, problems)?;
    let Some(line) = block_line(&job.program, arguments.block) else {
        let message = format!("the program has no block {}", arguments.block);
        let hint = "give a block number N, or a line of the program";
        problems.error("no-such-block", argument("--block"), message, hint);
        return None;
    };
    let (found, run) = trace(&job.machine, &job.program, &job.setup, &job.options, line);
    problems.append(run.problems);
    if found.executions == 0 && !problems.has_errors() {
        let message = format!("line {line} is never executed, or does nothing: {}", found.text);
        problems.warn("nothing-to-trace", argument("--block"), message, "choose another block");
    }
    let report = TraceReport::of(&job, arguments.block, &found);
    Some(match arguments.format {
        Format::Json => Answer::Json(trace_json(&report)),
        Format::Text => Answer::Text(trace_report(&report).text()),
    })
}
