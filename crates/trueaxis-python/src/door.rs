//! A question of the library put from Python: as the command does, read, check the outputs, compute, write.

use crate::answer::{Held, NativeAnswer};
use crate::machine::{Contents, with_contents};
use crate::options::Options;
use crate::problems::{one, refused};
use crate::threads;
use crate::verbs;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};
use trueaxis::files::output::Guard;
use trueaxis::files::{self, noted_disk};
use trueaxis::input::{Diagnostics, Place};
use trueaxis::questions::{Answer, Content, NewFile, Question, is_finite, may_put, may_write};
use trueaxis_paper::ReportFile;
use trueaxis_words::ReportLanguage;

/// What is read from memory, what is written, and whether what stands there is replaced.
pub struct Door<'py> {
    py: Python<'py>,
    memory: Contents,
    report: Option<PathBuf>,
    heading: Option<PathBuf>,
    language: ReportLanguage,
    force: bool,
}

/// Puts the question of a verb; `options` by the names of the command, `report` with its heading and its language.
#[pyfunction]
#[pyo3(signature = (verb, options, memory, report, force))]
pub fn ask(
    py: Python<'_>,
    verb: &str,
    options: &Bound<'_, PyDict>,
    memory: Contents,
    report: (Option<PathBuf>, Option<PathBuf>, String),
    force: bool,
) -> PyResult<NativeAnswer> {
    let (report, heading, language) = report;
    let Some(language) = ReportLanguage::named(&language) else {
        let message = format!("no report is written in `{language}`");
        let hint = "the languages are en, de and zh";
        return Err(one(py, "unknown-language", "language", message, hint));
    };
    let door = Door { py, memory, report, heading, language, force };
    verbs::ask(verb, &Options(options), &door)
}

impl Door<'_> {
    /// The interpreter.
    pub fn py(&self) -> Python<'_> {
        self.py
    }

    /// Puts a question and writes what it leaves.
    pub fn ask<Q>(&self, question: &Q) -> PyResult<NativeAnswer>
    where
        Q: Question + Sync,
        Q::Answer: Send + 'static,
    {
        let asked = Asked {
            memory: &self.memory,
            report: self.report.as_deref(),
            heading: self.heading.as_deref(),
            language: self.language,
            force: self.force,
        };
        let work = || computed(question, &asked);
        let Computed { answer, report, mut problems, guard } = threads::work(self.py, None, work)?;
        let Some(mut answer) = answer else { return Err(refused(self.py, &problems)) };
        let new = answer.files();
        let mut taken = Diagnostics::new();
        may_put(&new, &guard, &mut taken);
        if taken.has_errors() {
            return Err(refused(self.py, &taken));
        }
        let mut written = Vec::new();
        let done = self.py.detach(|| {
            if let Some(file) = &report {
                write_report(file, &answer, &mut problems)?;
            }
            new.into_iter().try_for_each(|file| write(file, &mut written, &mut problems))?;
            Some(Box::new(answer) as Held)
        });
        let Some(answer) = done else { return Err(refused(self.py, &problems)) };
        written.extend(self.report.iter().map(|path| path.display().to_string()));
        Ok(NativeAnswer::new(answer, problems, written).in_language(self.language))
    }
}

/// What is read from memory, and what is written.
struct Asked<'a> {
    memory: &'a Contents,
    report: Option<&'a Path>,
    heading: Option<&'a Path>,
    language: ReportLanguage,
    force: bool,
}

/// The answer, if there is one, and what is needed to write its files.
struct Computed<A> {
    answer: Option<A>,
    report: Option<ReportFile>,
    problems: Diagnostics,
    guard: Guard,
}

/// Reads, checks the outputs, computes.
fn computed<Q: Question>(question: &Q, asked: &Asked<'_>) -> Computed<Q::Answer> {
    let mut problems = Diagnostics::new();
    let (disk, read) = noted_disk();
    let files = match asked.memory.is_empty() {
        true => disk,
        false => with_contents(asked.memory.clone(), disk).0,
    };
    // A machine that was read before is an input all the same.
    asked.memory.keys().for_each(|path| read.note(path));
    let input = question.read(&files, &mut problems);
    let report = ReportFile::read(
        asked.report,
        asked.heading,
        asked.language.language(),
        &files,
        &mut problems,
    );
    let guard = Guard { read, force: asked.force };
    let report_path = report.as_ref().map(ReportFile::path);
    may_write(question, input.as_ref(), report_path, &guard, &mut problems);
    let answer = match input.filter(|_| !problems.has_errors()) {
        Some(input) => question.answer(input, &|_| {}, &mut problems),
        None => None,
    };
    let answer = answer.filter(|answer| is_finite(answer, &mut problems));
    let usable =
        |answer: &Q::Answer| !problems.has_errors() || answer.in_spite_of_errors().is_some();
    Computed { answer: answer.filter(usable), report, problems, guard }
}

fn write_report(file: &ReportFile, answer: &impl Answer, problems: &mut Diagnostics) -> Option<()> {
    let place = Place::whole(&file.path().display().to_string());
    let bytes = match file.print(answer.report(), problems) {
        Ok(bytes) => bytes,
        Err(error) => {
            problems.error("no-report", place, error.to_string(), "leave out `report`");
            return None;
        }
    };
    if let Err(error) = files::write_in_folder(file.path(), &bytes) {
        let message = format!("cannot be written: {error}");
        let hint = "name another `report`, or leave it out";
        problems.error("unwritable-file", place, message, hint);
        return None;
    }
    Some(())
}

fn write(file: NewFile, written: &mut Vec<String>, problems: &mut Diagnostics) -> Option<()> {
    let shown = file.path.display().to_string();
    let code = match file.content {
        Content::Folder(_) => "unwritable-folder",
        _ => "unwritable-file",
    };
    if let Err(error) = file.write() {
        let message = format!("cannot be written: {error}");
        problems.error(code, Place::whole(&shown), message, "name another file or folder");
        return None;
    }
    written.push(shown);
    Some(())
}
