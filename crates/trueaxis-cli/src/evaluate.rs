//! `trueaxis evaluate`: readings by ISO 230 and related standards.

mod form;

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;
use trueaxis::questions::{Evaluate, ReadingsFile};
use trueaxis::verify::Standard;
use trueaxis::verify::import::Import;

/// The readings to evaluate.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  trueaxis evaluate iso230-1 examples/07_verify/moody-1955.csv --report plate.html
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --report x.html
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --format json
  trueaxis evaluate iso230-4 examples/07_verify/circle-xy.csv
  trueaxis evaluate iso230-10 examples/07_verify/probe-performance.csv
  trueaxis evaluate iso230-4 PART.qif --feature \"Circle 1\"
  trueaxis evaluate iso230-2 REPORT.md --import ecmc-md
  trueaxis evaluate iso230-2 LASER.rtl
  trueaxis evaluate iso230-4 EXPORT.csv --map EXPORT.map.toml
  trueaxis evaluate iso230-4 examples/07_verify/ball-bar-export.csv \
      --machine machines/three-axis-mill/machine.toml -o out.toml
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --tolerance \"A=16 um\" --tolerance \"R=8 um\"
  trueaxis evaluate form examples/07_verify/cone-section.csv --element circle

The conditions (instrument, temperature, nominal circle; the geometric test) are in a TOML file with the name of the data
file in its folder, or in the file that --conditions names.

Exit status: 0 done, 1 a tolerance is not proved to be kept, 2 unusable input; then no report is written."
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<EvaluateCommand>,
    #[command(flatten)]
    readings: ReadingArguments,
}

#[derive(Subcommand)]
enum EvaluateCommand {
    /// Roundness, straightness, flatness, sphericity, cylindricity: an element through points
    Form(form::Arguments),
}

#[derive(Args)]
struct ReadingArguments {
    /// The standard
    #[arg(value_name = "STANDARD", required = true)]
    standard: Option<Name>,
    /// The readings: a table with headings, each with its unit; or a format of --import
    #[arg(value_name = "DATA.csv", required = true)]
    data: Option<PathBuf>,
    /// The format of the readings; default by the extension: .qif, .md, .rtl, .rta, else csv
    #[arg(long, value_name = "FORM")]
    import: Option<Form>,
    /// The feature of a QIF file: its name or its id
    #[arg(long, value_name = "NAME")]
    feature: Option<String>,
    /// Which column is what, with units, decimal sign, encoding; default: DATA.map.toml beside DATA.csv, if there is one
    #[arg(long, value_name = "FILE.toml")]
    map: Option<PathBuf>,
    /// Instrument, temperature, nominal circle …, instead of the TOML file of the data
    #[arg(long, value_name = "FILE.toml")]
    conditions: Option<PathBuf>,
    /// Radius of the nominal circle (iso230-4), mm, instead of that of the conditions
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    radius: Option<String>,
    /// Length of the windows of iso230-3, such as "30 min"
    #[arg(long, value_name = "TIME", default_value = "60 min")]
    window: String,
    /// Write the error motion (iso230-2) as a table into the folder of the machine file, for one of its axes
    #[arg(long, num_args = 2, value_names = ["MACHINE.toml", "AXIS"])]
    write_back: Option<Vec<String>>,
    /// The machine whose errors the circle states (iso230-4): what differs from its file by more than U
    #[arg(long, value_name = "MACHINE.toml")]
    machine: Option<PathBuf>,
    /// Write the machine file with these errors to this file
    #[arg(short = 'o', long, value_name = "OUT.toml", requires = "machine")]
    output: Option<PathBuf>,
    /// A tolerance of a figure, by its name in JSON: "A=10 um", "G_b=8 um", "x.range=5 um"; may be repeated
    #[arg(long = "tolerance", value_name = "FIGURE=LIMIT")]
    tolerances: Vec<String>,
    /// Tolerances in a file: [tolerance] A = "10 um", for one axis [axis.X] A = "8 um"
    #[arg(long = "tolerances", value_name = "FILE.toml")]
    tolerance_file: Option<PathBuf>,
    /// How tolerances decide: with U, or by the value alone
    #[arg(long, value_enum, default_value = "iso14253-1")]
    rule: Rule,
    #[command(flatten)]
    door: DoorArguments,
}

/// How a tolerance decides.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Rule {
    /// Conforming where the size + U is within the tolerance, not conforming where the size - U is beyond it
    #[value(name = "iso14253-1")]
    Guarded,
    /// The value alone
    Simple,
}

/// The formats by their names.
#[derive(Clone, Copy)]
struct Form(Import);

impl ValueEnum for Form {
    fn value_variants<'a>() -> &'a [Self] {
        const {
            &[
                Form(Import::ALL[0]),
                Form(Import::ALL[1]),
                Form(Import::ALL[2]),
                Form(Import::ALL[3]),
            ]
        }
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(self.0.key()).help(self.0.title()))
    }
}

/// The standards by their names.
#[derive(Clone, Copy)]
struct Name(Standard);

impl ValueEnum for Name {
    fn value_variants<'a>() -> &'a [Self] {
        static ALL: [Name; Standard::ALL.len()] = {
            let mut names = [Name(Standard::ALL[0]); Standard::ALL.len()];
            let mut i = 0;
            while i < names.len() {
                names[i] = Name(Standard::ALL[i]);
                i += 1;
            }
            names
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(self.0.key()).help(self.0.title()))
    }
}

pub fn run(arguments: &Arguments) -> Outcome {
    match &arguments.command {
        Some(EvaluateCommand::Form(arguments)) => form::run(arguments),
        None => run_readings(&arguments.readings),
    }
}

fn run_readings(arguments: &ReadingArguments) -> Outcome {
    // Required arguments: clap has refused the command without them.
    let (Some(standard), Some(data)) = (arguments.standard, arguments.data.clone()) else {
        return Outcome::Unusable;
    };
    let write_back = arguments.write_back.as_deref().and_then(|both| match both {
        [machine, axis] => Some((PathBuf::from(machine), axis.clone())),
        _ => None,
    });
    let question = Evaluate {
        standard: standard.0,
        data: ReadingsFile::Path(data),
        import: arguments.import.map(|form| form.0),
        feature: arguments.feature.clone(),
        map: arguments.map.clone(),
        conditions: arguments.conditions.clone(),
        radius: arguments.radius.as_ref().map(|mm| format!("{mm} mm")),
        window: Some(arguments.window.clone()),
        write_back,
        machine: arguments.machine.clone(),
        output: arguments.output.clone(),
        tolerances: arguments.tolerances.clone(),
        tolerance_file: arguments.tolerance_file.clone(),
        is_simple: arguments.rule == Rule::Simple,
    };
    arguments.door.door().ask(&question)
}
