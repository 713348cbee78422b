//! How did the figures of this machine change over its calibrations?

use super::{Answer, Question, Tell, with_diagnostics};
use crate::files::in_folder;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_condition::history::{Calibration, History, Limits, history, read_limits};
use trueaxis_condition::history_report::{HistoryDocument, history_report};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_report::Report;

/// The figures of one machine over its calibrations.
#[derive(Debug, Clone, Default)]
pub struct VerifyHistory {
    /// Machine files, documents of `evaluate`, folders with them.
    pub files: Vec<PathBuf>,
    /// Limits of figures as typed: `EC0Y=20 urad`.
    pub limits: Vec<String>,
}

/// A history.
#[derive(Debug)]
pub struct HistoryAnswer(History);

impl Question for VerifyHistory {
    type Input = (Vec<Calibration>, Limits);
    type Answer = HistoryAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let named = self.files.iter();
        let all: Vec<PathBuf> = named.flat_map(|path| in_folder(path, &["toml", "json"])).collect();
        if all.is_empty() {
            let message = "there are no calibrations here".to_owned();
            let hint =
                "machine files (.toml) and documents of evaluate (.json), or a folder with them";
            problems.error("no-history", Place::whole("--history"), message, hint);
        }
        let limits = read_limits(&self.limits, problems);
        let read = all.iter().filter_map(|path| Calibration::read(files, path, problems)).collect();
        Some((read, limits))
    }

    fn answer(
        &self,
        (calibrations, limits): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<HistoryAnswer> {
        history(&calibrations, &limits, problems).map(HistoryAnswer)
    }
}

impl Answer for HistoryAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&HistoryDocument::from(&self.0), problems)
    }

    fn report(&self) -> Report<'_> {
        history_report(&self.0)
    }

    fn is_yes(&self) -> bool {
        self.0.series.iter().all(|series| series.is_quiet())
    }
}
