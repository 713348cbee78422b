//! What will a measurement show, and how is it run?

use super::{Answer, NewFile, Question, Tell, in_folder, named_control};
use crate::files::file_from;
use crate::report;
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_calibrate::plan::{
    Plan, PlanReport, READINGS_FOLDER, READY_CAMPAIGN, chosen, planned, read_plan,
};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_nc::Control;
use trueaxis_report::{Report, document};

/// What each path of a campaign shows, its programs, the most informative poses.
#[derive(Debug, Clone)]
pub struct PlanMeasurement {
    /// The campaign: machine, unknowns, instruments, paths.
    pub campaign: PathBuf,
    /// The control of the programs, by its name.
    pub control: String,
    /// The folder for one program and one table of poses per path, and the campaign with the chosen poses.
    pub output: Option<PathBuf>,
}

/// A plan worked out.
#[derive(Debug)]
pub struct PlanAnswer {
    /// The plan.
    pub found: PlanReport,
    /// The campaign that `measure` and `identify` read.
    ready: Option<String>,
    output: Option<PathBuf>,
}

impl Question for PlanMeasurement {
    type Input = (Plan, Control);
    type Answer = PlanAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let plan = problems.keep(read_plan(files, &self.campaign));
        let control = named_control(&self.control, problems);
        plan.zip(control)
    }

    fn answer(
        &self,
        (plan, control): Self::Input,
        progress: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<PlanAnswer> {
        progress(0.1);
        let chosen = chosen(&plan, problems);
        if problems.has_errors() {
            return None;
        }
        let found = planned(plan, chosen, control);
        let ready = match &self.output {
            None => None,
            Some(folder) => match found.ready_campaign(&|file| {
                let at = self.campaign.parent().unwrap_or(Path::new("")).join(file);
                file_from(folder, &at)
            }) {
                Ok(text) => Some(text),
                Err(why) => {
                    let place = Place::whole(&self.campaign.display().to_string());
                    let hint = "write its sections as in examples/04_plan";
                    problems.error("toml-syntax", place, why, hint);
                    return None;
                }
            },
        };
        Some(PlanAnswer { found, ready, output: self.output.clone() })
    }
}

impl Answer for PlanAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        document(&report::PlanDocument::of(&self.found))
    }

    fn report(&self) -> Report<'_> {
        report::plan_report(&self.found)
    }

    fn is_yes(&self) -> bool {
        self.found.paths.iter().all(|p| p.check.as_ref().is_ok_and(|c| c.is_sound()))
    }

    fn files(&mut self) -> Vec<NewFile> {
        let mut files: Vec<(String, Vec<u8>)> = Vec::new();
        for file in self.found.paths.iter().flat_map(|path| &path.files) {
            // Masks of the log are the same for all paths.
            if files.iter().all(|f| f.0 != file.0) {
                files.push(file.clone());
            }
        }
        files.extend(self.ready.take().map(|text| (READY_CAMPAIGN.to_owned(), text.into_bytes())));
        in_folder(self.output.as_deref(), files)
    }

    fn notes(&self) -> Vec<String> {
        let Some(folder) = &self.output else { return Vec::new() };
        let [campaign, readings] = [READY_CAMPAIGN, READINGS_FOLDER].map(|name| folder.join(name));
        let campaign = campaign.display();
        vec![
            format!("virtual readings: trueaxis measure {campaign} -o {}", readings.display()),
            format!("then: trueaxis identify {campaign}"),
        ]
    }
}
