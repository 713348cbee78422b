//! The study of a part of any shape.

use super::super::Setting;
use super::super::cutting::setting_command;
use super::super::monte_carlo::Sampling;
use super::super::running::running_machine;
use super::super::study::{
    Decision, check_uncertainties, read_decision, read_sampling, read_setting,
};
use super::super::temperatures::StudyTemperatures;
use super::measured::Measurement;
use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Files, Place, Section, SourceText};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_motion::{Densify, Job, Options, ProgramFiles};
use trueaxis_part::part::Part;

/// Chords leave 0.02 µm, also where the tool or the workpiece turns; errors of the machine are followed in steps of 5 mm.
const PLACES: Densify =
    Densify::Tool { chord_mm: 2e-5, reach_mm: 100.0, angle_rad: 0.01, spacing_mm: 5.0 };

/// A question to the machine: which features of this part will be good?
pub struct PartStudy {
    /// Its name.
    pub name: String,
    /// The study file.
    pub path: PathBuf,
    /// The part and its file.
    pub part: Part,
    /// The file of the part.
    pub part_file: String,
    /// The program on the machine.
    pub job: Job,
    /// The machine as the set-up file mounts the workpiece.
    pub mounted: Machine,
    /// Where the axes were when the part zero was set; none if it is where it should be.
    pub setting: Option<Command>,
    /// The rule of the verdict.
    pub decision: Decision,
    /// The machine that will measure the part; none: it is not asked what that would find.
    pub measurement: Option<Measurement>,
    /// How many machines are drawn; none: u is found by linear propagation alone.
    pub sampling: Option<Sampling>,
}

impl std::fmt::Debug for PartStudy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PartStudy")
            .field("name", &self.name)
            .field("part", &self.part)
            .finish_non_exhaustive()
    }
}

/// Whether a study file is about a part file.
pub fn is_part_study(files: &Files, path: &Path) -> bool {
    let text = files.text(path, "a study file", &mut Diagnostics::new());
    let names_part = |line: &str| line.split_once('=').is_some_and(|(key, _)| key.trim() == "part");
    text.is_some_and(|t| t.lines().any(names_part))
}

/// Reads a study of a part; all problems at once.
pub fn read_part_study(files: &Files, path: &Path) -> (Option<PartStudy>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study file (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let study = source.read(|root| read(root, path));
    let problems = source.finish();
    (study.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path) -> Option<PartStudy> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = root.require("name", "give the study a name").and_then(|i| i.text());
    let machine = running_machine(root, path).map(|(_, machine)| machine);
    let temperatures = StudyTemperatures::read(root, folder, false);
    let machine = machine.and_then(|m| temperatures.warm(root, m));
    let mut problems = Diagnostics::new();
    let file =
        root.require("part", "the part file, relative to the study file").and_then(|i| i.text());
    let part_path = file.map(|file| folder.join(file));
    let part = part_path.as_ref().and_then(|p| Part::of_file(root.files(), p, &mut problems));
    let hint = "the program that cuts the part, relative to the study file";
    let program = root.require("program", hint).and_then(|i| i.text());
    let setup = root.text("setup").map(|name| folder.join(name));
    let decision = root.section("decision", read_decision).unwrap_or(Some(Decision::Simple));
    let sampling = root
        .section("monte_carlo", |s| read_sampling(s, PartStudy::MOST_SAMPLES))
        .map_or(Some(None), |s| s.map(Some));
    let measurement =
        root.section("measurement", Measurement::read).map_or(Some(None), |m| m.map(Some));
    let setting = machine.as_ref().map(|machine| {
        check_uncertainties(root, decision, machine);
        root.section("setting", |s| read_setting(s, machine, &[])).flatten().unwrap_or_default()
    });
    if temperatures.running.is_some() {
        let message =
            "a part is cut at the temperatures of one time; a log is not followed".to_owned();
        root.error("contradiction", message, "state the temperatures in [temperature]");
    }
    if machine.is_none() {
        // What needs the machine is not called unknown.
        root.entries();
    }
    let job = machine.zip(program).and_then(|(machine, program)| {
        let program = folder.join(program);
        let files = ProgramFiles {
            files: root.files(),
            program: &program,
            text: None,
            setup: setup.as_deref(),
            control: None,
        };
        let options = Options { densify: PLACES, ..Options::default() };
        Job::read(machine, &files, options, &mut problems)
    });
    root.take_over(problems);
    let (job, part) = (job?, part?);
    let mounted = job.setup.mounted(&job.machine);
    let setting = match setting? {
        Setting::Perfect => None,
        touched @ Setting::Touched { .. } => match setting_command(&mounted, &touched) {
            Ok(command) => Some(command),
            Err(error) => {
                let hint = "[setting] perfect = true, or other rotary positions";
                root.error(error.code(), error.to_string(), hint);
                return None;
            }
        },
    };
    Some(PartStudy {
        name: name?.to_owned(),
        path: path.to_owned(),
        part_file: part_path?.display().to_string(),
        part,
        mounted,
        setting,
        job,
        decision: decision?,
        measurement: measurement?,
        sampling: sampling?.filter(|s| s.samples > 0),
    })
}

impl PartStudy {
    /// More would take hours.
    pub const MOST_SAMPLES: usize = 1_000_000;

    /// The error of the tip where the part zero was set, mm.
    pub(super) fn zero(&self, problems: &mut Diagnostics) -> Option<Vec3> {
        let Some(setting) = &self.setting else { return Some(Vec3::zeros()) };
        match self.mounted.errors_at(setting, &Approach::default()) {
            Ok(errors) => Some(self.mounted.deviation(setting, &errors).tip_mm),
            Err(error) => {
                let place = Place::whole(&self.path.display().to_string());
                let hint = "cover the travel by the table, or [setting] perfect = true";
                problems.error(
                    "outside-table",
                    place,
                    format!("the tool-setting point: {error}"),
                    hint,
                );
                None
            }
        }
    }
}
