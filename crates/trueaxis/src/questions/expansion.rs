//! How far does a scale expand?

use super::{Answer, Question, Tell};
use crate::report;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_calibrate::identify::expansion::{Expansion, Runs, identify_expansion, read_runs};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_report::Report;

/// The coefficient of expansion of a scale, from runs at two or more temperatures.
#[derive(Debug, Clone, Default)]
pub struct IdentifyExpansion {
    /// The file of the runs.
    pub runs: PathBuf,
}

/// The runs with the coefficient.
#[derive(Debug)]
pub struct ExpansionAnswer {
    runs: Runs,
    found: Expansion,
}

impl Question for IdentifyExpansion {
    type Input = Runs;
    type Answer = ExpansionAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Runs> {
        problems.keep(read_runs(files, &self.runs))
    }

    fn answer(
        &self,
        runs: Runs,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<ExpansionAnswer> {
        let found = identify_expansion(&runs);
        for warning in &found.warnings {
            let place = Place::whole(&self.runs.display().to_string());
            problems.warn("identification", place, warning.clone(), "");
        }
        Some(ExpansionAnswer { runs, found })
    }
}

impl Answer for ExpansionAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        report::expansion_json(&self.runs, &self.found)
    }

    fn report(&self) -> Report<'_> {
        report::expansion_report(&self.runs, &self.found)
    }
}
