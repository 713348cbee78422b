//! What a measurement will show, before it is made.

use crate::desk::{Desk, Job};
use crate::frame::Array;
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request, ask};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use trueaxis::JsonSchema;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Axis, AxisKind};
use trueaxis::measure::Readings;
use trueaxis::plan::{PlanReport, PlannedPath, tools};
use trueaxis::questions::PlanMeasurement;
use trueaxis::report::{DiagnosticEntry, PlanDocument};

/// The control of programs where a request names none.
pub(super) const SINUMERIK: &str = "sinumerik";

/// The plan of a campaign: paths, programs, expected uncertainties.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PlanRequest {
    /// The campaign file.
    campaign: String,
    /// The control that the programs are for, as `--control` of the command line; `sinumerik` if it is left out.
    dialect: Option<String>,
}

/// A plan. Arrays: `commands` (f64: the axis positions of all stations of all paths, mm and degrees), `tools`
/// (f64: for each station the tip, mm, then the tool axis, both in the workpiece frame).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct PlanAnswer<'a> {
    /// The document of `trueaxis plan`.
    document: PlanDocument<'a>,
    /// The machine file below the project folder; null if it is outside.
    machine: Option<String>,
    /// The axes in the order of the commands.
    axes: Vec<AxisUnitEntry>,
    /// The paths, in the order of the arrays.
    paths: Vec<PlannedPathEntry<'a>>,
    /// The problems found in the campaign.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// An axis with the unit of its positions.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct AxisUnitEntry {
    /// Its name.
    name: String,
    /// The unit.
    #[schemars(extend("enum" = ["mm", "deg"]))]
    unit: &'static str,
}

/// A path of the plan.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct PlannedPathEntry<'a> {
    /// Its name.
    name: &'a str,
    /// Its instrument.
    instrument: &'a str,
    /// The kind of the instrument.
    kind: &'static str,
    /// How many stations it has.
    stations: usize,
    /// Its programs.
    files: Vec<TextEntry<'a>>,
}

/// A file by name and text.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct TextEntry<'a> {
    /// Its name.
    pub(super) name: &'a str,
    /// Its text.
    pub(super) text: Cow<'a, str>,
}

impl Request for PlanRequest {
    type Answer<'a> = PlanAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let question = PlanMeasurement {
            campaign: desk.project.path(&self.campaign)?,
            control: self.dialect.unwrap_or_else(|| SINUMERIK.to_owned()),
            output: None,
            write_unsafe: false,
        };
        let (plan, problems) = ask(&question, job)?;
        Ok(reply(desk, &plan.found, &problems))
    }
}

fn reply(desk: &Desk, report: &PlanReport, problems: &Diagnostics) -> Reply<PlanRequest> {
    let campaign = &report.plan.campaign;
    let machine = &campaign.machine;
    let stations = || report.paths.iter().map(|path| &path.path.stations);
    let commands = stations().flat_map(|readings| commands(machine, readings));
    let tools = stations().flat_map(|readings| tools(campaign, readings));
    let tools = tools.flat_map(|(point, axis)| [point, axis]).flat_map(|v| [v.x, v.y, v.z]);
    let arrays =
        vec![("commands", Array::F64(commands.collect())), ("tools", Array::F64(tools.collect()))];
    let answer = PlanAnswer {
        document: PlanDocument::of(report),
        machine: desk.project.name_of(&campaign.machine_path),
        axes: machine.axes().iter().map(AxisUnitEntry::from).collect(),
        paths: report.paths.iter().map(|path| PlannedPathEntry::of(report, path)).collect(),
        diagnostics: entries(problems),
    };
    Reply::frame(&answer, arrays)
}

impl From<&Axis> for AxisUnitEntry {
    fn from(axis: &Axis) -> Self {
        let unit = if axis.kind == AxisKind::Rotary { "deg" } else { "mm" };
        Self { name: axis.name.to_string(), unit }
    }
}

impl<'a> PlannedPathEntry<'a> {
    fn of(report: &'a PlanReport, planned: &'a PlannedPath) -> Self {
        let stations = &planned.path.stations;
        let index = stations.instruments.first().copied().unwrap_or(0);
        let instrument = &report.plan.campaign.instruments[index as usize];
        let file = |(name, text): &'a (String, Vec<u8>)| TextEntry {
            name,
            text: String::from_utf8_lossy(text),
        };
        Self {
            name: &planned.path.name,
            instrument: &instrument.name,
            kind: instrument.kind.name(),
            stations: stations.len(),
            files: planned.files.iter().map(file).collect(),
        }
    }
}

/// The positions of all axes at all stations, mm and deg.
fn commands(machine: &Machine, readings: &Readings) -> Vec<f64> {
    let shown = |(axis, q): (&Axis, &f64)| match axis.kind {
        AxisKind::Linear => *q,
        AxisKind::Rotary => q.to_degrees(),
    };
    let of = |command| machine.axes().iter().zip(command).map(shown);
    readings.commands.iter().flat_map(of).collect()
}
