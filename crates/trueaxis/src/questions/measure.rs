//! What would instruments read on a machine whose errors are known?

use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_measure::measure::instrument::SetupError;
use trueaxis_measure::measure::virtual_campaign::{
    Measurement, VirtualCampaign, measure, read_virtual, stage_tables,
};
use trueaxis_measure::measure::{Campaign, read_campaign, readings_file};
use trueaxis_measure::report::MeasuredReport;
use trueaxis_report::Report;

/// The readings of a campaign on a machine whose errors are known.
#[derive(Debug, Clone, Default)]
pub struct Measure {
    /// The campaign: machine, instruments, paths, and if wanted `[truth]` and `[disturb]`.
    pub campaign: PathBuf,
    /// The folder for one table of readings per instrument.
    pub output: Option<PathBuf>,
    /// Where what is true goes.
    pub truth: Option<PathBuf>,
    /// Random seed instead of that of `[truth]`.
    pub seed: Option<u64>,
}

/// A campaign with the readings that its instruments would take.
#[derive(Debug)]
pub struct MeasureAnswer {
    campaign: Campaign,
    real: VirtualCampaign,
    measurement: Measurement,
    tables: Vec<String>,
    files: Vec<NewFile>,
}

const READINGS_BEGIN: &str = "# virtual readings of trueaxis measure";
const TRUTH_BEGIN: &str = "# true values of virtual readings";

impl Measure {
    /// Where the table of each instrument goes.
    fn tables(&self, campaign: &Campaign) -> Vec<PathBuf> {
        let Some(folder) = &self.output else { return Vec::new() };
        campaign.instruments.iter().map(|i| folder.join(readings_file(&i.name))).collect()
    }

    /// Where the table of a stage goes.
    fn stage_table(&self, path: &Path) -> Option<PathBuf> {
        Some(self.output.as_ref()?.join(path.file_name()?))
    }

    fn name(&self) -> String {
        self.campaign.file_name().unwrap_or_default().display().to_string()
    }

    fn files(
        &self,
        campaign: &Campaign,
        real: &VirtualCampaign,
        measurement: &Measurement,
    ) -> Vec<NewFile> {
        let name = self.name();
        let mut files = Vec::new();
        let tables = self.tables(campaign);
        for (index, (path, instrument)) in (0..).zip(tables.into_iter().zip(&campaign.instruments))
        {
            let head = format!(
                "{READINGS_BEGIN}: {} on the paths of {name}, seed {}\n",
                instrument.name, real.truth.seed
            );
            let rows = measurement.readings.table(&campaign.machine, instrument, index);
            files.push(NewFile::of("readings", path, head + &rows));
        }
        for (path, rows) in stage_tables(campaign, real) {
            let Some(path) = self.stage_table(&path) else { continue };
            let head = format!("{READINGS_BEGIN}: a stage of {name}, seed {}\n", real.truth.seed);
            files.push(NewFile::of("readings", path, head + &rows));
        }
        if let Some(path) = &self.truth {
            let text = truth_text(&name, campaign, real, measurement);
            files.push(NewFile::of("truth", path, text));
        }
        files
    }
}

impl Question for Measure {
    type Input = (Campaign, VirtualCampaign);
    type Answer = MeasureAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        problems.keep(read_campaign(files, &self.campaign, |root, campaign| {
            read_virtual(root, campaign, self.seed)
        }))
    }

    fn outputs(&self, input: Option<&Self::Input>) -> Vec<Output> {
        let mut tables = input.map(|(campaign, _)| self.tables(campaign)).unwrap_or_default();
        if let Some((campaign, real)) = input {
            let own = stage_tables(campaign, real);
            tables.extend(own.iter().filter_map(|(path, _)| self.stage_table(path)));
        }
        let tables = tables.into_iter().map(|path| Output::in_new_folder("-o", path));
        tables.chain(self.truth.iter().map(|path| Output::file("--truth", path))).collect()
    }

    fn answer(
        &self,
        (campaign, real): Self::Input,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<MeasureAnswer> {
        let measurement = match measure(&campaign, &real) {
            Ok(measurement) => measurement,
            Err(error) => {
                let place = Place::whole(&self.campaign.display().to_string());
                let hint = "change the path, the set-up or the machine";
                problems.error("cannot-measure", place, error.to_string(), hint);
                return None;
            }
        };
        let files = self.files(&campaign, &real, &measurement);
        let own = stage_tables(&campaign, &real);
        let own = own.iter().filter_map(|(path, _)| self.stage_table(path));
        let tables = self.tables(&campaign).into_iter().chain(own);
        let tables = tables.map(|p| p.display().to_string()).collect();
        Some(MeasureAnswer { campaign, real, measurement, tables, files })
    }
}

impl MeasureAnswer {
    fn shown(&self) -> MeasuredReport<'_> {
        MeasuredReport {
            campaign: &self.campaign,
            real: &self.real,
            measurement: &self.measurement,
            files: &self.tables,
        }
    }
}

impl Answer for MeasureAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::MeasurementDocument::of(&self.shown()), problems)
    }

    fn report(&self) -> Report<'_> {
        report::measurement_report(&self.shown())
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }
}

/// What is true, as a `[truth]` that says it again.
fn truth_text(
    name: &str,
    campaign: &Campaign,
    real: &VirtualCampaign,
    measurement: &Measurement,
) -> String {
    let truth = &real.truth;
    let mut text = format!("{TRUTH_BEGIN} of {name}\n\n[truth]\nseed = {}\n", truth.seed);
    let path = truth.machine_path.as_ref().unwrap_or(&campaign.machine_path);
    // Writing to a String cannot fail.
    let _ = writeln!(text, "machine = {:?}", path.display().to_string());
    let _ = writeln!(text, "draw = {}", truth.factors.is_some());
    let shown = |value: f64, angle: bool, by: &str| match angle {
        true => format!("\"{} urad{by}\"", value * 1e6),
        false => format!("\"{} um{by}\"", value * 1e3),
    };
    if !truth.errors.is_empty() {
        let _ = writeln!(text, "\n[truth.errors]");
    }
    for (error, value) in &truth.errors {
        let _ = writeln!(text, "{error} = {}", shown(*value, error.component.is_rotation(), ""));
    }
    for (instrument, values) in truth.instruments.iter().zip(&truth.setups) {
        if !values.is_empty() {
            let _ = writeln!(text, "\n[truth.setup.{:?}]", instrument.name);
        }
        for (unknown, value) in instrument.unknowns.iter().zip(values) {
            let by = if unknown.error.is_rate() { "/h" } else { "" };
            let angle = match unknown.error {
                SetupError::ReferenceTurn(_)
                | SetupError::Tilt(_)
                | SetupError::Scale
                | SetupError::Material => true,
                SetupError::Zero(_) | SetupError::Drift(_) => instrument.sight.is_angle(),
                _ => false,
            };
            let _ = writeln!(text, "{} = {}", unknown.name, shown(*value, angle, by));
        }
    }
    let _ = writeln!(text, "\n[wrong]\n# rows of each table, counted from 1, wrong on purpose");
    for (of, instrument) in campaign.instruments.iter().enumerate() {
        let rows = measurement.readings.instruments.iter().enumerate();
        let mine = rows.filter(|(_, i)| **i as usize == of).map(|(row, _)| row);
        let wrong =
            mine.enumerate().filter(|(_, row)| measurement.outliers.binary_search(row).is_ok());
        let wrong: Vec<usize> = wrong.map(|(k, _)| k + 1).collect();
        let _ = writeln!(text, "{:?} = {wrong:?}", instrument.name);
    }
    let _ = writeln!(text, "\n[lost]\nrows = {}", measurement.lost);
    text
}
