//! What must be commanded instead: programs, tables of a control, values, a path on a blank.

use super::shown::ShownEntry;
use crate::body::short;
use crate::desk::{Desk, Job};
use crate::frame::Array;
use crate::made::{MadeEntry, versions};
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request, ask};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis::JsonSchema;
use trueaxis::compensate::program::{Proof, Rewritten};
use trueaxis::compensate::tables::Target;
use trueaxis::files;
use trueaxis::input::Diagnostics;
use trueaxis::plan::extension;
use trueaxis::predict::holes::Compensation;
use trueaxis::questions::{
    Adapt, Answer, CompensateProgram, CompensateTables, CompensateValues, MachineChoice, Question,
    ValuesForm,
};
use trueaxis::report::DiagnosticEntry;
use trueaxis::simulate::control_named;

/// Changed lines that go to the page.
const MOST_CHANGES: usize = 300;

/// Rewrites an NC program for the actual machine.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CompensateProgramRequest {
    /// The machine file.
    machine: String,
    /// The NC program.
    program: String,
    /// The set-up file; the one beside the program if it is left out.
    setup: Option<String>,
    /// The control that the program is for, as `--control` of the command line.
    control: Option<String>,
    /// Temperatures as `--temperature` takes them, such as `scale_x=30.5 workpiece=31`.
    temperature: Option<String>,
    /// As `--machine-only`; false if it is left out.
    machine_only: Option<bool>,
    /// As `--flat`; false if it is left out.
    flat: Option<bool>,
    /// As `--position-only`; false if it is left out.
    position_only: Option<bool>,
    /// As `--keep-unproved`; false if it is left out.
    keep_unproved: Option<bool>,
    /// As `--residual`; `1 um` if it is left out.
    residual: Option<String>,
    /// As `--increment`; `1 um` if it is left out.
    increment: Option<String>,
}

/// A program that was rewritten. Array: `along` (f64: for each block, or for each stretch of blocks of a long program,
/// its line, then the largest deviation of the tip before and after, µm, and of the tool axis before and after, µrad).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct CompensateProgramAnswer<'a> {
    /// The document of `trueaxis compensate program`.
    #[schemars(with = "trueaxis::report::ProgramDocument<'a>")]
    document: Value,
    /// Its report.
    shown: ShownEntry,
    /// The first changed lines; null if the program was unrolled, or not written.
    changes: Option<ChangesEntry>,
    /// The compensated program; without a file if it was not proved.
    made: MadeEntry,
    /// The problems of machine, set-up and program.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// Lines that are not what they were.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ChangesEntry {
    /// How many lines have changed.
    changed: usize,
    /// How many lines the program had.
    of: usize,
    /// The first of them.
    lines: Vec<ChangedLine>,
}

/// A line as it was, and what it became.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ChangedLine {
    /// Its number in the program as it was.
    line: u32,
    /// As it was.
    was: String,
    /// What it became.
    is: Vec<String>,
}

fn choice(
    desk: &Desk,
    machine: &str,
    temperature: Option<String>,
) -> Result<MachineChoice, Refusal> {
    let file = desk.project.path(machine)?;
    // An empty field of the page is none.
    let temperature = temperature.filter(|text| !text.trim().is_empty());
    Ok(MachineChoice { file, temperature, ..MachineChoice::default() })
}

/// `part-comp.mpf` for `part.mpf`.
fn compensated(program: &Path) -> PathBuf {
    let stem = program.file_stem().unwrap_or_default().to_string_lossy();
    let ending = program.extension().map(|e| format!(".{}", e.to_string_lossy()));
    program.with_file_name(format!("{stem}-comp{}", ending.unwrap_or_default()))
}

impl CompensateProgramRequest {
    pub(super) fn question(&self, desk: &Desk) -> Result<CompensateProgram, Refusal> {
        let program = desk.project.path(&self.program)?;
        let setup = self.setup.as_ref().map(|name| desk.project.path(name)).transpose()?;
        let micrometre = || "1 um".to_owned();
        Ok(CompensateProgram {
            machine: choice(desk, &self.machine, self.temperature.clone())?,
            output: compensated(&program),
            program,
            setup,
            control: self.control.clone(),
            flat: self.flat.unwrap_or(false),
            position_only: self.position_only.unwrap_or(false),
            residual: self.residual.clone().unwrap_or_else(micrometre),
            residual_axis: None,
            keep_unproved: self.keep_unproved.unwrap_or(false),
            increment: self.increment.clone().unwrap_or_else(micrometre),
            increment_deg: "0.0001 deg".to_owned(),
            no_rounding: false,
            limit: "1 mm".to_owned(),
            limit_axis: "1 mrad".to_owned(),
            machine_only: self.machine_only.unwrap_or(false),
        })
    }
}

impl Request for CompensateProgramRequest {
    type Answer<'a> = CompensateProgramAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let question = self.question(desk)?;
        let from = versions(desk, [&self.machine, &self.program].into_iter().chain(&self.setup));
        let was = files::read_bytes(&question.program).unwrap_or_default();
        let (mut found, problems) = ask(&question, job)?;
        let unrolled = ["unrolled", "radius-compensation-removed"];
        let is_unrolled = question.flat || problems.iter().any(|d| unrolled.contains(&d.code));
        let is_written = found.is_yes() || question.keep_unproved;
        let changes =
            (is_written && !is_unrolled).then(|| ChangesEntry::of(&was, &found.rewritten));
        let along = along(&found.rewritten.proof);
        let answer = CompensateProgramAnswer {
            document: found.document(&problems),
            shown: ShownEntry::of(&found),
            changes,
            // Last: the text goes with it.
            made: desk.keep(found.files(), from),
            diagnostics: entries(&problems),
        };
        Ok(Reply::frame(&answer, vec![("along", Array::F64(along))]))
    }
}

/// What every answer of this room has: its document, its report, its files.
struct Made {
    document: Value,
    shown: ShownEntry,
    made: MadeEntry,
}

/// Puts a question and keeps its files; `from`: the versions of what it reads.
fn made<Q: Question>(
    question: &Q,
    (desk, job): (&Desk, &Job),
    from: Vec<(String, String)>,
) -> Result<(Made, Diagnostics), Refusal> {
    let (mut found, problems) = ask(question, job)?;
    let (document, shown) = (found.document(&problems), ShownEntry::of(&found));
    Ok((Made { document, shown, made: desk.keep(found.files(), from) }, problems))
}

fn along(proof: &Proof) -> Vec<f64> {
    let five = |b: &trueaxis::compensate::program::BlockResidual| {
        let (tip, axis) =
            ([b.tip_before_mm, b.tip_after_mm], [b.axis_before_rad, b.axis_after_rad]);
        let ([before, after], [from, to]) = (tip.map(|v| v * 1e3), axis.map(|v| v * 1e6));
        [f64::from(b.line), before, after, from, to]
    };
    proof.along.iter().flat_map(five).collect()
}

impl ChangesEntry {
    fn of(was: &[u8], rewritten: &Rewritten) -> Self {
        let lines = |text: &[u8]| -> Vec<String> {
            String::from_utf8_lossy(text).lines().map(str::to_owned).collect()
        };
        let (was, is) = (lines(was), lines(&rewritten.text));
        let mut changes = Self { changed: 0, of: was.len(), lines: Vec::new() };
        for (line, was) in (1..).zip(was) {
            let Some(range) = rewritten.lines_of(line) else { break };
            let end = (range.end as usize - 1).min(is.len());
            let became = is.get(range.start as usize - 1..end).unwrap_or_default();
            if became.len() == 1 && became[0] == was {
                continue;
            }
            changes.changed += 1;
            if changes.lines.len() < MOST_CHANGES {
                changes.lines.push(ChangedLine { line, was, is: became.to_vec() });
            }
        }
        changes
    }
}

/// The controls that tables can be made for.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TargetsRequest {}

/// A control that tables can be made for.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct TargetEntry {
    /// Its name in requests, and after `--target` of the command line.
    key: &'static str,
    /// What it is, and which files it reads.
    title: &'static str,
}

/// The controls with their titles.
const TARGETS: [(Target, &str); 6] = [
    (Target::Sinumerik, "SINUMERIK: $AA_ENC_COMP and $AN_CEC"),
    (Target::Fanuc, "FANUC: pitch error compensation and the grid of 3-D error compensation"),
    (Target::Heidenhain, "HEIDENHAIN: .COM tables and KinematicsComp"),
    (Target::LinuxCnc { trims: false }, "LinuxCNC: COMP_FILE"),
    (Target::Isg, "ISG kernel: ISG_CSV and leadscrew lists"),
    (Target::Csv, "plain CSV: every axis on every linear axis"),
];

impl Request for TargetsRequest {
    type Answer<'a> = Vec<TargetEntry>;

    fn answer(self, _: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let entry = |(target, title): (Target, &'static str)| TargetEntry {
            key: target.control().key(),
            title,
        };
        Ok(Reply::json(&TARGETS.map(entry).into()))
    }
}

/// Makes the compensation tables of a control.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CompensateTablesRequest {
    /// The machine file.
    machine: String,
    /// The control, such as `sinumerik`.
    target: String,
    /// As `--at`: the position of the other axes.
    at: Option<String>,
    /// As `--bound`; `1 um` if it is left out.
    bound: Option<String>,
    /// As `--no-kinematics`; false if it is left out.
    no_kinematics: Option<bool>,
    /// Temperatures as `--temperature` takes them.
    temperature: Option<String>,
    /// As `--machine-only`; false if it is left out.
    machine_only: Option<bool>,
    /// The study of a test piece or a part that is cut with the tables.
    piece: Option<String>,
}

/// Tables of a control.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct CompensateTablesAnswer<'a> {
    /// The document of `trueaxis compensate tables`.
    #[schemars(with = "trueaxis::report::TablesDocument<'a>")]
    document: Value,
    /// Its report.
    shown: ShownEntry,
    /// The tables.
    made: MadeEntry,
    /// The problems of the machine.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl CompensateTablesRequest {
    pub(super) fn question(&self, desk: &Desk) -> Result<CompensateTables, Refusal> {
        let known = TARGETS.iter().find(|(target, _)| target.control().key() == self.target);
        let Some((target, _)) = known else {
            let all = TARGETS.map(|(target, _)| target.control().key()).join(", ");
            return Err(Refusal::bad(format!("unknown target `{}`", short(&self.target)), &all));
        };
        let piece = self.piece.as_ref().map(|name| desk.project.path(name)).transpose()?;
        let filled = |text: &Option<String>| text.clone().filter(|text| !text.trim().is_empty());
        Ok(CompensateTables {
            machine: choice(desk, &self.machine, self.temperature.clone())?,
            target: *target,
            output: desk.project.new_folder(&self.machine, &self.target),
            at: filled(&self.at),
            bound: filled(&self.bound).unwrap_or_else(|| "1 um".to_owned()),
            bound_angle: "5 urad".to_owned(),
            limit: "1 mm".to_owned(),
            limit_angle: "1000 urad".to_owned(),
            no_kinematics: self.no_kinematics.unwrap_or(false),
            piece,
            machine_only: self.machine_only.unwrap_or(false),
        })
    }
}

impl Request for CompensateTablesRequest {
    type Answer<'a> = CompensateTablesAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let question = self.question(desk)?;
        let from = versions(desk, [&self.machine].into_iter().chain(&self.piece));
        let (Made { document, shown, made }, problems) = made(&question, (desk, job), from)?;
        let diagnostics = entries(&problems);
        Ok(Reply::json(&CompensateTablesAnswer { document, shown, made, diagnostics }))
    }
}

/// Calculates values per axis and position.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CompensateValuesRequest {
    /// The machine file.
    machine: String,
    /// The axis of a table over the travel.
    axis: String,
    /// As `--at`: the position of the other axes.
    at: Option<String>,
    /// As `--step`: distance of the positions, mm or degrees.
    step: Option<String>,
    /// As `--increment`: the least increment of the control, with its unit.
    increment: Option<String>,
    /// As `--of`: the error of the machine alone, or machine − workpiece; the latter if it is left out.
    of: Option<CompensatedError>,
    /// Temperatures as `--temperature` takes them.
    temperature: Option<String>,
    /// As `--machine-only`; false if it is left out.
    machine_only: Option<bool>,
}

/// Which error is compensated.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum CompensatedError {
    /// That of the machine alone.
    Machine,
    /// Machine − workpiece.
    Comprehensive,
}

/// Values of one axis.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct CompensateValuesAnswer<'a> {
    /// The document of `trueaxis compensate values`.
    #[schemars(with = "trueaxis::report::CompensationDocument<'a>")]
    document: Value,
    /// Its report.
    shown: ShownEntry,
    /// The values as CSV.
    made: MadeEntry,
    /// The problems of the machine.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl Request for CompensateValuesRequest {
    type Answer<'a> = CompensateValuesAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let filled = |text: Option<String>| text.filter(|text| !text.trim().is_empty());
        let machine = choice(desk, &self.machine, self.temperature)?;
        let file = format!("values-{}.csv", short(&self.axis));
        let question = CompensateValues {
            output: Some(machine.file.with_file_name(file)),
            machine,
            axis: Some(self.axis),
            at: filled(self.at),
            step: filled(self.step),
            targets: None,
            increment: filled(self.increment),
            of: match self.of {
                Some(CompensatedError::Machine) => Compensation::Machine,
                _ => Compensation::Comprehensive,
            },
            machine_only: self.machine_only.unwrap_or(false),
            form: ValuesForm::Csv,
        };
        let from = versions(desk, [&self.machine]);
        let (Made { document, shown, made }, problems) = made(&question, (desk, job), from)?;
        let diagnostics = entries(&problems);
        Ok(Reply::json(&CompensateValuesAnswer { document, shown, made, diagnostics }))
    }
}

/// Moves a path onto the blank that was measured.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CompensateAdaptRequest {
    /// The study: path, measured blank, cutter, wall.
    study: String,
    /// The control of the program, as `--control` of the command line; without one only the path is made.
    control: Option<String>,
}

/// A path that was adapted.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct CompensateAdaptAnswer<'a> {
    /// The document of `trueaxis compensate adapt`.
    #[schemars(with = "trueaxis::report::AdaptDocument<'a>")]
    document: Value,
    /// Its report.
    shown: ShownEntry,
    /// The adapted path and its program; none if it must not be cut.
    made: MadeEntry,
    /// The problems of the study.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl CompensateAdaptRequest {
    pub(super) fn question(&self, desk: &Desk) -> Result<Adapt, Refusal> {
        let study = desk.project.path(&self.study)?;
        let stem = study.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        // The library refuses a control that it does not know.
        let ending = |name: &str| control_named(name).map_or("nc", extension);
        let beside = |ending: &str| study.with_file_name(format!("{stem}-adapted.{ending}"));
        Ok(Adapt {
            output: self.control.clone().map(|control| (beside(ending(&control)), control)),
            tcp: true,
            tolerance: "0.001".to_owned(),
            cl: Some(beside("cls")),
            study: study.clone(),
        })
    }
}

impl Request for CompensateAdaptRequest {
    type Answer<'a> = CompensateAdaptAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let question = self.question(desk)?;
        let from = versions(desk, [&self.study]);
        let (Made { document, shown, made }, problems) = made(&question, (desk, job), from)?;
        let diagnostics = entries(&problems);
        Ok(Reply::json(&CompensateAdaptAnswer { document, shown, made, diagnostics }))
    }
}
