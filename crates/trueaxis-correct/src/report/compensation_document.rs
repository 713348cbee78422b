//! The document of compensation values.

use super::compensation::{Units, compensation_warnings, increment, place, units};
use crate::compensate::values::{Node, ValueTable};
use serde::Serialize;
use serde_json::Value;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisSide;
use trueaxis_machine::heat::ErrorPart;
use trueaxis_predict::predict::holes::Compensation;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Keyed, document};

/// Values that the control has to add to its commands: `trueaxis/compensate/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CompensationDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/compensate/1"))]
    pub schema: &'static str,
    /// `values`.
    pub what: &'static str,
    /// The name of the machine.
    pub machine: &'a str,
    /// The values are added to the command.
    pub added_to: &'static str,
    /// One entry for each axis.
    pub axes: Vec<AxisValues>,
    /// Where compensating the machine alone makes the part worse, or can.
    pub warnings: Vec<String>,
}

/// The values of one axis.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AxisValues {
    /// The axis.
    pub axis: String,
    /// Which error is compensated: `comprehensive` or `machine`.
    pub of: &'static str,
    /// What the axis carries: `tool` or `workpiece`.
    pub carries: &'static str,
    /// The least increment, with its unit.
    pub increment: String,
    /// `part_error_um`, or `part_error_urad` and `part_error_arcsec`: the largest error of the part under each
    /// compensation; absent where the temperature of the workpiece is not known.
    #[serde(flatten)]
    pub part_error: Keyed<Keyed<f64>>,
    /// The values by position.
    pub positions: Vec<PositionValue>,
}

/// The value at one position.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PositionValue {
    /// `position_mm` or `position_deg`.
    #[serde(flatten)]
    // why: flattened groups of one object share one schema of their values.
    #[schemars(with = "Keyed<Amount>")]
    pub position: Keyed<f64>,
    /// The value in least increments.
    pub value_increments: i64,
    /// The value of rising positions; absent if both directions have one value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value_up_increments: Option<i64>,
    /// The value of falling positions; absent if both directions have one value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value_down_increments: Option<i64>,
    /// `value_`, `remainder_` (lost by rounding), `split_` (by origin), `machine_`, `comprehensive_`, `u_`
    /// (standard uncertainty) and `part_error_` (under each compensation), each with `um`, or with `urad` and
    /// `arcsec`; those of the part are absent or null where the temperature of the workpiece is not known.
    #[serde(flatten)]
    pub values: Keyed<Amount>,
}

/// A number, or numbers by name.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Amount {
    /// One; null if it is not known.
    One(Option<f64>),
    /// Several.
    Named(Keyed<f64>),
}

/// The values as one JSON value.
///
/// `only` says what values of the machine alone can cost; the first warning then.
pub fn compensation_json(machine: &Machine, tables: &[ValueTable], only: Option<String>) -> Value {
    document(&CompensationDocument {
        schema: "trueaxis/compensate/1",
        what: "values",
        machine: machine.name(),
        added_to: "command",
        axes: tables.iter().map(|t| AxisValues::of(machine, t)).collect(),
        warnings: only.into_iter().chain(compensation_warnings(machine, tables)).collect(),
    })
}

impl AxisValues {
    fn of(machine: &Machine, table: &ValueTable) -> Self {
        let axis = &machine.axes()[table.order.axis];
        let units = units(axis);
        let part_error = |(unit, scale): &(&str, f64)| {
            (format!("part_error_{unit}"), by_compensation(table.worst, *scale))
        };
        Self {
            axis: axis.name.to_string(),
            of: table.order.of.name(),
            carries: if axis.carries == AxisSide::Tool { "tool" } else { "workpiece" },
            increment: increment(axis, table),
            part_error: units.keys.iter().filter(|_| table.part_is_known).map(part_error).collect(),
            positions: table
                .nodes
                .iter()
                .map(|node| PositionValue::of(&units, node, table))
                .collect(),
        }
    }
}

/// Of the part under each compensation.
fn by_compensation(values: [f64; 3], scale: f64) -> Keyed<f64> {
    let pairs = Compensation::ALL.iter().zip(values);
    pairs.map(|(c, v)| (c.name(), v * scale + 0.0)).collect()
}

impl PositionValue {
    fn of(units: &Units, node: &Node, table: &ValueTable) -> Self {
        let position = (format!("position_{}", units.place), place(units, node.position));
        Self {
            position: [position].into_iter().collect(),
            value_increments: node.value.increments,
            value_up_increments: node.by_direction.map(|[up, _]| up.increments),
            value_down_increments: node.by_direction.map(|[_, down]| down.increments),
            values: units
                .keys
                .iter()
                .flat_map(|(unit, scale)| amounts(node, unit, *scale, table.part_is_known))
                .collect(),
        }
    }
}

fn amounts(node: &Node, unit: &str, scale: f64, known: bool) -> Vec<(String, Amount)> {
    let one = |v: f64| Amount::One(Some(v * scale + 0.0));
    let split = ErrorPart::ALL.iter().zip(node.split);
    let split = split.filter(|(part, _)| known || **part != ErrorPart::Workpiece);
    let split = split.map(|(part, v)| (part.name(), v * scale + 0.0)).collect();
    let all = [
        ("value", one(node.value.added)),
        ("remainder", one(node.value.remainder)),
        ("split", Amount::Named(split)),
        ("machine", one(node.machine)),
        ("comprehensive", Amount::One(known.then_some(node.comprehensive * scale + 0.0))),
        ("u", Amount::One(node.u.map(|u| u * scale))),
        ("part_error", Amount::Named(by_compensation(node.part, scale))),
    ];
    let all = all.into_iter().filter(|(key, _)| known || *key != "part_error");
    all.map(|(key, amount)| (format!("{key}_{unit}"), amount)).collect()
}
