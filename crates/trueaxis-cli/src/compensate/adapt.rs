//! `trueaxis compensate adapt`: a path moved onto the measured blank.

use crate::arguments::control;
use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show, tell};
use crate::post::OnOff;
use crate::report_file::{REPORT, Written, may_write, unusable, write_report};
use clap::Args;
use std::path::{Path, PathBuf};
use trueaxis::compensate::adapt::{AdaptStudy, Adaptation, adapt, read_adapt_study};
use trueaxis::compensate::post::{PostOptions, post, verify};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::nc::writer::TipWords;
use trueaxis::report::{AdaptReport, AdaptedProgram, adapt_html, adapt_json, adapt_text};

/// The study: path, measured blank, cutter, wall.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis compensate adapt examples/06_compensate/bangle-adapt.toml
  trueaxis compensate adapt examples/06_compensate/bangle-adapt.toml --control fanuc -o bangle.nc \\
      --cl bangle-adapted.cls --format json

The blank is registered, its form becomes a smooth field, the path is moved along its normals, and a
virtual cut shows what wall it leaves. A program is written only if the wall holds everywhere, nothing
gouges, and the program, read back and simulated, follows the adapted path within the travel.
Exit status: 0 done, 1 it must not be cut (then no program is written), 2 unusable input.")]
pub struct AdaptArguments {
    /// The study
    #[arg(value_name = "STUDY.toml")]
    file: PathBuf,
    /// Where the HTML report goes
    #[arg(long, value_name = "FILE", default_value = "report.html")]
    report: PathBuf,
    /// Write no report
    #[arg(long, conflicts_with = "report")]
    no_report: bool,
    /// Where the program of the adapted path goes
    #[arg(short, long, value_name = "FILE", requires = "control")]
    output: Option<PathBuf>,
    /// For which control: sinumerik, fanuc, linuxcnc or heidenhain
    #[arg(long, alias = "dialect", value_name = "NAME", requires = "output")]
    control: Option<String>,
    /// Whether the control keeps the tip of the tool on the path
    #[arg(long, value_enum, default_value = "on")]
    tcp: OnOff,
    /// Largest distance between adapted path and program, mm
    #[arg(long, value_name = "MM", default_value = "0.001", allow_negative_numbers = true)]
    tolerance: String,
    /// Where the adapted cutter locations go
    #[arg(long, value_name = "FILE.cls")]
    cl: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// What `--cl` may replace: nothing that is there and not empty but an adapted path.
const CL: Written = Written {
    argument: "--cl",
    what: "an adapted path",
    begins: &[b"$$ adapted by trueaxis", b"# adapted by trueaxis"],
};

pub fn run(arguments: &AdaptArguments) -> Outcome {
    let (study, mut problems) = read_adapt_study(&disk(), &arguments.file);
    if !arguments.no_report {
        // Before the work, not after it.
        may_write(&arguments.report, &REPORT, &mut problems);
    }
    if let Some(path) = &arguments.cl {
        may_write(path, &CL, &mut problems);
    }
    let options = arguments.options(&mut problems);
    let usable = !problems.has_errors();
    let adaptation = study.as_ref().filter(|_| usable).and_then(|study| {
        let (adaptation, found) = adapt(study);
        problems.append(found);
        adaptation
    });
    let program = match (&study, &adaptation, &options) {
        (Some(study), Some(adaptation), Some(options)) => {
            program(arguments, study, adaptation, options, &mut problems)
        }
        _ => None,
    };
    let list = problems.clone();
    let failed = report(problems);
    let (Some(study), Some(adaptation), false) = (study, adaptation, failed) else {
        return Outcome::Unusable;
    };
    arguments.finish(&study, &adaptation, program, &list)
}

/// The program of the adapted path: where it goes, its text, its proof.
struct Made {
    path: PathBuf,
    text: Vec<u8>,
    told: AdaptedProgram,
}

fn program(
    arguments: &AdaptArguments,
    study: &AdaptStudy,
    adaptation: &Adaptation,
    options: &PostOptions,
    problems: &mut Diagnostics,
) -> Option<Made> {
    let path = arguments.output.clone()?;
    let (posted, found) = post(&study.machine, &adaptation.path, options);
    problems.append(found);
    let posted = posted?;
    let proof = verify(&study.machine, &posted, options);
    let told = AdaptedProgram {
        file: path.display().to_string(),
        written: proof.is_within(options) && adaptation.findings.is_empty(),
        blocks: posted.blocks,
        tip_mm: proof.tip_between.value,
        axis_rad: proof.axis_between.value,
    };
    Some(Made { path, text: posted.text, told })
}

impl AdaptArguments {
    fn options(&self, problems: &mut Diagnostics) -> Option<PostOptions> {
        let tolerance_mm = parse_quantity(&self.tolerance, Dimension::Ratio).ok();
        let Some(tolerance_mm) = tolerance_mm.filter(|v| (1e-6..1.0).contains(v)) else {
            let message = format!("`{}` is not a tolerance in mm", self.tolerance);
            problems.error("bad-number", Place::whole("--tolerance"), message, "such as 0.001");
            return None;
        };
        let name = self.output.as_ref().and_then(|p| p.file_stem());
        Some(PostOptions {
            tip_words: (self.tcp == OnOff::On).then_some(TipWords::Angles),
            tolerance_mm,
            name: name.map_or_else(|| "PROGRAM".into(), |n| n.to_string_lossy().into_owned()),
            ..PostOptions::of(control(self.control.as_ref()?, problems)?)
        })
    }

    fn finish(
        &self,
        study: &AdaptStudy,
        adaptation: &Adaptation,
        program: Option<Made>,
        problems: &Diagnostics,
    ) -> Outcome {
        let sound = adaptation.findings.is_empty();
        if let Some(made) = program.as_ref().filter(|made| made.told.written)
            && let Err(outcome) = write(&made.path, &made.text, "--output")
        {
            return outcome;
        }
        if let Some(path) = self.cl.as_ref().filter(|_| sound) {
            let begin = if study.path.is_table() { "#" } else { "$$" };
            let mut text = format!("{begin} adapted by trueaxis: {}\n", one_line(&study.name));
            text.retain(|c| c.is_ascii());
            let text = [text.into_bytes(), adaptation.path.rewritten()].concat();
            if let Err(outcome) = write(path, &text, "--cl") {
                return outcome;
            }
        }
        if !sound && (self.output.is_some() || self.cl.is_some()) {
            tell("the adapted path must not be cut; neither program nor path was written");
        }
        let told = program.map(|made| made.told);
        let shown = AdaptReport { study, adaptation, program: told.as_ref() };
        if !self.no_report
            && let Err(outcome) = write_report(&self.report, adapt_html(&shown))
        {
            return outcome;
        }
        let answer = match self.format {
            Format::Text => Answer::Text(adapt_text(&shown)),
            Format::Json => {
                let mut document = adapt_json(&shown);
                document["diagnostics"] = problems.iter().map(diagnostic_json).collect();
                Answer::Json(document)
            }
        };
        match show(&answer) {
            Outcome::Done if !sound || told.is_some_and(|t| !t.written) => Outcome::No,
            outcome => outcome,
        }
    }
}

fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(60).collect()
}

fn write(path: &Path, text: &[u8], argument: &str) -> Result<(), Outcome> {
    files::write(path, text).map_err(|error| {
        let message = format!("cannot be written: {error}");
        let shown = path.display().to_string();
        unusable("unwritable-file", &shown, &message, &format!("name another {argument}"))
    })
}
