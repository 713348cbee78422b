//! `trueaxis evaluate`: readings by ISO 230 and related standards.

use crate::door::Door;
use crate::output::{Format, Outcome};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueaxis::questions::{Evaluate, ReadingsFile};
use trueaxis::verify::Standard;
use trueaxis::verify::import::Import;

/// The readings to evaluate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --report x.html
  trueaxis evaluate iso230-2 examples/07_verify/x-axis-laser.csv --format json
  trueaxis evaluate iso230-4 examples/07_verify/circle-xy.csv
  trueaxis evaluate iso230-4 PART.qif --feature \"Circle 1\"
  trueaxis evaluate iso230-2 REPORT.md --import ecmc-md

The conditions (instrument, temperature, nominal circle) are in a TOML file with the name of the data
file in its folder, or in the file that --conditions names.

Exit status: 0 done, 2 unusable input; then no report is written.")]
pub struct Arguments {
    /// The standard
    #[arg(value_name = "STANDARD")]
    standard: Name,
    /// The readings: CSV with one line of headings, each with its unit; or a format of --import
    #[arg(value_name = "DATA.csv")]
    data: PathBuf,
    /// The format of the readings; default by the extension: .qif and .md, else csv
    #[arg(long, value_name = "FORM")]
    import: Option<Form>,
    /// The feature of a QIF file: its name or its id
    #[arg(long, value_name = "NAME")]
    feature: Option<String>,
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
    /// Write an HTML report to this file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// The formats by their names.
#[derive(Clone, Copy)]
struct Form(Import);

impl ValueEnum for Form {
    fn value_variants<'a>() -> &'a [Self] {
        const { &[Form(Import::ALL[0]), Form(Import::ALL[1]), Form(Import::ALL[2])] }
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
    let write_back = arguments.write_back.as_deref().and_then(|both| match both {
        [machine, axis] => Some((PathBuf::from(machine), axis.clone())),
        _ => None,
    });
    let question = Evaluate {
        standard: arguments.standard.0,
        data: ReadingsFile::Path(arguments.data.clone()),
        import: arguments.import.map(|form| form.0),
        feature: arguments.feature.clone(),
        conditions: arguments.conditions.clone(),
        radius: arguments.radius.as_ref().map(|mm| format!("{mm} mm")),
        window: Some(arguments.window.clone()),
        write_back,
    };
    Door { format: arguments.format, report: arguments.report.as_deref() }.ask(&question)
}
