//! `trueaxis identify thermal`: linear thermal models from logs.

use crate::door::DoorArguments;
use crate::output::Outcome;
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

  trueaxis identify thermal examples/05_identify/lathe-thermal.toml \\
      --score examples/05_identify/lathe-new-day.csv

scores later logs with the model: what remains, what was promised, which sensors did what they had not
done in the logs of the model, and how U grows there.

Exit status: 0 a model was found, and later logs leave no more than it promised; 1 the logs do not support a
model, or a later log is worse than promised; 2 unusable input.")]
pub struct Arguments {
    /// The study: logs, displacement, candidate sensors
    #[arg(value_name = "STUDY.toml")]
    file: PathBuf,
    /// A later log that the model has not seen; may be repeated
    #[arg(long, value_name = "LOG.csv")]
    score: Vec<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question =
        IdentifyThermal { study: arguments.file.clone(), score: arguments.score.clone() };
    arguments.door.door().ask(&question)
}
