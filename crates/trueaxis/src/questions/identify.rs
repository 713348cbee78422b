//! Which errors does the machine have?

use super::{Answer, NewFile, Question, Tell, with_diagnostics};
use crate::files::output::Output;
use crate::report;
use serde_json::Value;
use std::path::{Path, PathBuf};
use trueaxis_calibrate::identify::convention::{ConventionCheck, check_conventions};
use trueaxis_calibrate::identify::covariance_file::covariance_file;
use trueaxis_calibrate::identify::errors::{Identification, identify};
use trueaxis_calibrate::identify::file_residual::check_file;
use trueaxis_calibrate::identify::machine_file::{MachineFile, machine_file};
use trueaxis_calibrate::identify::predictor_file::{PredictorFile, judge, predictor_file};
use trueaxis_calibrate::identify::records::{
    Dropped, Options, Records, read_options, read_records_with,
};
use trueaxis_calibrate::report::IdentificationReport;
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_machine::file::Folder;
use trueaxis_measure::measure::{Campaign, read_campaign};
use trueaxis_report::Report;

/// The errors of a machine from a campaign of measurements.
#[derive(Debug, Clone, Default)]
pub struct Identify {
    /// The campaign: machine, instruments with their readings, unknown errors.
    pub campaign: PathBuf,
    /// A table of readings in place of those of one instrument.
    pub table: Option<DroppedTable>,
    /// Where a machine file with the errors found goes.
    pub output: Option<PathBuf>,
    /// Where a machine file with the prediction by all errors goes.
    pub predictor: Option<PathBuf>,
    /// Whether sign, order, sense, side and unit of the readings are tried.
    pub check_conventions: bool,
}

/// A table of readings that is not a file of the campaign.
#[derive(Debug, Clone, Default)]
pub struct DroppedTable {
    /// Whose readings they are; may be left out where there is one instrument.
    pub instrument: Option<String>,
    /// Its name, for messages.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// A campaign with its readings and what they show.
#[derive(Debug)]
pub struct Identified {
    /// The campaign.
    pub campaign: Campaign,
    /// How it is evaluated.
    pub options: Options,
    /// Its readings.
    pub records: Records,
    /// What they show.
    pub found: Identification,
    conventions: Option<ConventionCheck>,
    files: Vec<NewFile>,
}

impl Identified {
    /// What a report shows.
    pub fn shown(&self) -> IdentificationReport<'_> {
        IdentificationReport {
            campaign: &self.campaign,
            options: &self.options,
            records: &self.records,
            found: &self.found,
            conventions: self.conventions.as_ref().or(self.found.conventions.as_ref()),
        }
    }

    /// The machine file with the errors found, to be put at a place.
    ///
    /// # Errors
    /// Why it cannot be edited.
    pub fn machine_file(&self, place: &Path) -> Result<MachineFile, String> {
        let Self { campaign, options, found, .. } = self;
        let old = campaign.files.read_text(&campaign.machine_path).map_err(|e| e.to_string())?;
        let beside = Folder::of(&campaign.files, place);
        machine_file(campaign, found, options.date.as_deref(), &old, &beside)
    }
}

impl Identify {
    /// The instrument of the table in place of its own.
    fn dropped<'a>(
        &'a self,
        campaign: &Campaign,
        problems: &mut Diagnostics,
    ) -> Option<Option<Dropped<'a>>> {
        let Some(table) = &self.table else { return Some(None) };
        let instrument = match (&table.instrument, campaign.instruments.len()) {
            (None, 1) => Some(0),
            (None, _) => None,
            (Some(wanted), _) => campaign.instrument(wanted),
        };
        let Some(instrument) = instrument else {
            let names: Vec<&str> = campaign.instruments.iter().map(|i| i.name.as_str()).collect();
            let message = match &table.instrument {
                None => "the instrument of these readings is not stated".to_owned(),
                Some(wanted) => format!("the campaign has no instrument `{wanted}`"),
            };
            let hint = format!("one of {}", names.join(", "));
            problems.error("unknown-instrument", Place::whole(&table.name), message, &hint);
            return None;
        };
        Some(Some(Dropped { instrument, name: &table.name, text: &table.text }))
    }
}

impl Question for Identify {
    type Input = (Campaign, Options, Records);
    type Answer = Identified;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Self::Input> {
        let read =
            problems.keep(read_campaign(files, &self.campaign, |root, _| Some(read_options(root))));
        let (campaign, options) = read?;
        let dropped = self.dropped(&campaign, problems)?;
        let records = read_records_with(&campaign, dropped, problems)?;
        if self.check_conventions && problems.has_errors() {
            // What does not fit may be a matter of signs: then the check is all that helps.
            warn_of_conventions(&check(&campaign, &records), &self.campaign, problems);
        }
        Some((campaign, options, records))
    }

    fn outputs(&self, _: Option<&Self::Input>) -> Vec<Output> {
        let all = [("-o", &self.output), ("--predictor", &self.predictor)];
        let both = |(argument, path): (&'static str, &Option<PathBuf>)| {
            let path = path.clone()?;
            // A folder that is missing is reported once.
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            let beside = folder.is_none_or(Path::is_dir).then(|| covariance_path(&path));
            Some([path].into_iter().chain(beside).map(move |path| Output::file(argument, path)))
        };
        all.into_iter().filter_map(both).flatten().collect()
    }

    fn answer(
        &self,
        (campaign, options, records): Self::Input,
        progress: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<Identified> {
        progress(0.1);
        let found = identify(&campaign, &options, &records, problems);
        let asked = self.check_conventions && !records.readings.is_empty();
        let conventions = asked.then(|| check(&campaign, &records));
        let Some(found) = found.filter(|_| !problems.has_errors()) else {
            if let Some(check) = &conventions {
                warn_of_conventions(check, &self.campaign, problems);
            }
            return None;
        };
        let mut identified =
            Identified { campaign, options, records, found, conventions, files: Vec::new() };
        if let Some(output) = &self.output {
            identified.files = machine_files(&identified, output, problems)?;
        }
        if let Some(output) = &self.predictor {
            judge(&identified.found, &Place::whole(&self.campaign.display().to_string()), problems);
            if problems.has_errors() {
                return None;
            }
            let files = predictor_files(&identified, output, problems)?;
            identified.files.extend(files);
        }
        Some(identified)
    }
}

fn check(campaign: &Campaign, records: &Records) -> ConventionCheck {
    check_conventions(&campaign.design(), &records.readings)
}

/// What else the readings may mean, where they cannot be used as they stand.
fn warn_of_conventions(check: &ConventionCheck, campaign: &Path, problems: &mut Diagnostics) {
    let changes =
        check.better.iter().map(trueaxis_calibrate::identify::convention::Convention::words);
    for message in changes.chain(check.remarks.iter().cloned()) {
        let place = Place::whole(&campaign.display().to_string());
        problems.warn("other-convention", place, message, "is that how they were taken?");
    }
}

/// `machine-covariance.toml` for `machine.toml`.
fn covariance_path(output: &Path) -> PathBuf {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    output.with_file_name(format!("{stem}-covariance.toml"))
}

/// The machine file with the prediction by all errors, its tables, and the covariance.
fn predictor_files(
    identified: &Identified,
    output: &Path,
    problems: &mut Diagnostics,
) -> Option<Vec<NewFile>> {
    let Identified { campaign, options, records, found, .. } = identified;
    let path = covariance_path(output);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beside = Folder::of(&campaign.files, output);
    let old = campaign.files.read_text(&campaign.machine_path).map_err(|e| e.to_string());
    let made = old.and_then(|old| {
        let read = (records, options.date.as_deref());
        predictor_file((campaign, found), read, (&old, &name), &beside)
    });
    let PredictorFile { machine, covariance } =
        made.map_err(|reason| refuse(output, &reason, problems)).ok()?;
    let table =
        |(name, text): (String, String)| NewFile::of("table", output.with_file_name(name), text);
    let mut files: Vec<NewFile> = machine.tables.into_iter().map(table).collect();
    files.push(NewFile::of("machine file", output, machine.text));
    files.push(NewFile::of("covariance", path, covariance));
    Some(files)
}

fn refuse(output: &Path, reason: &str, problems: &mut Diagnostics) {
    let message = format!("the machine file cannot be edited: {reason}");
    let hint = "put it beside the machine file if that names tables";
    let place = Place::whole(&output.display().to_string());
    problems.error("unwritable-file", place, message, hint);
}

/// The machine file with the errors found, and the tables that it names.
fn machine_files(
    identified: &Identified,
    output: &Path,
    problems: &mut Diagnostics,
) -> Option<Vec<NewFile>> {
    let campaign = &identified.campaign;
    if let Some(joint) = campaign.machine.joint()
        && let Some(term) = campaign.terms.iter().find(|term| joint.has(term.index))
    {
        let error = term.error;
        let message = format!(
            "{error} of the machine file is known together with other errors, by their covariance: a new value alone contradicts it"
        );
        let hint = "write the prediction by all errors, --predictor NEW.toml, or begin from the machine file before it";
        problems.error(
            "unwritable-file",
            Place::whole(&output.display().to_string()),
            message,
            hint,
        );
        return None;
    }
    let made = identified.machine_file(output);
    let made = made.map_err(|reason| refuse(output, &reason, problems)).ok()?;
    let table =
        |(name, text): (String, String)| NewFile::of("table", output.with_file_name(name), text);
    let mut files: Vec<NewFile> = made.tables.into_iter().map(table).collect();
    files.push(NewFile::of("machine file", output, made.text));
    let Identified { campaign, options, records, found, .. } = identified;
    check_file(found, &records.readings, Place::whole(&output.display().to_string()), problems);
    let text = covariance_file(campaign, found, records, options.date.as_deref());
    files.push(NewFile::of("covariance", covariance_path(output), text));
    Some(files)
}

impl Answer for Identified {
    fn document(&self, problems: &Diagnostics) -> Value {
        with_diagnostics(&report::IdentificationDocument::of(&self.shown()), problems)
    }

    fn report(&self) -> Report<'_> {
        report::identification_report(self.shown())
    }

    fn is_yes(&self) -> bool {
        self.found.verdict.is_good()
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }
}
