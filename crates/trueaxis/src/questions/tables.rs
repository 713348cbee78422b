//! Which tables does a control take?

use super::words::{self, argument};
use super::workpiece::{machine_or_part, on_top};
use super::{Answer, Content, MachineChoice, NewFile, Question, Tell};
use crate::files::output::may_fill;
use crate::report::{self, PartWithTables, TablesReport};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_correct::compensate::not_twice;
use trueaxis_correct::compensate::tables::proof::{IndexLeft, part_left, piece_left};
use trueaxis_correct::compensate::tables::{Compiled, Order, TablesError, Target, compile};
use trueaxis_input::{Diagnostics, Dimension, Files, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::describe::warn_beyond_travel;
use trueaxis_predict::predict::drawing::{PartStudy, is_part_study, predict_part, read_part_study};
use trueaxis_predict::predict::{Error, Study, read_study};
use trueaxis_report::{Report, document};

/// The tables of one control, read back, with the residual errors. Texts are as typed.
#[derive(Debug, Clone)]
pub struct CompensateTables {
    /// The machine.
    pub machine: MachineChoice,
    /// The control.
    pub target: Target,
    /// The folder of the files: new or empty.
    pub output: PathBuf,
    /// The position of the other axes: `X=10 C=30`.
    pub at: Option<String>,
    /// Largest error of one table of a linear axis.
    pub bound: String,
    /// The same of a rotary axis.
    pub bound_angle: String,
    /// A larger correction of a linear axis is refused.
    pub limit: String,
    /// The same of a rotary axis.
    pub limit_angle: String,
    /// Whether rotary centres and tilts are left to the tables.
    pub no_kinematics: bool,
    /// A study of a test piece, or of a part by its drawing, that is cut with the tables.
    pub piece: Option<PathBuf>,
    /// Whether tables of the machine alone are wanted, though the temperature of the workpiece is unknown.
    pub machine_only: bool,
}

/// The tables of a control with what they leave.
pub struct TablesAnswer {
    machine: Machine,
    compiled: Compiled,
    piece: Option<(String, Vec<IndexLeft>)>,
    part: Option<Box<PartWithTables>>,
    output: PathBuf,
    written: Vec<String>,
    /// What it can cost that the temperature of the workpiece is not known.
    price: Option<String>,
}

impl CompensateTables {
    fn order(&self, machine: &Machine, problems: &mut Diagnostics) -> Option<Order> {
        let mut above_zero = |name, text: &str, dimension| {
            let usual = ("above zero", "above zero, with its unit: \"1 um\", \"5 urad\"");
            words::above_zero(name, text, dimension, usual, problems)
        };
        let bound_mm = above_zero("--bound", &self.bound, Dimension::Length);
        let bound_rad = above_zero("--bound-angle", &self.bound_angle, Dimension::Angle);
        let limit_mm = above_zero("--limit", &self.limit, Dimension::Length);
        let limit_rad = above_zero("--limit-angle", &self.limit_angle, Dimension::Angle);
        let reference = match &self.at {
            Some(text) => {
                let command = words::command(machine, "--at", text, problems)?;
                warn_beyond_travel(machine, &command, &argument("--at"), problems);
                Some(command)
            }
            None => None,
        };
        Some(Order {
            reference,
            bound_mm: bound_mm?,
            bound_rad: bound_rad?,
            kinematics: !self.no_kinematics,
            limit_mm: limit_mm?,
            limit_rad: limit_rad?,
            ..Order::of(self.target)
        })
    }

    /// The tables of some controls hold errors of axes alone: without the growth of the workpiece they make a warm part
    /// worse (Zhang et al. 2019, section 3.2.1).
    fn can_hold_growth(&self, machine: &Machine, problems: &mut Diagnostics) {
        let is_of_axes_alone = matches!(self.target, Target::Heidenhain | Target::Isg);
        if is_of_axes_alone && machine.growth().is_some() {
            let message = "the tables of this control hold errors of axes alone: the growth of the \
                           workpiece would stay on the part, and compensating the machine alone makes it worse"
                .to_owned();
            let hint = "compensate program, or another --target; --machine-only for the machine without a part";
            problems.error("workpiece-left-out", argument("--target"), message, hint);
        }
    }
}

impl Question for CompensateTables {
    type Input = (Machine, Order, Files, Option<String>);
    type Answer = TablesAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        may_fill(&self.output, problems);
        let machine = self.machine.read(files, problems)?;
        // What is active is named; the tables leave it out, and know where it is held.
        not_twice(&machine, self.machine.place(), problems);
        let order = self.order(&machine, problems);
        let only = self.machine_only;
        let (machine, price) = machine_or_part(machine, &self.machine, files, only, problems)?;
        self.can_hold_growth(&machine, problems);
        Some((machine, order?, files.clone(), price))
    }

    fn answer(
        &self,
        (machine, order, files, price): Self::Input,
        progress: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<TablesAnswer> {
        let compiled = compile(&machine, &order)
            .map_err(|e| refuse(&e, self.machine.place(), problems))
            .ok()?;
        let (mut piece, mut part) = (None, None);
        if let Some(path) = &self.piece {
            if is_part_study(&files, path) {
                let study = drawn(&files, path, &machine, problems)?;
                part = Some(Box::new(cut_part(study, &compiled, progress, problems)?));
            } else {
                let study = test_piece(&files, path, &machine, problems)?;
                piece = Some((path.display().to_string(), cut(&study, path, &compiled, problems)?));
            }
        }
        let output = self.output.clone();
        let written = compiled.files.iter().map(|f| output.join(&f.name).display().to_string());
        let written = written.collect();
        let machine = machine.with_active_compensation();
        Some(TablesAnswer { machine, compiled, piece, part, output, written, price })
    }
}

/// An option is the place of what it allows, the machine file that of the rest.
fn refuse(error: &TablesError, machine: Place, problems: &mut Diagnostics) {
    let (code, place, hint) = match error {
        TablesError::UnknownAxis { .. } => {
            ("unknown-axis", argument("--target"), "choose another target; csv takes every axis")
        }
        TablesError::UnknownTravel(_) => {
            ("unknown-travel", machine, "state travel = [from, to] of the axis")
        }
        TablesError::Position(_) => (
            "outside-table",
            machine,
            "the errors must be known over the whole travel: measure more, or say outside = \"clamp\" or \"extend\"",
        ),
        TablesError::TooLarge { .. } | TablesError::ErrorTooLarge { .. } => (
            "too-large",
            argument("--limit"),
            "is it an error of the machine? then raise --limit or --limit-angle",
        ),
        TablesError::Turns { .. } => (
            "another-turn",
            argument("--target"),
            "choose another target, or state the travel that is used; of an axis with more than a turn this control repeats its table",
        ),
        TablesError::TooManyNodes { .. }
        | TablesError::ErrorNodes { .. }
        | TablesError::GridPoints { .. } => {
            ("too-many-nodes", argument("--bound"), "allow a larger loss: --bound or --bound-angle")
        }
        TablesError::GridValue { .. } => (
            "too-large",
            argument("--target"),
            "choose another form; is it an error of the machine?",
        ),
        TablesError::Increment { .. } | TablesError::ErrorIncrement { .. } => (
            "bound-below-increment",
            argument("--bound"),
            "allow a larger loss: --bound or --bound-angle",
        ),
        TablesError::TooManyTables { .. } => {
            ("too-many-tables", argument("--target"), "choose another target; csv takes any number")
        }
        TablesError::Active { .. } => (
            "active-overwritten",
            machine,
            "a table is loaded whole: take the error out of [compensation] active, so that the file holds it too; \
             then load the file instead of what is in force",
        ),
        TablesError::NotRecovered(_) => (
            "not-recovered",
            argument("--target"),
            "please report this machine file to the developers",
        ),
    };
    problems.error(code, place, error.to_string(), hint);
}

/// The study of a test piece that the tables can be tried on.
fn test_piece(
    files: &Files,
    path: &Path,
    machine: &Machine,
    problems: &mut Diagnostics,
) -> Option<Study> {
    let mut study = problems.keep(read_study(files, path))?;
    study.machine = study.machine.with_active_compensation();
    is_of(&study.machine, machine, path, problems)?;
    if study.temperatures.is_some() {
        let message = "its temperatures follow a log; tables do not".to_owned();
        let place = Place::whole(&path.display().to_string());
        problems.error("running-log", place, message, "name a study without log_start");
        return None;
    }
    Some(study)
}

/// Whether a study is about the machine of the tables.
fn is_of(
    studied: &Machine,
    machine: &Machine,
    path: &Path,
    problems: &mut Diagnostics,
) -> Option<()> {
    if studied.axes() == machine.axes() {
        return Some(());
    }
    let message = "its machine has other axes than that of the tables".to_owned();
    let place = Place::whole(&path.display().to_string());
    problems.error("another-machine", place, message, "name a study of this machine");
    None
}

/// The study of a part that the tables can be tried on; it is cut by one machine.
fn drawn(
    files: &Files,
    path: &Path,
    machine: &Machine,
    problems: &mut Diagnostics,
) -> Option<PartStudy> {
    let mut study = problems.keep(read_part_study(files, path))?;
    is_of(&study.job.machine, machine, path, problems)?;
    study.sampling = None;
    Some(study)
}

/// The part as it is, and cut on the study's machine with the tables.
fn cut_part(
    study: PartStudy,
    compiled: &Compiled,
    progress: Tell<'_>,
    problems: &mut Diagnostics,
) -> Option<PartWithTables> {
    let before = predict_part(&study, progress, problems)?;
    let (control, content) = (compiled.order.target.control(), compiled.content());
    let after = part_left(&study, &before, (control.as_ref(), &content), problems)?;
    Some(PartWithTables { study, before, after })
}

/// The test piece, cut on the study's machine with the tables.
fn cut(
    study: &Study,
    path: &Path,
    compiled: &Compiled,
    problems: &mut Diagnostics,
) -> Option<Vec<IndexLeft>> {
    let control = compiled.order.target.control();
    let content = compiled.content();
    let refuse = |e: Error| {
        let place = Place::whole(&path.display().to_string());
        problems.error(e.code(), place, e.to_string(), "can the study be predicted?");
    };
    piece_left(study, (control.as_ref(), &content)).map_err(refuse).ok()
}

impl TablesAnswer {
    fn shown(&self) -> TablesReport<'_> {
        TablesReport {
            machine: &self.machine,
            compiled: &self.compiled,
            target: self.compiled.order.target.control().key(),
            files: &self.written,
            machine_only: self.price.as_deref(),
            piece: self.piece.as_ref().map(|(study, indices)| (&study[..], &indices[..])),
            part: self.part.as_deref(),
        }
    }
}

impl Answer for TablesAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        document(&report::TablesDocument::of(&self.shown()))
    }

    fn report(&self) -> Report<'_> {
        on_top(report::tables_report(&self.shown()), self.price.as_deref())
    }

    fn files(&mut self) -> Vec<NewFile> {
        let files = self.compiled.files.iter().map(|f| (f.name.clone(), f.text.clone())).collect();
        let (path, content) = (self.output.clone(), Content::Folder(files));
        vec![NewFile { name: "", path, content }]
    }
}
