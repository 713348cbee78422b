//! What do the readings show by a standard?

use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::report;
use crate::verify::write_back::write_back;
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_condition::ball_bar::{BallBar, MachineErrors};
use trueaxis_condition::report::{EvaluatedDocument, MachineErrorsEntry, machine_errors_sections};
use trueaxis_input::foreign::{self, Mapping, read_mapping};
use trueaxis_input::{Diagnostics, Dimension, Files, Place, parse_quantity};
use trueaxis_machine::Machine;
use trueaxis_machine::describe::axis_index;
use trueaxis_machine::file::Folder;
use trueaxis_report::Report;
use trueaxis_standards::conditions::{Conditions, read_conditions};
use trueaxis_standards::import::Import;
use trueaxis_standards::judge::{
    Decision, Judged, ToleranceFile, figures, judge, overall, tolerances,
};
use trueaxis_standards::report::Evaluation;
use trueaxis_standards::{Evaluated, Readings, Standard, evaluate_text, iso230_3};

/// Readings by ISO 230 and its relatives.
#[derive(Debug, Clone)]
pub struct Evaluate {
    /// By which standard.
    pub standard: Standard,
    /// The readings.
    pub data: ReadingsFile,
    /// The form of the readings; by the ending of the name if none is named.
    pub import: Option<Import>,
    /// Which feature of a QIF file: its name or its id.
    pub feature: Option<String>,
    /// The mapping file: which column is what; `NAME.map.toml` beside `NAME.csv` if none is named.
    pub map: Option<PathBuf>,
    /// Instrument, temperature, nominal circle; the TOML file beside the data if none is named.
    pub conditions: Option<PathBuf>,
    /// Radius of the nominal circle instead of that of the conditions, as typed, with its unit.
    pub radius: Option<String>,
    /// Length of the windows of ISO 230-3, as typed, with its unit.
    pub window: Option<String>,
    /// The machine file and the axis beside which the error motion goes as a table.
    pub write_back: Option<(PathBuf, String)>,
    /// The machine file whose errors a circle states.
    pub machine: Option<PathBuf>,
    /// Where the machine file with these errors goes.
    pub output: Option<PathBuf>,
    /// Tolerances as typed: `A=10 um`.
    pub tolerances: Vec<String>,
    /// A file of tolerances.
    pub tolerance_file: Option<PathBuf>,
    /// Whether a value alone decides, without U.
    pub is_simple: bool,
}

/// Where readings come from.
#[derive(Debug, Clone)]
pub enum ReadingsFile {
    /// A file.
    Path(PathBuf),
    /// A text with its name.
    Text(String, String),
}

impl ReadingsFile {
    /// The name and the text; `kind` is what the file is expected to be.
    pub(super) fn text(
        &self,
        files: &Files,
        kind: &str,
        problems: &mut Diagnostics,
    ) -> (String, Option<String>) {
        match self {
            Self::Path(path) => (path.display().to_string(), files.text(path, kind, problems)),
            Self::Text(name, text) => (name.clone(), Some(text.clone())),
        }
    }
}

/// What is known for an evaluation.
#[derive(Debug)]
pub struct EvaluateInput {
    name: String,
    text: String,
    mapping: Option<Mapping>,
    conditions: Conditions,
    conditions_file: Option<PathBuf>,
    window_s: f64,
    machine: Option<(PathBuf, Machine, usize)>,
    /// The machine of a circle with its text.
    circle_on: Option<(PathBuf, Machine, String)>,
    files: Files,
}

/// Readings with their result.
#[derive(Debug)]
pub struct EvaluateAnswer {
    /// By which standard.
    pub standard: Standard,
    /// The readings' file or name.
    pub name: String,
    /// The conditions of the readings.
    pub conditions: Conditions,
    /// The file of the conditions, if there is one.
    pub conditions_file: Option<PathBuf>,
    /// The result.
    pub evaluated: Evaluated,
    /// Warnings and notes, each as one text.
    pub remarks: Vec<String>,
    /// Figures against their tolerances.
    pub judged: Vec<Judged>,
    table: Option<Table>,
    machine_errors: Option<MachineErrors>,
    machine_files: Vec<NewFile>,
}

impl EvaluateAnswer {
    /// What a report shows.
    pub fn shown(&self) -> Evaluation<'_> {
        Evaluation {
            standard: self.standard,
            file: &self.name,
            conditions: &self.conditions,
            evaluated: &self.evaluated,
            remarks: &self.remarks,
            judged: &self.judged,
        }
    }

    /// The two axes of a circle.
    fn circle_axes(&self) -> Option<(&MachineErrors, &[String; 2])> {
        match (&self.machine_errors, &self.evaluated) {
            (Some(found), Evaluated::Circular(circle)) => Some((found, &circle.axes)),
            _ => None,
        }
    }
}

/// An error motion as a table next to the machine file.
#[derive(Debug)]
struct Table {
    file: Option<NewFile>,
    /// The lines for the machine file.
    lines: String,
}

impl Evaluate {
    fn path(&self) -> &Path {
        match &self.data {
            ReadingsFile::Path(path) => path,
            ReadingsFile::Text(name, _) => Path::new(name),
        }
    }

    /// The conditions that are named, or those beside the data.
    fn conditions_file(&self, files: &Files) -> Option<PathBuf> {
        let beside = self.path().with_extension("toml");
        let is_there = matches!(self.data, ReadingsFile::Path(_)) && files.is_file(&beside);
        self.conditions.clone().or(is_there.then_some(beside))
    }

    /// Beside an uploaded text there are no files.
    fn mapping(&self, files: &Files, problems: &mut Diagnostics) -> Option<Mapping> {
        let is_file = matches!(self.data, ReadingsFile::Path(_));
        let path = if is_file { self.path() } else { Path::new("") };
        read_mapping(files, self.map.as_deref(), path, problems)
    }

    /// The axis that the table is for.
    fn machine(
        &self,
        problems: &mut Diagnostics,
        files: &Files,
    ) -> Option<(PathBuf, Machine, usize)> {
        let (path, letter) = self.write_back.as_ref()?;
        let machine = problems.keep(Machine::read(files, path))?;
        let Some(axis) = axis_index(&machine, letter) else {
            let message = format!("the machine has no axis `{letter}`");
            let hint = format!("its chain: {}", machine.chain_text());
            problems.error("unknown-axis", Place::whole("--write-back"), message, &hint);
            return None;
        };
        Some((path.clone(), machine, axis))
    }

    fn table(
        &self,
        input: &EvaluateInput,
        conditions: &Conditions,
        evaluated: &Evaluated,
        problems: &mut Diagnostics,
    ) -> Option<Table> {
        let (machine_path, machine, axis) = input.machine.as_ref()?;
        let Evaluated::Positioning(_, result) = evaluated else {
            let message = "only a positioning test makes a table".to_owned();
            problems.error("no-table", Place::whole("--write-back"), message, "use iso230-2");
            return None;
        };
        let axis = &machine.axes()[*axis];
        other_axis(machine, &axis.name.to_string(), conditions, problems)?;
        let back = write_back(axis, result, conditions, &input.name, problems)?;
        let stem = self.path().file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = format!("{stem}-{}.csv", back.error);
        let path = machine_path.with_file_name(&name);
        let sign = match back.negated {
            true => "sign changed: this body moves against its command (ISO 841)\n",
            false => "",
        };
        let section = back.section(axis, &name, conditions);
        let lines = format!(
            "{sign}for the machine file, in place of what it says of {}:\n{section}",
            back.error
        );
        let file = NewFile::of("table", path, back.table);
        Some(Table { file: Some(file), lines })
    }
}

impl Evaluate {
    /// The machine of a circle, with the text of its file.
    fn circle_on(
        &self,
        files: &Files,
        problems: &mut Diagnostics,
    ) -> Option<(PathBuf, Machine, String)> {
        if self.output.is_some() && self.machine.is_none() {
            let message = "there is no machine file to write errors into".to_owned();
            problems.error(
                "missing-machine",
                Place::whole("-o"),
                message,
                "--machine MACHINE.toml",
            );
        }
        let path = self.machine.as_ref()?;
        if self.standard != Standard::Iso230_4 {
            let message = "only a circle states errors of a machine file".to_owned();
            let hint = "iso230-4; a positioning test: --write-back MACHINE.toml AXIS";
            problems.error("unused-argument", Place::whole("--machine"), message, hint);
            return None;
        }
        let machine = problems.keep(Machine::read(files, path))?;
        let text = files.text(path, "a machine file (TOML)", problems)?;
        Some((path.clone(), machine, text))
    }

    /// The errors of the machine file that a circle states, and the files with them.
    fn machine_errors(
        &self,
        input: &EvaluateInput,
        (conditions, conditions_file): (&Conditions, &Path),
        evaluated: &Evaluated,
        problems: &mut Diagnostics,
    ) -> Option<(MachineErrors, Vec<NewFile>)> {
        let (path, machine, text) = input.circle_on.as_ref()?;
        let Evaluated::Circular(circle) = evaluated else { return None };
        let place = Place::whole(&conditions_file.display().to_string());
        let bar = BallBar::on(machine, circle, conditions, &place, problems)?;
        let output = self.output.as_ref().unwrap_or(path);
        let date = conditions.date.as_ref().map(|d| format!(", {d}")).unwrap_or_default();
        let origin = format!("ball-bar {}{date}", input.name).replace(['\n', '\r'], " ");
        let beside = Folder::of(&input.files, output);
        let found = bar.machine_errors(machine, (text, &beside), &origin);
        let refuse = |reason: String| {
            let message = format!("the errors cannot be written: {reason}");
            let hint = "put the new file beside the machine file if that names tables";
            problems.error(
                "unwritable-file",
                Place::whole(&output.display().to_string()),
                message,
                hint,
            );
        };
        let found = found.map_err(refuse).ok()?;
        let mut new = Vec::new();
        if let Some(output) = &self.output {
            let table = |(name, text): &(String, String)| {
                NewFile::of("table", output.with_file_name(name), text.clone())
            };
            new.extend(found.tables.iter().map(table));
            new.push(NewFile::of("machine file", output, found.text.clone()));
        }
        Some((found, new))
    }
}

impl Question for Evaluate {
    type Input = EvaluateInput;
    type Answer = EvaluateAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<EvaluateInput> {
        let conditions_file = self.conditions_file(files);
        let mut conditions = read_conditions(files, conditions_file.as_deref(), problems);
        if let Some(text) = &self.radius {
            conditions.circle.radius_mm = positive("--radius", text, Dimension::Length, problems);
        }
        let window_s = match &self.window {
            Some(text) => positive("--window", text, Dimension::Time, problems),
            None => Some(iso230_3::HOUR_S),
        };
        let mapping = self.mapping(files, problems);
        let (name, text) = match &self.data {
            ReadingsFile::Path(path) => {
                let what = "a table of readings (CSV)";
                let text = foreign::text(files, path, what, mapping.as_ref(), problems);
                (path.display().to_string(), text)
            }
            ReadingsFile::Text(name, text) => (name.clone(), Some(text.clone())),
        };
        let machine = self.machine(problems, files);
        let (circle_on, files) = (self.circle_on(files, problems), files.clone());
        let (text, window_s) = (text?, window_s.unwrap_or(iso230_3::HOUR_S));
        Some(EvaluateInput {
            name,
            text,
            mapping,
            conditions,
            conditions_file,
            window_s,
            machine,
            circle_on,
            files,
        })
    }

    fn answer(
        &self,
        mut input: EvaluateInput,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<EvaluateAnswer> {
        let usual = || self.path().with_extension("toml");
        let conditions_file = input.conditions_file.clone().unwrap_or_else(usual);
        let readings = Readings {
            standard: self.standard,
            file: &input.name,
            text: &input.text,
            import: self.import.unwrap_or_else(|| Import::of(self.path())),
            feature: self.feature.as_deref(),
            mapping: input.mapping.as_ref(),
            conditions: &input.conditions,
            conditions_file: &conditions_file.display().to_string(),
            window_s: input.window_s,
        };
        let (evaluated, conditions) = evaluate_text(&readings, problems);
        let evaluated = evaluated?;
        let table = self.table(&input, &conditions, &evaluated, problems);
        let stated = (&conditions, &*conditions_file);
        let found = self.machine_errors(&input, stated, &evaluated, problems);
        let (machine_errors, machine_files) =
            found.map_or((None, Vec::new()), |(f, n)| (Some(f), n));
        let (file, axis) = (self.tolerance_file.as_deref(), conditions.axis.as_deref());
        let figures = figures(&evaluated, &conditions);
        let of = ToleranceFile { path: file, files: &input.files, axis, figures: &figures };
        let tolerances = tolerances(&self.tolerances, &of, problems);
        let judged = judge(&figures, &tolerances, !self.is_simple, problems);
        let remarks = report::remarks(problems);
        let (name, conditions_file) = (std::mem::take(&mut input.name), input.conditions_file);
        let standard = self.standard;
        Some(EvaluateAnswer {
            standard,
            name,
            conditions,
            conditions_file,
            evaluated,
            remarks,
            judged,
            table,
            machine_errors,
            machine_files,
        })
    }
}

/// Readings of one axis are not written to another.
fn other_axis(
    machine: &Machine,
    wanted: &str,
    conditions: &Conditions,
    problems: &mut Diagnostics,
) -> Option<()> {
    // `X`, `x-axis`, `X, upper slide`: the letter is one of the words.
    let stated = conditions.axis.as_deref().unwrap_or("");
    let words = || stated.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty());
    let is_wanted = words().any(|w| w.eq_ignore_ascii_case(wanted));
    let other = words().find(|w| axis_index(machine, &w.to_uppercase()).is_some());
    let Some(other) = other.filter(|_| !is_wanted) else { return Some(()) };
    let message = format!("the readings are of axis {other} by their conditions, not of {wanted}");
    let hint =
        format!("--write-back MACHINE.toml {other}; or correct `axis` in the conditions file");
    problems.error("wrong-axis", Place::whole("--write-back"), message, &hint);
    None
}

/// A positive quantity of an argument.
pub(super) fn positive(
    name: &str,
    text: &str,
    dimension: Dimension,
    problems: &mut Diagnostics,
) -> Option<f64> {
    let (code, message, hint) = match parse_quantity(text, dimension) {
        Ok(value) if value > 0.0 => return Some(value),
        Ok(_) => ("not-positive", format!("`{text}` is not positive"), String::new()),
        Err(e) => (e.code(), e.to_string(), e.hint()),
    };
    problems.error(code, Place::whole(name), message, &hint);
    None
}

impl Answer for EvaluateAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        let document = EvaluatedDocument {
            document: report::EvaluationDocument::of(&self.shown()),
            machine_errors: self.circle_axes().map(|(f, axes)| MachineErrorsEntry::of(f, axes)),
        };
        with_diagnostics(&document, problems)
    }

    fn report(&self) -> Report<'_> {
        let report = report::evaluation_report(&self.shown());
        let sections = self.circle_axes().map(|(f, axes)| machine_errors_sections(f, axes));
        report.sections(sections.into_iter().flatten())
    }

    fn is_yes(&self) -> bool {
        let tolerances =
            overall(&self.judged).is_none_or(|decision| decision == Decision::Conforming);
        tolerances && self.evaluated.is_yes()
    }

    fn files(&mut self) -> Vec<NewFile> {
        let table = self.table.iter_mut().filter_map(|table| table.file.take());
        table.chain(std::mem::take(&mut self.machine_files)).collect()
    }

    fn notes(&self) -> Vec<String> {
        self.table.iter().map(|table| table.lines.clone()).collect()
    }
}
