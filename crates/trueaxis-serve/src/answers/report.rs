//! The pages of the command line, kept for the page to show.

use super::evaluate::{EvaluateRequest, Judged};
use super::identify::identified;
use super::predict::{holes, predicted, study};
use super::settings::control;
use super::simulate_document::SimulateRequest;
use crate::body::needed;
use crate::desk::{Desk, Job};
use crate::refusal::Refusal;
use crate::request::{Reply, Request};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::input::Place;
use trueaxis::plan::{chosen, planned};
use trueaxis::predict::holes::is_hole_study;
use trueaxis::report::{
    self, DrawingError, comparison_report, evaluation_report, holes_report, identification_report,
    plan_report,
};
use trueaxis::verify::compare::{compare, read_comparison};

/// Makes a report.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ReportRequest {
    /// The command whose report it is.
    verb: Verb,
    /// The file that the command takes.
    file: String,
    /// The machine file, for `simulate`.
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
        let page = self.page(desk, &path, job)?;
        let bytes = page.len();
        let (number, _) = desk.reports.put(page);
        Ok(Reply::json(&ReportAnswer { url: format!("/report/{number}"), bytes, name }))
    }
}

impl ReportRequest {
    fn page(self, desk: &Desk, path: &Path, job: &Job) -> Result<String, Refusal> {
        match self.verb {
            Verb::Predict => prediction(path, job),
            Verb::Simulate => {
                let machine = needed(self.machine, "machine")?;
                SimulateRequest::of(machine, self.file).page(desk, job)
            }
            Verb::Plan => plan(self.dialect.as_deref(), path),
            Verb::Identify => {
                let identified = identified(path, |_| Ok(None), job)?;
                identification_report(identified.report()).html().map_err(undrawn)
            }
            Verb::Evaluate => {
                let standard = needed(self.standard, "standard")?;
                let judged = Judged::read(desk, &EvaluateRequest::of(standard, self.file))?;
                judged.with(|e| evaluation_report(e).html()).map_err(undrawn)
            }
            Verb::Verify => comparison(path),
        }
    }
}

pub(super) fn undrawn(error: DrawingError) -> Refusal {
    Refusal::new(422, "no-report", error.to_string(), "the numbers are in the other tabs")
}

fn prediction(path: &Path, job: &Job) -> Result<String, Refusal> {
    if is_hole_study(&disk(), path) {
        let (study, found, _) = holes(path)?;
        return holes_report(&study, &found).html().map_err(undrawn);
    }
    let (study, _) = study(path)?;
    let prediction = predicted(&study, job)?;
    report::prediction_report(&study, &prediction).html().map_err(undrawn)
}

fn plan(dialect: Option<&str>, path: &Path) -> Result<String, Refusal> {
    let control = control(dialect)?;
    let (plan, mut problems) = super::plan::read(path)?;
    let chosen = chosen(&plan, &mut problems);
    if problems.has_errors() {
        return Err(Refusal::unusable(&problems));
    }
    plan_report(&planned(plan, chosen, control)).html().map_err(undrawn)
}

fn comparison(path: &Path) -> Result<String, Refusal> {
    let (task, mut problems) = read_comparison(&disk(), path);
    let Some(task) = task.filter(|_| !problems.has_errors()) else {
        return Err(Refusal::unusable(&problems));
    };
    let verified = compare(&task).map_err(|error| {
        let hint = "do the readings belong to this campaign: columns, units, order of channels?";
        let place = Place::whole(&path.display().to_string());
        problems.error("cannot-compare", place, error.to_string(), hint);
        Refusal::unusable(&problems)
    })?;
    comparison_report(&task, &verified).html().map_err(undrawn)
}
