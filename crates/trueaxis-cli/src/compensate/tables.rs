//! `trueaxis compensate tables`: the tables of one control.

use crate::arguments::{self, MachineArguments, argument};
use crate::output::{Answer, Format, Outcome, report, show};
use crate::report_file::unusable;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use trueaxis::compensate::not_twice;
use trueaxis::compensate::tables::proof::{IndexLeft, piece_left};
use trueaxis::compensate::tables::{Compiled, Order, TablesError, Target, compile};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::predict::read_study;
use trueaxis::report::{TablesReport, tables_json, tables_report};

/// The machine, the control, and the resolution.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis compensate tables machines/three-axis-mill/machine.toml --target linuxcnc -o mill-comp
  trueaxis compensate tables machines/xkas2525/machine.toml --target sinumerik -o xkas-comp \\
      --piece examples/03_predict/nas979-on-xkas2525.toml --format json

Each table holds what the control has to add; it is made with the other axes at a reference (--at). Rotary
centres and tilts, grids and errors of whole links go where the control has a place for them. The files
are read back and applied as the control does; the residual errors over the travel of all axes are shown.
The folder must be new or empty. Exit status: 0 done, 2 unusable input (then nothing is written).")]
pub struct TablesArguments {
    #[command(flatten)]
    machine: MachineArguments,
    /// For which control
    #[arg(long, value_enum)]
    target: Control,
    /// The folder of the files: new or empty
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// The position of the other axes, axes not named at 0; default: the middle of linear travels,
    /// rotary axes at 0
    #[arg(long, value_name = "\"X=.. Y=..\"", allow_hyphen_values = true)]
    at: Option<String>,
    /// Largest error of interpolation and rounding of one table of a linear axis
    #[arg(long, value_name = "\"1 um\"", default_value = "1 um", allow_hyphen_values = true)]
    bound: String,
    /// The same of a rotary axis
    #[arg(long, value_name = "\"5 urad\"", default_value = "5 urad", allow_hyphen_values = true)]
    bound_angle: String,
    /// A larger correction of a linear axis is refused
    #[arg(long, value_name = "\"1 mm\"", default_value = "1 mm", allow_hyphen_values = true)]
    limit: String,
    /// The same of a rotary axis
    #[arg(
        long,
        value_name = "\"1000 urad\"",
        default_value = "1000 urad",
        allow_hyphen_values = true
    )]
    limit_angle: String,
    /// Leave rotary centres and tilts to the tables, for a control without a transformation (TCP)
    #[arg(long)]
    no_kinematics: bool,
    /// Of linuxcnc: 0 for actual positions (default), 1 for trims
    #[arg(long, value_enum)]
    comp_file_type: Option<CompFileType>,
    /// A study of `predict`: its test piece is cut with the tables
    #[arg(long, value_name = "STUDY.toml")]
    piece: Option<PathBuf>,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// Which control.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Control {
    /// Plain tables of every axis on every linear axis
    Csv,
    /// COMP_FILE of each joint; rotary centres of tilting tables as HAL lines
    Linuxcnc,
    /// $AA_ENC_COMP and $AN_CEC
    Sinumerik,
    /// Pitch error compensation and the grid of 3-D error compensation
    Fanuc,
    /// Axis-error tables .COM and KinematicsComp
    Heidenhain,
    /// Volumetric compensation ISG_CSV (ISG, Beckhoff) and leadscrew lists
    Isg,
}

/// Columns of COMP_FILE.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CompFileType {
    /// Actual positions
    #[value(name = "0")]
    Actual,
    /// Trims
    #[value(name = "1")]
    Trims,
}

pub fn run(arguments: &TablesArguments) -> Outcome {
    let mut problems = Diagnostics::new();
    may_fill(&arguments.output, &mut problems);
    let machine = arguments.machine.read(&mut problems);
    let place = Place::whole(&arguments.machine.path().display().to_string());
    let machine = machine.map(|machine| not_twice(&machine, place, &mut problems));
    let order = machine.as_ref().and_then(|m| arguments.order(m, &mut problems));
    let found = match (machine, order) {
        (Some(machine), Some(order)) if !problems.has_errors() => {
            let compiled = compile(&machine, &order).map_err(|e| refuse(&e, &mut problems)).ok();
            compiled.map(|compiled| (machine, compiled))
        }
        _ => None,
    };
    let piece = found
        .as_ref()
        .zip(arguments.piece.as_deref())
        .and_then(|((machine, compiled), path)| cut(path, machine, compiled, &mut problems));
    let failed = report(problems);
    match found {
        Some((machine, compiled)) if !failed => arguments.finish(&machine, &compiled, piece),
        _ => Outcome::Unusable,
    }
}

/// Whether the folder is new or empty, and the one that it stands in is there.
fn may_fill(folder: &Path, problems: &mut Diagnostics) {
    let above = folder.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let full = folder.read_dir().is_ok_and(|mut entries| entries.next().is_some());
    let (message, hint) = if folder.file_name().is_none() || folder.is_file() || full {
        ("is no new or empty folder", "nothing is overwritten; name a folder that is new or empty")
    } else if !above.is_dir() {
        ("its folder does not exist", "make that folder first, or name another --output")
    } else {
        return;
    };
    let place = Place::whole(&folder.display().to_string());
    problems.error("unwritable-folder", place, message.to_owned(), hint);
}

impl TablesArguments {
    fn order(&self, machine: &Machine, problems: &mut Diagnostics) -> Option<Order> {
        if self.comp_file_type.is_some() && self.target != Control::Linuxcnc {
            let message = "only LinuxCNC has a COMP_FILE_TYPE".to_owned();
            let hint = "use it with --target linuxcnc, or leave it out";
            problems.error("unused-argument", argument("--comp-file-type"), message, hint);
        }
        let target = match self.target {
            Control::Csv => Target::Csv,
            Control::Linuxcnc => {
                Target::LinuxCnc { trims: self.comp_file_type == Some(CompFileType::Trims) }
            }
            Control::Sinumerik => Target::Sinumerik,
            Control::Fanuc => Target::Fanuc,
            Control::Heidenhain => Target::Heidenhain,
            Control::Isg => Target::Isg,
        };
        let length =
            |name, text, problems: &mut _| above_zero(name, text, Dimension::Length, problems);
        let angle =
            |name, text, problems: &mut _| above_zero(name, text, Dimension::Angle, problems);
        let bound_mm = length("--bound", &self.bound, problems);
        let bound_rad = angle("--bound-angle", &self.bound_angle, problems);
        let limit_mm = length("--limit", &self.limit, problems);
        let limit_rad = angle("--limit-angle", &self.limit_angle, problems);
        let reference = match &self.at {
            Some(text) => Some(arguments::command(machine, "--at", text, problems)?),
            None => None,
        };
        Some(Order {
            reference,
            bound_mm: bound_mm?,
            bound_rad: bound_rad?,
            kinematics: !self.no_kinematics,
            limit_mm: limit_mm?,
            limit_rad: limit_rad?,
            ..Order::of(target)
        })
    }

    fn finish(
        &self,
        machine: &Machine,
        compiled: &Compiled,
        piece: Option<Vec<IndexLeft>>,
    ) -> Outcome {
        let files: Vec<(&str, &str)> =
            compiled.files.iter().map(|f| (f.name.as_str(), f.text.as_str())).collect();
        if let Err(error) = files::write_folder(&self.output, &files) {
            let message = format!("cannot be written: {error}");
            let shown = self.output.display().to_string();
            return unusable("unwritable-folder", &shown, &message, "name another --output");
        }
        let written =
            compiled.files.iter().map(|f| self.output.join(&f.name).display().to_string());
        let study = self.piece.as_ref().map(|p| p.display().to_string());
        let shown = TablesReport {
            machine,
            compiled,
            target: compiled.order.target.control().key(),
            files: &written.collect::<Vec<_>>(),
            piece: study.as_deref().zip(piece.as_deref()),
        };
        show(&match self.format {
            Format::Text => Answer::Text(tables_report(&shown).text()),
            Format::Json => Answer::Json(tables_json(&shown)),
        })
    }
}

fn above_zero(
    name: &str,
    text: &str,
    dimension: Dimension,
    problems: &mut Diagnostics,
) -> Option<f64> {
    let (code, message) = match parse_quantity(text, dimension) {
        Ok(value) if value > 0.0 => return Some(value),
        Ok(_) => ("not-positive", format!("`{text}` is not above zero")),
        Err(e) => (e.code(), e.to_string()),
    };
    problems.error(
        code,
        argument(name),
        message,
        "above zero, with its unit: \"1 um\", \"5 urad\"",
    );
    None
}

fn refuse(error: &TablesError, problems: &mut Diagnostics) {
    let (code, name, hint) = match error {
        TablesError::UnknownAxis { .. } => {
            ("unknown-axis", "--target", "choose another target; csv takes every axis")
        }
        TablesError::UnknownTravel(_) => {
            ("unknown-travel", "MACHINE.toml", "state travel = [from, to] of the axis")
        }
        TablesError::Position(_) => (
            "outside-table",
            "MACHINE.toml",
            "the errors must be known over the whole travel: measure more, or say outside = \"clamp\" or \"extend\"",
        ),
        TablesError::TooLarge { .. } | TablesError::ErrorTooLarge { .. } => (
            "too-large",
            "--limit",
            "is it an error of the machine? then raise --limit or --limit-angle",
        ),
        TablesError::TooManyNodes { .. }
        | TablesError::ErrorNodes { .. }
        | TablesError::GridPoints { .. } => {
            ("too-many-nodes", "--bound", "allow a larger loss: --bound or --bound-angle")
        }
        TablesError::GridValue { .. } => {
            ("too-large", "--target", "choose another form; is it an error of the machine?")
        }
        TablesError::Increment { .. } | TablesError::ErrorIncrement { .. } => {
            ("bound-below-increment", "--bound", "allow a larger loss: --bound or --bound-angle")
        }
        TablesError::TooManyTables { .. } => {
            ("too-many-tables", "--target", "choose another target; csv takes any number")
        }
        TablesError::NotRecovered(_) => {
            ("not-recovered", "--target", "please report this machine file to the developers")
        }
    };
    problems.error(code, argument(name), error.to_string(), hint);
}

/// The test piece of a study, cut on the study's machine with the tables.
fn cut(
    path: &Path,
    machine: &Machine,
    compiled: &Compiled,
    problems: &mut Diagnostics,
) -> Option<Vec<IndexLeft>> {
    let (study, found) = read_study(&disk(), path);
    problems.append(found);
    let mut study = study?;
    study.machine = study.machine.with_active_compensation();
    let place = Place::whole(&path.display().to_string());
    if study.machine.axes() != machine.axes() {
        let message = "its machine has other axes than that of the tables".to_owned();
        problems.error("another-machine", place, message, "name a study of this machine");
        return None;
    }
    if study.temperatures.is_some() {
        let message = "its temperatures follow a log; tables do not".to_owned();
        problems.error("running-log", place, message, "name a study without log_start");
        return None;
    }
    let control = compiled.order.target.control();
    let content = compiled.content();
    let refuse = |e: trueaxis::predict::Error| {
        problems.error(e.code(), place, e.to_string(), "can the study be predicted?");
    };
    piece_left(&study, (control.as_ref(), &content)).map_err(refuse).ok()
}
