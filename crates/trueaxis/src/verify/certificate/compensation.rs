//! `[compensation]`: the compensation of the errors, and its files.

use super::applied::AppliedCompensation;
use super::file::{Application, above_zero};
use super::inputs::{Input, Inputs};
use super::loaded::check_loaded;
use super::used::read_at;
use trueaxis_correct::compensate::tables::{Order, Target, compile};
use trueaxis_input::{Diagnostics, Dimension, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::compensate::{Compensator, Fault, Scope};

/// Reads `[compensation]`; tables are compiled again and compared with the loaded ones.
pub fn read_compensation(
    section: &Section<'_>,
    machine: &Machine,
    inputs: &mut Inputs,
) -> Option<(AppliedCompensation, Application)> {
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
            let message = format!("unknown compensation `{other}`");
            kind.error("unknown-kind", message, "\"program\" or \"tables\"");
            return None;
        }
    };
    Some((applied, Application { method, date, by, files, loaded }))
}

fn read_program_scope(section: &Section<'_>, machine: &Machine) -> Option<AppliedCompensation> {
    let scope = match section.get("scope") {
        None => Scope::Pose,
        Some(item) => match item.text()? {
            "pose" => Scope::Pose,
            "position" => Scope::Position,
            other => {
                let message = format!("unknown scope `{other}`");
                item.error("unknown-scope", message, "\"pose\" (usual) or \"position\"");
                return None;
            }
        },
    };
    let refuse = |e: Fault| {
        section.error("cannot-compensate", e.to_string(), "is it the right machine?");
    };
    let compensator = Compensator::of(machine, scope).map_err(refuse).ok()?;
    Some(AppliedCompensation::Program(Box::new(compensator)))
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

fn read_tables(section: &Section<'_>, machine: &Machine) -> Option<AppliedCompensation> {
    let target = section.require("target", "target = \"sinumerik\", or another control")?;
    let target = match target.text()? {
        "sinumerik" => Target::Sinumerik,
        "linuxcnc" => Target::LinuxCnc { trims: false },
        "linuxcnc-trims" => Target::LinuxCnc { trims: true },
        "csv" => Target::Csv,
        "fanuc" => Target::Fanuc,
        "heidenhain" => Target::Heidenhain,
        "isg" => Target::Isg,
        other => {
            let message = format!("unknown control `{other}`");
            let hint = "\"sinumerik\", \"fanuc\", \"heidenhain\", \"isg\", \"linuxcnc\", \"linuxcnc-trims\" or \"csv\"";
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
    let kinematics = match section.get("kinematics") {
        Some(item) => item.flag()?,
        None => usual.kinematics,
    };
    let order = Order {
        reference,
        kinematics,
        bound_mm: size("bound", Dimension::Length, usual.bound_mm)?,
        bound_rad: size("bound_angle", Dimension::Angle, usual.bound_rad)?,
        limit_mm: size("limit", Dimension::Length, usual.limit_mm)?,
        limit_rad: size("limit_angle", Dimension::Angle, usual.limit_rad)?,
        ..usual
    };
    match compile(machine, &order) {
        Ok(compiled) => Some(AppliedCompensation::tables(compiled)),
        Err(error) => {
            let hint = "trueaxis compensate tables MACHINE.toml --target … shows details";
            section.error("no-tables", error.to_string(), hint);
            None
        }
    }
}
