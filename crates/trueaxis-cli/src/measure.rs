//! `trueaxis measure`: what the instruments of a campaign would read.

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::Measure;

/// What to measure.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis measure examples/04_plan/probe-ball.toml
  trueaxis measure examples/04_plan/probe-ball.toml -o readings --truth truth.toml --report m.html

The machine of the campaign, or that of its [truth], is measured by its instruments on its [[path]]s,
with what [disturb] says: noise, drift, axes that lag. The readings do not tell the truth; --truth does.

Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    /// The campaign: machine, instruments, paths, and if wanted [truth] and [disturb]
    #[arg(value_name = "CAMPAIGN.toml")]
    campaign: PathBuf,
    /// Write one table of readings for each instrument into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Write what is true into this file: machine, errors, set-ups, rows that are wrong on purpose
    #[arg(long, value_name = "FILE.toml")]
    truth: Option<PathBuf>,
    /// The seed of chance, instead of that of [truth]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = Measure {
        campaign: arguments.campaign.clone(),
        output: arguments.output.clone(),
        truth: arguments.truth.clone(),
        seed: arguments.seed,
    };
    Door { format: arguments.format, report: arguments.report.as_deref() }.ask(&question)
}
