use crate::output::{Format, Outcome, report, show, show_json, tell};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::geometry::input::{Diagnostics, Place};
use trueaxis::part::tolerance;
use trueaxis::predict::{Error, Prediction, Study, predict, read_study};
use trueaxis::report;

/// The study to predict.
#[derive(Args)]
#[command(after_help = "Example:\n  trueaxis predict examples/03_predict/nas979-on-xkas2525.toml")]
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
    #[arg(long, value_name = "N")]
    samples: Option<usize>,
    /// Monte Carlo seed, instead of the study's
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let (study, problems) = read_study(&arguments.study);
    if report(problems) {
        return Outcome::Unusable;
    }
    let Some(mut study) = study else { return Outcome::Unusable };
    if let Err(message) = sampling(&mut study, arguments) {
        return unusable("bad-sampling", "--samples", &message, "0, or 2 and more");
    }
    let prediction = match predicted(&study) {
        Ok(prediction) => prediction,
        Err(error) => return refused(&arguments.study, &error),
    };
    if let Err(outcome) = write_report(arguments, &study, &prediction) {
        return outcome;
    }
    match arguments.format {
        Format::Json => show_json(&report::json(&study, &prediction)),
        Format::Text => show(&report::text(&study, &prediction)),
    }
    match prediction.verdict.outcome {
        tolerance::Outcome::Pass => Outcome::Done,
        tolerance::Outcome::Fail | tolerance::Outcome::Undecided => Outcome::No,
    }
}

fn sampling(study: &mut Study, arguments: &Arguments) -> Result<(), String> {
    let mut sampling = study.sampling.unwrap_or_default();
    sampling.samples = arguments.samples.unwrap_or(study.sampling.map_or(0, |s| s.samples));
    sampling.seed = arguments.seed.unwrap_or(sampling.seed);
    if sampling.samples == 1 {
        return Err("one sample has no spread".into());
    }
    study.sampling = Some(sampling).filter(|s| s.samples > 0);
    Ok(())
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

fn write_report(
    arguments: &Arguments,
    study: &Study,
    prediction: &Prediction,
) -> Result<(), Outcome> {
    if arguments.no_report {
        return Ok(());
    }
    let shown = arguments.report.display().to_string();
    let page = report::html(study, prediction)
        .map_err(|e| unusable("no-report", &shown, &e.to_string(), "use --no-report"))?;
    files::write(&arguments.report, page.as_bytes()).map_err(|e| {
        unusable(
            "unwritable-file",
            &shown,
            &format!("cannot be written: {e}"),
            "name another --report",
        )
    })?;
    tell(&format!("report: {shown}"));
    Ok(())
}

fn unusable(code: &'static str, place: &str, message: &str, hint: &str) -> Outcome {
    let mut problems = Diagnostics::new();
    problems.error(code, Place::whole(place), message.to_owned(), hint);
    report(problems);
    Outcome::Unusable
}

fn refused(study: &Path, error: &Error) -> Outcome {
    let hint = "move the part on the machine, tilt it, or change the tool, and ask again";
    unusable(error.code(), &study.display().to_string(), &error.to_string(), hint)
}
