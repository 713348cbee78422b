//! The document of compensation tables.

use super::tables::{PartWithTables, TablesReport, joints_of, round};
use crate::compensate::tables::content::Line;
use crate::compensate::tables::grid::{Gridded, Side};
use crate::compensate::tables::joints::Joint;
use crate::compensate::tables::known::MadeKnown;
use crate::compensate::tables::proof::{ErrorLoss, IndexLeft, Left};
use crate::compensate::tables::table::{PER_UNIT, count_of};
use crate::compensate::tables::{LeftOut, Made, What};
use serde::Serialize;
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_machine::describe::to_shown;
use trueaxis_machine::errors::ErrorName;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// Tables of one control, and what they leave of the errors: `trueaxis/compensate-tables/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TablesDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/compensate-tables/1"))]
    pub schema: &'static str,
    /// The name of the machine.
    pub machine: &'a str,
    /// The control, as `--target` names it.
    pub target: &'a str,
    /// The files that were written.
    pub files: &'a [String],
    /// The values are added to the command.
    pub added_to: &'static str,
    /// Where the other axes stand for each table, mm and deg.
    pub reference: Keyed<f64>,
    /// The tables.
    pub tables: Vec<TableEntry>,
    /// Errors that the control's own chain holds.
    pub known: Vec<KnownEntry>,
    /// Lines by which the control follows temperatures.
    pub temperature: Vec<LineEntry>,
    /// Rotary axes in the control's kinematics.
    pub kinematics: Vec<JointEntry>,
    /// The grid of corrections in space; null if there is none.
    pub grid: Option<GridEntry>,
    /// What was left out, and why.
    pub left_out: Vec<LeftOutEntry>,
    /// The errors that the tables represent.
    pub represents: Vec<String>,
    /// The errors that they cannot represent.
    pub cannot: Vec<LossEntry>,
    /// Deviation of the tool over the travel without tables, µm.
    pub before_um: ResidualEntry,
    /// The same with the tables, µm.
    pub left_um: ProvedEntry<'a>,
    /// The same after the part zero was set with the tables in force, the axes at `reference`, µm.
    pub left_zero_set_um: ResidualEntry,
    /// The same if the control took them with the wrong sign, µm.
    pub wrong_sign_um: ResidualEntry,
    /// What to do at the control.
    pub notes: &'a [&'static str],
    /// What tables of the machine alone can cost; present only where the temperature of the workpiece is not
    /// known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub machine_only: Option<&'a str>,
}

/// One table: what is added to one axis by the position of another.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TableEntry {
    /// The axis by whose position the table is read.
    pub input: String,
    /// The axis to which it adds.
    pub output: String,
    /// How many nodes it has.
    pub nodes: usize,
    /// Whether the two directions of travel have values of their own.
    pub by_direction: bool,
    /// Whether it repeats after a turn.
    pub modulo: bool,
    /// The node that adds most; absent if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub check: Option<CheckEntry>,
    /// `loss_` and `largest_` with `um` or `urad`: what is lost between the nodes, the largest value.
    #[serde(flatten)]
    pub sizes: Keyed<f64>,
}

/// A node to check the sign by.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CheckEntry {
    /// Its position. Unit: mm or deg.
    pub position: f64,
    /// `added_` with `um` or `urad`: what is added there.
    #[serde(flatten)]
    pub added: Keyed<f64>,
}

/// An error that the control's own chain holds.
#[derive(Debug, Serialize, JsonSchema)]
pub struct KnownEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// How many nodes; 1 if it is constant.
    pub nodes: usize,
    /// `loss_` and `largest_` with `um` or `urad`.
    #[serde(flatten)]
    pub sizes: Keyed<f64>,
}

/// A line by which the control follows the temperature of a scale.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LineEntry {
    /// The axis.
    pub axis: String,
    /// The position at which only the offset is added. Unit: mm or deg.
    pub reference: f64,
    /// The slope, µm/m or µrad/rad.
    pub slope_um_per_m: f64,
    /// `offset_` with `um` or `urad`.
    #[serde(flatten)]
    pub offset: Keyed<f64>,
}

/// A rotary axis as the control holds it.
#[derive(Debug, Serialize, JsonSchema)]
pub struct JointEntry {
    /// The axis.
    pub axis: String,
    /// A point on it, mm.
    pub point_mm: [f64; 3],
    /// Its direction, a unit vector. Unit: 1.
    pub direction: [f64; 3],
    /// By how much the point is off the nominal one, µm.
    pub moved_um: [f64; 3],
    /// By how much the direction is off the nominal one, µrad.
    pub tilted_urad: [f64; 3],
}

/// A grid of corrections in space.
#[derive(Debug, Serialize, JsonSchema)]
pub struct GridEntry {
    /// Its sides.
    pub sides: [SideEntry; 3],
    /// How many points.
    pub points: usize,
    /// What is lost between the points, µm.
    pub loss_um: f64,
    /// The largest correction, µm.
    pub largest_um: f64,
}

/// A side of the grid.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SideEntry {
    /// The axis.
    pub axis: String,
    /// The first point, mm.
    pub from_mm: f64,
    /// The distance of two points, mm.
    pub step_mm: f64,
    /// How many points.
    pub points: usize,
}

/// A table or an error that was left out.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LeftOutEntry {
    /// What it is.
    #[serde(flatten)]
    pub subject: LeftOutSubject,
    /// Why.
    pub reason: &'static str,
    /// `largest_` with `um` or `urad`.
    #[serde(flatten)]
    pub largest: Keyed<f64>,
}

/// What was left out.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum LeftOutSubject {
    /// A table.
    Table {
        /// The axis by whose position it would be read.
        input: String,
        /// The axis to which it would add.
        output: String,
    },
    /// An error.
    Error {
        /// Its ISO 230-1 name.
        error: String,
    },
}

/// An error that the tables cannot represent, alone on the machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LossEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// Deviation of the tip without tables, µm.
    pub before_um: f64,
    /// With the tables, µm.
    pub left_um: f64,
    /// Where it could be compensated.
    pub instead: &'static str,
}

/// Deviation of the tool over the travel of all axes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ResidualEntry {
    /// The largest of the tip. Unit: µm.
    pub max: f64,
    /// Root mean square of the tip. Unit: µm.
    pub rms: f64,
    /// Where the largest is, mm and deg.
    pub at: Keyed<f64>,
    /// How many poses, each from both sides.
    pub poses: usize,
    /// The largest of the tool axis, µrad.
    pub axis_urad: f64,
}

/// The same with the files read back, and on a test piece.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProvedEntry<'a> {
    /// Over the travel.
    #[serde(flatten)]
    pub residual: ResidualEntry,
    /// The test piece; null if none was asked for.
    pub test_piece: Option<PieceEntry<'a>>,
    /// The part by its drawing; absent if none was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<PartWithTablesEntry<'a>>,
}

/// A part by its drawing, before and with the tables. Outcomes are `pass`, `fail` or `undecided`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PartWithTablesEntry<'a> {
    /// The study.
    pub study: String,
    /// Without tables.
    pub outcome: &'static str,
    /// With them, the zero where it was set without them.
    pub zero_kept_outcome: &'static str,
    /// With them, the zero set again.
    pub zero_set_outcome: &'static str,
    /// The lines of the drawing.
    pub characteristics: Vec<CharacteristicWithTables<'a>>,
}

/// A characteristic before and with the tables.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CharacteristicWithTables<'a> {
    /// Its name.
    pub name: &'a str,
    /// Without tables, µm.
    pub before_um: f64,
    /// With them, the zero where it was set without them, µm.
    pub zero_kept_um: f64,
    /// With them, the zero set again, µm.
    pub zero_set_um: f64,
    /// Without tables.
    pub outcome: &'static str,
    /// With them, the zero kept.
    pub zero_kept_outcome: &'static str,
    /// With them, the zero set again.
    pub zero_set_outcome: &'static str,
}

/// A test piece cut with the tables.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PieceEntry<'a> {
    /// The study.
    pub study: &'a str,
    /// Its indices.
    pub indices: Vec<PieceIndex<'a>>,
}

/// One index of the test piece.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PieceIndex<'a> {
    /// Its key.
    pub index: &'a str,
    /// Without tables, µm.
    pub before_um: f64,
    /// With the tables, µm.
    pub left_um: f64,
}

impl<'a> TablesDocument<'a> {
    /// The document of tables.
    pub fn of(report: &TablesReport<'a>) -> Self {
        let TablesReport { machine, compiled, .. } = *report;
        let (represented, not): (Vec<_>, Vec<_>) =
            compiled.errors.iter().partition(|e| e.represented);
        Self {
            schema: "trueaxis/compensate-tables/1",
            machine: machine.name(),
            target: report.target,
            files: report.files,
            added_to: "command",
            reference: place(machine, &compiled.reference),
            tables: compiled.tables.iter().map(|t| TableEntry::of(machine, t)).collect(),
            known: compiled.known.iter().map(KnownEntry::from).collect(),
            temperature: compiled.lines.iter().map(|l| LineEntry::of(machine, l)).collect(),
            kinematics: joints_of(machine, compiled).iter().map(JointEntry::from).collect(),
            grid: compiled.grid.as_ref().map(|g| GridEntry::of(machine, g)),
            left_out: compiled.left_out.iter().map(|t| LeftOutEntry::of(machine, t)).collect(),
            represents: represented.iter().map(|e| e.error.to_string()).collect(),
            cannot: not.into_iter().map(LossEntry::from).collect(),
            before_um: ResidualEntry::of(machine, &compiled.before),
            left_um: ProvedEntry {
                residual: ResidualEntry::of(machine, &compiled.after),
                test_piece: report.piece.map(PieceEntry::from),
                part: report.part.map(PartWithTablesEntry::from),
            },
            left_zero_set_um: ResidualEntry::of(machine, &compiled.after_zero_set),
            wrong_sign_um: ResidualEntry::of(machine, &compiled.wrong_sign),
            notes: compiled.advice,
            machine_only: report.machine_only,
        }
    }
}

/// Positions of all axes, mm and deg.
fn place(machine: &Machine, command: &Command) -> Keyed<f64> {
    let axes = machine.axes().iter().enumerate();
    axes.map(|(i, axis)| (axis.name.to_string(), round(to_shown(machine, i, command[i])))).collect()
}

/// The suffix of a key, and the factor from mm or rad.
type Unit = (&'static str, f64);

fn unit(machine: &Machine, axis: usize) -> Unit {
    match machine.axes()[axis].kind {
        AxisKind::Linear => ("um", 1e3),
        AxisKind::Rotary => ("urad", 1e6),
    }
}

fn unit_of_error(error: ErrorName) -> Unit {
    match error.component.is_rotation() {
        true => ("urad", 1e6),
        false => ("um", 1e3),
    }
}

fn in_unit<const N: usize>((unit, factor): Unit, values: [(&str, f64); N]) -> Keyed<f64> {
    values.into_iter().map(|(key, value)| (format!("{key}_{unit}"), value * factor)).collect()
}

fn name(machine: &Machine, axis: usize) -> String {
    machine.axes()[axis].name.to_string()
}

impl TableEntry {
    fn of(machine: &Machine, made: &Made) -> Self {
        let Made { table, loss, largest } = made;
        let unit = unit(machine, table.output);
        let check = table.largest().map(|node| {
            let added = node.up as f64 * count_of(machine, table.output);
            let position = round(node.at as f64 / PER_UNIT);
            CheckEntry { position, added: in_unit(unit, [("added", added)]) }
        });
        Self {
            input: name(machine, table.input),
            output: name(machine, table.output),
            nodes: table.nodes.len(),
            by_direction: table.is_directional(),
            modulo: table.modulo,
            check,
            sizes: in_unit(unit, [("loss", *loss), ("largest", *largest)]),
        }
    }
}

impl From<&MadeKnown> for KnownEntry {
    fn from(made: &MadeKnown) -> Self {
        let MadeKnown { known, loss, largest, .. } = made;
        let sizes = [("loss", *loss), ("largest", *largest)];
        Self {
            error: known.error.to_string(),
            nodes: known.nodes.len(),
            sizes: in_unit(unit_of_error(known.error), sizes),
        }
    }
}

impl LineEntry {
    fn of(machine: &Machine, line: &Line) -> Self {
        let offset = line.offset as f64 * count_of(machine, line.axis);
        Self {
            axis: name(machine, line.axis),
            reference: line.reference as f64 / PER_UNIT,
            slope_um_per_m: line.slope as f64 * 1e-3,
            offset: in_unit(unit(machine, line.axis), [("offset", offset)]),
        }
    }
}

impl From<&(Joint, Joint)> for JointEntry {
    fn from((actual, nominal): &(Joint, Joint)) -> Self {
        let vector = |v: Vec3| [v.x, v.y, v.z];
        Self {
            axis: actual.axis.to_string(),
            point_mm: vector(actual.point_mm()),
            direction: vector(actual.along()),
            moved_um: vector((actual.point_mm() - nominal.point_mm()) * 1e3),
            tilted_urad: vector((actual.along() - nominal.along()) * 1e6),
        }
    }
}

impl GridEntry {
    fn of(machine: &Machine, gridded: &Gridded) -> Self {
        let Gridded { grid, loss, largest } = gridded;
        let side = |s: &Side| SideEntry {
            axis: name(machine, s.axis),
            from_mm: s.from as f64 / PER_UNIT,
            step_mm: s.step as f64 / PER_UNIT,
            points: s.count,
        };
        Self {
            sides: grid.sides.each_ref().map(side),
            points: grid.values.len(),
            loss_um: loss / PER_UNIT * 1e3,
            largest_um: *largest as f64 / PER_UNIT * 1e3,
        }
    }
}

impl LeftOutEntry {
    fn of(machine: &Machine, out: &LeftOut) -> Self {
        let (subject, unit) = match out.what {
            What::Table { input, output } => {
                let (input, named) = (name(machine, input), name(machine, output));
                (LeftOutSubject::Table { input, output: named }, unit(machine, output))
            }
            What::Error(error) => {
                (LeftOutSubject::Error { error: error.to_string() }, unit_of_error(error))
            }
        };
        let largest = in_unit(unit, [("largest", out.largest)]);
        Self { subject, reason: out.reason, largest }
    }
}

impl From<&ErrorLoss> for LossEntry {
    fn from(e: &ErrorLoss) -> Self {
        Self {
            error: e.error.to_string(),
            before_um: e.before_mm * 1e3,
            left_um: e.left_mm * 1e3,
            instead: e.instead,
        }
    }
}

impl ResidualEntry {
    fn of(machine: &Machine, left: &Left) -> Self {
        Self {
            max: left.max_mm * 1e3,
            rms: left.rms_mm * 1e3,
            at: place(machine, &left.at),
            poses: left.poses,
            axis_urad: left.axis_rad * 1e6,
        }
    }
}

impl<'a> From<(&'a str, &'a [IndexLeft])> for PieceEntry<'a> {
    fn from((study, indices): (&'a str, &'a [IndexLeft])) -> Self {
        let index = |i: &'a IndexLeft| PieceIndex {
            index: &i.key,
            before_um: i.before_mm * 1e3,
            left_um: i.left_mm * 1e3,
        };
        Self { study, indices: indices.iter().map(index).collect() }
    }
}

impl<'a> From<&'a PartWithTables> for PartWithTablesEntry<'a> {
    fn from(PartWithTables { study, before, after }: &'a PartWithTables) -> Self {
        let (kept, set) = (&after.zero_kept, &after.zero_set);
        let all = study.part.characteristics.iter().zip(&before.values).enumerate();
        let characteristics = all.map(|(i, (asked, value))| CharacteristicWithTables {
            name: &asked.name,
            before_um: value.value_mm * 1e3,
            zero_kept_um: kept.values_mm[i] * 1e3,
            zero_set_um: set.values_mm[i] * 1e3,
            outcome: value.outcome.word(),
            zero_kept_outcome: kept.outcomes[i].word(),
            zero_set_outcome: set.outcomes[i].word(),
        });
        Self {
            study: study.path.display().to_string(),
            outcome: before.outcome.word(),
            zero_kept_outcome: kept.outcome.word(),
            zero_set_outcome: set.outcome.word(),
            characteristics: characteristics.collect(),
        }
    }
}
