//! `trueaxis measure`: readings of the instruments of a campaign on a virtual machine.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{Measure, MeasurePart};

/// The campaign to simulate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis measure examples/04_plan/probe-ball.toml
  trueaxis measure examples/04_plan/probe-ball.toml -o readings --truth truth.toml --report m.html
  trueaxis measure --part examples/03_predict/nas979-on-xkas2525.toml -o points.csv --point-u '0.7 um' --draw

The machine of the campaign, or that of its [truth], is measured by its instruments on its [[path]]s,
with the disturbances of [disturb]: noise, drift, following errors. The true errors are in --truth only.
With --part the test piece of a study is cut once and measured on a coordinate measuring machine.

Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    /// The campaign: machine, instruments, paths, and if wanted [truth] and [disturb]
    #[arg(value_name = "CAMPAIGN.toml", required_unless_present = "part")]
    campaign: Option<PathBuf>,
    /// The test piece of this study instead, on a coordinate measuring machine
    #[arg(long, value_name = "STUDY.toml", conflicts_with_all = ["campaign", "truth"])]
    part: Option<PathBuf>,
    /// Standard uncertainty of a point along the normal, with --part
    #[arg(
        long,
        value_name = "LENGTH",
        default_value = "0 um",
        requires = "part",
        // What is required is not asked for where it would conflict with what is there.
        conflicts_with = "campaign",
        allow_hyphen_values = true
    )]
    point_u: String,
    /// Draw the errors of the machine within their uncertainties, with --part
    #[arg(long, requires = "part", conflicts_with = "campaign")]
    draw: bool,
    /// Write one table of readings for each instrument into this folder; with --part the points into this file
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Write the true values into this file: machine, errors, set-ups, rows that are wrong on purpose
    #[arg(long, value_name = "FILE.toml")]
    truth: Option<PathBuf>,
    /// The random seed, instead of that of [truth]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let door = arguments.door.door();
    if let Some(study) = &arguments.part {
        return door.ask(&MeasurePart {
            study: study.clone(),
            output: arguments.output.clone(),
            seed: arguments.seed.unwrap_or(1),
            draw: arguments.draw,
            point_u: arguments.point_u.clone(),
        });
    }
    let question = Measure {
        campaign: arguments.campaign.clone().unwrap_or_default(),
        output: arguments.output.clone(),
        truth: arguments.truth.clone(),
        seed: arguments.seed,
    };
    door.ask(&question)
}
