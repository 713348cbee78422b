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
lags. Sensors are selected, and the model is validated, on whole cycles that the fit has not used.

Exit status: 0 a model was found, 1 the logs do not support a model, 2 unusable input.")]
pub struct Arguments {
    /// The study: logs, displacement, candidate sensors
    #[arg(value_name = "STUDY.toml")]
    file: PathBuf,
    /// Write an HTML report to this file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = IdentifyThermal { study: arguments.file.clone() };
    Door { format: arguments.format, report: arguments.report.as_deref() }.ask(&question)
}
