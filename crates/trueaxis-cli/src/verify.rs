//! `trueaxis verify`: comparisons, calibrations, certificates and measured parts.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{
    Certify, CompareCalibrations, LaserBeforeAfter, VerifyHistory, VerifyPart, VerifyReadings,
};

/// The comparison to make.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis verify examples/07_verify/probe-ball.toml --report v.html
  trueaxis verify --diff machines/xkas2525/machine.toml examples/07_verify/xkas2525-after-a-year.toml
  trueaxis verify --certificate examples/07_verify/certificate.toml --report certificate.html
  trueaxis verify --part examples/07_verify/nas979-points.toml --report part.html
  trueaxis verify --before-after examples/07_verify/laser-before-after-x.toml --report laser.html
  trueaxis verify --history examples/07_verify/history --limit \"EC0X=40 urad\" --report history.html

Exit status: 0 pass, or no change; 1 fail or undecided, or a significant change; 2 unusable input.")]
pub struct Arguments {
    /// The readings, what they are compared with, and the decision rule
    #[arg(value_name = "FILE.toml", required_unless_present_any = ["diff", "certificate", "part", "before_after", "history"])]
    file: Option<PathBuf>,
    /// Compare two calibrations of one machine: which errors changed significantly
    #[arg(long, num_args = 2, value_names = ["OLD.toml", "NEW.toml"], conflicts_with = "file")]
    diff: Option<Vec<PathBuf>>,
    /// Certify a compensation: the residual errors at poses that the identification has not used
    #[arg(long, value_name = "STUDY.toml", conflicts_with_all = ["file", "diff"])]
    certificate: Option<PathBuf>,
    /// Measured test pieces: their indices against their tolerances and their prediction
    #[arg(long, value_name = "FILE.toml", conflicts_with_all = ["file", "diff", "certificate"])]
    part: Option<PathBuf>,
    /// Read virtual lasers before and after compensation, evaluated by ISO 230-2
    #[arg(long, value_name = "CAMPAIGN.toml", conflicts_with_all = ["file", "diff", "certificate", "part"])]
    before_after: Option<PathBuf>,
    /// The figures of one machine over its calibrations: machine files, JSON documents of evaluate, folders with them
    #[arg(long, num_args = 1.., value_name = "FILE", conflicts_with_all = ["file", "diff", "certificate", "part", "before_after"])]
    history: Option<Vec<PathBuf>>,
    /// With --history: the limit of a figure, such as "EC0Y=30 urad" or "iso230-2 X: A=15 um"; may be repeated
    // What is required is not asked for where it would conflict with what is there.
    #[arg(long = "limit", value_name = "FIGURE=LIMIT", requires = "history",
        conflicts_with_all = ["file", "diff", "certificate", "part", "before_after"])]
    limits: Vec<String>,
    /// With --before-after: write one table of readings per path and compensation into this folder
    #[arg(short, long, value_name = "FOLDER", requires = "before_after", conflicts_with_all = ["file", "diff", "certificate", "part"])]
    output: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let door = arguments.door.door();
    if let Some(campaign) = &arguments.before_after {
        let (campaign, output) = (campaign.clone(), arguments.output.clone());
        return door.ask(&LaserBeforeAfter { campaign, output });
    }
    if let Some(files) = &arguments.history {
        let (files, limits) = (files.clone(), arguments.limits.clone());
        return door.ask(&VerifyHistory { files, limits });
    }
    if let Some(file) = &arguments.part {
        return door.ask(&VerifyPart { file: file.clone() });
    }
    match (&arguments.diff.as_deref(), &arguments.certificate, &arguments.file) {
        (Some([old, new]), ..) => {
            door.ask(&CompareCalibrations { old: old.clone(), new: new.clone() })
        }
        (_, Some(study), _) => door.ask(&Certify { study: study.clone() }),
        (.., Some(file)) => door.ask(&VerifyReadings { file: file.clone() }),
        _ => Outcome::Unusable,
    }
}
