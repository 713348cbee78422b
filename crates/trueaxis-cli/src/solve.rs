//! `trueaxis solve`: axis positions for a tool pose.

use crate::arguments::MachineArguments;
use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{Solve, SolveTarget};

/// The tool pose to reach.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis solve machines/i5-engraver/machine.toml --tip \"10 20 30\" --axis \"0.3 -0.2 0.93\"
  trueaxis solve machines/i5-engraver/machine.toml --path examples/01_describe/path.csv

All solutions of the nominal machine, the best first; those outside the travel are listed last. In a
singular pose the axis without effect keeps its angle of --from.
Exit status: 0 done, 2 unusable input, such as a direction that the machine cannot reach.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// Tool tip in the workpiece frame, mm
    #[arg(
        long,
        value_name = "\"x y z\"",
        required_unless_present = "path",
        allow_hyphen_values = true
    )]
    tip: Option<String>,
    /// Tool axis from the tip to the spindle, of any length
    #[arg(
        long,
        value_name = "\"i j k\"",
        required_unless_present = "path",
        allow_hyphen_values = true
    )]
    axis: Option<String>,
    /// The present axis positions; the solution nearest to them is the best
    #[arg(long, value_name = "\"A=.. C=..\"", allow_hyphen_values = true)]
    from: Option<String>,
    /// A path: CSV with tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k; one best branch
    #[arg(long, value_name = "PATH.csv", conflicts_with_all = ["tip", "axis"])]
    path: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: Arguments) -> Outcome {
    let Arguments { machine, tip, axis, from, path, door } = arguments;
    let target = match path {
        Some(path) => SolveTarget::Path(path),
        None => SolveTarget::Pose(tip.unwrap_or_default(), axis.unwrap_or_default()),
    };
    door.door().ask(&Solve { machine: machine.choice(None), target, from })
}
