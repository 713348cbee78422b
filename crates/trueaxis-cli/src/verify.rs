//! `trueaxis verify`: comparisons, calibrations and certificates.

use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show};
use crate::report_file::{REPORT, may_write, unusable, write_report};
use clap::Args;
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::part::tolerance;
use trueaxis::report::{
    CalibrationsReport, calibrations_html, calibrations_json, calibrations_text, certificate_html,
    certificate_json, certificate_text, comparison_html, comparison_json, comparison_text,
};
use trueaxis::verify::calibrations::calibrations;
use trueaxis::verify::certificate::{PoseFault, certify, read_certificate};
use trueaxis::verify::compare::{compare, read_comparison};

/// What to verify.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis verify examples/07_verify/probe-ball.toml --report v.html
  trueaxis verify --diff machines/xkas2525/machine.toml examples/07_verify/xkas2525-after-a-year.toml
  trueaxis verify --certificate examples/07_verify/certificate.toml --report certificate.html

Exit status: 0 pass, or nothing moved; 1 fail or undecided, or something moved; 2 unusable input.")]
pub struct Arguments {
    /// What is compared with what, and how it is decided
    #[arg(value_name = "FILE.toml", required_unless_present_any = ["diff", "certificate"])]
    file: Option<PathBuf>,
    /// Compare two calibrations of one machine: what moved, and is it significant?
    #[arg(long, num_args = 2, value_names = ["OLD.toml", "NEW.toml"], conflicts_with = "file")]
    diff: Option<Vec<PathBuf>>,
    /// Certify a compensation: what it leaves on poses that the identification has not used
    #[arg(long, value_name = "STUDY.toml", conflicts_with_all = ["file", "diff"])]
    certificate: Option<PathBuf>,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    match (&arguments.diff.as_deref(), &arguments.certificate, &arguments.file) {
        (Some([old, new]), ..) => diff(arguments, old, new),
        (_, Some(study), _) => run_certificate(arguments, study),
        (.., Some(file)) => run_comparison(arguments, file),
        _ => Outcome::Unusable,
    }
}

fn diff(arguments: &Arguments, old_path: &Path, new_path: &Path) -> Outcome {
    let (old, mut problems) = files::machine(old_path);
    let (new, found) = files::machine(new_path);
    problems.append(found);
    if let Some(path) = &arguments.report {
        may_write(path, &REPORT, &mut problems);
    }
    let list = problems.clone();
    let failed = report(problems);
    let (Some(old), Some(new), false) = (old, new, failed) else { return Outcome::Unusable };
    let names = [old_path, new_path].map(|path| path.display().to_string());
    let found = match calibrations(&old, &new) {
        Ok(found) => found,
        Err(why) => {
            let hint = "name two machine files of one machine, the older first";
            return unusable("other-machine", &names[1], &why, hint);
        }
    };
    let told =
        CalibrationsReport { old: &old, new: &new, files: [&names[0], &names[1]], found: &found };
    if let Some(path) = &arguments.report
        && let Err(outcome) = write_report(path, calibrations_html(&told))
    {
        return outcome;
    }
    let shown = show(&match arguments.format {
        Format::Text => Answer::Text(calibrations_text(&told)),
        Format::Json => {
            let mut document = calibrations_json(&told);
            document["diagnostics"] = list.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    });
    match found.moved().next() {
        Some(_) if shown == Outcome::Done => Outcome::No,
        _ => shown,
    }
}

fn run_comparison(arguments: &Arguments, file: &Path) -> Outcome {
    let (task, mut problems) = read_comparison(&disk(), file);
    if let Some(path) = &arguments.report {
        may_write(path, &REPORT, &mut problems);
    }
    let list = problems.clone();
    let failed = report(problems);
    let (Some(task), false) = (task, failed) else { return Outcome::Unusable };
    let verified = match compare(&task) {
        Ok(verified) => verified,
        Err(error) => {
            let place = file.display().to_string();
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
    judged(verified.outcome, shown)
}

/// What the verdict makes of a run that was shown.
fn judged(outcome: tolerance::Outcome, shown: Outcome) -> Outcome {
    match outcome {
        tolerance::Outcome::Pass => shown,
        _ if shown == Outcome::Unusable => shown,
        _ => Outcome::No,
    }
}

fn run_certificate(arguments: &Arguments, path: &Path) -> Outcome {
    let (study, mut problems) = read_certificate(&disk(), path);
    if let Some(path) = &arguments.report {
        may_write(path, &REPORT, &mut problems);
    }
    let list = problems.clone();
    let failed = report(problems);
    let (Some(study), false) = (study, failed) else { return Outcome::Unusable };
    let certificate = match certify(&study) {
        Ok(certificate) => certificate,
        Err(PoseFault { place, fault }) => {
            let mut problems = Diagnostics::new();
            let place = place.unwrap_or_else(|| Place::whole(&path.display().to_string()));
            let hint = "leave the pose out, or extend the tables of the machine file";
            problems.error("pose-not-certified", place, fault.to_string(), hint);
            report(problems);
            return Outcome::Unusable;
        }
    };
    if let Some(path) = &arguments.report
        && let Err(outcome) = write_report(path, certificate_html(&study, &certificate))
    {
        return outcome;
    }
    let shown = show(&match arguments.format {
        Format::Text => Answer::Text(certificate_text(&study, &certificate)),
        Format::Json => {
            let mut document = certificate_json(&study, &certificate);
            document["diagnostics"] = list.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    });
    judged(certificate.outcome, shown)
}
