//! The study file of a certificate.

use super::applied::Applied;
use super::decide::{Decision, Rule};
use super::inputs::{Input, Inputs};
use super::known::Known;
use super::loaded::check_loaded;
use super::used::{Used, read_at, read_used};
use super::validation::{Validation, read_validation};
use super::{Determined, identified};
use crate::compensate::not_twice;
use crate::compensate::tables::{Order, Target, compile};
use crate::files;
use crate::predict::Sampling;
use crate::verify::conditions::SOUND_TEMPERATURES_C;
use std::path::Path;
use trueaxis_geometry::input::{Diagnostics, Dimension, Item, Measured, Section, Source};
use trueaxis_machine::Machine;
use trueaxis_machine::compensate::{Compensator, Scope};

/// What a certificate is made from.
pub struct Study {
    /// Its name.
    pub name: String,
    /// The identified machine; what the control compensates already is taken out.
    pub machine: Machine,
    /// How its errors were found.
    pub determination: Circumstances,
    /// How well they are known.
    pub known: Known,
    /// Where that is from.
    pub determined: Determined,
    /// Poses that were used for it.
    pub used: Vec<Used>,
    /// What is done against the errors.
    pub applied: Applied,
    /// When, by whom and how it was put into the control.
    pub application: Application,
    /// The readings.
    pub validation: Validation,
    /// How it is decided.
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
    pub temperature_c: Measured,
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
pub fn read_certificate(path: &Path) -> (Option<Study>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files::text(path, "a study of a certificate (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = Source::new(&file, &text);
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut inputs = Inputs::beside(folder);
    let own = path.file_name().map_or(String::new(), |name| name.display().to_string());
    inputs.add("study", &own, text.as_bytes());
    let read = source.read(|root| read(root, folder, inputs));
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
        let machine = inputs.machine(item.text()?, &mut problems);
        let machine = machine.map(|m| not_twice(&m, item.place(), &mut problems));
        root.take_over(problems);
        machine
    });
    let sections = SECTIONS.map(|(key, hint)| root.require(key, hint));
    let monte_carlo = root.get("monte_carlo");
    let (
        Some(machine),
        [Some(determination), Some(compensation), Some(validation), Some(decision)],
    ) = (machine, sections)
    else {
        // The rest needs all of them; do not call it unknown.
        root.entries();
        return None;
    };
    let sampling = match monte_carlo {
        Some(item) => item.section("monte_carlo", read_sampling).flatten(),
        None => Some(Sampling::default()),
    };
    let decision = decision.section("decision", read_decision).flatten();
    let determined = determination
        .section("determination", |s| read_determination(s, &machine, folder, &mut inputs));
    let compensation =
        compensation.section("compensation", |s| read_compensation(s, &machine, &mut inputs));
    let used = determined.as_ref().and_then(|d| Some(d.as_ref()?.used.as_slice()));
    let validation = validation
        .section("validation", |s| read_validation(s, &machine, used.unwrap_or(&[]), &mut inputs));
    let found = determined.flatten()?;
    let (applied, application) = compensation.flatten()?;
    Some(Study {
        name: name?.to_owned(),
        determination: found.circumstances,
        known: found.known,
        determined: found.determined,
        used: found.used,
        applied,
        application,
        validation: validation.flatten()?,
        decision: decision?,
        sampling: sampling?,
        inputs: inputs.finish(),
        machine,
    })
}

/// What `[determination]` says.
struct Determination {
    circumstances: Circumstances,
    known: Known,
    determined: Determined,
    used: Vec<Used>,
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
        None => {
            check_stated(section, machine);
            (Some(Known::stated(machine)), Determined::Stated)
        }
        Some(item) => {
            let found = identified::read(section, item, machine, (folder, inputs));
            match found {
                Some(found) => {
                    if let Some(used) = &mut used {
                        used.extend(found.used);
                    }
                    (Some(found.known), found.determined)
                }
                None => (None, Determined::Stated),
            }
        }
    };
    if used.as_ref().is_some_and(Vec::is_empty) && campaign.is_none() {
        let message = "nobody says which poses the identification has used".to_owned();
        let hint = "used = [\"poses.csv\"], or campaign = \"campaign.toml\": the validation must stand on others";
        section.error("no-used-poses", message, hint);
    }
    Some(Determination { circumstances: circumstances?, known: known?, determined, used: used? })
}

/// Errors without uncertainty would be certified as exact.
fn check_stated(section: &Section<'_>, machine: &Machine) {
    let stated = machine.stated_errors();
    let without = stated.iter().filter(|(index, _)| {
        let body = &machine.bodies()[index.body];
        body.stated(index.kind, index.component).is_some_and(|s| s.u.is_none())
    });
    let mut names: Vec<String> = without.map(|(_, name)| name.to_string()).collect();
    names.extend(machine.coefficients_without_u());
    if !names.is_empty() {
        let message = format!("a certificate needs u of every error; none for {}", names.join(" "));
        let hint = "state them in the machine file (\"12 ± 1 urad\")";
        section.error("no-uncertainty", message, hint);
    }
}

/// Reads who measured when with what; all of it is due.
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
            let message = format!("{} °C is no temperature of a machine", found.value);
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
                let message = format!("no decision rule is called `{other}`");
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

fn read_compensation(
    section: &Section<'_>,
    machine: &Machine,
    inputs: &mut Inputs,
) -> Option<(Applied, Application)> {
    let text = |key| section.text(key).map(str::to_owned);
    let (method, by) = (text("method"), text("by"));
    let date = section.get("date").and_then(|i| i.date_or_text());
    let kind = section.require("kind", "kind = \"program\" or \"tables\"")?;
    let (applied, files, loaded) = match kind.text()? {
        "program" => {
            let applied = read_program_scope(section, machine)?;
            let files = read_programs(section, inputs)?;
            (applied, files, None)
        }
        "tables" => {
            let applied = read_tables(section, machine)?;
            let (files, loaded) = check_loaded(section, &applied, inputs)?;
            (applied, files, loaded)
        }
        other => {
            let message = format!("no compensation is called `{other}`");
            kind.error("unknown-kind", message, "\"program\" or \"tables\"");
            return None;
        }
    };
    Some((applied, Application { method, date, by, files, loaded }))
}

fn read_program_scope(section: &Section<'_>, machine: &Machine) -> Option<Applied> {
    let scope = match section.get("scope") {
        None => Scope::Pose,
        Some(item) => match item.text()? {
            "pose" => Scope::Pose,
            "position" => Scope::Position,
            other => {
                let message = format!("no scope is called `{other}`");
                item.error("unknown-scope", message, "\"pose\" (usual) or \"position\"");
                return None;
            }
        },
    };
    let refuse = |e: trueaxis_machine::compensate::Fault| {
        section.error("cannot-compensate", e.to_string(), "is it the right machine?");
    };
    let compensator = Compensator::of(machine, scope).map_err(refuse).ok()?;
    Some(Applied::Program(Box::new(compensator)))
}

/// `programs`: the compensated programs that the certificate goes with, by their SHA-256.
fn read_programs(section: &Section<'_>, inputs: &mut Inputs) -> Option<Vec<Input>> {
    let Some(item) = section.get("programs") else { return Some(Vec::new()) };
    let mut found = Vec::new();
    for item in item.list()? {
        let mut problems = Diagnostics::new();
        let read = inputs.bytes("compensated program", item.text()?, &mut problems);
        section.take_over(problems);
        found.push(read?);
    }
    Some(found)
}

fn read_tables(section: &Section<'_>, machine: &Machine) -> Option<Applied> {
    let hint = "target = \"sinumerik\", \"linuxcnc\" or \"csv\"";
    let target = section.require("target", hint)?;
    let target = match target.text()? {
        "sinumerik" => Target::Sinumerik,
        "linuxcnc" => Target::LinuxCnc { trims: false },
        "linuxcnc-trims" => Target::LinuxCnc { trims: true },
        "csv" => Target::Csv,
        other => {
            let message = format!("no control is called `{other}`");
            let hint = "\"sinumerik\", \"linuxcnc\", \"linuxcnc-trims\" or \"csv\"";
            target.error("unknown-target", message, hint);
            return None;
        }
    };
    let usual = Order::of(target);
    let size = |key, dimension, usual| {
        section.get(key).map_or(Some(usual), |item| above_zero(&item, dimension))
    };
    let reference = match section.get("at") {
        Some(item) => Some(read_at(section, &item, machine)?),
        None => None,
    };
    let order = Order {
        reference,
        bound_mm: size("bound", Dimension::Length, usual.bound_mm)?,
        bound_rad: size("bound_angle", Dimension::Angle, usual.bound_rad)?,
        limit_mm: size("limit", Dimension::Length, usual.limit_mm)?,
        limit_rad: size("limit_angle", Dimension::Angle, usual.limit_rad)?,
        ..usual
    };
    match compile(machine, &order) {
        Ok(compiled) => Some(Applied::tables(compiled)),
        Err(error) => {
            let hint = "trueaxis compensate tables MACHINE.toml --target … says more";
            section.error("no-tables", error.to_string(), hint);
            None
        }
    }
}
