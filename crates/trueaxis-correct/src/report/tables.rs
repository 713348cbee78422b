//! Compensation tables and what they leave, as text.

use crate::compensate::tables::grid::{Gridded, Side};
use crate::compensate::tables::joints::{Joint, Joints};
use crate::compensate::tables::known::MadeKnown;
use crate::compensate::tables::proof::{ErrorLoss, IndexLeft, Left};
use crate::compensate::tables::table::{PER_UNIT, Table, count_of};
use crate::compensate::tables::{Compiled, LeftOut, Made, What, known, shown};
use std::fmt::Write;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::describe::to_shown;

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

/// The tables as text.
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
pub(super) fn joints_of(machine: &Machine, compiled: &Compiled) -> Vec<(Joint, Joint)> {
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
pub(super) fn round(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}
