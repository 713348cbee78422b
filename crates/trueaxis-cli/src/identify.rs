//! `trueaxis identify`: errors of a machine from readings.

mod errors;
mod probe;
mod rtcp;
mod surface;
mod thermal;
mod tools;

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::{Args, Subcommand};
use std::path::PathBuf;
use trueaxis::questions::IdentifyExpansion;

/// The errors to identify.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  trueaxis identify examples/05_identify/probe-ball.toml --report found.html
  trueaxis identify examples/05_identify/mixed-instruments.toml -o identified.toml --format json
  trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml
  trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml

Exit status: 0 the model fits the readings, 1 it does not, 2 unusable input."
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<IdentifyCommand>,
    #[command(flatten)]
    errors: errors::CampaignArguments,
}

#[derive(Subcommand)]
enum IdentifyCommand {
    /// The coefficient of expansion of a scale, from laser runs at two or more temperatures
    Expansion(ExpansionArguments),
    /// The rotary centres for RTCP, from dial or probe readings at turned poses
    Rtcp(rtcp::Arguments),
    /// A linear model of an error that drifts with temperatures, from logs of whole cycles
    Thermal(thermal::Arguments),
    /// The offset of a stylus ball and its pre-travel by direction, from hits on a ring or sphere
    Probe(probe::Arguments),
    /// The deviations of a surface, from the hits of a probing program
    Surface(surface::Arguments),
    /// Length, diameter and wear of tools, from the log of a tool setting
    Tools(tools::Arguments),
}

/// The runs.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml

Exit status: 0 done, 2 unusable input.")]
struct ExpansionArguments {
    /// The file of the runs: table, temperatures
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    match &arguments.command {
        None => errors::run(&arguments.errors),
        Some(IdentifyCommand::Expansion(arguments)) => run_expansion(arguments),
        Some(IdentifyCommand::Rtcp(arguments)) => rtcp::run(arguments),
        Some(IdentifyCommand::Thermal(arguments)) => thermal::run(arguments),
        Some(IdentifyCommand::Probe(arguments)) => probe::run(arguments),
        Some(IdentifyCommand::Surface(arguments)) => surface::run(arguments),
        Some(IdentifyCommand::Tools(arguments)) => tools::run(arguments),
    }
}

fn run_expansion(arguments: &ExpansionArguments) -> Outcome {
    let question = IdentifyExpansion { runs: arguments.file.clone() };
    Door { format: arguments.format, report: None }.ask(&question)
}
