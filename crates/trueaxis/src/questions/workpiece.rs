//! A workpiece of unknown temperature: values of the machine alone only where they are asked for.
//!
//! Zhang et al. 2019, section 3.2.1: compensating the machine alone makes a warm part nine times worse.

use super::MachineChoice;
use super::words::argument;
use trueaxis_input::{Diagnostics, Files};
use trueaxis_machine::Machine;
use trueaxis_machine::heat::Conditions;
use trueaxis_report::Report;

/// Whether the values are for a part, and what it can cost if they are not.
#[derive(Debug, Clone, Default)]
pub(super) struct Asked {
    /// `--machine-only`, or another word for it.
    pub machine_only: bool,
    /// The cost for the very positions that are asked for, where it is known.
    pub here: Option<String>,
}

/// What it can cost the part that the temperature of the workpiece is not known; none where it is.
pub(super) fn price(machine: &Machine, conditions: &Conditions) -> Option<String> {
    let found = machine.unknown_growth(conditions)?;
    let over = match found.axis {
        Some(axis) => format!("the {} mm of {}", found.over_mm, machine.axes()[axis].name),
        None => format!("{} mm", found.over_mm),
    };
    let per_k_um = found.per_k_mm * 1e3;
    let warm = found.scales_celsius.map(|celsius| {
        let um = found.per_k_mm * (celsius - trueaxis_machine::heat::REFERENCE_CELSIUS) * 1e3;
        format!(", {um:.1} µm if it has the {celsius:.1} °C of the scales")
    });
    Some(format!(
        "each K of the workpiece above 20 °C displaces the part by {per_k_um:.1} µm over {over}{}",
        warm.unwrap_or_default()
    ))
}

/// The cost that the user accepts, none where the temperature is known, or an error: `None`.
pub(super) fn accepted(
    machine: &Machine,
    conditions: &Conditions,
    asked: &Asked,
    problems: &mut Diagnostics,
) -> Option<Option<String>> {
    let Some(mut price) = price(machine, conditions) else { return Some(None) };
    if let Some(here) = &asked.here {
        price = format!("{price}; {here}");
    }
    if asked.machine_only {
        return Some(Some(price));
    }
    let sensors = machine.heat().workpiece.iter().flat_map(|w| &w.sensors);
    let sensors: Vec<String> = sensors.map(|s| format!("{}=20", s.name)).collect();
    let message = format!(
        "the temperature of the workpiece is not given, and compensating the machine alone can make the \
         part worse: {price}"
    );
    let hint = format!(
        "state it: --temperature \"{}\" if it is at 20 °C; or --machine-only for the machine without a \
         part, such as a check with a laser",
        sensors.join(" ")
    );
    problems.error("no-workpiece-temperature", argument("--temperature"), message, &hint);
    None
}

/// The same for a machine as it was chosen; with the machine that is compensated, without its workpiece where
/// only the machine is wanted.
pub(super) fn machine_or_part(
    machine: Machine,
    choice: &MachineChoice,
    files: &Files,
    machine_only: bool,
    problems: &mut Diagnostics,
) -> Option<(Machine, Option<String>)> {
    // What is wrong with the temperatures was reported when the machine was read.
    let conditions = choice.conditions(files, &mut Diagnostics::new()).flatten();
    let asked = Asked { machine_only, here: None };
    let price = accepted(&machine, &conditions.unwrap_or_default(), &asked, problems)?;
    if let Some(price) = &price {
        warn(price, problems);
    }
    let machine = if machine_only { machine.without_growth() } else { machine };
    Some((machine, price))
}

/// Where the report is not what is seen first.
pub(super) fn warn(price: &str, problems: &mut Diagnostics) {
    let hint = "do not cut a part with it; give the temperature of the workpiece";
    problems.warn("machine-only", argument("--machine-only"), heading(price), hint);
}

/// The first line of all that is made for the machine alone.
pub(super) fn heading(price: &str) -> String {
    format!("MACHINE ONLY, not for a part: {price}")
}

/// The report with the cost on top.
pub(super) fn on_top<'a>(mut report: Report<'a>, price: Option<&str>) -> Report<'a> {
    if let Some(price) = price {
        let title = std::mem::replace(&mut report.title, heading(price));
        report.lines.insert(0, title);
    }
    report
}
