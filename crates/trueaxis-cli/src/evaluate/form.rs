//! `trueaxis evaluate form`: an element through points and its form deviation.

use crate::door::DoorArguments;
use crate::output::Outcome;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueaxis::form::Element;
use trueaxis::questions::{EvaluateForm, ReadingsFile};

/// The points and the element.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis evaluate form examples/07_verify/cone-section.csv --element circle
  trueaxis evaluate form examples/07_verify/cone-section.csv --element circle --filter \"gauss 15 upr\" \\
      --u \"0.3 um\" --tolerance \"0.02 mm\" --report section.html
  trueaxis evaluate form POINTS.csv --element cylinder --reference MICY --format json

The columns are x_mm, y_mm and z_mm (any unit of length); with two of them the points lie in that plane. Other columns
are not read. The answer: the least-squares element with U, the form deviation by every reference element with U and
with what is proved of it, and the decision by ISO 14253-1 where there is a tolerance.

Exit status: 0 done, 1 the tolerance is not proved to be kept, 2 unusable input; then no report is written.")]
pub struct Arguments {
    /// The points: CSV with one line of headings, each with its unit
    #[arg(value_name = "POINTS.csv")]
    points: PathBuf,
    /// The element
    #[arg(long, value_name = "ELEMENT")]
    element: Name,
    /// The reference element that decides: LSC, MZC, MCC, MIC, also as LSCI, MZLI, MICY … [default: MZC]
    #[arg(long, value_name = "NAME")]
    reference: Option<String>,
    /// A filter: "gauss 50 upr" for a circle, "gauss 0.8 mm" for a line
    #[arg(long, value_name = "FILTER")]
    filter: Option<String>,
    /// The tolerance of the form deviation, such as "0.01 mm"
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    tolerance: Option<String>,
    /// The standard uncertainty of a point along the normal, such as "1 um"
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    u: Option<String>,
    #[command(flatten)]
    door: DoorArguments,
}

/// The elements by their names.
#[derive(Clone, Copy)]
struct Name(Element);

impl ValueEnum for Name {
    fn value_variants<'a>() -> &'a [Self] {
        static ALL: [Name; Element::ALL.len()] = {
            let mut names = [Name(Element::ALL[0]); Element::ALL.len()];
            let mut i = 0;
            while i < names.len() {
                names[i] = Name(Element::ALL[i]);
                i += 1;
            }
            names
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(self.0.key()).help(self.0.deviation_name()))
    }
}

pub fn run(arguments: &Arguments) -> Outcome {
    let question = EvaluateForm {
        data: ReadingsFile::Path(arguments.points.clone()),
        element: arguments.element.0,
        reference: arguments.reference.clone(),
        filter: arguments.filter.clone(),
        tolerance: arguments.tolerance.clone(),
        u: arguments.u.clone(),
    };
    arguments.door.door().ask(&question)
}
