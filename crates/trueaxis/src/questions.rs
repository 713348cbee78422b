//! One question and one answer for each verb: what is read, with which options, how it is computed, and what
//! is advised where that fails. The command line and the page are two doors to the same questions.
//!
//! ```no_run
//! use trueaxis::files::disk;
//! use trueaxis::input::Diagnostics;
//! use trueaxis::questions::{Answer, Predict, ask};
//! use trueaxis::report::English;
//! let question = Predict { study: "nas979-on-xkas2525.toml".into(), ..Predict::default() };
//! let mut problems = Diagnostics::new();
//! let answer = ask(&question, &disk(), &|_| {}, &mut problems).unwrap();
//! println!("{}", answer.text(&English));
//! ```

mod adapt;
mod before_after;
mod error_tables;
mod evaluate;
mod expansion;
mod form;
mod history;
mod hits;
mod identify;
mod job;
mod machine;
mod machine_folder;
mod measure;
mod part;
mod part_file;
mod plan;
mod pose;
mod post;
mod predict;
mod probe;
mod probe_programs;
mod program;
mod rtcp;
mod rtcp_programs;
mod simulate;
mod solve;
mod surface;
mod tables;
mod thermal;
mod tool_setting;
mod trace;
mod values;
mod verify;
mod words;
mod workpiece;

pub use adapt::{Adapt, AdaptAnswer};
pub use before_after::{BeforeAfterAnswer, LaserBeforeAfter};
pub use error_tables::{IdentifyTables, TablesFoundAnswer};
pub use evaluate::{Evaluate, EvaluateAnswer, EvaluateInput, ReadingsFile};
pub use expansion::{ExpansionAnswer, ExpansionInput, IdentifyExpansion};
pub use form::{EvaluateForm, FormAnswer, FormInput};
pub use history::{HistoryAnswer, VerifyHistory};
pub use hits::{HitsAnswer, IdentifySurface};
pub use identify::{DroppedTable, Identified, Identify};
pub use job::ProgramChoice;
pub use machine::{MachineChoice, tool_length};
pub use measure::{Measure, MeasureAnswer};
pub use part::{MeasurePart, PartAnswer, VerifyPart, VirtualPartAnswer, VirtualPartDocument};
pub use part_file::{AskPart, PartFileAnswer};
pub use plan::{PlanAnswer, PlanMeasurement};
pub use pose::{AskPose, PoseAnswer, PoseFound, PoseInput, Positions};
pub use post::{Post, PostAnswer, template};
pub use predict::{Predict, PredictInput, Predicted};
pub use probe::{IdentifyProbe, ProbeAnswer};
pub use probe_programs::{ProbePrograms, ProbeProgramsAnswer, ProbeProgramsDocument};
pub use program::{CompensateProgram, ProgramAnswer};
pub use rtcp::{IdentifyRtcp, RtcpAnswer};
pub use rtcp_programs::{RtcpPrograms, RtcpProgramsAnswer, RtcpProgramsDocument};
pub use simulate::{Simulate, Simulated};
pub use solve::{Solve, SolveAnswer, SolveInput, SolveTarget};
pub use surface::{PlanSurface, SurfaceAnswer};
pub use tables::{CompensateTables, TablesAnswer};
pub use thermal::{IdentifyThermal, ThermalAnswer};
pub use tool_setting::{
    IdentifyTools, PlanToolSetting, ToolChoice, ToolSettingAnswer, ToolsAnswer,
};
pub use trace::{TraceAnswer, TraceBlock};
pub use trueaxis_motion::PoseTable;
pub use values::{CompensateValues, ValuesAnswer, ValuesForm};
pub use verify::{
    CalibrationsAnswer, CertificateAnswer, Certify, CompareCalibrations, VerifyAnswer,
    VerifyReadings,
};

use crate::files::output::{Guard, Output, no_file_twice};
use crate::files::{self, Part};
use serde::Serialize;
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_motion::{CONTROLS, control_named};
use trueaxis_nc::Control;
use trueaxis_report::{Language, Report, document, not_finite};

/// Receives the part that is done, 0 to 1.
pub type Tell<'a> = &'a (dyn Fn(f64) + Sync + 'a);

/// What a verb is asked.
pub trait Question {
    /// What stands in the files.
    type Input;
    /// What comes back.
    type Answer: Answer;
    /// What the progress counts, in words; empty where there is nothing to wait for.
    const PROGRESS: &'static str = "";

    /// Reads the files; what is wrong with them goes to `problems`.
    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input>;

    /// Files that the answer will write: checked before the work, not after it.
    fn outputs(&self, _input: Option<&Self::Input>) -> Vec<Output> {
        Vec::new()
    }

    /// Computes; `progress` receives the part that is done, 0 to 1.
    fn answer(
        &self,
        input: Self::Input,
        progress: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<Self::Answer>;
}

/// What a verb answers.
pub trait Answer {
    /// As one JSON document.
    fn document(&self, problems: &Diagnostics) -> Value;

    /// For readers.
    fn report(&self) -> Report<'_>;

    /// For the terminal, in a language.
    fn text(&self, language: &dyn Language) -> String {
        self.report().in_language(language).text()
    }

    /// Writes it for the terminal; long tables block after block.
    ///
    /// # Errors
    /// What the writer says.
    fn write_text(&self, language: &dyn Language, out: &mut dyn io::Write) -> io::Result<()> {
        out.write_all(self.text(language).as_bytes())
    }

    /// Writes it as one JSON document, with what was found in the input.
    ///
    /// # Errors
    /// What the writer says.
    fn write_json(&self, problems: &Diagnostics, out: &mut dyn io::Write) -> io::Result<()> {
        write_document(self.document(problems), problems, out)
    }

    /// What is looked through for figures that cannot be: the document, or of a long table the rows that have them.
    fn examined(&self, problems: &Diagnostics) -> Value {
        self.document(problems)
    }

    /// Whether the verdict is "yes", where there is one.
    fn is_yes(&self) -> bool {
        true
    }

    /// How the work ended where it goes on in spite of errors; without that there is no answer then.
    fn in_spite_of_errors(&self) -> Option<&'static str> {
        None
    }

    /// Files that were asked for beside the report; they are handed out once.
    fn files(&mut self) -> Vec<NewFile> {
        Vec::new()
    }

    /// What to do with these files.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }
}

/// A file that an answer brings.
#[derive(Debug)]
pub struct NewFile {
    /// What it is, in one word; empty where the answer itself names it.
    pub name: &'static str,
    /// Where it goes.
    pub path: PathBuf,
    /// What stands in it.
    pub content: Content,
}

/// What stands in a file.
#[derive(Debug)]
pub enum Content {
    /// These bytes.
    Bytes(trueaxis_input::Content),
    /// What was written beside its place during the work.
    Part(Part),
    /// It is a folder, new or empty: its files by name, all or none.
    Folder(Vec<(String, String)>),
}

impl NewFile {
    fn of(name: &'static str, path: impl Into<PathBuf>, content: impl Into<Vec<u8>>) -> Self {
        Self { name, path: path.into(), content: Content::Bytes(content.into().into()) }
    }

    /// Puts it in its place.
    ///
    /// # Errors
    /// What the disk says.
    pub fn write(self) -> io::Result<()> {
        match self.content {
            Content::Bytes(bytes) => files::write_in_folder(&self.path, &bytes),
            Content::Part(part) => part.put_and_note(),
            Content::Folder(written) => files::write_folder(&self.path, &written),
        }
    }
}

/// Whether the files that a question names, and its report, may be written: what keeps them out goes to `problems`.
pub fn may_write<Q: Question>(
    question: &Q,
    input: Option<&Q::Input>,
    report: Option<&Path>,
    guard: &Guard,
    problems: &mut Diagnostics,
) {
    let report = report.map(|path| Output::file("--report", path));
    let outputs: Vec<Output> = question.outputs(input).into_iter().chain(report).collect();
    outputs.iter().for_each(|output| guard.may_write(output, problems));
    let paths: Vec<&Path> = outputs.iter().map(|output| output.path.as_path()).collect();
    no_file_twice(&paths, problems);
}

/// Whether files may be put in their places, all of them: what keeps them out goes to `problems`.
pub fn may_put(new: &[NewFile], guard: &Guard, problems: &mut Diagnostics) {
    for file in new {
        match &file.content {
            Content::Bytes(bytes) => guard.may_put(&file.path, Some(bytes), problems),
            Content::Part(_) => guard.may_put(&file.path, None, problems),
            Content::Folder(_) => {}
        }
        let inside =
            |other: &NewFile| other.path != file.path && other.path.starts_with(&file.path);
        if !matches!(file.content, Content::Folder(_)) && new.iter().any(inside) {
            let place = Place::whole(&file.path.display().to_string());
            let message = "is named as a file and as the folder of others".to_owned();
            problems.error("one-file-twice", place, message, "name a folder of its own");
        }
    }
}

/// Reads and computes; none if there was an error, which then stands in `problems`.
pub fn ask<Q: Question>(
    question: &Q,
    files: &Files,
    progress: Tell<'_>,
    problems: &mut Diagnostics,
) -> Option<Q::Answer> {
    let input = question.read(files, problems).filter(|_| !problems.has_errors())?;
    let answer = question.answer(input, progress, problems)?;
    let usable = !problems.has_errors() || answer.in_spite_of_errors().is_some();
    (usable && is_finite(&answer, problems)).then_some(answer)
}

/// Whether every number of an answer is one: JSON has no other, and no user can act on it.
pub fn is_finite(answer: &impl Answer, problems: &mut Diagnostics) -> bool {
    let document = answer.examined(problems);
    warn_of_absurd(&document, problems);
    let Some(entry) = not_finite(&document) else { return true };
    let message = format!("`{entry}` of the answer is not a finite number");
    let hint = "a value of the input is probably far too large or too small: check its units and exponents";
    problems.error("not-finite-result", Place::whole(entry), message, hint);
    false
}

/// The largest figures of an answer that anybody would believe: a metre or a radian of an error.
const BELIEVED: [(&str, f64); 3] = [("_um", 1e6), ("_urad", 1e6), ("_um_per_m_k", 1e4)];

/// Warnings that name where such a figure comes from.
const SAID: [&str; 2] = ["implausible-value", "deviation-outside-travel"];

/// An error of metres comes from a wrong unit or a slip of the point. Where no input was named for it, the answer says it.
fn warn_of_absurd(document: &Value, problems: &mut Diagnostics) {
    let said = problems.iter().any(|d| SAID.contains(&d.code));
    let Some((place, value)) = absurd(document, "", "").filter(|_| !said) else { return };
    let message =
        format!("`{place}` of the answer is {value:e}: no error of a machine or part is as large");
    let hint = "look for a wrong unit, a lost decimal point or a wrong row in the input";
    problems.warn("absurd-result", Place::whole(&place), message, hint);
}

/// Whether a figure under this key is above what is believed.
fn is_absurd(key: &str, number: f64) -> bool {
    let limits = BELIEVED.iter().filter(|(ending, _)| key.ends_with(ending));
    // An uncertainty is an error too, also in mm.
    let of_u = (key.starts_with("u_") && key.ends_with("_mm")).then_some(1e3);
    limits.map(|(_, most)| *most).chain(of_u).any(|most| number.abs() > most)
}

/// The first figure above what is believed, with its place.
fn absurd(value: &Value, key: &str, place: &str) -> Option<(String, f64)> {
    let inside = |key: &str, step: &str| match place {
        "" => (key.to_owned(), step.to_owned()),
        _ => (key.to_owned(), format!("{place}.{step}")),
    };
    match value {
        Value::Number(number) => {
            let number = number.as_f64()?;
            is_absurd(key, number).then(|| (place.to_owned(), number))
        }
        Value::Array(list) => list.iter().enumerate().find_map(|(i, entry)| {
            let (key, place) = inside(key, &i.to_string());
            absurd(entry, &key, &place)
        }),
        Value::Object(entries) => entries.iter().find_map(|(name, entry)| {
            let (key, place) = inside(name, name);
            absurd(entry, &key, &place)
        }),
        _ => None,
    }
}

/// A document with what was found in the files, in the order in which it was found.
fn with_diagnostics(found: &impl Serialize, problems: &Diagnostics) -> Value {
    complete(document(found), problems)
}

/// A document with what was found in the input, which every document has.
pub fn complete(mut document: Value, problems: &Diagnostics) -> Value {
    if let Value::Object(entries) = &mut document {
        let listed = || problems.iter().map(crate::report::diagnostic_json).collect();
        entries.entry("diagnostics").or_insert_with(listed);
    }
    document
}

/// Writes a document with what was found in the input.
fn write_document(
    document: Value,
    problems: &Diagnostics,
    out: &mut dyn io::Write,
) -> io::Result<()> {
    writeln!(out, "{:#}", complete(document, problems))
}

/// Files of a folder that was asked for; none if there is no folder.
fn in_folder(
    folder: Option<&Path>,
    files: impl IntoIterator<Item = (String, Vec<u8>)>,
) -> Vec<NewFile> {
    let Some(folder) = folder else { return Vec::new() };
    let file = |(name, content)| NewFile::of("written", folder.join(name), content);
    files.into_iter().map(file).collect()
}

/// The control by its name, as every verb takes it.
pub fn named_control(name: &str, problems: &mut Diagnostics) -> Option<Control> {
    let control = control_named(name);
    if control.is_none() {
        let message = format!("unknown control `{name}`");
        problems.error("unknown-control", Place::whole("--control"), message, CONTROLS);
    }
    control
}
