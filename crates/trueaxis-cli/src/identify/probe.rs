//! `trueaxis identify probe FILE.toml`: a touch probe on a ring or a sphere.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::{IdentifyProbe, ProbePrograms};

/// The study and its outputs.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis identify probe examples/05_identify/ring-60.toml --report probe.html --table table.csv
  trueaxis identify probe examples/05_identify/ring-60.toml \\
      --correct examples/05_identify/ring-60-fresh.csv -o corrected.csv
  trueaxis identify probe examples/05_identify/ring-programs.toml --programs nc --control fanuc
  trueaxis identify probe examples/05_identify/ring-programs.toml --corrections nc --control fanuc

Directions are those of motion; the offset is ball - spindle; corrected point = measured point - dR
along the direction of motion. Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    /// The study: ring or sphere, styli, tables of hits
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Raw hits to be corrected (columns as in the study, with directions)
    #[arg(long, value_name = "HITS.csv", requires = "output")]
    correct: Option<PathBuf>,
    /// Write the corrected hits to this file
    #[arg(short, long, value_name = "FILE.csv", requires = "correct")]
    output: Option<PathBuf>,
    /// Write the table by direction to this file: angle, dR, dX, dY, u
    #[arg(long, value_name = "FILE.csv")]
    table: Option<PathBuf>,
    /// The stylus of the table (default: the first)
    #[arg(long, value_name = "NAME")]
    stylus: Option<String>,
    /// Write the programs that make the hits into this folder: ring, four hits, plane face; no hits are needed yet
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["correct", "table", "corrections"])]
    programs: Option<PathBuf>,
    /// Write programs into this folder in which the control corrects each hit by the table that is found
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["correct", "table"])]
    corrections: Option<PathBuf>,
    /// The control of the programs: sinumerik, fanuc, haas, linuxcnc or heidenhain
    #[arg(long, alias = "dialect", value_name = "NAME", default_value = "sinumerik")]
    control: String,
    /// Spindle orientation of the table, of the programs, and of hits that state none
    #[arg(long, value_name = "ANGLE", allow_negative_numbers = true)]
    orientation: Option<String>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let door = arguments.door.door();
    if let Some(folder) = arguments.programs.as_ref().or(arguments.corrections.as_ref()) {
        return door.ask(&ProbePrograms {
            study: arguments.file.clone(),
            control: arguments.control.clone(),
            output: folder.clone(),
            corrected: arguments.corrections.is_some(),
            stylus: arguments.stylus.clone(),
            orientation: arguments.orientation.clone(),
        });
    }
    let question = IdentifyProbe {
        study: arguments.file.clone(),
        correct: arguments.correct.clone().zip(arguments.output.clone()),
        table: arguments.table.clone(),
        stylus: arguments.stylus.clone(),
        orientation: arguments.orientation.clone(),
    };
    door.ask(&question)
}
