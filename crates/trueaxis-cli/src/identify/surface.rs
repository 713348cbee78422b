//! `trueaxis identify surface HITS.toml`: hits of a probing program.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::IdentifySurface;

/// The hits and their outputs.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis plan probe-surface examples/04_plan/probe-surface.toml --control fanuc -o D
  trueaxis identify surface D/hits.toml -o D/measured.csv

The study is written by `plan probe-surface`; the log is what its program writes on the control. The table has
deviation_um along the outward normals and U_um (k = 2); `compensate adapt` reads it.
Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    /// The study of the hits: machine, points, log, probe
    #[arg(value_name = "HITS.toml")]
    file: PathBuf,
    /// Write the table of deviations to this file
    #[arg(short, long, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question =
        IdentifySurface { study: arguments.file.clone(), output: arguments.output.clone() };
    arguments.door.door().ask(&question)
}
