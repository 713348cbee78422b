//! `trueaxis predict`: accuracy of test pieces, holes and parts before they are cut.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::Predict;

/// The study to predict.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml
  trueaxis predict examples/03_predict/torque-arm.toml
  trueaxis predict examples/03_predict/housing.toml
  trueaxis predict examples/03_predict/housing.toml --compensated
  trueaxis predict examples/03_predict/housing.toml --results housing.qif
  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml --format json

Exit status: 0 the part is predicted within tolerance, 1 it is not (or that is undecided within the
uncertainty), 2 unusable input; then no report is written.")]
pub struct Arguments {
    /// The study file: machine, test piece or part, setting point
    #[arg(value_name = "STUDY.toml")]
    study: PathBuf,
    /// Monte Carlo samples, instead of the study's (0: none)
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    samples: Option<String>,
    /// Monte Carlo seed, instead of the study's
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// Of a part, write its characteristics with value, u and verdict here: a table (.csv) or QIF (.qif, ISO 23952)
    #[arg(long, value_name = "FILE")]
    results: Option<PathBuf>,
    /// Of a part, judge it by its program compensated for the machine, too (as by `compensate program`): before and after
    #[arg(long)]
    compensated: bool,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = Predict {
        study: arguments.study.clone(),
        samples: arguments.samples.clone(),
        seed: arguments.seed,
        results: arguments.results.clone(),
        compensated: arguments.compensated,
    };
    arguments.door.door().ask(&question)
}
