//! `trueaxis study`: the question and its answer.

use crate::file::{Changes, read_study};
use crate::findings::Findings;
use crate::report::{StudyDocument, study_report};
use crate::study::Study;
use crate::table;
use serde_json::Value;
use std::path::PathBuf;
use std::sync::Arc;
use trueaxis::files::output::Output;
use trueaxis::input::{Diagnostics, Files, Place};
use trueaxis::part::tolerance::Outcome;
use trueaxis::questions::{Answer, Content, NewFile, Question, Tell};
use trueaxis_report::{Report, document};

/// Many machines on many days.
#[derive(Debug, Clone, Default)]
pub struct AskStudy {
    /// The study file.
    pub study: PathBuf,
    /// What is different from it.
    pub changes: Changes,
    /// Where the inputs and outputs of all samples go, as a table.
    pub table: Option<PathBuf>,
}

/// A study with what was found; the table is handed out once.
#[derive(Debug)]
pub struct StudyAnswer {
    study: Arc<Study>,
    findings: Findings,
    table: Option<NewFile>,
}

impl StudyAnswer {
    /// Of a study whose samples were evaluated elsewhere: `values_mm` as of [`Study::evaluate`].
    ///
    /// # Panics
    /// Another number of values than all samples of the study have.
    pub fn of_values(study: Arc<Study>, values_mm: &[f64]) -> Self {
        let findings = study.findings(values_mm);
        Self { study, findings, table: None }
    }
}

impl Question for AskStudy {
    type Input = Study;
    type Answer = StudyAnswer;
    const PROGRESS: &'static str = "samples";

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Study> {
        let study = problems.keep(read_study(files, &self.study, self.changes))?;
        if let Some(path) = &self.table {
            table::check(&study, path, problems);
        }
        Some(study)
    }

    fn outputs(&self, _: Option<&Study>) -> Vec<Output> {
        self.table.iter().map(|path| Output::file("--table", path)).collect()
    }

    fn answer(
        &self,
        study: Study,
        progress: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<StudyAnswer> {
        let samples = study.design.samples();
        let share = |done: usize| progress(done as f64 / samples as f64);
        let values = match study.evaluate(0..samples, &share) {
            Ok(values) => values,
            Err(fault) => {
                let place = Place::whole(&self.study.display().to_string());
                let hint = "narrower distributions, or another study of the part";
                problems.error("sample-not-made", place, fault.message, hint);
                return None;
            }
        };
        let table = self.table.as_ref().map(|path| NewFile {
            name: "table",
            path: path.clone(),
            content: Content::Bytes(table::csv(&study, &values).into_bytes().into()),
        });
        Some(StudyAnswer { table, ..StudyAnswer::of_values(Arc::new(study), &values) })
    }
}

impl Answer for StudyAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        document(&StudyDocument::of(&self.study, &self.findings))
    }

    fn report(&self) -> Report<'_> {
        study_report(&self.study, &self.findings)
    }

    fn files(&mut self) -> Vec<NewFile> {
        self.table.take().into_iter().collect()
    }

    fn is_yes(&self) -> bool {
        self.findings.outcome().is_none_or(|outcome| outcome == Outcome::Pass)
    }
}
