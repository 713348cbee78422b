//! `trueaxis identify tables FILE.toml`: error tables from readings of single error motions.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::IdentifyTables;

/// The readings.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis identify tables examples/05_identify/error-tables.toml
  trueaxis identify tables examples/05_identify/error-tables.toml -o gantry --report tables.html

Readings of a laser, a level, an R-test or a dial gauge, each of one error motion (EXX, EYX, EAX, ECC),
in both directions and several runs, and circles of a ball-bar: the error table of each with its
uncertainty, averaged over the runs, without what the angles of the axis do over the arm of the optics;
the squareness from each circle. -o writes the machine file with all of them, which was read back: its
virtual instruments read what the instruments read.

Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    /// The file that names machine and readings
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Write the machine file with these tables into this new folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let (study, output) = (arguments.file.clone(), arguments.output.clone());
    let door = arguments.door.door();
    door.ask(&IdentifyTables { study, output })
}
