//! What becomes of a plan: every path with its program, what that does, and what the path sees.

use super::ready::{ChosenTable, ready_campaign};
use super::{Chosen, Expectation, Plan, StageExpectation, choose, expect, seen};
use super::{expect_stages, planned_design};
use crate::plan::program::{ProgramCheck, check, program, program_files};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::axis::{Axis, AxisKind};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_measure::measure::path::Path;
use trueaxis_measure::measure::virtual_campaign::{set_times, station_times_s};
use trueaxis_measure::measure::{Campaign, Kind, Readings};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_nc::Control;

/// What becomes of a plan.
#[derive(Debug, Clone)]
pub struct PlanReport {
    /// What was asked.
    pub plan: Plan,
    /// The unknowns.
    pub design: Design,
    /// What all paths together will determine.
    pub expectation: Expectation,
    /// What each stage will determine, if the campaign has stages.
    pub stages: Vec<StageExpectation>,
    /// The paths, the chosen poses last.
    pub paths: Vec<PlannedPath>,
    /// The choice, if one was asked for.
    pub chosen: Option<Chosen>,
}

/// A path with all that was found of it.
#[derive(Debug, Clone)]
pub struct PlannedPath {
    /// The path.
    pub path: Path,
    /// What it sees of each error.
    pub seen: Vec<super::Seen>,
    /// The names of what is read.
    pub channels: &'static [&'static str],
    /// What the machine would do with its program, or why there is none.
    pub check: Result<ProgramCheck, String>,
    /// Its NC program, if there is one, and its table of poses: names and contents.
    pub files: Vec<(String, Vec<u8>)>,
}

impl PlanReport {
    /// The campaign that `measure` and `identify` read, for a folder with the files of the paths; `moved` names a file
    /// of the campaign from there.
    ///
    /// # Errors
    /// In words, why the text of the campaign cannot be edited.
    pub fn ready_campaign(&self, moved: &dyn Fn(&str) -> String) -> Result<String, String> {
        let campaign = &self.plan.campaign;
        let text = campaign.files.read_text(&campaign.path).map_err(|e| e.to_string())?;
        let planned = self.paths.last().filter(|_| self.chosen.is_some());
        let index = planned.and_then(|p| p.path.stations.instruments.first());
        let overrun = planned.map(|p| overrun_text(campaign, &p.path)).unwrap_or_default();
        let chosen = planned.zip(index).map(|(planned, index)| ChosenTable {
            file: planned.files.iter().find(|f| f.0.ends_with(".csv")).map_or("", |f| &f.0),
            instrument: &campaign.instruments[*index as usize].name,
            dwell_s: planned.path.dwell_s,
            overrun: Some(overrun.as_str()).filter(|text| !text.is_empty()),
        });
        ready_campaign(&text, &self.plan, chosen.as_ref(), moved)
    }
}

/// The overrun of a path as a campaign writes it; empty if there is none.
fn overrun_text(campaign: &Campaign, path: &Path) -> String {
    let sides = &path.stations.approaches;
    let of_rotary = |(i, axis): (usize, &Axis)| {
        axis.kind == AxisKind::Rotary && sides.iter().any(|side| side[i] != 0.0)
    };
    match path.overrun {
        overrun if overrun <= 0.0 => String::new(),
        rad if campaign.machine.axes().iter().enumerate().any(of_rotary) => {
            format!("{} deg", rad.to_degrees())
        }
        mm => format!("{mm} mm"),
    }
}

/// The most informative poses, if the campaign asks for a choice; why there is none goes to `problems`.
pub fn chosen(plan: &Plan, problems: &mut Diagnostics) -> Option<Chosen> {
    match choose(plan, plan.candidates.as_ref()?) {
        Ok(chosen) => Some(chosen),
        Err(why) => {
            let place = Place::whole(&plan.campaign.path.display().to_string());
            let hint = "more candidates, a wider [limit], or other [want] errors";
            problems.error("no-choice", place, why, hint);
            None
        }
    }
}

/// Plans all paths, the chosen poses last.
pub fn planned(plan: Plan, chosen: Option<Chosen>, control: Control) -> PlanReport {
    let design = planned_design(&plan.campaign);
    let mut paths = plan.paths.clone();
    if let Some(chosen) = &chosen {
        paths.push(Path {
            name: "chosen".to_owned(),
            stations: chosen.stations.clone(),
            feed_mm_per_s: None,
            dwell_s: plan.candidates.as_ref().map_or(1.0, |c| c.dwell_s),
            overrun: plan.candidates.as_ref().map_or(0.0, |c| c.overrun),
        });
    }
    if plan.campaign.instruments.iter().any(|i| i.has_rate()) {
        set_times(&plan.campaign, &mut paths);
    }
    let mut stations = Readings::default();
    paths.iter().for_each(|path| stations.append(&path.stations));
    let expectation = expect(&plan.campaign, &design, &stations);
    let stages = expect_stages(&plan.campaign, &stations);
    let numbered = paths.into_iter().zip(1..);
    let paths = numbered.map(|(path, n)| planned_path(&plan, &design, path, n, control)).collect();
    PlanReport { plan, design, expectation, stages, paths, chosen }
}

fn planned_path(
    plan: &Plan,
    design: &Design,
    path: Path,
    number: usize,
    control: Control,
) -> PlannedPath {
    let (campaign, settings) = (&plan.campaign, &plan.program);
    let stem = file_name(&path.name, number);
    let index = path.stations.instruments.first().copied().unwrap_or(0);
    let instrument = &campaign.instruments[index as usize];
    let mut stations = path.stations.clone();
    if stations.times_s.iter().all(|t| *t == 0.0) {
        stations.times_s = station_times_s(campaign, &path);
    }
    let sided = instrument.kind.triggers() || path.overrun > 0.0;
    let table = stations.poses(&campaign.machine, instrument.direction, sided);
    let text = program(campaign, &path, settings, control);
    let check = match &text {
        Ok(text) => Ok(check(campaign, &path, settings, text, control)),
        Err(error) => Err(error.to_string()),
    };
    let hits = text.is_ok() && instrument.kind == Kind::TouchProbeBall;
    let program = text.ok().map(|text| (format!("{stem}.{}", extension(control)), text));
    let beside = hits.then(|| program_files(campaign, control)).into_iter().flatten();
    let table = (format!("{stem}.csv"), table.into_bytes());
    let files = program
        .into_iter()
        .chain([table])
        .chain(beside.map(|(name, text)| (name, text.into_bytes())))
        .collect();
    let channels = instrument.kind.channels();
    PlannedPath { seen: seen(design, &path.stations), channels, path, check, files }
}

/// How files of a control's programs usually end.
pub fn extension(control: Control) -> &'static str {
    match control {
        Control::Fanuc | Control::Haas => "nc",
        Control::LinuxCnc => "ngc",
        Control::Sinumerik840d => "mpf",
        Control::Heidenhain => "h",
    }
}

/// Letters and digits of a name of people; the number keeps two of one name apart.
pub fn file_name(name: &str, number: usize) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    format!("{number:02}-{}", name.chars().take(40).map(plain).collect::<String>())
}

/// Tool point (mm) and tool axis at every station of the nominal machine, on the workpiece.
pub fn tools(campaign: &Campaign, stations: &Readings) -> Vec<(Vec3, Vec3)> {
    let none = ErrorValues::default();
    let of = |(command, instrument): (_, &u32)| {
        let instrument = &campaign.instruments[*instrument as usize];
        let pose = campaign.machine.pose(command, &none);
        let r = pose.linear();
        (r * instrument.tool_point_mm + pose.shift_mm(), r.column(2).into_owned())
    };
    stations.commands.iter().zip(&stations.instruments).map(of).collect()
}
