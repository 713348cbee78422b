//! A question of the library as a command: read, check the outputs, compute, write, show.

use crate::output::{Answer as Shown, Format, Outcome, report_and, show, show_by, tell};
use crate::report_file::{unusable, write_report};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use trueaxis::files::noted_disk;
use trueaxis::files::output::Guard;
use trueaxis::input::Diagnostics;
use trueaxis::questions::{Answer, Content, NewFile, Question, is_finite, may_put, may_write};
use trueaxis::report::refused_json;
use trueaxis_paper::ReportFile;
use trueaxis_words::{REPORT_LANGUAGES, ReportLanguage};

/// What is shown and written.
#[derive(Args)]
pub struct DoorArguments {
    /// Write a report to this file: FILE.html or FILE.pdf
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// The heading of the report, to be filed and signed: [report] number, date, customer, operator, logo, signatures
    #[arg(long, value_name = "HEADING.toml", requires = "report")]
    heading: Option<PathBuf>,
    /// Accepted as before: without --report no report is written
    #[arg(long, hide = true, conflicts_with = "report")]
    no_report: bool,
    /// Replace files that are there, also those that this program did not write or that were edited since
    #[arg(long)]
    force: bool,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// The language of the text and of the report: en, de (German), zh (Chinese); JSON and tables stay as they are
    #[arg(long, default_value = "en", value_parser = report_language, value_name = "LANGUAGE")]
    language: ReportLanguage,
}

/// A language by its code.
pub fn report_language(code: &str) -> Result<ReportLanguage, String> {
    let known: Vec<&str> = REPORT_LANGUAGES.iter().map(|(code, _)| *code).collect();
    ReportLanguage::named(code).ok_or_else(|| format!("the languages are {}", known.join(", ")))
}

impl DoorArguments {
    /// The door with these arguments.
    pub fn door(&self) -> Door<'_> {
        let (report, heading) = (self.report.as_deref(), self.heading.as_deref());
        Door { format: self.format, report, heading, force: self.force, language: self.language }
    }
}

/// The form of the answer.
pub struct Door<'a> {
    /// On standard output.
    pub format: Format,
    /// The file of the report.
    pub report: Option<&'a Path>,
    /// The file of its heading.
    pub heading: Option<&'a Path>,
    /// Whether files are replaced that this program did not write.
    pub force: bool,
    /// The language of text and report.
    pub language: ReportLanguage,
}

impl Door<'_> {
    /// Puts the question and shows the answer.
    pub fn ask<Q: Question>(&self, question: &Q) -> Outcome {
        self.try_ask(question).unwrap_or_else(|outcome| outcome)
    }

    fn try_ask<Q: Question>(&self, question: &Q) -> Result<Outcome, Outcome> {
        let mut problems = Diagnostics::new();
        let (files, read) = noted_disk();
        let input = question.read(&files, &mut problems);
        let report_file = ReportFile::read(
            self.report,
            self.heading,
            self.language.language(),
            &files,
            &mut problems,
        );
        let guard = Guard { read, force: self.force };
        let report_path = report_file.as_ref().map(ReportFile::path);
        may_write(question, input.as_ref(), report_path, &guard, &mut problems);
        let answer = match input.filter(|_| !problems.has_errors()) {
            Some(input) => answer(question, input, &mut problems),
            None => None,
        };
        let answer = answer.filter(|answer| is_finite(answer, &mut problems));
        let found = problems.clone();
        let in_spite = answer.as_ref().and_then(Answer::in_spite_of_errors);
        let failed = report_and(problems, in_spite.unwrap_or("nothing was written"));
        let usable = !failed || in_spite.is_some();
        let Some(mut answer) = answer.filter(|_| usable) else {
            if self.format == Format::Json {
                show(&Shown::Json(refused_json(&found)));
            }
            return Err(Outcome::Unusable);
        };
        let files = answer.files();
        let mut taken = Diagnostics::new();
        may_put(&files, &guard, &mut taken);
        if taken.has_errors() {
            report_and(taken.clone(), "nothing was written");
            if self.format == Format::Json {
                show(&Shown::Json(refused_json(&taken)));
            }
            return Err(Outcome::Unusable);
        }
        if let Some(file) = &report_file {
            write_report(file, answer.report())?;
        }
        files.into_iter().try_for_each(write)?;
        answer.notes().iter().for_each(|note| tell(note));
        let shown = show_by(|out| match self.format {
            Format::Json => answer.write_json(&found, out),
            Format::Text => answer.write_text(self.language.language(), out),
        });
        Ok(match shown {
            Outcome::Done if failed => Outcome::Unusable,
            Outcome::Done if !answer.is_yes() => Outcome::No,
            shown => shown,
        })
    }
}

/// Computes with a progress bar, where there is something to wait for.
fn answer<Q: Question>(
    question: &Q,
    input: Q::Input,
    problems: &mut Diagnostics,
) -> Option<Q::Answer> {
    const STEPS: f64 = 1000.0;
    if Q::PROGRESS.is_empty() {
        return question.answer(input, &|_| {}, problems);
    }
    let bar = ProgressBar::new(STEPS as u64).with_message(Q::PROGRESS);
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent} %, {eta} remaining")
    {
        bar.set_style(style);
    }
    let answer = question.answer(input, &|part| bar.set_position((part * STEPS) as u64), problems);
    bar.finish_and_clear();
    answer
}

fn write(file: NewFile) -> Result<(), Outcome> {
    let (name, shown) = (file.name, file.path.display().to_string());
    let code = match file.content {
        Content::Folder(_) => "unwritable-folder",
        _ => "unwritable-file",
    };
    file.write().map_err(|e| {
        let message = format!("cannot be written: {e}");
        unusable(code, &shown, &message, "name another file or folder")
    })?;
    if !name.is_empty() {
        tell(&format!("{name}: {shown}"));
    }
    Ok(())
}
