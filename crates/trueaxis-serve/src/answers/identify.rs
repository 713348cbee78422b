//! The errors of the machine from readings.

use super::plan::TextEntry;
use crate::desk::{Desk, Job};
use crate::frame::{Array, Arrays};
use crate::refusal::{Refusal, entries};
use crate::request::{Diagnosed, Reply, Request};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::identify::errors::{Identification, identify as identify_errors};
use trueaxis::identify::machine_file::{MachineFile, machine_file};
use trueaxis::identify::records::{Dropped, Options, Records, read_options, read_records_with};
use trueaxis::input::Diagnostics;
use trueaxis::machine::file::Folder;
use trueaxis::measure::{Campaign, Instrument, read_campaign};
use trueaxis::report::{Arrow, DiagnosticEntry, IdentificationDocument, IdentificationReport};

/// The errors of a machine from the readings of a campaign.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct IdentifyRequest {
    /// The campaign file.
    campaign: String,
    /// The instrument that `text` belongs to; needed where the campaign has several.
    instrument: Option<String>,
    /// The name of the file that was dropped.
    name: Option<String>,
    /// Its text: readings in place of those of the instrument.
    text: Option<String>,
}

/// An identification. Arrays: `correlation` (f64: row by row), `at_mm` (f64: three for each reading), `before_um`,
/// `after_um` (f32: three for each reading, without and with the identified errors).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct IdentifyAnswer<'a> {
    /// The document of `trueaxis identify`.
    document: Diagnosed<'a, IdentificationDocument<'a>>,
    /// The machine file below the project folder; null if it is outside.
    machine: Option<String>,
    /// The instruments of the campaign.
    instruments: Vec<InstrumentEntry<'a>>,
    /// The names of the unknowns, in the order of the correlation matrix.
    correlation: Vec<&'a str>,
    /// The machine file with the identified errors; null if it cannot be edited.
    machine_file: Option<MachineFileEntry<'a>>,
    /// The problems of the campaign and its readings.
    diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// An instrument.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct InstrumentEntry<'a> {
    /// Its name.
    name: &'a str,
    /// Its kind, as campaign files call it.
    kind: &'static str,
    /// The names of its channels.
    channels: &'static [&'static str],
    /// The files of its readings below the project folder.
    tables: Vec<String>,
}

/// A machine file with the tables of its errors.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct MachineFileEntry<'a> {
    /// Its text.
    text: &'a str,
    /// Its tables.
    tables: Vec<TextEntry<'a>>,
}

/// A campaign with its readings and the identified errors.
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

    /// The machine file with the identified errors; none if it cannot be edited.
    fn machine_file(&self) -> Option<MachineFile> {
        let path = &self.campaign.machine_path;
        let mut unread = Diagnostics::new();
        let old = disk().text(path, "the machine file", &mut unread)?;
        let folder = Folder::of(&disk(), path);
        machine_file(&self.campaign, &self.found, self.options.date.as_deref(), &old, &folder).ok()
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

impl Request for IdentifyRequest {
    type Answer<'a> = IdentifyAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let path = desk.project.path(&self.campaign)?;
        let identified = identified(&path, |campaign| self.dropped(campaign), job)?;
        let Identified { campaign, problems, .. } = &identified;
        let report = identified.report();
        let determined = report.found.found.iter().filter(|f| f.value.is_some());
        let tables = campaign.instruments.iter().zip(&campaign.tables);
        let machine_file = identified.machine_file();
        let answer = IdentifyAnswer {
            document: Diagnosed {
                document: IdentificationDocument::of(&report),
                diagnostics: entries(problems),
            },
            machine: desk.project.name_of(&campaign.machine_path),
            instruments: tables.map(|(i, tables)| InstrumentEntry::of(desk, i, tables)).collect(),
            correlation: determined.map(|f| f.name.as_str()).collect(),
            machine_file: machine_file.as_ref().map(MachineFileEntry::from),
            diagnostics: entries(problems),
        };
        Ok(Reply::frame(&answer, arrays(&report)))
    }
}

/// Correlations and residuals.
fn arrays(report: &IdentificationReport<'_>) -> Arrays {
    let determined: Vec<_> = report.found.found.iter().filter(|f| f.value.is_some()).collect();
    let pairs = determined.iter().flat_map(|a| determined.iter().map(|b| (a.number, b.number)));
    let correlation = pairs.map(|(a, b)| report.correlation(a, b)).collect();
    let arrows = report.arrows();
    let um =
        |of: fn(&Arrow) -> Vec3| Array::F32(three(&arrows, of).map(|v| (v * 1e3) as f32).collect());
    vec![
        ("correlation", Array::F64(correlation)),
        ("at_mm", Array::F64(three(&arrows, |a| a.at_mm).collect())),
        ("before_um", um(|a| a.before_mm)),
        ("after_um", um(|a| a.after_mm)),
    ]
}

fn three(arrows: &[Arrow], of: fn(&Arrow) -> Vec3) -> impl Iterator<Item = f64> {
    arrows.iter().map(of).flat_map(|v| [v.x, v.y, v.z])
}

impl IdentifyRequest {
    /// The table that was dropped on the page, and its instrument.
    fn dropped(&self, campaign: &Campaign) -> Result<Option<Dropped<'_>>, Refusal> {
        let Some(text) = &self.text else { return Ok(None) };
        let name = self.name.as_deref().unwrap_or("dropped readings");
        let hint = || {
            let names = campaign.instruments.iter().map(|i| i.name.as_str());
            format!("`instrument`, one of {}", names.collect::<Vec<_>>().join(", "))
        };
        let instrument = match (&self.instrument, campaign.instruments.len()) {
            (None, 1) => Some(0),
            (None, _) => {
                let message = "the instrument of these readings is not stated";
                return Err(Refusal::bad(message, &hint()));
            }
            (Some(wanted), _) => campaign.instrument(wanted),
        };
        let Some(instrument) = instrument else {
            return Err(Refusal::bad("the campaign has no such instrument", &hint()));
        };
        Ok(Some(Dropped { instrument, name: short_name(name), text }))
    }
}

fn short_name(name: &str) -> &str {
    let end = name.char_indices().nth(100).map_or(name.len(), |(i, _)| i);
    &name[..end]
}

impl<'a> InstrumentEntry<'a> {
    fn of(desk: &Desk, instrument: &'a Instrument, tables: &[PathBuf]) -> Self {
        Self {
            name: &instrument.name,
            kind: instrument.kind.name(),
            channels: instrument.kind.channels(),
            tables: tables.iter().filter_map(|path| desk.project.name_of(path)).collect(),
        }
    }
}

impl<'a> From<&'a MachineFile> for MachineFileEntry<'a> {
    fn from(file: &'a MachineFile) -> Self {
        let table = |(name, text): &'a (String, String)| TextEntry { name, text: text.into() };
        Self { text: &file.text, tables: file.tables.iter().map(table).collect() }
    }
}
