//! `trueaxis compensate tables`: the tables of one control.

use crate::arguments::MachineArguments;
use crate::door::DoorArguments;
use crate::output::Outcome;
use crate::report_file::unusable;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueaxis::compensate::tables::Target;
use trueaxis::questions::CompensateTables;

/// The machine, the control, and the resolution.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis compensate tables machines/three-axis-mill/machine.toml --target linuxcnc -o mill-comp
  trueaxis compensate tables machines/xkas2525/machine.toml --target sinumerik -o xkas-comp \\
      --piece examples/03_predict/nas979-on-xkas2525.toml --format json
  trueaxis compensate tables machines/xkas2525/machine.toml --target isg -o xkas-isg --piece examples/03_predict/housing.toml

Each table holds what the control has to add; it is made with the other axes at a reference (--at). Rotary
centres and tilts, grids and errors of whole links go where the control has a place for them. The files
are read back and applied as the control does; the residual errors over the travel of all axes are shown.
The folder must be new or empty. Exit status: 0 done, 2 unusable input (then nothing is written).")]
pub struct TablesArguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// For which control
    #[arg(long, value_enum)]
    target: Control,
    /// The folder of the files: new or empty
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// The position of the other axes, axes not named at 0; default: the middle of linear travels,
    /// rotary axes at 0
    #[arg(long, value_name = "\"X=.. Y=..\"", allow_hyphen_values = true)]
    at: Option<String>,
    /// Largest error of interpolation and rounding of one table of a linear axis
    #[arg(long, value_name = "\"1 um\"", default_value = "1 um", allow_hyphen_values = true)]
    bound: String,
    /// The same of a rotary axis
    #[arg(long, value_name = "\"5 urad\"", default_value = "5 urad", allow_hyphen_values = true)]
    bound_angle: String,
    /// A larger correction of a linear axis is refused
    #[arg(long, value_name = "\"1 mm\"", default_value = "1 mm", allow_hyphen_values = true)]
    limit: String,
    /// The same of a rotary axis
    #[arg(
        long,
        value_name = "\"1000 urad\"",
        default_value = "1000 urad",
        allow_hyphen_values = true
    )]
    limit_angle: String,
    /// Leave rotary centres and tilts to the tables, for a control without a transformation (TCP)
    #[arg(long)]
    no_kinematics: bool,
    /// Of linuxcnc: 0 for actual positions (default), 1 for trims
    #[arg(long, value_enum)]
    comp_file_type: Option<CompFileType>,
    /// A study of `predict`: its test piece, or its part by its drawing, is cut with the tables, too
    #[arg(long, value_name = "STUDY.toml")]
    piece: Option<PathBuf>,
    /// For the machine alone, without a part, though the workpiece grows and its temperature is not given
    #[arg(long)]
    machine_only: bool,
    #[command(flatten)]
    door: DoorArguments,
}

/// Which control.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Control {
    /// Plain tables of every axis on every linear axis
    Csv,
    /// COMP_FILE of each joint; rotary centres of tilting tables as HAL lines
    Linuxcnc,
    /// $AA_ENC_COMP and $AN_CEC
    Sinumerik,
    /// Pitch error compensation and the grid of 3-D error compensation
    Fanuc,
    /// Axis-error tables .COM and KinematicsComp
    Heidenhain,
    /// Volumetric compensation ISG_CSV (ISG, Beckhoff) and leadscrew lists
    Isg,
}

/// Columns of COMP_FILE.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CompFileType {
    /// Actual positions
    #[value(name = "0")]
    Actual,
    /// Trims
    #[value(name = "1")]
    Trims,
}

pub fn run(arguments: TablesArguments) -> Outcome {
    let trims = arguments.comp_file_type == Some(CompFileType::Trims);
    if arguments.comp_file_type.is_some() && arguments.target != Control::Linuxcnc {
        let message = "only LinuxCNC has a COMP_FILE_TYPE";
        let hint = "use it with --target linuxcnc, or leave it out";
        return unusable("unused-argument", "--comp-file-type", message, hint);
    }
    let question = CompensateTables {
        machine: arguments.machine.choice(None),
        target: match arguments.target {
            Control::Csv => Target::Csv,
            Control::Linuxcnc => Target::LinuxCnc { trims },
            Control::Sinumerik => Target::Sinumerik,
            Control::Fanuc => Target::Fanuc,
            Control::Heidenhain => Target::Heidenhain,
            Control::Isg => Target::Isg,
        },
        output: arguments.output,
        at: arguments.at,
        bound: arguments.bound,
        bound_angle: arguments.bound_angle,
        limit: arguments.limit,
        limit_angle: arguments.limit_angle,
        no_kinematics: arguments.no_kinematics,
        machine_only: arguments.machine_only,
        piece: arguments.piece,
    };
    arguments.door.door().ask(&question)
}
