//! What a measurement will tell.

use super::wants::control;
use crate::body::Body;
use crate::desk::{Desk, Job, Reply};
use crate::frame::{Array, Frame};
use crate::refusal::{Refusal, diagnostics_json};
use serde_json::{Value, json};
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::AxisKind;
use trueaxis::measure::Readings;
use trueaxis::plan::PlanReport;
use trueaxis::plan::{Plan, PlannedPath, chosen, planned, read_plan, tools};
use trueaxis::report::plan_json;

/// A plan that may be asked, and what was found in its file.
pub(super) fn read(path: &Path) -> Result<(Plan, Diagnostics), Refusal> {
    let (plan, problems) = read_plan(&disk(), path);
    match plan.filter(|_| !problems.has_errors()) {
        Some(plan) => Ok((plan, problems)),
        None => Err(Refusal::unusable(&problems)),
    }
}

/// The whole plan: paths, programs, what to expect.
pub(super) fn plan(desk: &Desk, body: &Value, job: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["campaign", "dialect"])?;
    let control = control(&body)?;
    let (plan, mut problems) = read(&desk.project.path(body.text("campaign")?)?)?;
    job.tell(0.1);
    let chosen = chosen(&plan, &mut problems);
    if problems.has_errors() {
        return Err(Refusal::unusable(&problems));
    }
    let design = plan.campaign.design();
    let report = planned(&plan, &design, chosen, control);
    Ok(Reply::Frame(frame(desk, &report, &problems)))
}

fn frame(desk: &Desk, report: &PlanReport<'_>, problems: &Diagnostics) -> Frame {
    let campaign = &report.plan.campaign;
    let machine = &campaign.machine;
    let stations = || report.paths.iter().map(|path| &path.path.stations);
    let commands = stations().flat_map(|readings| commands(machine, readings));
    let tools = stations().flat_map(|readings| tools(campaign, readings));
    let tools = tools.flat_map(|(point, axis)| [point, axis]).flat_map(|v| [v.x, v.y, v.z]);
    Frame::new()
        .say("document", plan_json(report))
        .say("machine", json!(desk.project.name_of(&campaign.machine_path)))
        .say("axes", axes(machine))
        .say("paths", report.paths.iter().map(|path| path_json(report, path)).collect())
        .say("diagnostics", diagnostics_json(problems).into())
        .with("commands", Array::F64(commands.collect()))
        .with("tools", Array::F64(tools.collect()))
}

fn path_json(report: &PlanReport<'_>, planned: &PlannedPath) -> Value {
    let stations = &planned.path.stations;
    let index = stations.instruments.first().copied().unwrap_or(0);
    let instrument = &report.plan.campaign.instruments[index as usize];
    let file = |(name, text): &(String, Vec<u8>)| json!({ "name": name, "text": String::from_utf8_lossy(text) });
    json!({
        "name": planned.path.name,
        "instrument": instrument.name,
        "kind": instrument.kind.name(),
        "stations": stations.len(),
        "files": planned.files.iter().map(file).collect::<Vec<_>>(),
    })
}

/// Names of the axes with the units of their positions.
pub(super) fn axes(machine: &Machine) -> Value {
    let unit = |kind| if kind == AxisKind::Rotary { "deg" } else { "mm" };
    let axes = machine.axes().iter();
    axes.map(|a| json!({ "name": a.name.to_string(), "unit": unit(a.kind) })).collect()
}

/// The positions of all axes at all stations, mm and deg.
fn commands(machine: &Machine, readings: &Readings) -> Vec<f64> {
    let shown = |(axis, q): (&trueaxis::machine::axis::Axis, &f64)| match axis.kind {
        AxisKind::Linear => *q,
        AxisKind::Rotary => q.to_degrees(),
    };
    let of = |command| machine.axes().iter().zip(command).map(shown);
    readings.commands.iter().flat_map(of).collect()
}
