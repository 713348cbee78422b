//! The test piece before it is cut, and what it would be if.

use super::wants::{errors, setting};
use crate::body::Body;
use crate::desk::{Desk, Job, Reply};
use crate::frame::{Array, Frame};
use crate::refusal::{Refusal, diagnostics_json};
use serde_json::{Value, json};
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::axis::AxisKind;
use trueaxis::machine::heat::Conditions;
use trueaxis::part::fit::circle::Zone;
use trueaxis::predict::holes::{is_hole_study, predict_holes, read_hole_study};
use trueaxis::predict::{
    Error, Prediction, SectionResult, Study, WhatIf, predict, preview, read_study,
};
use trueaxis::report;

/// The whole prediction, as `trueaxis predict --no-report` computes it.
pub(super) fn whole(desk: &Desk, body: &Value, job: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["study"])?;
    let path = desk.project.path(body.text("study")?)?;
    if is_hole_study(&disk(), &path) {
        return holes(&path);
    }
    let (study, problems) = study(&path)?;
    let prediction = predicted(&study, job)?;
    Ok(Reply::Frame(frame(desk, &study, &prediction, &problems)))
}

/// The same without drawing machines and seeking corrections, and with changes: as fast as somebody drags a slider.
pub(super) fn what_if(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let known = ["study", "errors", "setting_deg", "tool_length_mm", "temperature"];
    let body = Body::of(body, &known)?;
    let (mut study, mut problems) = study(&desk.project.path(body.text("study")?)?)?;
    study.sampling = None;
    let conditions = match body.optional_text("temperature")? {
        Some(text) => Conditions::typed("temperature", text, &mut problems),
        None => None,
    };
    let changes = WhatIf {
        errors: errors(&body, "errors")?,
        setting_rad: setting(&body, "setting_deg")?,
        tool_length_mm: body.optional_number("tool_length_mm")?,
        conditions,
    };
    let study = changes.put(study, &mut problems).filter(|_| !problems.has_errors());
    let Some(study) = study else { return Err(Refusal::unusable(&problems)) };
    let prediction = preview(&study).map_err(|e| refused(&e))?;
    Ok(Reply::Frame(frame(desk, &study, &prediction, &problems)))
}

/// A study that may be predicted, and what was found in its file.
pub(super) fn study(path: &Path) -> Result<(Study, Diagnostics), Refusal> {
    let (study, problems) = read_study(&disk(), path);
    match study.filter(|_| !problems.has_errors()) {
        Some(study) => Ok((study, problems)),
        None => Err(Refusal::unusable(&problems)),
    }
}

/// The prediction, with its progress through the Monte Carlo samples.
pub(super) fn predicted(study: &Study, job: &Job) -> Result<Prediction, Refusal> {
    let samples = study.sampling.map_or(0, |s| s.samples).max(1);
    let tell = |done: usize| job.tell(done as f64 / samples as f64);
    predict(study, &tell).map_err(|e| refused(&e))
}

fn refused(error: &Error) -> Refusal {
    let hint = "change the setting, the tool or the mounting, and ask again";
    Refusal::new(422, error.code(), error.to_string(), hint)
}

fn frame(desk: &Desk, study: &Study, prediction: &Prediction, problems: &Diagnostics) -> Frame {
    let machine = &study.machine;
    let rotary = machine.axes().iter().filter(|a| a.kind == AxisKind::Rotary);
    let errors = machine.stated_errors().into_iter().map(|(_, name)| {
        json!({ "name": name.to_string(), "unit": if name.component.is_rotation() { "µrad" } else { "µm" } })
    });
    let frame = Frame::new()
        .say("kind", json!("test-piece"))
        .say("document", report::json(study, prediction))
        .say("machine", json!(desk.project.name_of(&study.machine_path)))
        .say("rotary", rotary.map(|a| a.name.to_string()).collect())
        .say("tool_length_mm", json!(-machine.tip_mm().z))
        .say("errors", errors.collect())
        .say("sensors", machine.heat().sensors().into())
        .say("sections", prediction.sections.iter().map(section_json).collect())
        .say("diagnostics", diagnostics_json(problems).into());
    with_sections(frame, prediction)
}

/// Height and fitted circles; the points of all sections stand in the arrays, one after the other.
fn section_json(result: &SectionResult) -> Value {
    let section = &result.section;
    let circles = &section.circles;
    let zones = [
        ("least squares", circles.lsc),
        ("minimum zone", circles.mzc),
        ("maximum inscribed", circles.mic),
        ("minimum circumscribed", circles.mcc),
    ];
    let zone = |(name, zone): (&str, Zone)| {
        json!({
            "name": name,
            "centre_mm": zone.center_mm,
            "radius_mm": zone.radius_mm,
            "inner_mm": zone.inner_mm,
            "outer_mm": zone.outer_mm,
        })
    };
    json!({
        "z_mm": section.z_mm,
        "height_mm": section.height_mm,
        "radius_mm": section.radius_mm,
        "points": section.azimuth_rad.len(),
        "circles": zones.map(zone),
    })
}

fn with_sections(frame: Frame, prediction: &Prediction) -> Frame {
    let sections = || prediction.sections.iter().map(|s| &s.section);
    let azimuth = sections().flat_map(|s| s.azimuth_rad.iter().map(|a| *a as f32)).collect();
    let error_um = sections().flat_map(|s| s.deviation_mm.iter().map(|e| (e * 1e3) as f32));
    let profile = sections().flat_map(|s| s.profile_mm.iter().flatten().copied());
    frame
        .with("azimuth_rad", Array::F32(azimuth))
        .with("error_um", Array::F32(error_um.collect()))
        .with("profile_mm", Array::F64(profile.collect()))
}

fn holes(path: &Path) -> Result<Reply, Refusal> {
    let (study, problems) = read_hole_study(&disk(), path);
    let Some(study) = study.filter(|_| !problems.has_errors()) else {
        return Err(Refusal::unusable(&problems));
    };
    let prediction = predict_holes(&study).map_err(|problems| Refusal::unusable(&problems))?;
    let frame = Frame::new()
        .say("kind", json!("holes"))
        .say("document", report::holes_json(&study, &prediction))
        .say("sensors", study.machine.heat().sensors().into())
        .say("diagnostics", diagnostics_json(&problems).into());
    let places = study.holes_mm.iter().flat_map(|p| [p.x, p.y, p.z]);
    let of_sets = prediction.sets.iter().flat_map(|set| &set.holes);
    let error_um =
        of_sets.flat_map(|h| [h.error_mm.x, h.error_mm.y, h.error_mm.z].map(|e| (e * 1e3) as f32));
    Ok(Reply::Frame(
        frame
            .with("holes_mm", Array::F64(places.collect()))
            .with("error_um", Array::F32(error_um.collect())),
    ))
}
