//! `trueaxis study`: many machines on many days.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis_study::{AskStudy, Changes};

/// The study of many machines.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis study examples/09_study/fleet.toml
  trueaxis study examples/09_study/guideways.toml --report guideways.html
  trueaxis study examples/09_study/fleet.toml --machines 500 --table samples.csv
  trueaxis study examples/09_study/summer.toml --format json

Exit status: 0 the required share of machines holds its tolerances, or none is required, 1 it does not (or that is
undecided with so few machines), 2 unusable input; then no file is written.")]
pub struct Arguments {
    /// The study: what every machine makes, what differs between machines and days, how many there are
    #[arg(value_name = "STUDY.toml")]
    study: PathBuf,
    /// Number of machines, instead of the study's
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    machines: Option<u64>,
    /// Number of days, instead of the study's
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    days: Option<u64>,
    /// Random seed, instead of the study's
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// Rows of the sensitivity analysis, instead of the study's (0: none)
    #[arg(long, value_name = "N", value_parser = rows)]
    sensitivity: Option<usize>,
    /// Write inputs and outputs of every sample here, as a table (.csv)
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

/// So few rows as 1 to 15 say nothing.
fn rows(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(rows) if rows == 0 || rows >= 16 => Ok(rows),
        _ => Err("0 for none, or 16 and more".to_owned()),
    }
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = AskStudy {
        study: arguments.study.clone(),
        changes: Changes {
            machines: arguments.machines.map(|n| n as usize),
            days: arguments.days.map(|n| n as usize),
            seed: arguments.seed,
            sensitivity: arguments.sensitivity,
        },
        table: arguments.table.clone(),
    };
    arguments.door.door().ask(&question)
}
