//! `[compensation]` of a campaign whose lasers are read before and after it.

use super::axis_of;
use std::path::Path;
use trueaxis_correct::compensate::not_twice;
use trueaxis_correct::compensate::tables::content::Content;
use trueaxis_correct::compensate::tables::control::Control;
use trueaxis_correct::compensate::tables::{Order, Target, compile};
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Place, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::heat::Conditions;
use trueaxis_measure::measure::virtual_campaign::{VirtualCampaign, read_virtual};
use trueaxis_measure::measure::{Campaign, Kind, read_campaign};
use trueaxis_predict::predict::holes::Compensation;

/// What is measured, and what is compensated.
pub struct BeforeAfter {
    /// The campaign.
    pub campaign: Campaign,
    /// Its paths and the machine of `[truth]`.
    pub real: VirtualCampaign,
    /// The compensations, one after the other.
    pub states: Vec<Compensation>,
    /// The machine file at the temperatures that the compensation reads.
    pub model: Machine,
    /// Where the values come from.
    pub values: AppliedValues,
    /// The least increment of linear axes, mm.
    pub increment_mm: f64,
    /// That of rotary axes, rad.
    pub increment_rad: f64,
}

/// Where the values come from.
pub enum AppliedValues {
    /// Those of `compensate values`, calculated at each position.
    Values,
    /// Tables of a control, as it reads them.
    Tables(Vec<LoadedTables>),
}

/// A control that has read its tables.
pub struct LoadedTables {
    /// What they compensate.
    pub of: Compensation,
    /// How the control interpolates.
    pub control: Box<dyn Control + Send + Sync>,
    /// What it holds.
    pub content: Content,
}

/// The controls by their names.
const TARGETS: [(&str, Target); 7] = [
    ("csv", Target::Csv),
    ("linuxcnc", Target::LinuxCnc { trims: false }),
    ("linuxcnc-trims", Target::LinuxCnc { trims: true }),
    ("sinumerik", Target::Sinumerik),
    ("fanuc", Target::Fanuc),
    ("heidenhain", Target::Heidenhain),
    ("isg", Target::Isg),
];

/// Reads a campaign with its `[truth]`, `[disturb]` and `[compensation]`; `seed` instead of that of the file.
pub fn read_before_after(
    files: &Files,
    path: &Path,
    seed: Option<u64>,
) -> (Option<BeforeAfter>, Diagnostics) {
    let mut after = Diagnostics::new();
    let (read, mut problems) = read_campaign(files, path, |root, campaign| {
        let real = read_virtual(root, campaign, seed)?;
        check_paths(root, campaign, &real);
        let section = root.section("compensation", |s| read_compensation(s, campaign));
        let stated = section.unwrap_or_else(|| Some(Stated::default()))?;
        let place = Place::whole(&campaign.machine_path.display().to_string());
        let model = match &stated.conditions {
            None => campaign.machine.clone(),
            Some(conditions) => campaign.machine.at(conditions, &mut after)?,
        };
        let model = not_twice(&model, place.clone(), &mut after);
        let states = stated.states.unwrap_or_else(|| usual_states(&model));
        check_states(root, &model, &states)?;
        let values = match stated.target {
            None => AppliedValues::Values,
            Some(target) => loaded(root, &model, target, &states)?,
        };
        Some((real, model, states, values, stated.increment_mm, stated.increment_rad))
    });
    problems.append(after);
    let study =
        read.map(|(campaign, (real, model, states, values, increment_mm, increment_rad))| {
            BeforeAfter { campaign, real, states, model, values, increment_mm, increment_rad }
        });
    (study.filter(|_| !problems.has_errors()), problems)
}

/// What `[compensation]` states.
struct Stated {
    states: Option<Vec<Compensation>>,
    increment_mm: f64,
    increment_rad: f64,
    conditions: Option<Conditions>,
    target: Option<Target>,
}

impl Default for Stated {
    fn default() -> Self {
        let increment_rad = 1e-4f64.to_radians();
        Self { states: None, increment_mm: 1e-3, increment_rad, conditions: None, target: None }
    }
}

fn read_compensation(section: &Section<'_>, campaign: &Campaign) -> Option<Stated> {
    let mut stated = Stated::default();
    let increment = |key: &str, dimension, value: &mut f64| {
        let Some(found) = section.quantity(key, dimension) else { return };
        if found <= 0.0 {
            section.error("not-positive", format!("`{key}` is above zero"), "such as \"1 um\"");
        }
        *value = found;
    };
    increment("increment", Dimension::Length, &mut stated.increment_mm);
    increment("increment_deg", Dimension::Angle, &mut stated.increment_rad);
    if let Some(item) = section.get("states") {
        stated.states = Some(item.list()?.iter().map(read_state).collect::<Option<_>>()?);
        if stated.states.as_ref().is_some_and(Vec::is_empty) {
            item.error("bad-list", "no state is named".to_owned(), "[\"none\", \"machine\"]");
        }
    }
    // A sensor that is not named reads what it reads in the campaign.
    let read = section.section("temperature", Conditions::read);
    stated.conditions = read.map(|own| {
        let all = campaign.conditions.iter().flat_map(Conditions::readings);
        all.fold(own, |found, (sensor, celsius)| found.with_reading(sensor, celsius))
    });
    if let Some(item) = section.get("tables") {
        let name = item.text()?;
        let found = TARGETS.into_iter().find(|(known, _)| *known == name);
        if found.is_none() {
            let names = TARGETS.map(|(known, _)| known).join(", ");
            item.error("unknown-target", format!("unknown control `{name}`"), &names);
        }
        stated.target = Some(found?.1);
    }
    Some(stated)
}

fn read_state(item: &Item<'_>) -> Option<Compensation> {
    let word = item.text()?;
    let found = Compensation::ALL.into_iter().find(|c| c.name() == word);
    if found.is_none() {
        let message = format!("`{word}` is no compensation");
        item.error("unknown-word", message, "none, machine or comprehensive");
    }
    found
}

/// All that differ: without a workpiece that grows, the comprehensive error is that of the machine.
fn usual_states(model: &Machine) -> Vec<Compensation> {
    let all = Compensation::ALL.into_iter();
    all.filter(|c| *c != Compensation::Comprehensive || model.growth().is_some()).collect()
}

/// A comprehensive compensation needs to know its workpiece.
fn check_states(root: &Section<'_>, model: &Machine, states: &[Compensation]) -> Option<()> {
    if !states.contains(&Compensation::Comprehensive) || model.growth().is_some() {
        return Some(());
    }
    let (code, message, hint) = match &model.heat().workpiece {
        None => (
            "no-workpiece",
            "the machine file does not say how its workpiece expands",
            "add [workpiece] expansion = \"13.2 um/(m K)\" to it, or leave out \"comprehensive\""
                .to_owned(),
        ),
        Some(workpiece) => (
            "no-workpiece-temperature",
            "the temperature of the workpiece is not given: its growth cannot be compensated",
            format!(
                "[temperature] {} = \"20 degC\", or leave out \"comprehensive\"",
                workpiece.sensors.first().map_or("workpiece", |s| s.name.as_str())
            ),
        ),
    };
    root.error(code, message.to_owned(), &hint);
    None
}

/// Every path is a positioning test with a laser along one linear axis.
fn check_paths(root: &Section<'_>, campaign: &Campaign, real: &VirtualCampaign) {
    for path in &real.paths {
        let kinds =
            path.stations.instruments.iter().map(|i| campaign.instruments[*i as usize].kind);
        let mut kinds = kinds.collect::<Vec<_>>().into_iter();
        if kinds.any(|kind| kind != Kind::LaserLine) || axis_of(campaign, path).is_none() {
            let message = format!("path {} is no positioning test of a linear axis", path.name);
            let hint = "kind = \"targets\", axis = \"X\", and a laser-line along that axis";
            root.error("no-positioning", message, hint);
        }
    }
}

fn loaded(
    root: &Section<'_>,
    model: &Machine,
    target: Target,
    states: &[Compensation],
) -> Option<AppliedValues> {
    let mut all = Vec::new();
    for of in states.iter().copied().filter(|c| *c != Compensation::None) {
        let machine = match of {
            Compensation::Comprehensive => model.clone(),
            Compensation::Machine | Compensation::None => model.without_growth(),
        };
        match compile(&machine, &Order::of(target)) {
            Ok(compiled) => all.push(LoadedTables {
                of,
                control: target.control(),
                content: compiled.content(),
            }),
            Err(error) => {
                let hint = "trueaxis compensate tables MACHINE.toml --target … shows details";
                root.error("no-tables", error.to_string(), hint);
                return None;
            }
        }
    }
    Some(AppliedValues::Tables(all))
}
