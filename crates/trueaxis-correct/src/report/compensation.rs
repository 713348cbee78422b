//! Compensation values as text and CSV.

use crate::compensate::values::{MOST_POSITIONS, Value, ValueTable};
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisKind, AxisSide};
use trueaxis_machine::heat::ErrorPart;
use trueaxis_predict::predict::holes::Compensation;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Report, Section, Table};

/// The units of an axis: of its positions, and of its errors in text, CSV and JSON.
pub(super) struct Units {
    pub place: &'static str,
    place_scale: f64,
    shown: &'static str,
    shown_scale: f64,
    /// The suffixes of keys and headings with their factors.
    pub keys: &'static [(&'static str, f64)],
}

/// 1 rad in arcsec.
const ARCSEC: f64 = 180.0 * 3600.0 / std::f64::consts::PI;

pub(super) fn units(axis: &Axis) -> Units {
    match axis.kind {
        AxisKind::Linear => Units {
            place: "mm",
            place_scale: 1.0,
            shown: "µm",
            shown_scale: 1e3,
            keys: &[("um", 1e3)],
        },
        AxisKind::Rotary => Units {
            place: "deg",
            place_scale: 180.0 / std::f64::consts::PI,
            shown: "arcsec",
            shown_scale: ARCSEC,
            keys: &[("urad", 1e6), ("arcsec", ARCSEC)],
        },
    }
}

/// A position without the noise of radians.
pub(super) fn place(units: &Units, position: f64) -> f64 {
    (position * units.place_scale * 1e9).round() / 1e9 + 0.0
}

fn axis<'a>(machine: &'a Machine, table: &ValueTable) -> &'a Axis {
    &machine.axes()[table.order.axis]
}

/// The increment as people write it.
pub(super) fn increment(axis: &Axis, table: &ValueTable) -> String {
    let value = match axis.kind {
        AxisKind::Linear => (table.order.increment * 1e3, "µm"),
        AxisKind::Rotary => (table.order.increment.to_degrees(), "deg"),
    };
    format!("{} {}", (value.0 * 1e9).round() / 1e9, value.1)
}

/// Where compensating the machine alone makes the part worse.
pub fn compensation_warnings(machine: &Machine, tables: &[ValueTable]) -> Vec<String> {
    let worse = tables.iter().filter(|t| t.machine_alone_is_worse());
    let tell = |table: &ValueTable| {
        let axis = axis(machine, table);
        let units = units(axis);
        let [none, alone, whole] = table.worst.map(|v| v * units.shown_scale);
        let unit = units.shown;
        format!(
            "COMPENSATING THE MACHINE ALONE MAKES THE PART WORSE in {}: {alone:.1} {unit} instead of \
             {none:.1} {unit}; the comprehensive compensation leaves {whole:.1} {unit}",
            axis.name
        )
    };
    worse.map(tell).collect()
}

/// Errors are along the machine's axes, the value along the command, which moves the body by its sense.
fn sign_note(axis: &Axis) -> String {
    let along = axis.sense * axis.direction[axis.direction.iamax()];
    let carried = match (axis.carries, along > 0.0) {
        (AxisSide::Tool, true) => "it carries the tool: error and value have opposite signs",
        (AxisSide::Tool, false) => {
            "it carries the tool against its command: where its body stands too far in the positive direction \
             of the machine, the value is positive"
        }
        (AxisSide::Workpiece, true) => {
            "it carries the workpiece along its command: error and value have opposite signs"
        }
        (AxisSide::Workpiece, false) => {
            "it carries the workpiece: where its body stands too far in the positive direction of the \
             machine, the value is positive"
        }
    };
    format!("{}: {carried}", axis.name)
}

fn meaning(of: Compensation) -> &'static str {
    match of {
        Compensation::Comprehensive => "- (machine - workpiece), the comprehensive error",
        Compensation::Machine | Compensation::None => "- machine, the workpiece is left out",
    }
}

/// The values as tables, the warnings first.
pub fn compensation_report<'a>(machine: &Machine, tables: &[ValueTable]) -> Report<'a> {
    let warnings = compensation_warnings(machine, tables);
    let warnings = warnings.into_iter().map(|warning| format!("WARNING  {warning}"));
    Report::new(machine.name())
        .line(machine.chain_text())
        .section(Section::new("").list(warnings))
        .sections(tables.iter().map(|table| section(axis(machine, table), table)))
}

fn section<'a>(axis: &Axis, table: &ValueTable) -> Section<'a> {
    let units = units(axis);
    let unit = units.shown;
    let shown = |v: f64| fixed(v * units.shown_scale, 1);
    let title = format!(
        "Values of {} in increments of {}, to be added to the command",
        axis.name,
        increment(axis, table)
    );
    let rule = format!("value = {}; {}", meaning(table.order.of), sign_note(axis));
    let [none, alone, whole] = table.worst.map(shown);
    let part = match table.part_is_known {
        true => format!(
            "{none} {unit} without compensation, {alone} {unit} with the machine alone, {whole} {unit} with \
             the comprehensive one"
        ),
        false => "not known, as the temperature of the workpiece is not given".to_owned(),
    };
    let note = format!(
        "errors, u (standard uncertainty) and remainder in {unit}; largest error of the part at these positions: {part}"
    );
    let known = |text: String| if table.part_is_known { text } else { "–".to_owned() };
    let both = table.nodes.iter().any(|n| n.by_direction.is_some());
    let by_direction: &[&str] = if both { &["value ↑", "value ↓"] } else { &[] };
    let place_heading = format!("{}, {}", axis.name, units.place);
    let headings = std::iter::once(&place_heading[..]).chain(HEADINGS).chain(by_direction.to_vec());
    let rows = table.nodes.iter().map(|node| {
        let [geometric, scale, structure, workpiece] = node.split.map(shown);
        let mut row = vec![place(&units, node.position).to_string(), geometric, scale, structure];
        row.extend([shown(node.machine), known(workpiece), known(shown(node.comprehensive))]);
        row.push(node.u.map_or("–".to_owned(), shown));
        row.extend([node.value.increments.to_string(), shown(node.value.remainder)]);
        row.extend(node.by_direction.iter().flatten().map(|value| value.increments.to_string()));
        row
    });
    let table = Table::new(headings).rows(rows).note(note).most_on_terminal(MOST_POSITIONS);
    Section::new(title).paragraph(rule).table(table)
}

/// The parts of an error, from the left to the right as they add up, and what is done about it.
const HEADINGS: [&str; 9] = [
    "geometric",
    "+ scale",
    "+ struct.",
    "= machine",
    "- workpiece",
    "= part",
    "u",
    "value",
    "remainder",
];

/// The values of one axis as a table that begins with its conditions as comments; where they are of the
/// machine alone, with what that can cost.
pub fn compensation_csv(machine: &Machine, table: &ValueTable, only: Option<&str>) -> String {
    let axis = axis(machine, table);
    let units = units(axis);
    let (unit, scale) = units.keys[0];
    let mut text = format!(
        "# TrueAxis compensation values of {} of {}, added to the command{}\n# value = {}; increment {}\n",
        axis.name,
        machine.name().replace(['\n', '\r'], " "),
        only.map_or(String::new(), |only| format!(". {only}")),
        meaning(table.order.of),
        increment(axis, table)
    );
    for warning in compensation_warnings(machine, std::slice::from_ref(table)) {
        let _ = writeln!(text, "# WARNING {warning}");
    }
    let both = table.nodes.iter().any(|n| n.by_direction.is_some());
    let _ = write!(text, "position_{},value_increments,value_{unit},remainder_{unit}", units.place);
    for part in ErrorPart::ALL {
        let _ = write!(text, ",{}_{unit}", part.name());
    }
    let _ = write!(text, ",machine_{unit},comprehensive_{unit},u_{unit}");
    text += if both { ",value_up_increments,value_down_increments\n" } else { "\n" };
    for node in &table.nodes {
        let Value { increments, added, remainder } = node.value;
        let _ = write!(text, "{},{increments}", place(&units, node.position));
        let numbers = [added, remainder].into_iter().chain(node.split);
        let numbers: Vec<f64> = numbers.chain([node.machine, node.comprehensive]).collect();
        for (i, v) in numbers.iter().enumerate() {
            // Of the part: the workpiece, and what remains with it.
            match table.part_is_known || ![5, 7].contains(&i) {
                true => {
                    let _ = write!(text, ",{}", v * scale + 0.0);
                }
                false => text.push(','),
            }
        }
        let _ = write!(text, ",{}", node.u.map_or(String::new(), |u| (u * scale).to_string()));
        if both {
            let [up, down] = node.by_direction.unwrap_or([node.value; 2]);
            let _ = write!(text, ",{},{}", up.increments, down.increments);
        }
        text.push('\n');
    }
    text
}
