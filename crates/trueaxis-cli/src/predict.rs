//! `trueaxis predict`: accuracy of test pieces and holes before they are cut.

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::Predict;

/// The study to predict.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml
  trueaxis predict examples/03_predict/torque-arm.toml
  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml --format json --no-report

Exit status: 0 the part is predicted within tolerance, 1 it is not (or that is undecided within the
uncertainty), 2 unusable input; then no report is written.")]
pub struct Arguments {
    /// The study file: machine, test piece, setting point
    #[arg(value_name = "STUDY.toml")]
    study: PathBuf,
    /// File of the HTML report
    #[arg(long, value_name = "FILE", default_value = "report.html")]
    report: PathBuf,
    /// Write no report
    #[arg(long, conflicts_with = "report")]
    no_report: bool,
    /// Monte Carlo samples, instead of the study's (0: none)
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    samples: Option<String>,
    /// Monte Carlo seed, instead of the study's
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let report = Some(arguments.report.as_path()).filter(|_| !arguments.no_report);
    let question = Predict {
        study: arguments.study.clone(),
        samples: arguments.samples.clone(),
        seed: arguments.seed,
    };
    Door { format: arguments.format, report }.ask(&question)
}
