//! `trueaxis part`: what a part file asks for; a draft of one from a QIF file.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::Args;
use std::path::PathBuf;
use trueaxis::questions::AskPart;

/// The part.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis part parts/housing.toml
  trueaxis part bracket.qif -o parts/bracket.toml

A QIF file (ISO 23952) states features, datums and tolerances of a model. What a part file can say of them is
drafted; a value that the QIF file does not state is written as \"?\", and all that is left out is listed with the
reason. Name the finished file as `part` of a study, and ask `trueaxis predict`.

Exit status: 0 read, 2 unusable input.")]
pub struct Arguments {
    /// The part file, or a QIF file
    #[arg(value_name = "PART.toml|MODEL.qif")]
    file: PathBuf,
    /// Write the draft of a QIF file here; without it the draft is shown
    #[arg(short, value_name = "PART.toml")]
    output: Option<PathBuf>,
    #[command(flatten)]
    door: DoorArguments,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = AskPart { file: arguments.file.clone(), output: arguments.output.clone() };
    arguments.door.door().ask(&question)
}
