//! What becomes of a plan: every path with its program, what that does, and what the path sees.

use super::{Chosen, Expectation, Plan, StageExpectation, choose, expect, seen};
use super::{expect_stages, planned_design};
use crate::plan::program::{ProgramCheck, check, program, program_files};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_measure::measure::path::Path;
use trueaxis_measure::measure::virtual_campaign::set_times;
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
            dwell_s: 1.0,
            overrun: 0.0,
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
    let table = path.stations.poses(&campaign.machine);
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
