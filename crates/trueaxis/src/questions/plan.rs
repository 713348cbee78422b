//! What will a measurement show, and how is it run?

use super::{Answer, NewFile, Question, Tell, in_folder, named_control};
use crate::files::file_from;
use crate::report;
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_calibrate::plan::{
    Plan, PlanReport, PlannedPath, READINGS_FOLDER, READY_CAMPAIGN, chosen, planned, read_plan,
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
    /// Whether programs that are not safe are written, too.
    pub write_unsafe: bool,
}

/// A plan worked out.
#[derive(Debug)]
pub struct PlanAnswer {
    /// The plan.
    pub found: PlanReport,
    /// The campaign that `measure` and `identify` read.
    ready: Option<String>,
    output: Option<PathBuf>,
    write_unsafe: bool,
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
        let (output, write_unsafe) = (self.output.clone(), self.write_unsafe);
        Some(PlanAnswer { found, ready, output, write_unsafe })
    }
}

impl PlanAnswer {
    /// Whether a file of a path is kept back: all but the table of the poses, where the program is not safe.
    fn is_kept_back(&self, path: &PlannedPath, name: &str) -> bool {
        let is_unsafe = path.check.as_ref().is_ok_and(|check| !check.is_sound());
        is_unsafe && !self.write_unsafe && !name.ends_with(".csv")
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
        for path in &self.found.paths {
            for file in path.files.iter().filter(|file| !self.is_kept_back(path, &file.0)) {
                // Masks of the log are the same for all paths.
                if files.iter().all(|f| f.0 != file.0) {
                    files.push(file.clone());
                }
            }
        }
        files.extend(self.ready.take().map(|text| (READY_CAMPAIGN.to_owned(), text.into_bytes())));
        in_folder(self.output.as_deref(), files)
    }

    fn notes(&self) -> Vec<String> {
        let Some(folder) = &self.output else { return Vec::new() };
        let [campaign, readings] = [READY_CAMPAIGN, READINGS_FOLDER].map(|name| folder.join(name));
        let campaign = campaign.display();
        let unsafe_ones = self.found.paths.iter().filter(|path| self.is_kept_back(path, ""));
        let kept_back = unsafe_ones.map(|path| {
            let name = &path.path.name;
            format!("the program of path {name} is NOT SAFE: it was not written (--write-unsafe writes it)")
        });
        let next = [
            format!("virtual readings: trueaxis measure {campaign} -o {}", readings.display()),
            format!("then: trueaxis identify {campaign}"),
        ];
        kept_back.chain(next).collect()
    }
}
