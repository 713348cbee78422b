//! `trueaxis identify CAMPAIGN.toml`: the errors of the machine.

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::Identify;

/// What to identify the errors from.
#[derive(Args)]
pub struct CampaignArguments {
    /// The campaign file: machine, instruments with their readings, what is sought
    #[arg(value_name = "CAMPAIGN.toml", required = true)]
    file: Option<PathBuf>,
    /// A machine file with the errors that were found, their uncertainties and where they come from
    #[arg(short, long, value_name = "MACHINE.toml")]
    output: Option<PathBuf>,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Try sign, order, sense, side and unit of the readings, and name what fits far better
    #[arg(long)]
    check_conventions: bool,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &CampaignArguments) -> Outcome {
    let Some(file) = &arguments.file else { return Outcome::Unusable };
    let question = Identify {
        campaign: file.clone(),
        table: None,
        output: arguments.output.clone(),
        check_conventions: arguments.check_conventions,
    };
    Door { format: arguments.format, report: arguments.report.as_deref() }.ask(&question)
}
