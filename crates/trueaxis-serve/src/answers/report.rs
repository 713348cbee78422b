//! The pages of the command line, kept for the page to show.

use super::compensate::{
    CompensateAdaptRequest, CompensateProgramRequest, CompensateTablesRequest,
};
use super::evaluate::EvaluateRequest;
use super::plan::SINUMERIK;
use super::shown::unwritten;
use super::simulate_document::SimulateRequest;
use crate::body::needed;
use crate::desk::{Desk, Job, KeptReport};
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request, ask};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::path::PathBuf;
use trueaxis::JsonSchema;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::questions::{
    Answer, Certify, CompareCalibrations, Identify, IdentifyRtcp, LaserBeforeAfter,
    PlanMeasurement, Predict, Question, Simulate, VerifyHistory, VerifyPart, VerifyReadings,
};
use trueaxis::report::{DiagnosticEntry, Report};
use trueaxis_paper::{Form, Heading, PrintError, missing_glyphs, print, read_heading, today};
use trueaxis_words::ReportLanguage;

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
    /// Tolerances such as `A=10 um`, for `evaluate`.
    tolerances: Option<Vec<String>>,
    /// Whether a value alone decides, without its uncertainty, for `evaluate`.
    is_simple: Option<bool>,
    /// The file of the conditions, for `evaluate`.
    conditions: Option<String>,
    /// The radius of a circular test, for `evaluate`.
    radius: Option<String>,
    /// The window of a drift test, for `evaluate`.
    window: Option<String>,
    /// The feature of a QIF file, for `evaluate`.
    feature: Option<String>,
    /// The control of the programs, for `plan`.
    dialect: Option<String>,
    /// What else is asked, by the names of the requests `compensate-program`, `compensate-tables` and `compensate-adapt`.
    options: Option<Map<String, Value>>,
    /// The file of its heading, to be filed and signed.
    heading: Option<String>,
    /// Its language: `en`, `de` or `zh`; `en` where it is not stated.
    language: Option<String>,
}

/// A command that has a report.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
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
    /// An NC program, compensated.
    CompensateProgram,
    /// Tables of a control.
    CompensateTables,
    /// A path on a measured blank.
    CompensateAdapt,
    /// The rotary centres in the control.
    Rtcp,
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
            Self::CompensateProgram => "compensate-program",
            Self::CompensateTables => "compensate-tables",
            Self::CompensateAdapt => "compensate-adapt",
            Self::Rtcp => "rtcp",
        }
    }
}

/// A report that was made.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ReportAnswer<'a> {
    /// Its address on the server; only the last few reports are kept.
    url: String,
    /// Its size in bytes.
    bytes: usize,
    /// A name for the file.
    name: String,
    /// The address of the same as PDF; null where this build writes none.
    pdf: Option<String>,
    /// What was found in the heading, and characters that no font has.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl Request for ReportRequest {
    type Answer<'a> = ReportAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let path = desk.project.path(&self.file)?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let name = format!("{stem}-{}.html", self.verb.name());
        let mut problems = Diagnostics::new();
        let language = report_language(self.language.as_deref())?;
        let heading = match &self.heading {
            Some(file) => {
                let read = read_heading(&disk(), &desk.project.path(file)?, &mut problems);
                Some(read.ok_or_else(|| Refusal::unusable(&problems))?)
            }
            None => None,
        };
        let Made { html, pdf, missing } =
            self.made(desk, path, job, Frame { heading, language })?;
        if !missing.is_empty() {
            missing_glyphs(&missing, Place::whole(&name), &mut problems);
        }
        let bytes = html.len();
        let kept = |bytes, media_type| desk.reports.put(KeptReport { bytes, media_type }).0;
        let pdf = pdf.map(|bytes| format!("/report/{}", kept(bytes, "application/pdf")));
        let url = format!("/report/{}", kept(html, "text/html; charset=utf-8"));
        let diagnostics = entries(&problems);
        Ok(Reply::json(&ReportAnswer { url, bytes, name, pdf, diagnostics }))
    }
}

/// What is around the answer of a report.
struct Frame {
    heading: Option<Heading>,
    language: ReportLanguage,
}

fn report_language(code: Option<&str>) -> Result<ReportLanguage, Refusal> {
    let Some(code) = code else { return Ok(ReportLanguage::English) };
    ReportLanguage::named(code).ok_or_else(|| {
        let message = format!("no report is written in `{code}`");
        Refusal::new(422, "unknown-language", message, "the languages are en, de and zh")
    })
}

/// A report in all forms that this build prints.
struct Made {
    html: Vec<u8>,
    pdf: Option<Vec<u8>>,
    missing: String,
}

impl ReportRequest {
    fn made(self, desk: &Desk, file: PathBuf, job: &Job, frame: Frame) -> Result<Made, Refusal> {
        match self.verb {
            Verb::Predict => made(&Predict { study: file, ..Predict::default() }, job, frame),
            Verb::Simulate => {
                let machine = needed(self.machine, "machine")?;
                let question = SimulateRequest::of(machine, self.file).question(desk, job)?;
                made(&Simulate { pictures: true, ..question }, job, frame)
            }
            Verb::Plan => {
                let control = self.dialect.unwrap_or_else(|| SINUMERIK.to_owned());
                made(
                    &PlanMeasurement { campaign: file, control, output: None, write_unsafe: false },
                    job,
                    frame,
                )
            }
            Verb::Identify => made(&Identify { campaign: file, ..Identify::default() }, job, frame),
            Verb::Evaluate => {
                let standard = needed(self.standard, "standard")?;
                let request = EvaluateRequest {
                    conditions: self.conditions,
                    radius: self.radius,
                    window: self.window,
                    feature: self.feature,
                    tolerances: self.tolerances,
                    is_simple: self.is_simple,
                    ..EvaluateRequest::of(standard, self.file)
                };
                let (question, _) = request.question(desk)?;
                made(&question, job, frame)
            }
            Verb::Verify => made(&VerifyReadings { file }, job, frame),
            Verb::Diff => {
                let old = desk.project.path(&needed(self.machine, "machine")?)?;
                made(&CompareCalibrations { old, new: file }, job, frame)
            }
            Verb::History => {
                let files = desk.project.in_folder(&self.file, &["toml", "json"])?;
                made(&VerifyHistory { files, limits: Vec::new() }, job, frame)
            }
            Verb::Certificate => made(&Certify { study: file }, job, frame),
            Verb::Laser => made(&LaserBeforeAfter { campaign: file, output: None }, job, frame),
            Verb::Part => made(&VerifyPart { file }, job, frame),
            Verb::CompensateProgram => {
                let machine = needed(self.machine, "machine")?;
                let fixed = [("program", self.file), ("machine", machine)];
                let request: CompensateProgramRequest = with(self.options, fixed)?;
                made(&request.question(desk)?, job, frame)
            }
            Verb::CompensateTables => {
                let request: CompensateTablesRequest =
                    with(self.options, [("machine", self.file)])?;
                made(&request.question(desk)?, job, frame)
            }
            Verb::CompensateAdapt => {
                let request: CompensateAdaptRequest = with(self.options, [("study", self.file)])?;
                made(&request.question(desk)?, job, frame)
            }
            Verb::Rtcp => made(&IdentifyRtcp { study: file, output: None }, job, frame),
        }
    }
}

/// The request with these names: what was chosen, and what the report itself names.
fn with<T: DeserializeOwned, const N: usize>(
    options: Option<Map<String, Value>>,
    fixed: [(&str, String); N],
) -> Result<T, Refusal> {
    let mut body = options.unwrap_or_default();
    body.extend(fixed.map(|(name, value)| (name.to_owned(), Value::String(value))));
    let hint = "options are those of the request of the same name";
    serde_json::from_value(Value::Object(body)).map_err(|e| Refusal::bad(e.to_string(), hint))
}

fn made<Q: Question>(question: &Q, job: &Job, frame: Frame) -> Result<Made, Refusal> {
    let answer = ask(question, job)?.0;
    let Frame { heading, language } = frame;
    let report = || {
        let report = unwritten(answer.report());
        let report = Report { heading: heading.clone(), date: today(), ..report };
        report.in_language(language.language())
    };
    let html = print(&report(), Form::Html).map_err(|e| unprinted(&e))?.bytes;
    if !Form::Pdf.is_there() {
        return Ok(Made { html, pdf: None, missing: String::new() });
    }
    let printed = print(&report(), Form::Pdf).map_err(|e| unprinted(&e))?;
    Ok(Made { html, pdf: Some(printed.bytes), missing: printed.missing })
}

fn unprinted(error: &PrintError) -> Refusal {
    Refusal::new(422, "no-report", error.to_string(), "the numbers are in the other tabs")
}
