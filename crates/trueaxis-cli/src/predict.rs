//! `trueaxis predict`: test pieces and holes before they are cut.

use crate::output::{Answer, Format, Outcome, report, show};
use crate::report_file::{REPORT, may_write, unusable, write_report};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::part::tolerance;
use trueaxis::predict::holes::{is_hole_study, predict_holes, read_hole_study};
use trueaxis::predict::{Error, Prediction, Study, predict, read_study};
use trueaxis::report::{self, holes_html, holes_json, holes_text};

/// The study to predict.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml
  trueaxis predict examples/03_predict/torque-arm.toml
  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml --format json --no-report

Exit status: 0 the part will be in tolerance, 1 it will not (or that cannot be decided within the
uncertainty), 2 unusable input; then no report is written.")]
pub struct Arguments {
    /// The study file: machine, test piece, setting point
    #[arg(value_name = "STUDY.toml")]
    study: PathBuf,
    /// Where the HTML report goes
    #[arg(long, value_name = "FILE", default_value = "report.html")]
    report: PathBuf,
    /// Write no report
    #[arg(long, conflicts_with = "report")]
    no_report: bool,
    /// Monte Carlo samples, instead of the study's (0: none)
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    samples: Option<String>,
    /// Monte Carlo seed, instead of the study's
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// Holes on a circle.
fn run_holes(arguments: &Arguments) -> Outcome {
    let (study, mut problems) = read_hole_study(&disk(), &arguments.study);
    if !arguments.no_report {
        // Before the work, not after it.
        may_write(&arguments.report, &REPORT, &mut problems);
    }
    if report(problems) {
        return Outcome::Unusable;
    }
    let Some(study) = study else { return Outcome::Unusable };
    let prediction = match predict_holes(&study) {
        Ok(prediction) => prediction,
        Err(problems) => {
            report(problems);
            return Outcome::Unusable;
        }
    };
    let mut problems = Diagnostics::new();
    let place = Place::whole(&arguments.study.display().to_string());
    for warning in &prediction.warnings {
        problems.warn("machine-only-compensation", place.clone(), warning.clone(), "");
    }
    report(problems);
    if !arguments.no_report
        && let Err(outcome) = write_report(&arguments.report, holes_html(&study, &prediction))
    {
        return outcome;
    }
    let answer = match arguments.format {
        Format::Json => Answer::Json(holes_json(&study, &prediction)),
        Format::Text => Answer::Text(holes_text(&study, &prediction)),
    };
    let applied = prediction.sets.iter().find(|s| s.compensation == study.applied);
    match (show(&answer), applied.and_then(|s| s.in_tolerance)) {
        (Outcome::Done, Some(false)) => Outcome::No,
        (shown, _) => shown,
    }
}

pub fn run(arguments: &Arguments) -> Outcome {
    if is_hole_study(&disk(), &arguments.study) {
        return run_holes(arguments);
    }
    let (study, mut problems) = read_study(&disk(), &arguments.study);
    let samples = arguments.samples.as_deref().map(|text| sample_count(text, &mut problems));
    if !arguments.no_report {
        // Before the work, not after it.
        may_write(&arguments.report, &REPORT, &mut problems);
    }
    if report(problems) {
        return Outcome::Unusable;
    }
    let Some(mut study) = study else { return Outcome::Unusable };
    choose_sampling(&mut study, samples.flatten(), arguments.seed);
    let prediction = match predicted(&study) {
        Ok(prediction) => prediction,
        Err(error) => return refused(&arguments.study, &error),
    };
    if !arguments.no_report
        && let Err(outcome) = write_report(&arguments.report, report::html(&study, &prediction))
    {
        return outcome;
    }
    let answer = match arguments.format {
        Format::Json => Answer::Json(report::json(&study, &prediction)),
        Format::Text => Answer::Text(report::text(&study, &prediction)),
    };
    match (show(&answer), prediction.verdict.outcome) {
        (Outcome::Done, tolerance::Outcome::Fail | tolerance::Outcome::Undecided) => Outcome::No,
        (shown, _) => shown,
    }
}

fn sample_count(text: &str, problems: &mut Diagnostics) -> Option<usize> {
    let count = text.parse().ok().filter(|n| *n != 1 && *n <= Study::MOST_SAMPLES);
    if count.is_none() {
        let message = format!("`{text}` is no number of samples");
        let hint = format!("0 for no Monte Carlo run, or 2 to {}", Study::MOST_SAMPLES);
        problems.error("bad-sampling", Place::whole("--samples"), message, &hint);
    }
    count
}

fn choose_sampling(study: &mut Study, samples: Option<usize>, seed: Option<u64>) {
    let mut sampling = study.sampling.unwrap_or_default();
    sampling.samples = samples.unwrap_or(study.sampling.map_or(0, |s| s.samples));
    sampling.seed = seed.unwrap_or(sampling.seed);
    study.sampling = Some(sampling).filter(|s| s.samples > 0);
}

fn predicted(study: &Study) -> Result<Prediction, Error> {
    let samples = study.sampling.map_or(0, |s| s.samples);
    let bar = ProgressBar::new(samples as u64);
    let template = "Monte Carlo {wide_bar} {pos}/{len} machines, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    let prediction = predict(study, &|done| bar.set_position(done as u64));
    bar.finish_and_clear();
    prediction
}

fn refused(study: &Path, error: &Error) -> Outcome {
    let hint = match error {
        Error::Setting(_) | Error::SettingOutOfTravel => {
            "choose other rotary positions in [setting], or another fixture in [mounting]"
        }
        Error::Table { .. } => "cover the travel by the table, or say outside = \"clamp\" for it",
        Error::TooFewSamples(_) => "0, or 2 and more",
        Error::LogEnds { .. } => "take a longer log, or start earlier in it",
        _ => "move the part on the machine, tilt it, or change the tool, and ask again",
    };
    unusable(error.code(), &study.display().to_string(), &error.to_string(), hint)
}
