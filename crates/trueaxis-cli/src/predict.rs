use crate::output::{Answer, Format, Outcome, report, show, tell};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::geometry::input::{Diagnostics, Place};
use trueaxis::part::tolerance;
use trueaxis::predict::holes::{is_hole_study, predict_holes, read_hole_study};
use trueaxis::predict::{Error, Prediction, Study, predict, read_study};
use trueaxis::report::{self, holes_json, holes_text};

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

/// Holes on a circle: text or JSON, no page.
fn run_holes(arguments: &Arguments) -> Outcome {
    let (study, problems) = read_hole_study(&arguments.study);
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
    if !arguments.no_report {
        let message = "a study of holes has no HTML report: none is written".to_owned();
        problems.note("no-report", place.clone(), message, "use --format json, or --no-report");
    }
    for warning in &prediction.warnings {
        problems.warn("machine-only-compensation", place.clone(), warning.clone(), "");
    }
    report(problems);
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
    if is_hole_study(&arguments.study) {
        return run_holes(arguments);
    }
    let (study, mut problems) = read_study(&arguments.study);
    let samples = arguments.samples.as_deref().map(|text| sample_count(text, &mut problems));
    if !arguments.no_report {
        // Before the work, not after it.
        may_write(&arguments.report, &mut problems);
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
    if let Err(outcome) = write_report(arguments, &study, &prediction) {
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

/// Whether a report may be put there: the folder exists, and what stands there is a report.
fn may_write(path: &Path, problems: &mut Diagnostics) {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (message, hint) = if path.file_name().is_none() || path.is_dir() {
        ("is a folder, not a file", "name a file in it: --report FOLDER/report.html")
    } else if !folder.is_dir() {
        ("its folder does not exist", "make the folder first, or name another --report")
    } else if !replaceable(path) {
        ("is there, and is no report", "it is not overwritten; name another --report")
    } else {
        return;
    };
    let place = Place::whole(&path.display().to_string());
    problems.error("unwritable-file", place, message.to_owned(), hint);
}

/// Nothing, an empty file or an HTML page; never a study, a machine or a device.
fn replaceable(path: &Path) -> bool {
    let Ok(found) = fs::metadata(path) else { return true };
    if !found.is_file() {
        return false;
    }
    let mut start = String::new();
    // A file that cannot be read is not known to be a report.
    let read = File::open(path).and_then(|file| file.take(15).read_to_string(&mut start));
    read.is_ok() && (start.is_empty() || start.to_ascii_lowercase().starts_with("<!doctype html"))
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
        let message = format!("cannot be written: {e}");
        unusable("unwritable-file", &shown, &message, "name another --report, or use --no-report")
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
    let hint = match error {
        Error::Setting(_) | Error::SettingOutOfTravel => {
            "choose other rotary positions in [setting], or another fixture in [mounting]"
        }
        Error::Table { .. } => "cover the travel by the table, or say outside = \"clamp\" for it",
        Error::TooFewSamples(_) => "0, or 2 and more",
        _ => "move the part on the machine, tilt it, or change the tool, and ask again",
    };
    unusable(error.code(), &study.display().to_string(), &error.to_string(), hint)
}
