//! `trueaxis identify CAMPAIGN.toml`: the errors of the machine.

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::Identify;

/// The campaign to evaluate.
#[derive(Args)]
pub struct CampaignArguments {
    /// The campaign file: machine, instruments with their readings, unknown errors
    #[arg(value_name = "CAMPAIGN.toml", required = true)]
    file: Option<PathBuf>,
    /// Write a machine file with the identified errors, their uncertainties and sources
    #[arg(short, long, value_name = "MACHINE.toml")]
    output: Option<PathBuf>,
    /// Write an HTML report to this file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Try other signs, orders, senses, sides and units of the readings, and name those that fit far better
    #[arg(long)]
    check_conventions: bool,
    /// Output as text or as one JSON document
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
