//! The machine: what it is, where its tool is, and one error of it put into its file.

use super::machine::{Draft, draft};
use crate::body::Body;
use crate::desk::{Desk, Job, Reply};
use crate::frame::{Array, Frame};
use crate::project::version;
use crate::refusal::{Refusal, diagnostics_json};
use serde_json::{Value, json};
use trueaxis::describe::{self, set_error as put_error};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::Pose;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::Approach;
use trueaxis::machine::file::Folder;
use trueaxis::machine::heat::Conditions;
use trueaxis::report::{PoseReport, check_json, description_json, pose_json};
use trueaxis::simulate::collide::{BodyModel, load_models};

/// All of the machine; of one that cannot be used, what is wrong with it.
pub(super) fn describe(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["machine", "text"])?;
    let Draft { machine, text, problems, .. } = draft(desk, &body)?;
    let mut document =
        json!({ "links": [], "errors": [], "sensors": [], "tools": [], "models": [] });
    if let Some(machine) = &machine {
        document = description_json(&describe::describe(machine, Some(&text)));
    }
    document["check"] = check_json(machine.as_ref(), &problems.clone().sorted());
    document["version"] = json!(version(text.as_bytes()));
    document["text"] = json!(text);
    Ok(Reply::Json(document))
}

/// The surfaces of its models, those of STL files too.
pub(super) fn models(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["machine", "text"])?;
    let Draft { machine, path, mut problems, .. } = draft(desk, &body)?;
    let Some(machine) = machine else { return Err(Refusal::unusable(&problems)) };
    let models = load_models(&disk(), &machine, &path, &mut problems);
    let (list, corners) = surfaces(&models);
    let frame = Frame::new()
        .say("models", list)
        .say("diagnostics", diagnostics_json(&problems).into())
        .with("corners_mm", corners);
    Ok(Reply::Frame(frame))
}

/// What the page draws of models: their names and places, and the corners of their triangles.
pub(super) fn surfaces(models: &[BodyModel]) -> (Value, Array) {
    let list = models.iter().map(|model| {
        json!({
            "name": model.name,
            "body": model.node,
            "placement": twelve(&model.placement),
            "triangles": model.mesh.triangles().len(),
        })
    });
    let corners = models.iter().flat_map(|model| model.mesh.triangles()).flatten();
    let corners = corners.flat_map(|c| [c.x as f32, c.y as f32, c.z as f32]);
    (list.collect(), Array::F32(corners.collect()))
}

/// Nominal and actual place of the tool and of every body at one position.
pub(super) fn pose(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let known = ["machine", "text", "at", "tool_length_mm", "temperature"];
    let body = Body::of(body, &known)?;
    let Draft { machine, mut problems, .. } = draft(desk, &body)?;
    let Some(mut machine) = machine else { return Err(Refusal::unusable(&problems)) };
    if let Some(length_mm) = body.optional_number("tool_length_mm")? {
        machine = machine.with_tip(Vec3::new(0.0, 0.0, -length_mm));
    }
    let warm = match body.optional_text("temperature")? {
        Some(text) => Conditions::typed("temperature", text, &mut problems)
            .and_then(|conditions| machine.at(&conditions, &mut problems)),
        None => Some(machine),
    };
    let place = Place::whole("at");
    let at = body.numbers("at")?;
    let report = warm.as_ref().and_then(|machine| {
        let command = describe::command(machine, at, &place, &mut problems)?;
        PoseReport::at(machine, &command, &Approach::default(), &place, &mut problems)
    });
    let Some(report) = report.filter(|_| !problems.has_errors()) else {
        return Err(Refusal::unusable(&problems));
    };
    Ok(Reply::Frame(pose_frame(&report, &problems)))
}

fn pose_frame(report: &PoseReport<'_>, problems: &Diagnostics) -> Frame {
    let bodies = report.bodies();
    let names: Vec<&str> = bodies.iter().map(|(name, _)| &**name).collect();
    let all = |which: usize| bodies.iter().flat_map(|(_, poses)| twelve(&poses[which])).collect();
    Frame::new()
        .say("pose", pose_json(report))
        .say("bodies", names.into())
        .say("diagnostics", diagnostics_json(problems).into())
        .with("nominal", Array::F64(all(0)))
        .with("actual", Array::F64(all(1)))
}

/// Rotation row by row, then origin in mm.
pub(super) fn twelve<To, From>(pose: &Pose<To, From>) -> [f64; 12] {
    let (r, o) = (pose.linear(), pose.shift_mm());
    let row = |i: usize| [r[(i, 0)], r[(i, 1)], r[(i, 2)]];
    let ([a, b, c], [d, e, f], [g, h, i]) = (row(0), row(1), row(2));
    [a, b, c, d, e, f, g, h, i, o.x, o.y, o.z]
}

/// The text of the machine file with one error in it; nothing is saved.
pub(super) fn set_error(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["machine", "text", "error", "value"])?;
    let name = body.text("machine")?;
    let path = desk.project.path(name)?;
    let (error, value) = (body.text("error")?, body.text("value")?);
    let folder = Folder::of(&disk(), &path);
    let text = put_error(body.text("text")?, name, &folder, error, value)
        .map_err(|problems| Refusal::unusable(&problems))?;
    let (_, problems) = Machine::check(name, &text, &folder);
    Ok(Reply::Json(json!({ "text": text, "diagnostics": diagnostics_json(&problems) })))
}
