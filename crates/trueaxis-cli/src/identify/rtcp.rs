//! `trueaxis identify rtcp FILE.toml`: the rotary centres.

use crate::arguments::control;
use crate::output::{Answer, Format, Outcome, diagnostic_json, report, show, tell};
use crate::plan::written;
use clap::Args;
use serde_json::json;
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::identify::rtcp::forecast::forecast;
use trueaxis::identify::rtcp::program::{off_poses, program};
use trueaxis::identify::rtcp::{
    Calibration, Purpose, RtcpStudy, calibrate, machine_file, place_of, read_rtcp,
};
use trueaxis::input::{Diagnostics, Place};
use trueaxis::plan::{extension, file_name};
use trueaxis::report::{RtcpReport, rtcp_json, rtcp_text};
use trueaxis::unknowns::fit::FitError;

/// The readings.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml
  trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml -o engraver.toml --format json
  trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml --programs nc --control fanuc

Readings of an indicator or a probe at turned poses, with RTCP on or off, on machines with two rotary
axes in table or head: the offsets of the rotary centres with their uncertainty, the new numbers of
the control, and what they will be worth.

Exit status: 0 done, 1 the readings do not fit the machine or tell nothing, 2 unusable input.")]
pub struct Arguments {
    /// The file: machine, control, readings
    #[arg(value_name = "FILE.toml")]
    file: PathBuf,
    /// Write one NC program for each set of readings into this folder; the tables then need poses only
    #[arg(long, value_name = "FOLDER")]
    programs: Option<PathBuf>,
    /// Whose programs: sinumerik, fanuc, linuxcnc or heidenhain
    #[arg(
        long,
        alias = "dialect",
        value_name = "NAME",
        default_value = "sinumerik",
        requires = "programs"
    )]
    control: String,
    /// A machine file with the centres as they were found
    #[arg(short, long, value_name = "MACHINE.toml")]
    output: Option<PathBuf>,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    if let Some(folder) = &arguments.programs {
        return programs(arguments, folder);
    }
    let (study, mut problems) = read_rtcp(&disk(), &arguments.file, Purpose::Result);
    let found = match problems.has_errors() {
        true => None,
        false => study.as_ref().and_then(|study| solved(study, &mut problems)),
    };
    if let (Some(output), Some(study), Some(found)) = (&arguments.output, &study, &found) {
        write_machine(output, study, found, &mut problems);
    }
    let list = problems.clone();
    if report(problems) {
        return Outcome::Unusable;
    }
    let (Some(study), Some(found)) = (study, found) else { return Outcome::Unusable };
    let forecast = forecast(&study, &found);
    let told = RtcpReport { study: &study, found: &found, forecast: forecast.as_ref() };
    let shown = show(&match arguments.format {
        Format::Text => Answer::Text(rtcp_text(&told)),
        Format::Json => {
            let mut document = rtcp_json(&told);
            document["diagnostics"] = list.iter().map(diagnostic_json).collect();
            Answer::Json(document)
        }
    });
    match shown {
        Outcome::Done if !found.is_good() => Outcome::No,
        shown => shown,
    }
}

/// Programs for all sets, each read back through the simulation.
fn programs(arguments: &Arguments, folder: &Path) -> Outcome {
    let (study, mut problems) = read_rtcp(&disk(), &arguments.file, Purpose::Programs);
    let control = control(&arguments.control, &mut problems);
    let mut files = Vec::new();
    let mut told = Vec::new();
    if let (Some(study), Some(control)) = (&study, control) {
        for set in &study.sets {
            let name = format!("{}.{}", file_name(&set.name, files.len() + 1), extension(control));
            match program(study, set, control) {
                Ok(text) => {
                    let off = off_poses(study, set, &text, control);
                    told.push(json!({
                        "file": name, "set": set.name, "off_poses_um": 1e3 * off,
                    }));
                    if !off.is_finite() {
                        let message = "the program does not reach its poses".to_owned();
                        let hint = "another --control, or axes within their travel";
                        problems.error("unsound-program", Place::whole(&name), message, hint);
                    }
                    files.push((name, text));
                }
                Err(why) => {
                    let hint = "another --control";
                    problems.error("no-program", Place::whole(&name), why.to_string(), hint);
                }
            }
        }
    }
    if report(problems) || study.is_none() {
        return Outcome::Unusable;
    }
    if let Err(outcome) = written(folder, &files) {
        return outcome;
    }
    let document = json!({ "schema": "trueaxis/identify-rtcp-programs/1", "programs": told });
    match arguments.format {
        Format::Json => show(&Answer::Json(document)),
        Format::Text => Outcome::Done,
    }
}

fn solved(study: &RtcpStudy, problems: &mut Diagnostics) -> Option<Calibration> {
    match calibrate(study) {
        Ok(found) => Some(found),
        Err(why) => {
            let (place, hint) = match why {
                FitError::Outside { row, .. } => (
                    place_of(study, row),
                    "errors = \"none\" leaves out what the machine file states besides the centres",
                ),
                _ => {
                    let file = study.path.display().to_string();
                    (Place::whole(&file), "readings at turned poses, with the right units")
                }
            };
            problems.error("no-result", place, why.to_string(), hint);
            None
        }
    }
}

/// The machine file with the centres that were found; the input is never overwritten.
fn write_machine(
    output: &Path,
    study: &RtcpStudy,
    found: &Calibration,
    problems: &mut Diagnostics,
) {
    let shown = output.display().to_string();
    let same = |other: &Path| match (output.canonicalize(), other.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => output == other,
    };
    let ours = |text: String| text.is_empty() || text.contains("[machine]");
    let taken = output.exists() && !std::fs::read_to_string(output).is_ok_and(ours);
    let message = match same(&study.machine_path) || same(&study.path) {
        true => "is the input, which is not overwritten",
        false if taken => "is there, and is no machine file",
        false => "",
    };
    if !message.is_empty() {
        let hint = "name another file: -o identified.toml";
        problems.error("unwritable-file", Place::whole(&shown), message.to_owned(), hint);
        return;
    }
    let Some(old) = disk().text(&study.machine_path, "the machine file", problems) else { return };
    let beside = trueaxis::machine::file::Folder::of(&disk(), output);
    let written = machine_file(study, found, &old, &beside).and_then(|text| {
        files::write(output, text.as_bytes()).map_err(|e| format!("cannot be written: {e}"))
    });
    match written {
        Ok(()) => tell(&format!("machine file: {shown}")),
        Err(why) => {
            let hint = "put it beside the machine file if that names tables";
            problems.error("unwritable-file", Place::whole(&shown), why, hint);
        }
    }
}
