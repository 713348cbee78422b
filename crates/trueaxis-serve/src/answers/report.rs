//! The pages of the command line, kept for the page to show.

use super::evaluate::judged;
use super::identify::identified;
use super::predict::study;
use super::wants::control;
use crate::body::{Body, short};
use crate::desk::{Desk, Job, Reply};
use crate::refusal::Refusal;
use serde_json::{Value, json};
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::input::Place;
use trueaxis::plan::{chosen, planned};
use trueaxis::predict::holes::{is_hole_study, predict_holes, read_hole_study};
use trueaxis::report::{
    self, DrawingError, comparison_html, evaluation_html, holes_html, identification_html,
    plan_html,
};
use trueaxis::verify::compare::{compare, read_comparison};

const VERBS: &str = "predict, simulate, plan, identify, evaluate or verify";

/// Makes a report and says where it is.
pub(super) fn report(desk: &Desk, body: &Value, job: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["verb", "file", "machine", "standard", "dialect"])?;
    let verb = body.text("verb")?;
    let name = body.text("file")?;
    let path = desk.project.path(name)?;
    let page = match verb {
        "predict" => prediction(&path, job)?,
        "simulate" => {
            let request = json!({ "machine": body.text("machine")?, "program": name });
            super::simulate::page(desk, &request, job)?
        }
        "plan" => plan(&body, &path)?,
        "identify" => {
            let identified = identified(&path, |_| Ok(None), job)?;
            identification_html(&identified.report()).map_err(undrawn)?
        }
        "evaluate" => {
            let request = json!({ "standard": body.text("standard")?, "path": name });
            let judged = judged(desk, &Body::of(&request, &["standard", "path"])?)?;
            judged.told(evaluation_html).map_err(undrawn)?
        }
        "verify" => comparison(&path)?,
        _ => return Err(Refusal::bad(format!("`{}` has no report", short(verb)), VERBS)),
    };
    let bytes = page.len();
    let number = desk.reports.put(page);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(Reply::Json(json!({
        "url": format!("/report/{number}"),
        "bytes": bytes,
        "name": format!("{stem}-{verb}.html"),
    })))
}

pub(super) fn undrawn(error: DrawingError) -> Refusal {
    Refusal::new(422, "no-report", error.to_string(), "the numbers are in the other tabs")
}

fn prediction(path: &Path, job: &Job) -> Result<String, Refusal> {
    if is_hole_study(&disk(), path) {
        let (study, problems) = read_hole_study(&disk(), path);
        let Some(study) = study.filter(|_| !problems.has_errors()) else {
            return Err(Refusal::unusable(&problems));
        };
        let found = predict_holes(&study).map_err(|problems| Refusal::unusable(&problems))?;
        return holes_html(&study, &found).map_err(undrawn);
    }
    let (study, _) = study(path)?;
    let prediction = super::predict::predicted(&study, job)?;
    report::html(&study, &prediction).map_err(undrawn)
}

fn plan(body: &Body<'_>, path: &Path) -> Result<String, Refusal> {
    let control = control(body)?;
    let (plan, mut problems) = super::plan::read(path)?;
    let chosen = chosen(&plan, &mut problems);
    if problems.has_errors() {
        return Err(Refusal::unusable(&problems));
    }
    let design = plan.campaign.design();
    plan_html(&planned(&plan, &design, chosen, control)).map_err(undrawn)
}

fn comparison(path: &Path) -> Result<String, Refusal> {
    let (task, mut problems) = read_comparison(&disk(), path);
    let Some(task) = task.filter(|_| !problems.has_errors()) else {
        return Err(Refusal::unusable(&problems));
    };
    let verified = compare(&task).map_err(|error| {
        let hint = "do the readings belong to this campaign: columns, units, order of channels?";
        let place = Place::whole(&path.display().to_string());
        problems.error("cannot-compare", place, error.to_string(), hint);
        Refusal::unusable(&problems)
    })?;
    comparison_html(&task, &verified).map_err(undrawn)
}
