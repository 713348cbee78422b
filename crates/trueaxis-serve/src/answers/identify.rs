//! The errors of the machine from readings.

use super::plan::TextEntry;
use crate::body::short;
use crate::desk::{Desk, Job};
use crate::frame::{Array, Arrays};
use crate::refusal::{Refusal, entries};
use crate::request::{Diagnosed, Reply, Request, ask};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueaxis::JsonSchema;
use trueaxis::geometry::Vec3;
use trueaxis::identify::machine_file::MachineFile;
use trueaxis::measure::Instrument;
use trueaxis::questions::{DroppedTable, Identify};
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

impl Request for IdentifyRequest {
    type Answer<'a> = IdentifyAnswer<'a>;

    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let text = self.text;
        let table = text.map(|text| DroppedTable {
            instrument: self.instrument,
            name: short(self.name.as_deref().unwrap_or("dropped readings")),
            text,
        });
        let campaign = desk.project.path(&self.campaign)?;
        let question = Identify { campaign, table, ..Identify::default() };
        let (identified, problems) = ask(&question, job)?;
        let campaign = &identified.campaign;
        let report = identified.shown();
        let determined = report.found.found.iter().filter(|f| f.value.is_some());
        let tables = campaign.instruments.iter().zip(&campaign.tables);
        let machine_file = identified.machine_file(&campaign.machine_path).ok();
        let answer = IdentifyAnswer {
            document: Diagnosed {
                document: IdentificationDocument::of(&report),
                diagnostics: entries(&problems),
            },
            machine: desk.project.name_of(&campaign.machine_path),
            instruments: tables.map(|(i, tables)| InstrumentEntry::of(desk, i, tables)).collect(),
            correlation: determined.map(|f| f.name.as_str()).collect(),
            machine_file: machine_file.as_ref().map(MachineFileEntry::from),
            diagnostics: entries(&problems),
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
