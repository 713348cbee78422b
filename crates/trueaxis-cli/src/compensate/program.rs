//! `trueaxis compensate program`: an NC program rewritten for the actual machine.

use crate::arguments::MachineArguments;
use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::CompensateProgram;

/// The machine, the program and the residual error that is allowed.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis compensate program machines/xkas2525/machine.toml examples/06_compensate/frustum.mpf \\
      -o frustum-comp.mpf --report r.html
  trueaxis compensate program MACHINE.toml PART.nc --setup PART.setup.toml -o PART-comp.nc \\
      --position-only --residual \"2 um\" --no-rounding --format json
  trueaxis compensate program MACHINE.toml LOOPS.ngc --flat -o LOOPS-comp.ngc

Words, comments and blocks that need no change stay as they are, byte by byte. The written program is
read back and simulated on the actual machine; where it does not keep the residual, nothing is written.
Retracts, moves to machine zero or to a reference point and rapids from which no cut begins stay as they
are. Words are added to cutting blocks and to the last rapid before a cut, where an axis that it does
not name stands elsewhere; each is listed. Computed words keep their expression, and the correction of
this run is added to it: X=R1+5 becomes X=(R1+5)+0.012. Loops, subprograms that are called again and
cycles are unrolled where they need corrections (the lines of the report are then those of the unrolled
program, and computed words have numbers). Exit status: 0 written and proved, 1 not proved, 2 unusable
input or a block that cannot be corrected.")]
pub struct ProgramArguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// The NC program
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// Write the compensated program to this file
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Work offsets and tools; without it PROGRAM.setup.toml if it is there
    #[arg(long, value_name = "SETUP.toml")]
    setup: Option<PathBuf>,
    /// The control of the program: sinumerik, fanuc, haas, linuxcnc or heidenhain
    #[arg(long, value_name = "NAME")]
    control: Option<String>,
    /// Unroll the program first: loops, subprograms, repeated parts and computed numbers become one
    /// flat program, which is compensated
    #[arg(long)]
    flat: bool,
    /// Correct the position of the tip only, with the linear axes
    #[arg(long)]
    position_only: bool,
    /// Largest residual error of the tip between the ends of blocks
    #[arg(long, value_name = "\"1 um\"", default_value = "1 um", allow_negative_numbers = true)]
    residual: String,
    /// Largest residual error of the tool axis there [default: 10 urad where the machine can turn the tool]
    #[arg(long, value_name = "\"10 urad\"", allow_negative_numbers = true)]
    residual_axis: Option<String>,
    /// Write a program that does not keep the residual as FILE.unproved.EXT, marked in its heading
    #[arg(long)]
    keep_unproved: bool,
    /// The least increment of linear axes
    #[arg(long, value_name = "\"1 um\"", default_value = "1 um", allow_negative_numbers = true)]
    increment: String,
    /// The least increment of rotary axes
    #[arg(
        long,
        value_name = "\"0.0001 deg\"",
        default_value = "0.0001 deg",
        allow_negative_numbers = true
    )]
    increment_deg: String,
    /// Write numbers in full double precision instead
    #[arg(long, conflicts_with_all = ["increment", "increment_deg"])]
    no_rounding: bool,
    /// Largest permitted correction of the tip; a larger one is refused
    #[arg(long, value_name = "\"1 mm\"", default_value = "1 mm", allow_negative_numbers = true)]
    limit: String,
    /// A larger correction of the tool axis is refused
    #[arg(
        long,
        value_name = "\"1 mrad\"",
        default_value = "1 mrad",
        allow_negative_numbers = true
    )]
    limit_axis: String,
    /// For the machine alone, without a part, though the workpiece grows and its temperature is not given
    #[arg(long)]
    machine_only: bool,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &ProgramArguments) -> Outcome {
    let question = CompensateProgram {
        machine: arguments.machine.choice(None),
        program: arguments.program.clone(),
        output: arguments.output.clone(),
        setup: arguments.setup.clone(),
        control: arguments.control.clone(),
        flat: arguments.flat,
        position_only: arguments.position_only,
        residual: arguments.residual.clone(),
        keep_unproved: arguments.keep_unproved,
        residual_axis: arguments.residual_axis.clone(),
        increment: arguments.increment.clone(),
        increment_deg: arguments.increment_deg.clone(),
        no_rounding: arguments.no_rounding,
        limit: arguments.limit.clone(),
        limit_axis: arguments.limit_axis.clone(),
        machine_only: arguments.machine_only,
    };
    arguments.door.door().ask(&question)
}
