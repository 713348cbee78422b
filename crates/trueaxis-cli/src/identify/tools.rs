//! `trueaxis identify tools MACHINE.toml SETUP.toml LOG`: tools from the log of a tool setting.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{IdentifyTools, ToolChoice};

/// The readings.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis identify tools machines/i5-engraver/machine.toml examples/04_plan/tool-setting.setup.toml examples/05_identify/tool-setting.log

The log is what the program of `plan tool-setting` writes on the control. Length and diameter with U (k = 2),
wear, breakage, and the drift of spindle and setter where a gauge was measured.
Exit status: 0 all tools are fit, 1 a tool is worn or broken, 2 unusable input.")]
pub struct Arguments {
    /// The machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// The set-up file that the program was made from
    #[arg(value_name = "SETUP.toml")]
    setup: PathBuf,
    /// The log
    #[arg(value_name = "LOG")]
    log: PathBuf,
    /// The tools of the program, if it was made for some of them, such as 1,2
    #[arg(long, value_name = "NUMBERS")]
    tools: Option<String>,
    /// When it was measured, for the lines of the set-up file
    #[arg(long, value_name = "DATE")]
    date: Option<String>,
    /// Write the lines for the set-up file to this file
    #[arg(short, long, value_name = "FILE.toml")]
    output: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = IdentifyTools {
        choice: ToolChoice {
            machine: arguments.machine.clone(),
            setup: arguments.setup.clone(),
            tools: arguments.tools.clone(),
        },
        log: arguments.log.clone(),
        date: arguments.date.clone(),
        output: arguments.output.clone(),
    };
    arguments.door.door().ask(&question)
}
