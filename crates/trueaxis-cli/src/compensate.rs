//! `trueaxis compensate`: values per axis; the other kinds have files of their own.

mod adapt;
mod program;
mod tables;

use crate::arguments::MachineArguments;
use crate::door::{Door, report_language};
use crate::output::{self, Outcome};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;
use trueaxis::predict::holes::Compensation;
use trueaxis::questions::{CompensateValues, ValuesForm};
use trueaxis_words::ReportLanguage;

/// The form of the compensation.
#[derive(Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: CompensateCommand,
}

#[derive(Subcommand)]
enum CompensateCommand {
    /// Adapt a path to the blank that was probed, and show the wall thickness that remains
    Adapt(adapt::AdaptArguments),
    /// Rewrite an NC program so that the actual tool follows the programmed path
    Program(Box<program::ProgramArguments>),
    /// Tables of a control, read back, with the residual errors
    Tables(tables::TablesArguments),
    /// Values per axis and position, in least increments, to be added to the command
    Values(ValuesArguments),
}

/// The values to calculate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis compensate values machines/gantry-001/machine.toml --at \"X=3500 Y=2300\" --temperature \"scale_x=30.5 scale_y=31.2 workpiece=30.5\"
  trueaxis compensate values machines/gantry-001/machine.toml --axis X --step 350 --temperature \"scale_x=30.5 workpiece=30.5\"
  trueaxis compensate values machines/xkas2525/machine.toml --axis C --step 30 --format csv -o c.csv

value = - error of the axis in its own direction, rounded to whole increments, halves away from zero;
the control adds it to the command. Without temperatures there is no thermal part. Where the workpiece
grows, its temperature must be given (20 if it is at 20 degC), or --machine-only. Exit status: 0 done, 2 unusable input.")]
struct ValuesArguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// The axis of a table over the travel
    #[arg(long, value_name = "X", required_unless_present = "at")]
    axis: Option<String>,
    /// Without --axis: one position, with a value for each axis named; with it: the position of the other axes
    #[arg(long, value_name = "\"X=.. Y=..\"")]
    at: Option<String>,
    /// Distance of the positions over the travel, mm or degrees (default: 100 and 10)
    #[arg(long, value_name = "STEP", requires = "axis", allow_negative_numbers = true)]
    step: Option<String>,
    /// These positions instead, mm or degrees
    #[arg(long, value_name = "\"0 500 1000\"", requires = "axis", conflicts_with = "step")]
    #[arg(allow_hyphen_values = true)]
    targets: Option<String>,
    /// The least increment of the control: "1 um" for linear, "0.0001 deg" for rotary axes by default
    #[arg(long, value_name = "\"1 um\"")]
    increment: Option<String>,
    /// Which error is compensated
    #[arg(long, value_enum, default_value = "comprehensive")]
    of: CompensatedError,
    /// For the machine alone, without a part, though the workpiece grows and its temperature is not given
    #[arg(long)]
    machine_only: bool,
    /// Output as text, as one JSON document, or as a CSV table of one axis
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file, also one that this program did not write or that was edited since
    #[arg(long)]
    force: bool,
    /// The language of the text on standard output: en, de (German), zh (Chinese); a file stays English
    #[arg(long, default_value = "en", value_parser = report_language, value_name = "LANGUAGE")]
    language: ReportLanguage,
}

/// Which error is compensated.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CompensatedError {
    /// That of the machine alone, as a laser shows it
    Machine,
    /// machine - workpiece: what the part has at 20 degC
    Comprehensive,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Text with tables
    Text,
    /// One JSON document
    Json,
    /// The table of one axis
    Csv,
}

pub fn run(arguments: Arguments) -> Outcome {
    match arguments.command {
        CompensateCommand::Adapt(arguments) => adapt::run(&arguments),
        CompensateCommand::Program(arguments) => program::run(&arguments),
        CompensateCommand::Tables(arguments) => tables::run(arguments),
        CompensateCommand::Values(arguments) => run_values(arguments),
    }
}

fn run_values(arguments: ValuesArguments) -> Outcome {
    let question = CompensateValues {
        machine: arguments.machine.choice(None),
        axis: arguments.axis,
        at: arguments.at,
        step: arguments.step,
        targets: arguments.targets,
        increment: arguments.increment,
        of: match arguments.of {
            CompensatedError::Machine => Compensation::Machine,
            CompensatedError::Comprehensive => Compensation::Comprehensive,
        },
        machine_only: arguments.machine_only,
        form: match arguments.format {
            Format::Text => ValuesForm::Text,
            Format::Json => ValuesForm::Json,
            Format::Csv => ValuesForm::Csv,
        },
        output: arguments.output,
    };
    // The values know their form; on standard output JSON is that of every command, refusals too.
    let is_document = question.form == ValuesForm::Json && question.output.is_none();
    let format = if is_document { output::Format::Json } else { output::Format::Text };
    let (force, language) = (arguments.force, arguments.language);
    Door { format, report: None, heading: None, force, language }.ask(&question)
}
