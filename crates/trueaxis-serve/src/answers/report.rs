//! The pages of the command line, kept for the page to show.

use super::evaluate::EvaluateRequest;
use super::plan::SINUMERIK;
use super::simulate_document::SimulateRequest;
use crate::body::needed;
use crate::desk::{Desk, Job};
use crate::refusal::Refusal;
use crate::request::{Reply, Request, ask};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueaxis::questions::{
    Answer, Certify, CompareCalibrations, Identify, LaserBeforeAfter, PlanMeasurement, Predict,
    Question, Simulate, VerifyHistory, VerifyPart, VerifyReadings,
};
use trueaxis::report::DrawingError;

/// Makes a report.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ReportRequest {
    /// The command whose report it is.
    verb: Verb,
    /// The file that the command takes; a folder, for `history`.
    file: String,
    /// The machine file, for `simulate`; the older one, for `diff`.
    machine: Option<String>,
    /// The standard, for `evaluate`.
    standard: Option<String>,
    /// The control of the programs, for `plan`.
    dialect: Option<String>,
}

/// A command that has a report.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum Verb {
    /// A test piece or holes.
    Predict,
    /// An NC program.
    Simulate,
    /// A plan of measurements.
    Plan,
    /// The errors of a machine.
    Identify,
    /// Readings by a standard.
    Evaluate,
    /// Prediction and measurement compared.
    Verify,
    /// Two calibrations compared.
    Diff,
    /// The figures of one machine over its calibrations.
    History,
    /// A compensation certified.
    Certificate,
    /// A laser before and after a compensation.
    Laser,
    /// A measured test piece.
    Part,
}

impl Verb {
    fn name(self) -> &'static str {
        match self {
            Self::Predict => "predict",
            Self::Simulate => "simulate",
            Self::Plan => "plan",
            Self::Identify => "identify",
            Self::Evaluate => "evaluate",
            Self::Verify => "verify",
            Self::Diff => "diff",
            Self::History => "history",
            Self::Certificate => "certificate",
            Self::Laser => "laser",
            Self::Part => "part",
        }
    }
}

/// A report that was made.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ReportAnswer {
    /// Its address on the server; only the last few reports are kept.
    url: String,
    /// Its size in bytes.
    bytes: usize,
    /// A name for the file.
    name: String,
}

impl Request for ReportRequest {
    type Answer<'a> = ReportAnswer;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let path = desk.project.path(&self.file)?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let name = format!("{stem}-{}.html", self.verb.name());
        let page = self.page(desk, path, job)?;
        let bytes = page.len();
        let (number, _) = desk.reports.put(page);
        Ok(Reply::json(&ReportAnswer { url: format!("/report/{number}"), bytes, name }))
    }
}

impl ReportRequest {
    fn page(self, desk: &Desk, file: PathBuf, job: &Job) -> Result<String, Refusal> {
        match self.verb {
            Verb::Predict => page(&Predict { study: file, ..Predict::default() }, job),
            Verb::Simulate => {
                let machine = needed(self.machine, "machine")?;
                let question = SimulateRequest::of(machine, self.file).question(desk, job)?;
                page(&Simulate { pictures: true, ..question }, job)
            }
            Verb::Plan => {
                let control = self.dialect.unwrap_or_else(|| SINUMERIK.to_owned());
                page(&PlanMeasurement { campaign: file, control, output: None }, job)
            }
            Verb::Identify => page(&Identify { campaign: file, ..Identify::default() }, job),
            Verb::Evaluate => {
                let standard = needed(self.standard, "standard")?;
                page(&EvaluateRequest::of(standard, self.file).question(desk)?, job)
            }
            Verb::Verify => page(&VerifyReadings { file }, job),
            Verb::Diff => {
                let old = desk.project.path(&needed(self.machine, "machine")?)?;
                page(&CompareCalibrations { old, new: file }, job)
            }
            Verb::History => {
                let files = desk.project.in_folder(&self.file, &["toml", "json"])?;
                page(&VerifyHistory { files, limits: Vec::new() }, job)
            }
            Verb::Certificate => page(&Certify { study: file }, job),
            Verb::Laser => page(&LaserBeforeAfter { campaign: file, output: None }, job),
            Verb::Part => page(&VerifyPart { file }, job),
        }
    }
}

fn page<Q: Question>(question: &Q, job: &Job) -> Result<String, Refusal> {
    ask(question, job)?.0.page().map_err(undrawn)
}

fn undrawn(error: DrawingError) -> Refusal {
    Refusal::new(422, "no-report", error.to_string(), "the numbers are in the other tabs")
}
