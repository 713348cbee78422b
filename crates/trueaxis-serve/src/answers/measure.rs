//! A campaign while it is measured: sheets of its stations, the readings so far, and a machine that is not there.

use super::shown::ShownEntry;
use crate::body::short;
use crate::desk::{Desk, Job};
use crate::made::{MadeEntry, versions};
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request, ask};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;
use trueaxis::JsonSchema;
use trueaxis::files::disk;
use trueaxis::input::{CsvTable, Diagnostics};
use trueaxis::machine::axis::AxisKind;
use trueaxis::measure::path::Path as MeasuredPath;
use trueaxis::measure::repeats::{self, Repeatability};
use trueaxis::measure::virtual_campaign::{
    Disturb, VirtualCampaign, measure, read_virtual, set_times,
};
use trueaxis::measure::{Campaign, Instrument, Readings, read_campaign, readings_file};
use trueaxis::questions::{Answer, Measure, PlanMeasurement};
use trueaxis::report::DiagnosticEntry;

/// Stations of a sheet; more are measured by a program, not by hand.
const MOST_STATIONS: usize = 20_000;

/// The sheets of a campaign: one table for each instrument, its readings still empty.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MeasureSheetRequest {
    /// The campaign file.
    campaign: String,
}

/// What is to be measured.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct MeasureSheetAnswer<'a> {
    /// The name of the campaign.
    name: &'a str,
    /// The name of the machine.
    machine: &'a str,
    /// The machine file below the project folder; null if it is outside.
    machine_file: Option<String>,
    /// A sheet for each instrument that has stations.
    sheets: Vec<SheetEntry<'a>>,
    /// The problems of the campaign.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// The stations of one instrument, as `identify` reads them.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SheetEntry<'a> {
    /// The instrument.
    instrument: &'a str,
    /// Its kind, as campaign files call it.
    kind: &'static str,
    /// Where the campaign has its readings, else where they can be saved: below the project folder.
    file: String,
    /// Whether the campaign names that file.
    named: bool,
    /// Whether it is there.
    there: bool,
    /// The columns.
    columns: Vec<SheetColumn>,
    /// The stations in their order: the cells of the columns; those of readings are empty.
    rows: Vec<Vec<String>>,
    /// The paths, in the order of the rows.
    paths: Vec<SheetPath<'a>>,
}

/// A column of a sheet.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SheetColumn {
    /// Its heading, with its unit, such as `x_um`; axes by their letters, mm or degrees.
    name: String,
    /// Whether it is read, not commanded.
    read: bool,
}

/// The stations of one path.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SheetPath<'a> {
    /// Its name.
    name: &'a str,
    /// How many stations it has.
    stations: usize,
}

/// A campaign with its paths: its own, or those that were chosen.
struct Stations {
    campaign: Campaign,
    paths: Vec<MeasuredPath>,
    /// All stations as a machine without disturbances passes them: with their sides, feeds and times.
    readings: Readings,
    problems: Diagnostics,
}

impl Stations {
    fn of(desk: &Desk, name: &str, job: &Job) -> Result<Self, Refusal> {
        let path = desk.project.path(name)?;
        // Candidates are no stations yet: the plan chooses among them.
        let (read, mut problems) = read_campaign(&disk(), &path, |root, campaign| {
            let is_chosen = root.get("candidates").is_some();
            Some(if is_chosen { None } else { Some(read_virtual(root, campaign, None)?) })
        });
        let Some((campaign, real)) = read.filter(|_| !problems.has_errors()) else {
            return Err(Refusal::unusable(&problems));
        };
        let (paths, readings) = match real {
            Some(real) => {
                let readings = passed(&campaign, &real);
                (real.paths, readings)
            }
            None => {
                let control = super::plan::SINUMERIK.to_owned();
                let question =
                    PlanMeasurement { campaign: path, control, output: None, write_unsafe: false };
                let (plan, found) = ask(&question, job)?;
                problems = found;
                let planned = plan.found.paths.into_iter();
                let mut paths: Vec<MeasuredPath> = planned.map(|planned| planned.path).collect();
                set_times(&campaign, &mut paths);
                let readings = joined(&paths);
                (paths, readings)
            }
        };
        if readings.len() > MOST_STATIONS {
            let message = format!("{} stations are more than a sheet holds", readings.len());
            let hint = "let the control log them, and open the log in Identify";
            return Err(Refusal::new(422, "too-many-stations", message, hint));
        }
        Ok(Self { campaign, paths, readings, problems })
    }
}

/// All stations as a machine without disturbances passes them; what the tables of the true machine do not reach can be
/// measured all the same.
fn passed(campaign: &Campaign, real: &VirtualCampaign) -> Readings {
    let count = real.paths.iter().map(|path| path.stations.len()).sum::<usize>();
    let disturb = Disturb::none(campaign.instruments.len());
    let real = VirtualCampaign { disturb, ..real.clone() };
    let passed = (count <= MOST_STATIONS).then(|| measure(campaign, &real).ok()).flatten();
    passed.map_or_else(|| joined(&real.paths), |measured| measured.readings)
}

/// All stations; places stay apart.
fn joined(paths: &[MeasuredPath]) -> Readings {
    let mut all = Readings::default();
    paths.iter().for_each(|path| all.append(&path.stations));
    all
}

impl Request for MeasureSheetRequest {
    type Answer<'a> = MeasureSheetAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let stations = Stations::of(desk, &self.campaign, job)?;
        let campaign = &stations.campaign;
        let folder = Path::new(&self.campaign).parent().unwrap_or(Path::new(""));
        let sheets = campaign.instruments.iter().enumerate().filter_map(|(index, instrument)| {
            let sheet = SheetEntry::of(&stations, (index as u32, instrument))?;
            let named = campaign.tables.get(index).and_then(|tables| tables.first());
            let file = match named {
                Some(path) => path.clone(),
                None => folder.join(readings_file(&instrument.name)),
            };
            let shown = file.display().to_string().replace('\\', "/");
            let there = desk.project.name_of(&file);
            Some(SheetEntry {
                named: named.is_some(),
                there: there.is_some(),
                file: there.unwrap_or(shown),
                ..sheet
            })
        });
        Ok(Reply::json(&MeasureSheetAnswer {
            name: &campaign.name,
            machine: campaign.machine.name(),
            machine_file: desk.project.name_of(&campaign.machine_path),
            sheets: sheets.collect(),
            diagnostics: entries(&stations.problems),
        }))
    }
}

impl<'a> SheetEntry<'a> {
    /// None for an instrument without stations.
    fn of(all: &'a Stations, (index, instrument): (u32, &'a Instrument)) -> Option<Self> {
        let campaign = &all.campaign;
        let mine = |path: &MeasuredPath| {
            path.stations.instruments.iter().filter(|of| **of == index).count()
        };
        let paths =
            all.paths.iter().map(|path| SheetPath { name: &path.name, stations: mine(path) });
        let text = all.readings.table(&campaign.machine, instrument, index);
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect());
        let names: Vec<String> = lines.next()?;
        let columns: Vec<SheetColumn> = names
            .into_iter()
            .map(|name| SheetColumn { read: is_read(campaign, instrument, &name), name })
            .collect();
        let empty = |row: Vec<String>| -> Vec<String> {
            let cells = row.into_iter().zip(&columns);
            cells.map(|(cell, column)| if column.read { String::new() } else { cell }).collect()
        };
        let rows: Vec<Vec<String>> = lines.map(empty).collect();
        (!rows.is_empty()).then(|| Self {
            instrument: &instrument.name,
            kind: instrument.kind.name(),
            file: String::new(),
            named: false,
            there: false,
            rows,
            columns,
            paths: paths.filter(|path| path.stations > 0).collect(),
        })
    }
}

/// Whether a column of a table of readings is read: the channels of the instrument; of a touch probe the linear axes,
/// which stand where it triggered.
fn is_read(campaign: &Campaign, instrument: &Instrument, name: &str) -> bool {
    if instrument.kind.triggers() {
        let mut axes = campaign.machine.axes().iter();
        return axes.any(|a| a.kind == AxisKind::Linear && a.name.to_string() == name);
    }
    let channel = name.rsplit_once('_').map_or(name, |(channel, _)| channel);
    instrument.kind.channels().contains(&channel)
        && ["um", "urad", "mm"].iter().any(|unit| name.ends_with(unit))
}

/// Looks at readings while they are taken.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MeasureCheckRequest {
    /// The campaign file.
    campaign: String,
    /// The instrument.
    instrument: String,
    /// The name of the table, for messages.
    name: String,
    /// The table: CSV as `identify` takes it.
    text: String,
}

/// What the readings so far say.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct MeasureCheckAnswer<'a> {
    /// How many readings.
    readings: usize,
    /// In how many places.
    places: usize,
    /// How many of these were read more than once.
    repeated: usize,
    /// Each channel; empty where nothing was repeated.
    channels: Vec<RepeatedChannel>,
    /// The problems of the table.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// The repeatability of a channel.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct RepeatedChannel {
    /// The channel.
    channel: &'static str,
    /// `um` or `urad`.
    unit: &'static str,
    /// The standard deviation of readings in one place, from all places with several. Unit: that of `unit`.
    s: f64,
    /// Its degrees of freedom.
    degrees_of_freedom: usize,
    /// The largest difference of two readings in one place. Unit: that of `unit`.
    largest_range: f64,
    /// The noise that the campaign states. Unit: that of `unit`.
    stated: f64,
}

impl Request for MeasureCheckRequest {
    type Answer<'a> = MeasureCheckAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let path = desk.project.path(&self.campaign)?;
        let (read, mut problems) = read_campaign(&disk(), &path, |_, _| Some(()));
        let Some((campaign, ())) = read else { return Err(Refusal::unusable(&problems)) };
        let index = campaign.instruments.iter().position(|i| i.name == self.instrument);
        let Some(index) = index else {
            let message = format!("the campaign has no instrument `{}`", short(&self.instrument));
            let all: Vec<&str> = campaign.instruments.iter().map(|i| i.name.as_str()).collect();
            return Err(Refusal::bad(message, &all.join(", ")));
        };
        let instrument = &campaign.instruments[index];
        let table = CsvTable::parse(&short(&self.name), &self.text, &mut problems);
        let machine = &campaign.machine;
        let readings = Readings::parse(&table, machine, instrument, index as u32, &mut problems);
        let Some(readings) = readings.filter(|_| !problems.has_errors()) else {
            return Err(Refusal::unusable(&problems));
        };
        let places = repeats::places(&readings, |_| true);
        let found = repeats::repeatability(instrument, &readings, &places);
        let channels =
            found.iter().enumerate().map(|(c, of)| RepeatedChannel::of(instrument, c, of));
        Ok(Reply::json(&MeasureCheckAnswer {
            readings: readings.len(),
            places: places.len(),
            repeated: places.iter().filter(|rows| rows.len() > 1).count(),
            channels: channels.collect(),
            diagnostics: entries(&problems),
        }))
    }
}

impl RepeatedChannel {
    fn of(instrument: &Instrument, channel: usize, found: &Repeatability) -> Self {
        let (unit, scale) = if instrument.sight.is_angle() { ("urad", 1e6) } else { ("um", 1e3) };
        Self {
            channel: instrument.kind.channels()[channel],
            unit,
            s: found.s * scale,
            degrees_of_freedom: found.degrees_of_freedom,
            largest_range: found.largest_range * scale,
            stated: instrument.noise[channel] * scale,
        }
    }
}

/// Measures a campaign on a machine that exists only as a file: that of its `[truth]`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MeasureRequest {
    /// The campaign file.
    campaign: String,
    /// The random seed instead of that of `[truth]`.
    seed: Option<u64>,
}

/// What the instruments would read.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct MeasureAnswer<'a> {
    /// The document of `trueaxis measure`.
    #[schemars(with = "trueaxis::report::MeasurementDocument<'a>")]
    document: Value,
    /// Its report.
    shown: ShownEntry,
    /// The readings of each instrument, then what is true.
    made: MadeEntry,
    /// The problems of the campaign.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

impl Request for MeasureRequest {
    type Answer<'a> = MeasureAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let campaign = desk.project.path(&self.campaign)?;
        let from = versions(desk, [&self.campaign]);
        let question = Measure {
            output: Some(campaign.with_file_name("readings")),
            truth: Some(campaign.with_file_name("truth.toml")),
            campaign,
            seed: self.seed,
        };
        let (mut found, problems) = ask(&question, job)?;
        Ok(Reply::json(&MeasureAnswer {
            document: found.document(&problems),
            shown: ShownEntry::of(&found),
            made: desk.keep(found.files(), from),
            diagnostics: entries(&problems),
        }))
    }
}
