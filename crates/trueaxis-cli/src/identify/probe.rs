//! `trueaxis identify probe FILE.toml`: a touch probe on a ring or a sphere.

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::IdentifyProbe;

/// The study and its outputs.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis identify probe examples/05_identify/ring-60.toml --report probe.html --table table.csv
  trueaxis identify probe examples/05_identify/ring-60.toml \\
      --correct examples/05_identify/ring-60-fresh.csv -o corrected.csv

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
    /// Spindle orientation of the table, and of hits that state none
    #[arg(long, value_name = "ANGLE", allow_negative_numbers = true)]
    orientation: Option<String>,
    /// Write an HTML report to this file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = IdentifyProbe {
        study: arguments.file.clone(),
        correct: arguments.correct.clone().zip(arguments.output.clone()),
        table: arguments.table.clone(),
        stylus: arguments.stylus.clone(),
        orientation: arguments.orientation.clone(),
    };
    Door { format: arguments.format, report: arguments.report.as_deref() }.ask(&question)
}
