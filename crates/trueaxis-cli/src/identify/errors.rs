//! `trueaxis identify CAMPAIGN.toml`: the errors of the machine.

use crate::door::DoorArguments;
use crate::output::Outcome;
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
    /// Write a machine file with the prediction by all errors, listed or not, and next to it their covariance: for
    /// compensation where single errors cannot be separated
    #[arg(long, value_name = "MACHINE.toml")]
    predictor: Option<PathBuf>,
    /// Try other signs, orders, senses, sides and units of the readings, and name those that fit far better
    #[arg(long)]
    check_conventions: bool,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &CampaignArguments) -> Outcome {
    let Some(file) = &arguments.file else { return Outcome::Unusable };
    let question = Identify {
        campaign: file.clone(),
        table: None,
        output: arguments.output.clone(),
        predictor: arguments.predictor.clone(),
        check_conventions: arguments.check_conventions,
    };
    arguments.door.door().ask(&question)
}
