//! What does a part file ask for, and what of a QIF file can be drafted as one?

use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::Output;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_part::part::Part;
use trueaxis_part::qif;
use trueaxis_predict::report::{PartFileDocument, draft_report, part_report};
use trueaxis_report::Report;

/// A part file, or a QIF file that becomes a draft of one.
#[derive(Debug, Clone)]
pub struct AskPart {
    /// The part file, or the QIF file by its extension `qif`.
    pub file: PathBuf,
    /// Where the draft of a QIF file goes.
    pub output: Option<PathBuf>,
}

/// What was read.
#[derive(Debug)]
pub enum PartFileAnswer {
    /// A part file.
    Part(Part),
    /// A draft, and where it goes; it is handed out once.
    Draft {
        /// The draft.
        draft: qif::Draft,
        /// Its file.
        output: Option<PathBuf>,
        /// Whether it is shown, since it has no file.
        is_shown: bool,
    },
}

impl AskPart {
    fn is_qif(&self) -> bool {
        self.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("qif"))
    }
}

impl Question for AskPart {
    type Input = PartFileAnswer;
    type Answer = PartFileAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<PartFileAnswer> {
        if !self.is_qif() {
            if self.output.is_some() {
                let message = "a part file is not drafted again".to_owned();
                let hint = "-o belongs to a QIF file, `NAME.qif`";
                problems.error("contradiction", Place::whole("-o"), message, hint);
            }
            return Part::of_file(files, &self.file, problems).map(PartFileAnswer::Part);
        }
        let text = files.text(&self.file, "a QIF file (XML)", problems)?;
        let draft = qif::draft(&self.file.display().to_string(), &text, problems)?;
        let (output, is_shown) = (self.output.clone(), self.output.is_none());
        Some(PartFileAnswer::Draft { draft, output, is_shown })
    }

    fn outputs(&self, _: Option<&PartFileAnswer>) -> Vec<Output> {
        self.output.iter().map(|path| Output::file("-o", path)).collect()
    }

    fn answer(
        &self,
        input: PartFileAnswer,
        _: Tell<'_>,
        _: &mut Diagnostics,
    ) -> Option<PartFileAnswer> {
        Some(input)
    }
}

impl Answer for PartFileAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        let found = match self {
            Self::Part(part) => PartFileDocument::of_part(part),
            Self::Draft { draft, .. } => PartFileDocument::of_draft(draft),
        };
        with_diagnostics(&found, problems)
    }

    fn report(&self) -> Report<'_> {
        match self {
            Self::Part(part) => part_report(part),
            Self::Draft { draft, is_shown, .. } => draft_report(draft, *is_shown),
        }
    }

    fn files(&mut self) -> Vec<NewFile> {
        match self {
            Self::Part(_) => Vec::new(),
            Self::Draft { draft, output, .. } => {
                let file = output.take().map(|path| NewFile::of("draft", path, draft.text()));
                file.into_iter().collect()
            }
        }
    }
}
