//! `trueaxis measure`: readings of the instruments of a campaign on a virtual machine.

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::Measure;

/// The campaign to simulate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis measure examples/04_plan/probe-ball.toml
  trueaxis measure examples/04_plan/probe-ball.toml -o readings --truth truth.toml --report m.html

The machine of the campaign, or that of its [truth], is measured by its instruments on its [[path]]s,
with the disturbances of [disturb]: noise, drift, following errors. The true errors are in --truth only.

Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    /// The campaign: machine, instruments, paths, and if wanted [truth] and [disturb]
    #[arg(value_name = "CAMPAIGN.toml")]
    campaign: PathBuf,
    /// Write one table of readings for each instrument into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Write the true values into this file: machine, errors, set-ups, rows that are wrong on purpose
    #[arg(long, value_name = "FILE.toml")]
    truth: Option<PathBuf>,
    /// The random seed, instead of that of [truth]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Write an HTML report to this file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Output as text or as one JSON document
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
