//! `trueaxis pose`: where the tool is, nominal and actual, one pose or a table of them.

use crate::arguments::MachineArguments;
use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{AskPose, Positions};

/// The pose to show.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis pose machines/xkas2525/machine.toml --at \"X=3000 Y=1200 Z=-700 C=-90 A=15\"
  trueaxis pose machines/xkas2525/machine.toml --at-file examples/01_describe/positions.csv
  trueaxis pose machines/gantry-001/machine.toml --at \"X=3500\" --temperature \"scale_x=30.5 workpiece=30.5\"

Lengths are in the workpiece frame; deviation = actual - nominal. With temperatures it is the
comprehensive one, machine - workpiece: what the part has at 20 degC. A position outside the travel is
computed, with a warning. Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// Programmed axis positions in mm and degrees; axes not named are 0
    #[arg(long, value_name = "\"X=.. A=..\"", required_unless_present = "at_file")]
    at: Option<String>,
    /// Many positions: a CSV file whose columns are named by axis (mm, deg)
    #[arg(long, value_name = "POSITIONS.csv", conflicts_with = "at")]
    at_file: Option<PathBuf>,
    /// The direction of approach of each axis, where backlash is stated; without it the mean
    #[arg(long, value_name = "\"X=+ C=-\"")]
    approach: Option<String>,
    /// Also the nominal and actual place of every body in the machine frame
    #[arg(long, conflicts_with = "at_file")]
    bodies: bool,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: Arguments) -> Outcome {
    let Arguments { machine, at, at_file, approach, bodies, door } = arguments;
    let at = match at_file {
        Some(path) => Positions::File(path),
        None => Positions::One(at.unwrap_or_default()),
    };
    let question = AskPose { machine: machine.choice(None), at, approach, bodies };
    door.door().ask(&question)
}
