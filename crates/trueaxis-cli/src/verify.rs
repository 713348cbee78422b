use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show};
use crate::report_file::{REPORT, may_write, unusable, write_report};
use clap::Args;
use std::path::PathBuf;
use trueaxis::part::tolerance;
use trueaxis::report::{comparison_html, comparison_json, comparison_text};
use trueaxis::verify::compare::{compare, read_comparison};

/// What to verify.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis verify examples/07_verify/probe-ball.toml --report v.html

Exit status: 0 pass, 1 fail or undecided, 2 unusable input.")]
pub struct Arguments {
    /// What is compared with what, and how it is decided
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let (task, mut problems) = read_comparison(&arguments.file);
    if let Some(path) = &arguments.report {
        may_write(path, &REPORT, &mut problems);
    }
    let list = problems.clone();
    let failed = report(problems);
    let (Some(task), false) = (task, failed) else { return Outcome::Unusable };
    let verified = match compare(&task) {
        Ok(verified) => verified,
        Err(error) => {
            let place = arguments.file.display().to_string();
            let hint =
                "do the readings belong to this campaign: columns, units, order of channels?";
            return unusable("cannot-compare", &place, &error.to_string(), hint);
        }
    };
    if let Some(path) = &arguments.report
        && let Err(outcome) = write_report(path, comparison_html(&task, &verified))
    {
        return outcome;
    }
    let shown = show(&match arguments.format {
        Format::Text => Answer::Text(comparison_text(&task, &verified)),
        Format::Json => {
            let mut document = comparison_json(&task, &verified);
            document["diagnostics"] = list.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    });
    match verified.outcome {
        tolerance::Outcome::Pass => shown,
        _ if shown == Outcome::Unusable => shown,
        _ => Outcome::No,
    }
}
