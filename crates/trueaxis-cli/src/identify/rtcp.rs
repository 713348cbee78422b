//! `trueaxis identify rtcp FILE.toml`: the rotary centres.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{IdentifyRtcp, RtcpPrograms};

/// The readings.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml
  trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml -o engraver.toml --format json
  trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml --programs nc --control fanuc

Readings of an indicator or a probe at turned poses, with RTCP on or off, on machines with two rotary
axes in table or head: the offsets of the rotary centres with their uncertainty, the new numbers of
the control, and the residual error to be expected with them.

Exit status: 0 done, 1 the readings do not fit the machine or determine nothing, 2 unusable input.")]
pub struct Arguments {
    /// The file: machine, control, readings
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Write one NC program for each set of readings into this folder; the tables then need poses only
    #[arg(long, value_name = "FOLDER", conflicts_with = "output")]
    programs: Option<PathBuf>,
    /// The control of the programs: sinumerik, fanuc, haas, linuxcnc or heidenhain
    #[arg(
        long,
        alias = "dialect",
        value_name = "NAME",
        default_value = "sinumerik",
        requires = "programs"
    )]
    control: String,
    /// Write a machine file with the identified centres
    #[arg(short, long, value_name = "MACHINE.toml")]
    output: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let (study, output) = (arguments.file.clone(), arguments.output.clone());
    let door = arguments.door.door();
    match &arguments.programs {
        Some(folder) => {
            let (control, output) = (arguments.control.clone(), folder.clone());
            door.ask(&RtcpPrograms { study, control, output })
        }
        None => door.ask(&IdentifyRtcp { study, output }),
    }
}
