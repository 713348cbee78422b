//! `trueaxis identify thermal`: linear thermal models from logs.

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::IdentifyThermal;

/// The logs.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis identify thermal examples/05_identify/lathe-thermal.toml --report drift.html

The study names the logs (one cycle each), the column of the displacement, the candidate sensors and
lags. Sensors are chosen, and the model is judged, on whole cycles that it has not seen.

Exit status: 0 a model, 1 refused: the logs support none, 2 unusable input.")]
pub struct Arguments {
    /// The study: logs, displacement, candidate sensors
    #[arg(value_name = "STUDY.toml")]
    file: PathBuf,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = IdentifyThermal { study: arguments.file.clone() };
    Door { format: arguments.format, report: arguments.report.as_deref() }.ask(&question)
}
