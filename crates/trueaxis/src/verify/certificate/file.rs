//! The study file of a certificate.

use super::applied::AppliedCompensation;
use super::compensation::read_compensation;
use super::decide::{Decision, Rule};
use super::inputs::{Input, Inputs};
use super::uncertainties::UncertaintyFactors;
use super::used::{UsedPose, read_used};
use super::validation::{AllowedPoses, Validation, read_validation};
use super::{UncertaintySource, identified};
use std::path::Path;
use trueaxis_condition::certificate_head::{CertificateHead, read_head};
use trueaxis_correct::compensate::not_twice;
use trueaxis_input::{
    Date, Diagnostics, Dimension, Files, Item, MeasuredValue, Section, SourceText,
};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisKind, Travel};
use trueaxis_machine::describe::axis_index;
use trueaxis_predict::predict::Sampling;
use trueaxis_standards::conditions::SOUND_TEMPERATURES_C;

/// The study of a certificate.
pub struct Study {
    /// Its name.
    pub name: String,
    /// Number, customer, place, instruments; from `[certificate]`.
    pub head: Option<CertificateHead>,
    /// The identified machine without the errors that the control compensates already.
    pub machine: Machine,
    /// How its errors were found.
    pub determination: Circumstances,
    /// Their uncertainties.
    pub known: UncertaintyFactors,
    /// The source of the uncertainties.
    pub determined: UncertaintySource,
    /// Poses that were used for it.
    pub used: Vec<UsedPose>,
    /// The compensation.
    pub applied: AppliedCompensation,
    /// When, by whom and how it was put into the control.
    pub application: Application,
    /// The axes with the ends between which the certificate holds: those of the travels, or `[zone]`.
    pub zone: Vec<Axis>,
    /// The readings.
    pub validation: Validation,
    /// The decision rule with its figures.
    pub decision: Decision,
    /// The draws of the lengths.
    pub sampling: Sampling,
    /// Every file that was read.
    pub inputs: Vec<Input>,
}

/// Who measured when with what.
#[derive(Debug, Clone, PartialEq)]
pub struct Circumstances {
    /// In words.
    pub method: String,
    /// As written.
    pub date: String,
    /// Who.
    pub by: String,
    /// With what.
    pub instrument: String,
    /// How that is traced to standards.
    pub calibration: String,
    /// °C, with its standard uncertainty if it is stated.
    pub temperature_c: MeasuredValue,
}

/// How the compensation was put into the control.
#[derive(Debug, Clone, PartialEq)]
pub struct Application {
    /// In words, from the study.
    pub method: Option<String>,
    /// As written.
    pub date: Option<String>,
    /// Who.
    pub by: Option<String>,
    /// Files of the compensation with their SHA-256.
    pub files: Vec<Input>,
    /// The folder of what the control has loaded, if it was compared.
    pub loaded: Option<String>,
}

/// Reads a study with all that it names; nothing with errors.
pub fn read_certificate(files: &Files, path: &Path) -> (Option<Study>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a study of a certificate (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut inputs = Inputs::beside(files, folder);
    let own = path.file_name().map_or(String::new(), |name| name.display().to_string());
    inputs.add("study", &own, text.as_bytes());
    let read = source.read(|root| {
        inputs.limits = root.limits();
        read(root, folder, inputs)
    });
    problems.append(source.finish());
    (read.filter(|_| !problems.has_errors()), problems)
}

const SECTIONS: [(&str, &str); 4] = [
    ("determination", "[determination] method, date, by, instrument, calibration, temperature"),
    ("compensation", "[compensation] kind = \"program\", or kind = \"tables\" with its target"),
    ("validation", "[validation] before, after: tables of readings, and the uncertainty u"),
    ("decision", "[decision] limit = \"10 um\", rule = \"ISO 14253-1\""),
];

fn read(root: &Section<'_>, folder: &Path, mut inputs: Inputs) -> Option<Study> {
    let name = root.require("name", "what is certified").and_then(|i| i.text());
    let hint = "the identified machine file, relative to this file";
    let machine = root.require("machine", hint).and_then(|item| {
        let mut problems = Diagnostics::new();
        let machine = inputs.machine("machine file", item.text()?, &mut problems);
        let machine = machine.map(|m| not_twice(&m, item.place(), &mut problems));
        root.take_over(problems);
        machine
    });
    let sections = SECTIONS.map(|(key, hint)| root.require(key, hint));
    let head = root.section("certificate", read_head).flatten();
    let (monte_carlo, zone) = (root.get("monte_carlo"), root.get("zone"));
    let (
        Some(machine),
        [Some(determination), Some(compensation), Some(validation), Some(decision)],
    ) = (machine, sections)
    else {
        // The rest needs all of them; it must not be reported as unknown.
        root.entries();
        return None;
    };
    let sampling = match monte_carlo {
        Some(item) => item.section("monte_carlo", read_sampling).flatten(),
        None => Some(Sampling::default()),
    };
    let decision = decision.section("decision", read_decision).flatten();
    let zone = match zone {
        Some(item) => item.section("zone", |s| read_zone(s, &machine)).flatten(),
        None => Some(machine.axes().to_vec()),
    };
    let determined = determination
        .section("determination", |s| read_determination(s, &machine, folder, &mut inputs));
    let compensation =
        compensation.section("compensation", |s| read_compensation(s, &machine, &mut inputs));
    let used = determined.as_ref().and_then(|d| Some(d.as_ref()?.used.as_slice()));
    let allowed = AllowedPoses { used: used.unwrap_or(&[]), zone: zone.as_deref().unwrap_or(&[]) };
    let validation =
        validation.section("validation", |s| read_validation(s, &machine, &allowed, &mut inputs));
    let (found, validation) = (determined.flatten()?, validation.flatten()?);
    let (applied, application) = compensation.flatten()?;
    check_order(root, &found.circumstances, &application, &validation);
    Some(Study {
        name: name?.to_owned(),
        head,
        determination: found.circumstances,
        known: found.known,
        determined: found.determined,
        used: found.used,
        applied,
        application,
        zone: zone?,
        validation,
        decision: decision?,
        sampling: sampling?,
        inputs: inputs.finish(),
        machine,
    })
}

/// Readings of a machine whose compensation was not there yet validate nothing.
fn check_order(
    root: &Section<'_>,
    determination: &Circumstances,
    application: &Application,
    validation: &Validation,
) {
    let determined = ("the errors were determined", determination.date.as_str());
    let applied = application.date.as_deref().map(|date| ("the compensation was applied", date));
    let validated = &validation.circumstances.date;
    let Some(after) = Date::parse(validated) else { return };
    for (what, date) in std::iter::once(determined).chain(applied) {
        if Date::parse(date).is_some_and(|before| after < before) {
            let message = format!("the validation is of {validated}, {what} on {date}");
            let hint = "the readings `after` are those with the compensation that is certified: correct one `date`";
            root.error("bad-date", message, hint);
        }
    }
}

/// Reads `[zone]`: `A = ["-30 deg", "30 deg"]`; axes that are not named have their whole travel.
fn read_zone(section: &Section<'_>, machine: &Machine) -> Option<Vec<Axis>> {
    let mut zone = machine.axes().to_vec();
    let mut sound = true;
    for (key, place, item) in section.entries() {
        let Some(index) = axis_index(machine, key) else {
            let hint = format!("the chain of the machine: {}", machine.chain_text());
            let message = format!("the machine has no axis `{key}`");
            section.error_at(place, "unknown-axis", message, &hint);
            sound = false;
            continue;
        };
        let dimension = match zone[index].kind {
            AxisKind::Linear => Dimension::Length,
            AxisKind::Rotary => Dimension::Angle,
        };
        let ends: Option<Vec<f64>> =
            item.list().and_then(|ends| ends.iter().map(|e| e.quantity(dimension)).collect());
        match ends.as_deref() {
            Some([from, to]) if from <= to && is_in(&zone[index], from, to) => {
                zone[index].travel = Travel::Between(*from, *to);
            }
            Some(_) => {
                let message = "expected two increasing ends within the travel here".to_owned();
                item.error("bad-range", message, "A = [\"-30 deg\", \"30 deg\"]");
                sound = false;
            }
            None => sound = false,
        }
    }
    sound.then_some(zone)
}

fn is_in(axis: &Axis, from: &f64, to: &f64) -> bool {
    axis.travel.contains(*from) && axis.travel.contains(*to)
}

/// The content of `[determination]`.
struct Determination {
    circumstances: Circumstances,
    known: UncertaintyFactors,
    determined: UncertaintySource,
    used: Vec<UsedPose>,
}

fn read_determination(
    section: &Section<'_>,
    machine: &Machine,
    folder: &Path,
    inputs: &mut Inputs,
) -> Option<Determination> {
    let circumstances = read_circumstances(section);
    let mut used = read_used(section, machine, inputs);
    let campaign = section.get("campaign");
    let (known, determined) = match &campaign {
        None => (Some(UncertaintyFactors::stated(machine)), UncertaintySource::Stated),
        Some(item) => {
            let found = identified::read(section, item, machine, (folder, inputs));
            match found {
                Some(found) => {
                    if let Some(used) = &mut used {
                        used.extend(found.used);
                    }
                    (Some(found.known), found.determined)
                }
                None => (None, UncertaintySource::Stated),
            }
        }
    };
    if let Some(known) = &known {
        check_known(section, machine, known);
    }
    if used.as_ref().is_some_and(Vec::is_empty) && campaign.is_none() {
        let message = "the poses that the identification has used are not stated".to_owned();
        let hint = "used = [\"poses.csv\"], or campaign = \"campaign.toml\": the validation needs other poses";
        section.error("no-used-poses", message, hint);
    }
    Some(Determination { circumstances: circumstances?, known: known?, determined, used: used? })
}

/// Errors without uncertainty would be certified as exact.
fn check_known(section: &Section<'_>, machine: &Machine, known: &UncertaintyFactors) {
    let names = known.unknown(machine);
    if !names.is_empty() {
        let message = format!("a certificate needs u of every error; none for {}", names.join(" "));
        let hint = "state them in the machine file (\"12 ± 1 urad\")";
        section.error("no-uncertainty", message, hint);
    }
}

/// Reads who measured when with what; all entries are required.
pub(super) fn read_circumstances(section: &Section<'_>) -> Option<Circumstances> {
    let text = |key, hint: &str| Some(section.require(key, hint)?.text()?.to_owned());
    let method = text("method", "method = \"laser interferometer along X, Y, Z; …\"");
    let date = section.require("date", "date = 2026-03-14").and_then(|i| i.date_or_text());
    let by = text("by", "by = \"who measured\"");
    let instrument = text("instrument", "instrument = \"laser tracker, serial number\"");
    let calibration = text("calibration", "calibration = \"certificate number, date, U\"");
    let temperature = section.require("temperature", "temperature = \"20.4 ± 0.3 degC\"");
    let temperature_c = temperature.and_then(|item| {
        let found = item.measured(Dimension::Temperature)?;
        let sound = SOUND_TEMPERATURES_C.contains(&found.value);
        if !sound {
            let message = format!("{} °C is not a temperature of a machine", found.value);
            item.error("temperature-range", message, "is the unit right? -10 to 60 degC");
        }
        sound.then_some(found)
    });
    Some(Circumstances {
        method: method?,
        date: date?,
        by: by?,
        instrument: instrument?,
        calibration: calibration?,
        temperature_c: temperature_c?,
    })
}

fn read_sampling(section: &Section<'_>) -> Option<Sampling> {
    let usual = Sampling::default();
    let count = |key, usual| section.get(key).map_or(Some(usual), |i| i.count());
    let (samples, seed) = (count("samples", usual.samples), count("seed", 1));
    let samples = samples?;
    if !(1000..=1_000_000).contains(&samples) {
        let message = "1000 to 1 000 000 draws make sense".to_owned();
        section.error("bad-count", message, "samples = 10000");
        return None;
    }
    Some(Sampling { samples, seed: seed? as u64 })
}

fn read_decision(section: &Section<'_>) -> Option<Decision> {
    let limit = section.require("limit", "limit = \"10 um\": how far the tip may be off");
    let rule = match section.get("rule") {
        None => Some(Rule::GuardBand),
        Some(item) => match item.text() {
            Some("simple") => Some(Rule::Simple),
            Some("ISO 14253-1") => Some(Rule::GuardBand),
            Some(other) => {
                let message = format!("unknown decision rule `{other}`");
                item.error("unknown-rule", message, "\"ISO 14253-1\" (usual) or \"simple\"");
                None
            }
            None => None,
        },
    };
    let coverage_factor = match section.get("coverage_factor") {
        None => Some(2.0),
        Some(item) => item.number().filter(|k| {
            let sound = (1.0..=10.0).contains(k);
            if !sound {
                item.error("bad-factor", "k lies from 1 to 10".to_owned(), "2: about 95 %");
            }
            sound
        }),
    };
    let limit_mm = limit.and_then(|item| above_zero(&item, Dimension::Length))?;
    Some(Decision { rule: rule?, limit_mm, coverage_factor: coverage_factor? })
}

/// A quantity above zero.
pub(super) fn above_zero(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value <= 0.0 {
        item.error("not-positive", "it is not above zero".to_owned(), "such as \"1 um\"");
    }
    Some(value).filter(|v| *v > 0.0)
}
