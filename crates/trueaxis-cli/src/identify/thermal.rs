//! `trueaxis identify thermal`: linear thermal models from logs.

use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show};
use crate::report_file::{REPORT, may_write, write_report};
use clap::Args;
use std::path::PathBuf;
use trueaxis::files::disk;
use trueaxis::identify::thermal::{identify_thermal, read_logs};
use trueaxis::input::Place;
use trueaxis::report::{thermal_html, thermal_json, thermal_text};

/// The logs.
#[derive(Args)]
#[command(after_help = "\
Example:
  trueaxis identify thermal examples/05_identify/lathe-thermal.toml --report drift.html

The study names the logs (one cycle each), the column of the displacement, the candidate sensors and
lags. Sensors are chosen, and the model is judged, on whole cycles that it has not seen.

Exit status: 0 a model, 1 refused: the logs support none, 2 unusable input.")]
pub struct Arguments {
    /// The study: logs, displacement, candidate sensors
    #[arg(value_name = "STUDY.toml")]
    file: PathBuf,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let (logs, mut problems) = read_logs(&disk(), &arguments.file);
    if let Some(path) = &arguments.report {
        // Before the work, not after it.
        may_write(path, &REPORT, &mut problems);
    }
    let usable = !problems.has_errors();
    let found = logs.filter(|_| usable).map(|logs| {
        let model = identify_thermal(&logs);
        let place = || Place::whole(&arguments.file.display().to_string());
        for warning in &model.warnings {
            problems.warn("identification", place(), warning.clone(), "");
        }
        (logs, model)
    });
    let list = problems.clone();
    let failed = report(problems);
    let (Some((logs, model)), false) = (found, failed) else { return Outcome::Unusable };
    if let Some(path) = &arguments.report
        && let Err(outcome) = write_report(path, thermal_html(&logs, &model))
    {
        return outcome;
    }
    let answer = match arguments.format {
        Format::Text => Answer::Text(thermal_text(&logs, &model)),
        Format::Json => {
            let mut document = thermal_json(&logs, &model);
            document["diagnostics"] = list.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    };
    match show(&answer) {
        Outcome::Done if model.refusal.is_some() => Outcome::No,
        outcome => outcome,
    }
}
