//! Does the machine agree with its file, have its errors changed, is a compensation valid?

use super::shown::ShownEntry;
use crate::body::needed;
use crate::desk::{Desk, Job};
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request, ask};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::PathBuf;
use trueaxis::JsonSchema;
use trueaxis::questions::{
    Answer, Certify, CompareCalibrations, LaserBeforeAfter, Question, VerifyHistory, VerifyPart,
    VerifyReadings,
};
use trueaxis::report::DiagnosticEntry;

/// Verifies.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct VerifyRequest {
    /// What is asked.
    what: VerifiedSubject,
    /// The file that `what` takes; the older machine file of `diff`, a folder or a file of `history`.
    file: String,
    /// The newer machine file of `diff`.
    new: Option<String>,
    /// Limits of figures of `history`, as `--limit` of the command line: `EC0X=40 urad`.
    limits: Option<Vec<String>>,
}

/// What is verified.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum VerifiedSubject {
    /// Readings against the machine file, or against other readings.
    Readings,
    /// Two calibrations: what has moved.
    Diff,
    /// The figures of one machine over its calibrations.
    History,
    /// What a compensation leaves.
    Certificate,
    /// A laser before and after a compensation.
    Laser,
    /// A test piece that was measured.
    Part,
}

/// What was verified.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct VerifyAnswer<'a> {
    /// The document of `trueaxis verify`.
    #[schemars(with = "VerifiedDocument<'a>")]
    document: Value,
    /// Its report.
    shown: ShownEntry,
    /// The problems of the input.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// The documents of `trueaxis verify`, for their schemas.
#[cfg(feature = "schemas")]
#[derive(JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, clippy::large_enum_variant)]
enum VerifiedDocument<'a> {
    Readings(trueaxis::report::VerifyDocument<'a>),
    Diff(trueaxis::report::DiffDocument<'a>),
    History(trueaxis::report::HistoryDocument<'a>),
    Certificate(trueaxis::report::CertificateDocument<'a>),
    Laser(trueaxis::report::BeforeAfterDocument<'a>),
    Part(trueaxis::report::VerifyPartDocument<'a>),
}

impl Request for VerifyRequest {
    type Answer<'a> = VerifyAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let file: PathBuf = desk.project.path(&self.file)?;
        match self.what {
            VerifiedSubject::Readings => verified(&VerifyReadings { file }, job),
            VerifiedSubject::Diff => {
                let new = desk.project.path(&needed(self.new, "new")?)?;
                verified(&CompareCalibrations { old: file, new }, job)
            }
            VerifiedSubject::History => {
                let limits = self.limits.unwrap_or_default();
                let files = desk.project.in_folder(&self.file, &["toml", "json"])?;
                verified(&VerifyHistory { files, limits }, job)
            }
            VerifiedSubject::Certificate => verified(&Certify { study: file }, job),
            VerifiedSubject::Laser => {
                verified(&LaserBeforeAfter { campaign: file, output: None }, job)
            }
            VerifiedSubject::Part => verified(&VerifyPart { file }, job),
        }
    }
}

fn verified<Q: Question>(question: &Q, job: &Job) -> Result<Reply<VerifyRequest>, Refusal> {
    let (found, problems) = ask(question, job)?;
    Ok(Reply::json(&VerifyAnswer {
        document: found.document(&problems),
        shown: ShownEntry::of(&found),
        diagnostics: entries(&problems),
    }))
}
