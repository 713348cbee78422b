//! `trueaxis check`: what a machine file describes and what is missing in it.

use crate::door::report_language;
use crate::output::{Answer, Format, Outcome, report, show};
use clap::Args;
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::machine::Machine;
use trueaxis::report::{check_json, check_report, frames_section};
use trueaxis::simulate::collide::export;
use trueaxis_words::ReportLanguage;

/// The machine file to check.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis check machines/xkas2525/machine.toml
  trueaxis check machines/i5-engraver/machine.toml --models stl
  trueaxis check machines/wyxzcat-gantry/machine.toml --frames

Exit status: 0 the file can be used (also with warnings), 2 it cannot. With --format json the
document is printed in both cases: \"usable\" is the result, \"diagnostics\" the reasons.")]
pub struct Arguments {
    /// The machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Write the models that the machine file describes by dimensions as STL files into this new or empty folder
    #[arg(long, value_name = "FOLDER")]
    models: Option<PathBuf>,
    /// List the coordinate systems of the machine, its bodies and its models, too
    #[arg(long)]
    frames: bool,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// The language of the text: en, de (German), zh (Chinese)
    #[arg(long, default_value = "en", value_parser = report_language, value_name = "LANGUAGE")]
    language: ReportLanguage,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let (machine, mut problems) = files::machine(&arguments.machine);
    if let (Some(folder), Some(machine)) = (&arguments.models, &machine) {
        write_models(machine, folder, &mut problems);
    }
    let found = problems.clone();
    let unusable = report(problems) || machine.is_none();
    let shown = match (arguments.format, &machine) {
        (Format::Json, _) => show(&Answer::Json(check_json(machine.as_ref(), found.iter()))),
        (Format::Text, Some(machine)) => {
            let frames = arguments.frames.then(|| frames_section(machine));
            let language = arguments.language.language();
            show(&Answer::Text(check_report(machine).sections(frames).in_language(language).text()))
        }
        (Format::Text, None) => Outcome::Unusable,
    };
    if unusable { Outcome::Unusable } else { shown }
}

fn write_models(machine: &Machine, folder: &Path, problems: &mut Diagnostics) {
    let mut found = Diagnostics::new();
    files::output::may_fill(folder, &mut found);
    let refused = found.has_errors();
    problems.append(found);
    if refused {
        return;
    }
    for (name, bytes) in export(machine) {
        let path = folder.join(name);
        if let Err(error) = files::write_in_folder(&path, &bytes) {
            let place = Place::whole(&path.display().to_string());
            let message = format!("cannot be written: {error}");
            problems.error("unwritable-file", place, message, "name a folder that exists");
            return;
        }
    }
}
