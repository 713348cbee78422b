//! What the machine is like, from readings.

use crate::body::Body;
use crate::desk::{Desk, Job, Reply};
use crate::frame::{Array, Frame};
use crate::refusal::{Refusal, diagnostics_json};
use serde_json::{Value, json};
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::identify::errors::{Identification, identify as identify_errors};
use trueaxis::identify::machine_file::machine_file;
use trueaxis::identify::records::{Dropped, Options, Records, read_options, read_records_with};
use trueaxis::input::Diagnostics;
use trueaxis::machine::file::Folder;
use trueaxis::measure::{Campaign, read_campaign};
use trueaxis::report::{Arrow, IdentificationReport, identification_json};

/// A campaign with its readings and what they tell.
pub(super) struct Identified {
    campaign: Campaign,
    options: Options,
    records: Records,
    found: Identification,
    problems: Diagnostics,
}

impl Identified {
    pub(super) fn report(&self) -> IdentificationReport<'_> {
        IdentificationReport {
            campaign: &self.campaign,
            options: &self.options,
            records: &self.records,
            found: &self.found,
            conventions: self.found.conventions.as_ref(),
        }
    }
}

/// Reads and identifies; `dropped` is the table in place of those of one instrument.
pub(super) fn identified<'a>(
    path: &Path,
    dropped: impl FnOnce(&Campaign) -> Result<Option<Dropped<'a>>, Refusal>,
    job: &Job,
) -> Result<Identified, Refusal> {
    let (read, mut problems) = read_campaign(&disk(), path, |root, _| Some(read_options(root)));
    let Some((campaign, options)) = read else { return Err(Refusal::unusable(&problems)) };
    let dropped = dropped(&campaign)?;
    let records = read_records_with(&campaign, dropped, &mut problems);
    job.tell(0.1);
    let found = records.as_ref().filter(|_| !problems.has_errors());
    let found =
        found.and_then(|records| identify_errors(&campaign, &options, records, &mut problems));
    match (records, found.filter(|_| !problems.has_errors())) {
        (Some(records), Some(found)) => {
            Ok(Identified { campaign, options, records, found, problems })
        }
        _ => Err(Refusal::unusable(&problems)),
    }
}

/// Errors with their uncertainty, residuals as arrows, correlations, the machine file.
pub(super) fn identify(desk: &Desk, body: &Value, job: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["campaign", "instrument", "name", "text"])?;
    let path = desk.project.path(body.text("campaign")?)?;
    let identified = identified(&path, |campaign| dropped(&body, campaign), job)?;
    let campaign = &identified.campaign;
    let report = identified.report();
    let mut document = identification_json(&report);
    document["diagnostics"] = diagnostics_json(&identified.problems).into();
    let seen: Vec<_> = report.found.found.iter().filter(|f| f.value.is_some()).collect();
    let correlation = seen.iter().flat_map(|a| seen.iter().map(|b| (a.number, b.number)));
    let correlation = correlation.map(|(a, b)| report.correlation(a, b)).collect();
    let arrows = report.arrows();
    let um =
        |of: fn(&Arrow) -> Vec3| Array::F32(three(&arrows, of).map(|v| (v * 1e3) as f32).collect());
    let names: Vec<&str> = seen.iter().map(|f| f.name.as_str()).collect();
    let frame = Frame::new()
        .say("document", document)
        .say("machine", json!(desk.project.name_of(&campaign.machine_path)))
        .say("instruments", instruments(desk, campaign))
        .say("correlation", names.into())
        .say("machine_file", machine_file_json(&identified))
        .say("diagnostics", diagnostics_json(&identified.problems).into())
        .with("correlation", Array::F64(correlation))
        .with("at_mm", Array::F64(three(&arrows, |a| a.at_mm).collect()))
        .with("before_um", um(|a| a.before_mm))
        .with("after_um", um(|a| a.after_mm));
    Ok(Reply::Frame(frame))
}

fn three(arrows: &[Arrow], of: fn(&Arrow) -> Vec3) -> impl Iterator<Item = f64> {
    arrows.iter().map(of).flat_map(|v| [v.x, v.y, v.z])
}

/// The table that somebody dropped, and whose it is.
fn dropped<'a>(body: &Body<'a>, campaign: &Campaign) -> Result<Option<Dropped<'a>>, Refusal> {
    let Some(text) = body.optional_text("text")? else { return Ok(None) };
    let name = body.optional_text("name")?.unwrap_or("dropped readings");
    let names =
        || campaign.instruments.iter().map(|i| i.name.as_str()).collect::<Vec<_>>().join(", ");
    let instrument = match (body.optional_text("instrument")?, campaign.instruments.len()) {
        (None, 1) => Some(0),
        (None, _) => {
            let message = "whose readings these are is not said";
            return Err(Refusal::bad(message, &format!("`instrument`, one of {}", names())));
        }
        (Some(wanted), _) => campaign.instrument(wanted),
    };
    let Some(instrument) = instrument else {
        let message = "the campaign has no such instrument";
        return Err(Refusal::bad(message, &format!("`instrument`, one of {}", names())));
    };
    Ok(Some(Dropped { instrument, name: short_name(name), text }))
}

fn short_name(name: &str) -> &str {
    let end = name.char_indices().nth(100).map_or(name.len(), |(i, _)| i);
    &name[..end]
}

fn instruments(desk: &Desk, campaign: &Campaign) -> Value {
    let all = campaign.instruments.iter().zip(&campaign.tables);
    let one = |(instrument, tables): (&trueaxis::measure::Instrument, &Vec<std::path::PathBuf>)| {
        let tables: Vec<_> = tables.iter().filter_map(|path| desk.project.name_of(path)).collect();
        let kind = instrument.kind;
        json!({ "name": instrument.name, "kind": kind.name(), "channels": kind.channels(), "tables": tables })
    };
    all.map(one).collect()
}

/// The machine file with what was found; none if it cannot be edited.
fn machine_file_json(identified: &Identified) -> Value {
    let Identified { campaign, options, found, .. } = identified;
    let mut unread = Diagnostics::new();
    let Some(old) = disk().text(&campaign.machine_path, "the machine file", &mut unread) else {
        return Value::Null;
    };
    let beside = Folder::of(&trueaxis::files::disk(), &campaign.machine_path);
    let Ok(made) = machine_file(campaign, found, options.date.as_deref(), &old, &beside) else {
        return Value::Null;
    };
    let tables = made.tables.iter().map(|(name, text)| json!({ "name": name, "text": text }));
    json!({ "text": made.text, "tables": tables.collect::<Vec<_>>() })
}
