//! Compensation tables and what they leave, as text and JSON.

use crate::compensate::tables::content::Line;
use crate::compensate::tables::grid::{Gridded, Side};
use crate::compensate::tables::joints::{Joint, Joints};
use crate::compensate::tables::known::MadeKnown;
use crate::compensate::tables::proof::{ErrorLoss, IndexLeft, Left};
use crate::compensate::tables::table::{PER_UNIT, Table, count_of};
use crate::compensate::tables::{Compiled, LeftOut, Made, What, known, shown};
use serde_json::{Map, Value as Json, json};
use std::fmt::Write;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::describe::to_shown;
use trueaxis_machine::errors::ErrorName;

/// What there is to tell.
pub struct TablesReport<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// The tables.
    pub compiled: &'a Compiled,
    /// The control, as the command line calls it.
    pub target: &'a str,
    /// The files as they were written.
    pub files: &'a [String],
    /// Study and indices of the test piece.
    pub piece: Option<(&'a str, &'a [IndexLeft])>,
}

/// More errors than this tell a reader nothing new.
const MOST_SHOWN: usize = 12;

/// The tables for people.
pub fn tables_text(report: &TablesReport<'_>) -> String {
    let TablesReport { machine, compiled, .. } = report;
    let name = |axis: usize| machine.axes()[axis].name;
    let mut text = format!(
        "{}   {}\n\n{} tables, made with the other axes at {}\n",
        machine.name(),
        machine.chain_text(),
        report.target,
        place_text(machine, &compiled.reference)
    );
    for Made { table, loss, .. } in &compiled.tables {
        let (moved, nodes) = (&machine.axes()[table.output], table.nodes.len());
        let both = if table.is_directional() { ", by direction" } else { "" };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {} moves {}: {nodes} nodes{both}, {}, loses {} between the nodes",
            name(table.input),
            name(table.output),
            check_text(machine, table),
            shown(moved, *loss)
        );
    }
    text += &known_text(machine, compiled);
    for LeftOut { what, largest, reason } in &compiled.left_out {
        let (what, size) = match what {
            What::Table { input, output } => {
                let size = shown(&machine.axes()[*output], *largest);
                (format!("{} moves {}", name(*input), name(*output)), size)
            }
            What::Error(error) => (error.to_string(), known::shown(*error, *largest)),
        };
        let _ = writeln!(text, "  left out: {what}, at most {size}: {reason}");
    }
    text += &left_text(report);
    text += &errors_text(&compiled.errors);
    if let Some((study, indices)) = report.piece {
        let _ = writeln!(text, "\nTest piece {study}, µm without and with the tables");
        for index in indices {
            let [a, b] = [index.before_mm, index.left_mm].map(|v| v * 1e3);
            let worse = if b > a { "   worse" } else { "" };
            let _ = writeln!(text, "  {:<34} {a:>9.3} {b:>9.3}{worse}", index.key);
        }
    }
    if !compiled.advice.is_empty() {
        text += "\nNotes\n";
    }
    for line in compiled.advice {
        let _ = writeln!(text, "  {line}");
    }
    text += "\nFiles\n";
    for file in report.files {
        let _ = writeln!(text, "  {file}");
    }
    text
}

/// The errors that the control's chain knows, and its grid.
fn known_text(machine: &Machine, compiled: &Compiled) -> String {
    let mut text = String::new();
    for MadeKnown { known, loss, largest, .. } in &compiled.known {
        let nodes = match known.nodes.len() {
            1 => "constant".to_owned(),
            n => format!("{n} nodes, loses {} between them", known::shown(known.error, *loss)),
        };
        let size = known::shown(known.error, *largest);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {} up to {size}: {nodes}", known.error);
    }
    for line in &compiled.lines {
        let axis = &machine.axes()[line.axis];
        let count = count_of(machine, line.axis);
        let _ = writeln!(
            text,
            "  {} for the temperatures: {} at {}, {:.3} µm/m or µrad/rad",
            axis.name,
            shown(axis, line.offset as f64 * count),
            round(line.reference as f64 / PER_UNIT),
            line.slope as f64 * 1e-3
        );
    }
    for (actual, nominal) in joints_of(machine, compiled) {
        let [x, y, z] = (actual.point_mm() - nominal.point_mm()).map(|c| c * 1e3).into();
        let tilt = (actual.along() - nominal.along()).norm() * 1e6;
        let _ = writeln!(
            text,
            "  {} in the control's kinematics: moved by {x:.2} {y:.2} {z:.2} µm, tilted by {tilt:.2} µrad",
            actual.axis
        );
    }
    if let Some(Gridded { grid, loss, largest }) = &compiled.grid {
        let side = |s: &Side| {
            let (from, step) = (s.from as f64 / PER_UNIT, s.step as f64 / PER_UNIT);
            format!("{} {} from {from} mm every {step} mm", s.count, machine.axes()[s.axis].name)
        };
        let _ = writeln!(
            text,
            "  grid {}: up to {:.2} µm, loses {:.2} µm between the points",
            grid.sides.each_ref().map(side).join(" x "),
            *largest as f64 / PER_UNIT * 1e3,
            loss / PER_UNIT * 1e3
        );
    }
    text
}

/// The rotary axes as the control has them, beside the nominal ones.
fn joints_of(machine: &Machine, compiled: &Compiled) -> Vec<(Joint, Joint)> {
    let Some(joints) = &compiled.joints else { return Vec::new() };
    joints.0.iter().copied().zip(Joints::nominal(machine).0).collect()
}

/// What is added where, by the node that adds most.
fn check_text(machine: &Machine, table: &Table) -> String {
    let Some(node) = table.largest() else { return String::new() };
    let [input, output] = [table.input, table.output].map(|i| &machine.axes()[i]);
    let unit = if input.kind == AxisKind::Linear { "mm" } else { "deg" };
    let added = shown(output, node.up as f64 * count_of(machine, table.output));
    let place = round(node.at as f64 / PER_UNIT);
    format!("adds {added} to {} at {}={place} {unit}", output.name, input.name)
}

fn left_text(report: &TablesReport<'_>) -> String {
    let Compiled { before, after, wrong_sign, .. } = report.compiled;
    let line = |left: &Left| {
        format!(
            "{:9.2} µm at most, {:9.2} µm rms, tool axis {:7.2} µrad",
            left.max_mm * 1e3,
            left.rms_mm * 1e3,
            left.axis_rad * 1e6
        )
    };
    format!(
        "\nTool tip over the travel of all axes, {} poses, each from both sides, files read back\n  \
         without tables {}\n  with tables    {}\n  wrong sign     {}\n  the most is left at {}\n",
        after.poses,
        line(before),
        line(after),
        line(wrong_sign),
        place_text(report.machine, &after.at)
    )
}

fn errors_text(errors: &[ErrorLoss]) -> String {
    let (represented, not): (Vec<_>, Vec<_>) = errors.iter().partition(|e| e.represented);
    let names: Vec<String> = represented.iter().map(|e| e.error.to_string()).collect();
    let mut text = format!("\nRepresented: {}\n", names.join(" "));
    if !not.is_empty() {
        text +=
            "Not represented, each alone, µm at the tip\n    error    before      left  instead\n";
    }
    for e in not.iter().take(MOST_SHOWN) {
        let [before, left] = [e.before_mm, e.left_mm].map(|v| v * 1e3);
        let _ =
            writeln!(text, "  {:>7} {before:9.2} {left:9.2}  {}", e.error.to_string(), e.instead);
    }
    if not.len() > MOST_SHOWN {
        let _ = writeln!(text, "  … and {} smaller ones", not.len() - MOST_SHOWN);
    }
    text
}

fn place_text(machine: &Machine, command: &Command) -> String {
    let one = |(i, axis): (usize, &trueaxis_machine::axis::Axis)| {
        format!("{}={}", axis.name, round(to_shown(machine, i, command[i])))
    };
    machine.axes().iter().enumerate().map(one).collect::<Vec<_>>().join(" ")
}

/// Without the noise of radians.
fn round(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

/// The tables as one document.
pub fn tables_json(report: &TablesReport<'_>) -> Json {
    let TablesReport { machine, compiled, .. } = report;
    let (represented, not): (Vec<_>, Vec<_>) = compiled.errors.iter().partition(|e| e.represented);
    let cannot = not.iter().map(|e| {
        json!({
            "error": e.error.to_string(),
            "before_um": e.before_mm * 1e3,
            "left_um": e.left_mm * 1e3,
            "instead": e.instead,
        })
    });
    let piece = report.piece.map(|(study, indices)| {
        let one = |i: &IndexLeft| {
            json!({ "index": i.key, "before_um": i.before_mm * 1e3, "left_um": i.left_mm * 1e3 })
        };
        json!({ "study": study, "indices": indices.iter().map(one).collect::<Vec<_>>() })
    });
    json!({
        "schema": "trueaxis/compensate-tables/1",
        "machine": machine.name(),
        "target": report.target,
        "files": report.files,
        "added_to": "command",
        "reference": place_json(machine, &compiled.reference),
        "tables": compiled.tables.iter().map(|t| made_json(machine, t)).collect::<Vec<_>>(),
        "known": compiled.known.iter().map(known_json).collect::<Vec<_>>(),
        "temperature": compiled.lines.iter().map(|l| line_json(machine, l)).collect::<Vec<_>>(),
        "kinematics": joints_of(machine, compiled).iter().map(joint_json).collect::<Vec<_>>(),
        "grid": compiled.grid.as_ref().map(|g| grid_json(machine, g)),
        "left_out": compiled.left_out.iter().map(|t| out_json(machine, t)).collect::<Vec<_>>(),
        "represents": represented.iter().map(|e| e.error.to_string()).collect::<Vec<_>>(),
        "cannot": cannot.collect::<Vec<_>>(),
        "before_um": left_json(machine, &compiled.before, None),
        "left_um": left_json(machine, &compiled.after, Some(piece)),
        "wrong_sign_um": left_json(machine, &compiled.wrong_sign, None),
        "notes": compiled.advice,
    })
}

fn left_json(machine: &Machine, left: &Left, piece: Option<Option<Json>>) -> Json {
    let mut json = json!({
        "max": left.max_mm * 1e3,
        "rms": left.rms_mm * 1e3,
        "at": place_json(machine, &left.at),
        "poses": left.poses,
        "axis_urad": left.axis_rad * 1e6,
    });
    if let Some(piece) = piece {
        json["test_piece"] = piece.unwrap_or(Json::Null);
    }
    json
}

fn place_json(machine: &Machine, command: &Command) -> Json {
    let one = |(i, axis): (usize, &trueaxis_machine::axis::Axis)| {
        (axis.name.to_string(), json!(round(to_shown(machine, i, command[i]))))
    };
    Json::Object(machine.axes().iter().enumerate().map(one).collect::<Map<_, _>>())
}

/// The key and the factor of a correction.
fn unit(machine: &Machine, axis: usize) -> (&'static str, f64) {
    match machine.axes()[axis].kind {
        AxisKind::Linear => ("um", 1e3),
        AxisKind::Rotary => ("urad", 1e6),
    }
}

fn made_json(machine: &Machine, made: &Made) -> Json {
    let Made { table, loss, largest } = made;
    let (unit, factor) = unit(machine, table.output);
    let name = |axis: usize| machine.axes()[axis].name.to_string();
    let mut json = json!({
        "input": name(table.input),
        "output": name(table.output),
        "nodes": table.nodes.len(),
        "by_direction": table.is_directional(),
        "modulo": table.modulo,
    });
    if let Some(node) = table.largest() {
        json["check"] = json!({ "position": round(node.at as f64 / PER_UNIT) });
        let added = node.up as f64 * count_of(machine, table.output);
        json["check"][format!("added_{unit}")] = json!(added * factor);
    }
    json[format!("loss_{unit}")] = json!(loss * factor);
    json[format!("largest_{unit}")] = json!(largest * factor);
    json
}

fn out_json(machine: &Machine, out: &LeftOut) -> Json {
    let name = |axis: usize| machine.axes()[axis].name.to_string();
    let (mut json, (unit, factor)) = match out.what {
        What::Table { input, output } => {
            (json!({ "input": name(input), "output": name(output) }), unit(machine, output))
        }
        What::Error(error) => (json!({ "error": error.to_string() }), unit_of_error(error)),
    };
    json["reason"] = json!(out.reason);
    json[format!("largest_{unit}")] = json!(out.largest * factor);
    json
}

fn unit_of_error(error: ErrorName) -> (&'static str, f64) {
    match error.component.is_rotation() {
        true => ("urad", 1e6),
        false => ("um", 1e3),
    }
}

fn known_json(made: &MadeKnown) -> Json {
    let MadeKnown { known, loss, largest, .. } = made;
    let (unit, factor) = unit_of_error(known.error);
    let mut json = json!({ "error": known.error.to_string(), "nodes": known.nodes.len() });
    json[format!("loss_{unit}")] = json!(loss * factor);
    json[format!("largest_{unit}")] = json!(largest * factor);
    json
}

fn line_json(machine: &Machine, line: &Line) -> Json {
    let (unit, factor) = unit(machine, line.axis);
    let mut json = json!({
        "axis": machine.axes()[line.axis].name.to_string(),
        "reference": line.reference as f64 / PER_UNIT,
        "slope_um_per_m": line.slope as f64 * 1e-3,
    });
    json[format!("offset_{unit}")] =
        json!(line.offset as f64 * count_of(machine, line.axis) * factor);
    json
}

fn joint_json((actual, nominal): &(Joint, Joint)) -> Json {
    let vector = |v: Vec3| [v.x, v.y, v.z];
    json!({
        "axis": actual.axis.to_string(),
        "point_mm": vector(actual.point_mm()),
        "direction": vector(actual.along()),
        "moved_um": vector((actual.point_mm() - nominal.point_mm()) * 1e3),
        "tilted_urad": vector((actual.along() - nominal.along()) * 1e6),
    })
}

fn grid_json(machine: &Machine, gridded: &Gridded) -> Json {
    let Gridded { grid, loss, largest } = gridded;
    let side = |s: &Side| {
        json!({
            "axis": machine.axes()[s.axis].name.to_string(),
            "from_mm": s.from as f64 / PER_UNIT,
            "step_mm": s.step as f64 / PER_UNIT,
            "points": s.count,
        })
    };
    json!({
        "sides": grid.sides.each_ref().map(side),
        "points": grid.values.len(),
        "loss_um": loss / PER_UNIT * 1e3,
        "largest_um": *largest as f64 / PER_UNIT * 1e3,
    })
}
