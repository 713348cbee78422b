//! `trueaxis plan`: the errors that a measurement determines, and its programs.

mod surface;
mod tool_setting;

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::{Args, Subcommand};
use std::path::PathBuf;
use trueaxis::questions::PlanMeasurement;

/// The measurement to plan.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  trueaxis plan examples/04_plan/probe-ball.toml
  trueaxis plan examples/04_plan/touch-probe-5-minutes.toml --control fanuc -o five-minutes
  trueaxis measure five-minutes/campaign.toml -o five-minutes/readings
  trueaxis identify five-minutes/campaign.toml
  trueaxis plan CAMPAIGN.toml --format json
  trueaxis plan probe-surface examples/04_plan/probe-surface.toml -o programs

Shows before the measurement which errors each path responds to, with what uncertainty they will be
determined, which combinations are not observable, and which measurement separates them. -o also writes
campaign.toml: the campaign with the chosen poses, which `measure` and `identify` read. A program that would
cause a collision or leave the travel (NOT SAFE) is written with --write-unsafe only. Exit status: 0 done, 1 there is one, 2 unusable input."
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<PlanCommand>,
    #[command(flatten)]
    campaign: CampaignArguments,
}

#[derive(Subcommand)]
enum PlanCommand {
    /// A probing path over a surface, from cutter locations or an STL file
    ProbeSurface(surface::Arguments),
    /// The program that measures the tools of a set-up at a tool setter
    ToolSetting(tool_setting::Arguments),
}

/// The NC programs of a measurement, and the answer.
#[derive(Args)]
struct ProgramArguments {
    /// The control of the NC programs: sinumerik, fanuc, haas, linuxcnc or heidenhain
    #[arg(long, alias = "dialect", value_name = "NAME", default_value = "sinumerik")]
    control: String,
    /// With -o: write programs that are NOT SAFE, too, to look at them
    #[arg(long)]
    write_unsafe: bool,
    #[command(flatten)]
    door: DoorArguments,
}

/// The campaign.
#[derive(Args)]
struct CampaignArguments {
    /// The campaign: machine, unknowns, instruments, paths
    #[arg(value_name = "CAMPAIGN.toml", required = true)]
    file: Option<PathBuf>,
    /// Write one program and one table of poses per path, and the campaign with the chosen poses, into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    #[command(flatten)]
    program: ProgramArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    match &arguments.command {
        Some(PlanCommand::ProbeSurface(arguments)) => surface::run(arguments),
        Some(PlanCommand::ToolSetting(arguments)) => tool_setting::run(arguments),
        None => run_campaign(&arguments.campaign),
    }
}

fn run_campaign(arguments: &CampaignArguments) -> Outcome {
    let Some(file) = &arguments.file else { return Outcome::Unusable };
    let question = PlanMeasurement {
        campaign: file.clone(),
        control: arguments.program.control.clone(),
        output: arguments.output.clone(),
        write_unsafe: arguments.program.write_unsafe,
    };
    arguments.program.door.door().ask(&question)
}
