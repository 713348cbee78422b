//! `[datum]`: where the zero of the part was touched without any correction, and at which temperatures.

use super::sensors::SensorPlan;
use trueaxis::input::plausible::Quantity;
use trueaxis::input::{Dimension, Section};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command, Travel};
use trueaxis::machine::describe::axis_index;

/// A touch that the plan knows of.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedDatum {
    /// Where the axes stood. Unit: mm or rad.
    pub at: Command,
    /// The temperatures, by the sensors of the machine file, °C.
    pub readings: Vec<(String, f64)>,
}

/// Reads it; every live sensor needs its temperature.
pub fn read_datum(
    section: &Section<'_>,
    machine: &Machine,
    sensors: &[SensorPlan],
) -> Option<PlannedDatum> {
    let mut at = Command::default();
    let hint = "at = { X = \"1500 mm\", Y = \"800 mm\", Z = \"-200 mm\" }";
    section.require("at", hint)?.section("at", |axes| {
        for (name, _, item) in axes.entries() {
            let Some(axis) = axis_index(machine, name) else {
                let message = format!("the machine has no axis {name}");
                item.error("unknown-axis", message, &machine.chain_text());
                continue;
            };
            let axis_of = &machine.axes()[axis];
            let dimension = match axis_of.kind {
                AxisKind::Linear => Dimension::Length,
                AxisKind::Rotary => Dimension::Angle,
            };
            at[axis] = item.unjudged(dimension).unwrap_or(0.0);
            if let Travel::Between(from, to) = axis_of.travel
                && !(from..=to).contains(&at[axis])
            {
                let message = format!("{name} cannot have stood there: it is outside its travel");
                item.error(
                    "live-datum",
                    message,
                    "the position in machine coordinates at the touch",
                );
            }
        }
    })?;
    let names: Vec<&str> = sensors.iter().map(|s| s.settings.name.as_str()).collect();
    let usual = names.iter().map(|n| format!("{n} = \"20 degC\"")).collect::<Vec<_>>().join(", ");
    let mut readings = Vec::new();
    if !sensors.is_empty() {
        let item = section.require("temperatures", &format!("temperatures = {{ {usual} }}"))?;
        item.section("temperatures", |given| {
            for sensor in sensors {
                let name = &sensor.settings.name;
                let hint = format!("{name} = \"20 degC\": what it showed at the touch");
                let celsius =
                    given.require(name, &hint).and_then(|i| i.quantity_of(Quantity::Temperature));
                readings.extend(celsius.map(|c| (sensor.settings.input.clone(), c)));
            }
        })?;
    }
    (readings.len() == sensors.len()).then_some(PlannedDatum { at, readings })
}
