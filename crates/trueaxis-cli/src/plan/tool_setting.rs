//! `trueaxis plan tool-setting MACHINE.toml SETUP.toml`: tools measured at a tool setter.

use super::ProgramArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{PlanToolSetting, ToolChoice};

/// The tools.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis plan tool-setting machines/i5-engraver/machine.toml examples/04_plan/tool-setting.setup.toml --control fanuc -o programs

Writes the program that measures length, and diameter where the set-up asks for it, of its tools at its
[tool_setter]: it writes the wear, raises an alarm for a broken tool and stops for a worn one. The log that it
writes is read by `identify tools`.
Exit status: 0 done, 1 the program would cause a collision or leave the travel (then nothing is written without
--write-unsafe), 2 unusable input.")]
pub struct Arguments {
    /// The machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// The set-up file with [tool_setter] and [tool.N]
    #[arg(value_name = "SETUP.toml")]
    setup: PathBuf,
    /// Only these tools, such as 1,2
    #[arg(long, value_name = "NUMBERS")]
    tools: Option<String>,
    /// Write the program into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    #[command(flatten)]
    program: ProgramArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = PlanToolSetting {
        choice: ToolChoice {
            machine: arguments.machine.clone(),
            setup: arguments.setup.clone(),
            tools: arguments.tools.clone(),
        },
        control: arguments.program.control.clone(),
        output: arguments.output.clone(),
        write_unsafe: arguments.program.write_unsafe,
    };
    arguments.program.door.door().ask(&question)
}
