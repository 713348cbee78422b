//! Compensation tables and what they leave, in text and on a page.

use crate::compensate::tables::grid::{Gridded, Side};
use crate::compensate::tables::joints::{Joint, Joints};
use crate::compensate::tables::known::MadeKnown;
use crate::compensate::tables::proof::{ErrorLoss, IndexLeft, Left};
use crate::compensate::tables::table::{self, PER_UNIT, count_of};
use crate::compensate::tables::{Compiled, LeftOut, Made, What, known, shown};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::describe::to_shown;
use trueaxis_predict::predict::drawing::{CompensatedPart, PartPrediction, PartStudy};
use trueaxis_predict::report::compensated_table;
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Report, Section, Table};

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
    /// The part of a study as it is and with the tables.
    pub part: Option<&'a PartWithTables>,
    /// What tables of the machine alone can cost, where the temperature of the workpiece is not known.
    pub machine_only: Option<&'a str>,
}

/// A part cut with the tables, and before.
pub struct PartWithTables {
    /// The study.
    pub study: PartStudy,
    /// Without tables.
    pub before: PartPrediction,
    /// With them.
    pub after: CompensatedPart,
}

/// More errors than this tell a reader nothing new.
const MOST_SHOWN: usize = 12;

/// The tables with what they leave.
pub fn tables_report<'a>(report: &TablesReport<'_>) -> Report<'a> {
    let TablesReport { machine, compiled, .. } = report;
    let title = format!(
        "{} tables, made with the other axes at {}",
        report.target,
        place_text(machine, &compiled.reference)
    );
    let made = Section::new(title)
        .list(compiled.tables.iter().map(|made| made_text(machine, made)))
        .list(known_texts(machine, compiled))
        .list(compiled.left_out.iter().map(|left| left_out_text(machine, left)));
    Report::new(machine.name())
        .line(machine.chain_text())
        .section(made)
        .section(left(report))
        .sections(errors(&compiled.errors))
        .sections(report.piece.map(|(study, indices)| piece(study, indices)))
        .sections(report.part.map(part))
        .section(Section::new("Notes").list(compiled.advice.iter().map(ToString::to_string)))
        .section(Section::new("Files").list(report.files.iter().cloned()))
}

fn moves(machine: &Machine, input: usize, output: usize) -> String {
    let [input, output] = [input, output].map(|axis| machine.axes()[axis].name);
    format!("{input} moves {output}")
}

fn made_text(machine: &Machine, Made { table, loss, .. }: &Made) -> String {
    let both = if table.is_directional() { ", by direction" } else { "" };
    format!(
        "{}: {} nodes{both}, {}, loses {} between the nodes",
        moves(machine, table.input, table.output),
        table.nodes.len(),
        check_text(machine, table),
        shown(&machine.axes()[table.output], *loss)
    )
}

fn left_out_text(machine: &Machine, LeftOut { what, largest, reason }: &LeftOut) -> String {
    let (what, size) = match what {
        What::Table { input, output } => {
            let size = shown(&machine.axes()[*output], *largest);
            (moves(machine, *input, *output), size)
        }
        What::Error(error) => (error.to_string(), known::shown(*error, *largest)),
    };
    format!("left out: {what}, at most {size}: {reason}")
}

fn piece<'a>(study: &str, indices: &[IndexLeft]) -> Section<'a> {
    let rows = indices.iter().map(|index| {
        let [before, left] = [index.before_mm, index.left_mm].map(|v| fixed(v * 1e3, 3));
        let worse = if index.left_mm > index.before_mm { "worse" } else { "" };
        [index.key.to_string(), before, left, worse.to_owned()]
    });
    let headings = ["", "without tables, µm", "with tables, µm", ""];
    Section::new(format!("Test piece {study}")).table(Table::new(headings).rows(rows))
}

fn part<'a>(PartWithTables { study, before, after }: &PartWithTables) -> Section<'a> {
    let sentence = format!(
        "{} before; with the tables {} where the zero is kept, {} where it is set again.",
        before.outcome.word(),
        after.zero_kept.outcome.word(),
        after.zero_set.outcome.word()
    );
    let note = "Cut on the same machine with the same u. Zero kept: where it was set without the tables, so that what counts from it keeps \
                the error of the tip there. Zero set again: with the tables in force.";
    let table = compensated_table(study, before, after).note(note);
    Section::new(format!("Part {}", study.path.display())).paragraph(sentence).table(table)
}

/// The errors that the control's chain knows, and its grid.
fn known_texts(machine: &Machine, compiled: &Compiled) -> Vec<String> {
    let mut lines = Vec::new();
    for MadeKnown { known, loss, largest, .. } in &compiled.known {
        let nodes = match known.nodes.len() {
            1 => "constant".to_owned(),
            n => format!("{n} nodes, loses {} between them", known::shown(known.error, *loss)),
        };
        let size = known::shown(known.error, *largest);
        lines.push(format!("{} up to {size}: {nodes}", known.error));
    }
    for line in &compiled.lines {
        let axis = &machine.axes()[line.axis];
        let count = count_of(machine, line.axis);
        lines.push(format!(
            "{} for the temperatures: {} at {}, {:.3} µm/m or µrad/rad",
            axis.name,
            shown(axis, line.offset as f64 * count),
            round(line.reference as f64 / PER_UNIT),
            line.slope as f64 * 1e-3
        ));
    }
    for (actual, nominal) in joints_of(machine, compiled) {
        let [x, y, z] = (actual.point_mm() - nominal.point_mm()).map(|c| c * 1e3).into();
        let tilt = (actual.along() - nominal.along()).norm() * 1e6;
        lines.push(format!(
            "{} in the control's kinematics: moved by {x:.2} {y:.2} {z:.2} µm, tilted by {tilt:.2} µrad",
            actual.axis
        ));
    }
    if let Some(Gridded { grid, loss, largest }) = &compiled.grid {
        let side = |s: &Side| {
            let (from, step) = (s.from as f64 / PER_UNIT, s.step as f64 / PER_UNIT);
            format!("{} {} from {from} mm every {step} mm", s.count, machine.axes()[s.axis].name)
        };
        lines.push(format!(
            "grid {}: up to {:.2} µm, loses {:.2} µm between the points",
            grid.sides.each_ref().map(side).join(" x "),
            *largest as f64 / PER_UNIT * 1e3,
            loss / PER_UNIT * 1e3
        ));
    }
    lines
}

/// The rotary axes as the control has them, beside the nominal ones.
pub(super) fn joints_of(machine: &Machine, compiled: &Compiled) -> Vec<(Joint, Joint)> {
    let Some(joints) = &compiled.joints else { return Vec::new() };
    joints.0.iter().copied().zip(Joints::nominal(machine).0).collect()
}

/// What is added where, by the node that adds most.
fn check_text(machine: &Machine, table: &table::Table) -> String {
    let Some(node) = table.largest() else { return String::new() };
    let [input, output] = [table.input, table.output].map(|i| &machine.axes()[i]);
    let unit = if input.kind == AxisKind::Linear { "mm" } else { "deg" };
    let added = shown(output, node.up as f64 * count_of(machine, table.output));
    let place = round(node.at as f64 / PER_UNIT);
    format!("adds {added} to {} at {}={place} {unit}", output.name, input.name)
}

fn left<'a>(report: &TablesReport<'_>) -> Section<'a> {
    let Compiled { before, after, after_zero_set, wrong_sign, .. } = report.compiled;
    let row = |(name, left): (&str, &Left)| {
        let numbers = [left.max_mm * 1e3, left.rms_mm * 1e3, left.axis_rad * 1e6];
        std::iter::once(name.to_owned()).chain(numbers.map(|v| fixed(v, 2)))
    };
    let rows = [
        ("without tables", before),
        ("with tables", after),
        ("with tables, zero set", after_zero_set),
        ("wrong sign", wrong_sign),
    ];
    let note = format!(
        "{} poses, each from both sides, files read back; the most is left at {}. Zero set: the part \
         zero was set with the tables in force, the axes at {}",
        after.poses,
        place_text(report.machine, &after.at),
        place_text(report.machine, &report.compiled.reference)
    );
    let headings = ["", "at most, µm", "rms, µm", "tool axis, µrad"];
    Section::new("Tool tip over the travel of all axes")
        .table(Table::new(headings).rows(rows.map(row)).note(note))
}

fn errors<'a>(errors: &[ErrorLoss]) -> [Section<'a>; 2] {
    let (represented, not): (Vec<_>, Vec<_>) = errors.iter().partition(|e| e.represented);
    let names: Vec<String> = represented.iter().map(|e| e.error.to_string()).collect();
    let rows = not.iter().map(|e| {
        let [before, left] = [e.before_mm, e.left_mm].map(|v| fixed(v * 1e3, 2));
        [e.error.to_string(), before, left, e.instead.to_string()]
    });
    let table = Table::new(["error", "before, µm", "left, µm", "instead"]).rows(rows);
    [
        Section::new("Represented").paragraph(names.join(" ")),
        Section::new("Not represented, each alone, at the tip")
            .table(table.most_on_terminal(MOST_SHOWN)),
    ]
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
