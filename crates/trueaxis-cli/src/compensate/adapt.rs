//! `trueaxis compensate adapt`: a path moved onto the measured blank.

use crate::door::DoorArguments;
use crate::output::Outcome;
use crate::post::OnOff;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::Adapt;

/// The study: path, measured blank, cutter, wall.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis compensate adapt examples/06_compensate/bangle-adapt.toml
  trueaxis compensate adapt examples/06_compensate/bangle-adapt.toml --control fanuc -o bangle.nc \\
      --cl bangle-adapted.cls --format json

The blank is registered, its form becomes a smooth field, the path is moved along its normals, and a
virtual cut shows the wall thickness that remains. A program is written only if the wall is thick enough everywhere, nothing
is gouged, and the program, read back and simulated, follows the adapted path within the travel.
Exit status: 0 done, 1 the path must not be cut (then no program is written), or words of it that can change motion,
spindle or coolant are not applied (NOT APPLIED; path and program are written), 2 unusable input.")]
pub struct AdaptArguments {
    /// The study
    #[arg(value_name = "STUDY.toml")]
    file: PathBuf,
    /// Write the program of the adapted path to this file
    #[arg(short, long, value_name = "FILE", requires = "control")]
    output: Option<PathBuf>,
    /// The control of the program: sinumerik, fanuc, haas, linuxcnc or heidenhain
    #[arg(long, alias = "dialect", value_name = "NAME", requires = "output")]
    control: Option<String>,
    /// Whether the control keeps the tool tip on the path (RTCP, TRAORI, TCPM)
    #[arg(long, value_enum, default_value = "on")]
    tcp: OnOff,
    /// Largest distance between adapted path and program, mm
    #[arg(long, value_name = "MM", default_value = "0.001", allow_negative_numbers = true)]
    tolerance: String,
    /// Write the adapted cutter locations to this file
    #[arg(long, value_name = "FILE.cls")]
    cl: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &AdaptArguments) -> Outcome {
    let question = Adapt {
        study: arguments.file.clone(),
        output: arguments.output.clone().zip(arguments.control.clone()),
        tcp: arguments.tcp == OnOff::On,
        tolerance: arguments.tolerance.clone(),
        cl: arguments.cl.clone(),
    };
    arguments.door.door().ask(&question)
}
