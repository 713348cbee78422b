//! `trueaxis measure`: what the instruments of a campaign would read.

use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show, tell};
use crate::report_file::{REPORT, Written, may_write, unusable, write_report};
use clap::Args;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::measure::virtual_campaign::{Measurement, VirtualCampaign, measure, read_virtual};
use trueaxis::measure::{Campaign, read_campaign};
use trueaxis::report::{MeasuredReport, measurement_html, measurement_json, measurement_text};

/// What to measure.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis measure examples/04_plan/probe-ball.toml
  trueaxis measure examples/04_plan/probe-ball.toml -o readings --truth truth.toml --report m.html

The machine of the campaign, or that of its [truth], is measured by its instruments on its [[path]]s,
with what [disturb] says: noise, drift, axes that lag. The readings do not tell the truth; --truth does.

Exit status: 0 done, 2 unusable input.")]
pub struct Arguments {
    /// The campaign: machine, instruments, paths, and if wanted [truth] and [disturb]
    #[arg(value_name = "CAMPAIGN.toml")]
    campaign: PathBuf,
    /// Write one table of readings for each instrument into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Write what is true into this file: machine, errors, set-ups, rows that are wrong on purpose
    #[arg(long, value_name = "FILE.toml")]
    truth: Option<PathBuf>,
    /// The seed of chance, instead of that of [truth]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Where an HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

const READINGS_BEGIN: &str = "# virtual readings of trueaxis measure";
const READINGS: Written = Written {
    argument: "-o",
    what: "a table of virtual readings",
    begins: &[READINGS_BEGIN.as_bytes()],
};
const TRUTH_BEGIN: &str = "# the truth behind virtual readings";
const TRUTH: Written = Written {
    argument: "--truth",
    what: "the truth of a virtual measurement",
    begins: &[TRUTH_BEGIN.as_bytes()],
};

pub fn run(arguments: &Arguments) -> Outcome {
    let (read, mut problems) = read_campaign(&disk(), &arguments.campaign, |root, campaign| {
        read_virtual(root, campaign, arguments.seed)
    });
    if let Some(path) = &arguments.report {
        may_write(path, &REPORT, &mut problems);
    }
    if let Some(path) = &arguments.truth {
        may_write(path, &TRUTH, &mut problems);
    }
    let folder = match (&arguments.output, &read) {
        (Some(folder), Some((campaign, _))) => tables(folder, campaign, &mut problems),
        _ => Vec::new(),
    };
    let list = problems.clone();
    let failed = report(problems);
    let (Some((campaign, real)), false) = (read, failed) else { return Outcome::Unusable };
    let measurement = match measure(&campaign, &real) {
        Ok(measurement) => measurement,
        Err(error) => {
            let place = arguments.campaign.display().to_string();
            let hint = "change the path, the set-up or the machine";
            return unusable("cannot-measure", &place, &error.to_string(), hint);
        }
    };
    match write(arguments, &campaign, &real, &measurement, &folder) {
        Ok(files) => answer(arguments, &campaign, &real, &measurement, &files, &list),
        Err(outcome) => outcome,
    }
}

/// Where the table of each instrument goes.
fn tables(folder: &Path, campaign: &Campaign, problems: &mut Diagnostics) -> Vec<PathBuf> {
    if let Err(error) = std::fs::create_dir_all(folder) {
        let place = trueaxis::input::Place::whole(&folder.display().to_string());
        let message = format!("the folder cannot be made: {error}");
        problems.error("unwritable-file", place, message, "name another -o");
        return Vec::new();
    }
    let path = |name: &str| {
        // A name of a campaign must not lead out of the folder.
        let safe = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
        folder.join(format!("{}.csv", name.chars().map(safe).collect::<String>()))
    };
    let paths: Vec<PathBuf> = campaign.instruments.iter().map(|i| path(&i.name)).collect();
    for path in &paths {
        may_write(path, &READINGS, problems);
    }
    paths
}

fn write(
    arguments: &Arguments,
    campaign: &Campaign,
    real: &VirtualCampaign,
    measurement: &Measurement,
    tables: &[PathBuf],
) -> Result<Vec<String>, Outcome> {
    let put = |path: &Path, text: &str| {
        let shown = path.display().to_string();
        files::write(path, text.as_bytes()).map_err(|e| {
            let message = format!("cannot be written: {e}");
            unusable("unwritable-file", &shown, &message, "name another place")
        })?;
        Ok(shown)
    };
    let name = arguments.campaign.file_name().unwrap_or_default().display().to_string();
    let mut files = Vec::new();
    for (of, (path, instrument)) in tables.iter().zip(&campaign.instruments).enumerate() {
        let index = u32::try_from(of).unwrap_or(u32::MAX);
        let head = format!(
            "{READINGS_BEGIN}: {} on the paths of {name}, seed {}\n",
            instrument.name, real.truth.seed
        );
        let rows = measurement.readings.table(&campaign.machine, instrument, index);
        files.push(put(path, &(head + &rows))?);
    }
    if let Some(path) = &arguments.truth {
        tell(&format!("truth: {}", put(path, &truth(&name, campaign, real, measurement))?));
    }
    Ok(files)
}

/// What is true, as a `[truth]` that says it again.
fn truth(
    name: &str,
    campaign: &Campaign,
    real: &VirtualCampaign,
    measurement: &Measurement,
) -> String {
    let truth = &real.truth;
    let mut text = format!("{TRUTH_BEGIN} of {name}\n\n[truth]\nseed = {}\n", truth.seed);
    let path = truth.machine_path.as_ref().unwrap_or(&campaign.machine_path);
    // Writing to a String cannot fail.
    let _ = writeln!(text, "machine = {:?}", path.display().to_string());
    let _ = writeln!(text, "draw = {}", truth.factors.is_some());
    let shown = |value: f64, angle: bool| match angle {
        true => format!("\"{} urad\"", value * 1e6),
        false => format!("\"{} um\"", value * 1e3),
    };
    if !truth.errors.is_empty() {
        let _ = writeln!(text, "\n[truth.errors]");
    }
    for (error, value) in &truth.errors {
        let _ = writeln!(text, "{error} = {}", shown(*value, error.component.is_rotation()));
    }
    for (instrument, values) in truth.instruments.iter().zip(&truth.setups) {
        if !values.is_empty() {
            let _ = writeln!(text, "\n[truth.setup.{:?}]", instrument.name);
        }
        for (unknown, value) in instrument.unknowns.iter().zip(values) {
            use trueaxis::measure::instrument::SetupError;
            let angle = match unknown.error {
                SetupError::ReferenceTurn(_) | SetupError::Scale => true,
                SetupError::Zero(_) => instrument.sight.is_angle(),
                _ => false,
            };
            let _ = writeln!(text, "{} = {}", unknown.name, shown(*value, angle));
        }
    }
    let _ = writeln!(text, "\n[wrong]\n# rows of each table, counted from 1, wrong on purpose");
    for (of, instrument) in campaign.instruments.iter().enumerate() {
        let rows = measurement.readings.instruments.iter().enumerate();
        let mine = rows.filter(|(_, i)| **i as usize == of).map(|(row, _)| row);
        let wrong =
            mine.enumerate().filter(|(_, row)| measurement.outliers.binary_search(row).is_ok());
        let wrong: Vec<usize> = wrong.map(|(k, _)| k + 1).collect();
        let _ = writeln!(text, "{:?} = {wrong:?}", instrument.name);
    }
    let _ = writeln!(text, "\n[lost]\nrows = {}", measurement.lost);
    text
}

fn answer(
    arguments: &Arguments,
    campaign: &Campaign,
    real: &VirtualCampaign,
    measurement: &Measurement,
    files: &[String],
    problems: &Diagnostics,
) -> Outcome {
    let measured = MeasuredReport { campaign, real, measurement, files };
    if let Some(path) = &arguments.report
        && let Err(outcome) = write_report(path, measurement_html(&measured))
    {
        return outcome;
    }
    show(&match arguments.format {
        Format::Text => Answer::Text(measurement_text(&measured)),
        Format::Json => {
            let mut document = measurement_json(&measured);
            document["diagnostics"] = problems.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    })
}
