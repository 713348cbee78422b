//! How does an error follow temperatures?

use super::{Answer, Question, Tell, with_diagnostics};
use crate::report;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_report::Report;
use trueaxis_thermal::thermal::{
    Logs, Scoring, ThermalModel, identify_thermal, read_logs_and, score_thermal,
};

/// A linear model of an error that drifts with temperatures, from logs of whole cycles.
#[derive(Debug, Clone, Default)]
pub struct IdentifyThermal {
    /// The study: logs, displacement, candidate sensors.
    pub study: PathBuf,
    /// Logs that came later, beside those of `[score]`.
    pub score: Vec<PathBuf>,
}

/// The logs with their model.
#[derive(Debug)]
pub struct ThermalAnswer {
    /// The logs.
    pub logs: Logs,
    /// The model, or why there is none.
    pub model: ThermalModel,
    /// How later logs agree with it, if there are any.
    pub scoring: Option<Scoring>,
}

impl Question for IdentifyThermal {
    type Input = Logs;
    type Answer = ThermalAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Logs> {
        problems.keep(read_logs_and(files, &self.study, &self.score))
    }

    fn answer(&self, logs: Logs, _: Tell<'_>, problems: &mut Diagnostics) -> Option<ThermalAnswer> {
        let model = identify_thermal(&logs);
        for warning in &model.warnings {
            let place = Place::whole(&self.study.display().to_string());
            problems.warn("identification", place, warning.clone(), "");
        }
        let scoring = score_thermal(&logs, &model);
        for log in scoring.iter().flat_map(|s| &s.logs) {
            if let Some(message) = report::outside_pattern(&logs, log) {
                let hint = "add logs of this pattern to the study, or do not compensate with the model there";
                problems.warn("outside-pattern", Place::whole(&log.name), message, hint);
            }
        }
        Some(ThermalAnswer { logs, model, scoring })
    }
}

impl Answer for ThermalAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(
            &report::ThermalDocument::of(
                &self.logs,
                &self.model,
                &report::thermal_lines(&self.logs, &self.model),
                self.scoring.as_ref(),
            ),
            problems,
        )
    }

    fn report(&self) -> Report<'_> {
        report::thermal_report(&self.logs, &self.model, self.scoring.as_ref())
    }

    fn is_yes(&self) -> bool {
        self.model.refusal.is_none() && self.scoring.as_ref().is_none_or(Scoring::as_promised)
    }
}
