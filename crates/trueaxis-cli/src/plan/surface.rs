//! `trueaxis plan probe-surface FILE.toml`: a probing path over a surface.

use super::ProgramArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::PlanSurface;

/// The surface.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis plan probe-surface examples/04_plan/probe-surface.toml --control fanuc -o programs

Writes the NC program of the touches along the normals, and surface.csv: point, x_mm .. z_mm, i, j, k,
deviation_um (empty, for the readings: um along the normal, positive outwards).
Exit status: 0 done, 1 the program would cause a collision or leave the travel (then nothing is written without
--write-unsafe), 2 unusable input.")]
pub struct Arguments {
    /// The study: machine, surface, spacing, probe
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Write the program and the table of the points into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    #[command(flatten)]
    program: ProgramArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = PlanSurface {
        study: arguments.file.clone(),
        control: arguments.program.control.clone(),
        output: arguments.output.clone(),
        write_unsafe: arguments.program.write_unsafe,
    };
    arguments.program.door.door().ask(&question)
}
