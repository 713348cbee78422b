//! `trueaxis identify`: errors of a machine from readings.

mod errors;
mod probe;
mod rtcp;
mod surface;
mod tables;
mod thermal;
mod tools;

use crate::door::DoorArguments;
use crate::output::Outcome;
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
  trueaxis identify examples/05_identify/head-head.toml --predictor predicted.toml
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
    /// Error tables and squareness, from laser readings of single errors and ball-bar circles
    Tables(tables::Arguments),
    /// The deviations of a surface, from the hits of a probing program
    Surface(surface::Arguments),
    /// Length, diameter and wear of tools, from the log of a tool setting
    Tools(tools::Arguments),
}

/// The runs.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml
  trueaxis identify expansion examples/05_identify/x-axis-two-temperatures.toml \\
      examples/05_identify/y-axis-two-temperatures.toml -o gantry

Laser runs of the same positions at two or more temperatures: the expansion coefficient with its
uncertainty, the scale materials that it allows, the error table at one temperature and its cubic
spline with the coefficients that a PLC needs. -o writes the machine file that the runs name with
these tables and coefficients, and one file of spline coefficients for each axis.

Exit status: 0 done, 2 unusable input.")]
struct ExpansionArguments {
    /// The files of the runs, one for each scale: table, temperatures
    #[arg(value_name = "FILE.toml", required = true)]
    files: Vec<PathBuf>,
    /// Write the machine file with these scales, its tables and the spline coefficients into this new folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    match &arguments.command {
        None => errors::run(&arguments.errors),
        Some(IdentifyCommand::Expansion(arguments)) => run_expansion(arguments),
        Some(IdentifyCommand::Rtcp(arguments)) => rtcp::run(arguments),
        Some(IdentifyCommand::Thermal(arguments)) => thermal::run(arguments),
        Some(IdentifyCommand::Probe(arguments)) => probe::run(arguments),
        Some(IdentifyCommand::Tables(arguments)) => tables::run(arguments),
        Some(IdentifyCommand::Surface(arguments)) => surface::run(arguments),
        Some(IdentifyCommand::Tools(arguments)) => tools::run(arguments),
    }
}

fn run_expansion(arguments: &ExpansionArguments) -> Outcome {
    let (runs, output) = (arguments.files.clone(), arguments.output.clone());
    let door = arguments.door.door();
    door.ask(&IdentifyExpansion { runs, output })
}
