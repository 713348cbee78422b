//! Compensation values as text and CSV.

use crate::compensate::values::{Value, ValueTable};
use crate::predict::holes::Compensation;
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisKind, AxisSide};
use trueaxis_machine::heat::ErrorPart;

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

fn sign_note(axis: &Axis) -> String {
    let carried = match axis.carries {
        AxisSide::Tool => "it carries the tool: error and value have opposite signs",
        AxisSide::Workpiece => {
            "it carries the workpiece: where its body stands too far in the positive direction of the \
             machine, the value is positive"
        }
    };
    format!("{}: {carried}", axis.name)
}

fn title(of: Compensation) -> &'static str {
    match of {
        Compensation::Comprehensive => "- (machine - workpiece), the comprehensive error",
        Compensation::Machine | Compensation::None => "- machine, the workpiece is left out",
    }
}

/// The values as tables, the warnings first.
pub fn compensation_text(machine: &Machine, tables: &[ValueTable]) -> String {
    let mut text = format!("{}   {}\n", machine.name(), machine.chain_text());
    for warning in compensation_warnings(machine, tables) {
        // Writing to a String cannot fail.
        let _ = write!(text, "\n  WARNING  {warning}\n");
    }
    for table in tables {
        text += &one_text(axis(machine, table), table);
    }
    text
}

fn one_text(axis: &Axis, table: &ValueTable) -> String {
    let units = units(axis);
    let unit = units.shown;
    let shown = |v: f64| {
        // No minus before a zero.
        format!("{:.1}", (v * units.shown_scale * 10.0).round() / 10.0 + 0.0)
    };
    let mut text = format!(
        "\nValues of {} in increments of {}, to be added to the command\n  value = {}\n  {}\n\n",
        axis.name,
        increment(axis, table),
        title(table.order.of),
        sign_note(axis)
    );
    let both = table.nodes.iter().any(|n| n.by_direction.is_some());
    let up_down = if both { "     value ↑    value ↓" } else { "" };
    let head = format!("{}, {}", axis.name, units.place);
    let _ = writeln!(
        text,
        "  {head:>10}  geometric   + scale + struct. = machine - workpiece    = part       u      value \
         remainder{up_down}"
    );
    for node in &table.nodes {
        let [geometric, scale, structure, workpiece] = node.split.map(shown);
        let (machine, part) = (shown(node.machine), shown(node.comprehensive));
        let u = node.u.map_or("–".to_owned(), |u| format!("{:.1}", u * units.shown_scale));
        let (at, value) = (place(&units, node.position), node.value.increments);
        let remainder = shown(node.value.remainder);
        let _ = write!(
            text,
            "  {at:>10}  {geometric:>9} {scale:>9} {structure:>9} {machine:>9} {workpiece:>11} {part:>9} \
             {u:>7} {value:>10} {remainder:>9}"
        );
        if let Some([up, down]) = node.by_direction {
            let _ = write!(text, "  {:>10} {:>10}", up.increments, down.increments);
        }
        text.push('\n');
    }
    let [none, alone, whole] = table.worst.map(shown);
    let _ = writeln!(
        text,
        "\n  errors, u (standard uncertainty) and remainder in {unit}\n  largest error of the part: \
         {none} {unit} without compensation, {alone} {unit} with the machine alone, {whole} {unit} \
         with the comprehensive one"
    );
    text
}

/// The values of one axis as a table that begins with its conditions as comments.
pub fn compensation_csv(machine: &Machine, table: &ValueTable) -> String {
    let axis = axis(machine, table);
    let units = units(axis);
    let (unit, scale) = units.keys[0];
    let mut text = format!(
        "# TrueAxis compensation values of {} of {}, added to the command\n# value = {}; increment {}\n",
        axis.name,
        machine.name().replace(['\n', '\r'], " "),
        title(table.order.of),
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
        for v in numbers.chain([node.machine, node.comprehensive]) {
            let _ = write!(text, ",{}", v * scale + 0.0);
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
