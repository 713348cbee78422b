//! The document `trueaxis/check/1`.

use super::check::{lacks, measurements, shown_unit};
use super::diagnostic::DiagnosticEntry;
use super::frames::{FrameEntry, frames};
use serde::Serialize;
use serde_json::Value;
use trueaxis_input::Diagnostic;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Axis, AxisSide, Travel};
use trueaxis_report::JsonSchema;
use trueaxis_report::numbers::rounded;
use trueaxis_report::{Keyed, document};

/// A machine file, checked.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CheckDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/check/1"))]
    pub schema: &'static str,
    /// Whether the file can be used, perhaps with warnings.
    pub usable: bool,
    /// What it says; absent where it cannot be used.
    #[serde(flatten)]
    pub machine: Option<CheckedMachine<'a>>,
    /// The problems of the file.
    pub diagnostics: Vec<DiagnosticEntry<'a>>,
}

/// What a machine file says.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CheckedMachine<'a> {
    /// The name of the machine.
    pub name: &'a str,
    /// Its kinematic chain from the workpiece to the tool.
    pub chain: String,
    /// Where its data are from.
    pub source: &'a str,
    /// Its axes in chain order.
    pub axes: Vec<AxisEntry>,
    /// Its coordinate systems with all axes at 0, without errors.
    pub frames: Vec<FrameEntry>,
    /// Limits of spindle and magazine; absent where the file states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equipment: Option<EquipmentEntry>,
    /// The names of its tools.
    pub tools: Vec<&'a str>,
    /// The ISO 230-1 names of the errors that are stated.
    pub errors: Vec<String>,
    /// The measurements that the errors are from.
    pub measured: Vec<MeasurementEntry>,
    /// What a prediction or a simulation would need in addition, in words.
    pub lacks: Vec<String>,
}

/// Spindle and magazine; null where the file does not state it.
#[derive(Debug, Serialize, JsonSchema)]
pub struct EquipmentEntry {
    /// Highest speed of the spindle, 1/min.
    pub max_speed_per_min: Option<f64>,
    /// Lowest speed at which the spindle turns, 1/min.
    pub min_speed_per_min: Option<f64>,
    /// Power of the spindle motor, kW.
    pub spindle_power_kw: Option<f64>,
    /// Places of the magazine.
    pub magazine_places: Option<u32>,
}

impl EquipmentEntry {
    fn of(machine: &Machine) -> Option<Self> {
        let stated = machine.equipment();
        let per_minute = |rad_per_s: f64| rounded(rad_per_s * 30.0 / std::f64::consts::PI);
        stated.is_stated().then(|| Self {
            max_speed_per_min: stated.max_spindle_rad_per_s.map(per_minute),
            min_speed_per_min: stated.min_spindle_rad_per_s.map(per_minute),
            spindle_power_kw: stated.spindle_power_w.map(|w| rounded(w / 1e3)),
            magazine_places: stated.magazine_places,
        })
    }
}

/// An axis; its travel is `travel_mm` or `travel_deg`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AxisEntry {
    /// Its name.
    pub name: String,
    /// `tool` or `workpiece`.
    pub carries: &'static str,
    /// Its direction in the machine frame, a unit vector. Unit: 1.
    pub direction: [f64; 3],
    /// +1 where a positive command moves the body along the direction, −1 against it (ISO 841). Unit: 1.
    pub sense: f64,
    /// Its travel, mm or degrees; null if it is not stated.
    #[serde(flatten)]
    pub travel: Keyed<Option<TravelEntry>>,
}

/// The travel of an axis.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum TravelEntry {
    /// From and to, mm or degrees.
    Between([f64; 2]),
    /// `unlimited`: a rotary axis that turns without end.
    Unlimited(&'static str),
}

/// A measurement with the errors that it determined.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MeasurementEntry {
    /// Instrument, date and temperature.
    pub by: String,
    /// The names of the errors.
    pub errors: Vec<String>,
}

impl<'a> CheckDocument<'a> {
    /// The document of a file; without a machine only why there is none.
    pub fn of(
        machine: Option<&'a Machine>,
        diagnostics: impl IntoIterator<Item = &'a Diagnostic>,
    ) -> Self {
        Self {
            schema: "trueaxis/check/1",
            usable: machine.is_some(),
            machine: machine.map(CheckedMachine::from),
            diagnostics: diagnostics.into_iter().map(DiagnosticEntry::from).collect(),
        }
    }
}

impl<'a> From<&'a Machine> for CheckedMachine<'a> {
    fn from(machine: &'a Machine) -> Self {
        let measured = measurements(machine).into_iter();
        Self {
            name: machine.name(),
            chain: machine.chain_text(),
            source: machine.source(),
            axes: machine.axes().iter().map(AxisEntry::from).collect(),
            frames: frames(machine),
            equipment: EquipmentEntry::of(machine),
            tools: machine.tools().iter().map(|t| t.name.as_str()).collect(),
            errors: machine.stated_errors().iter().map(|(_, n)| n.to_string()).collect(),
            measured: measured.map(|(by, errors)| MeasurementEntry { by, errors }).collect(),
            lacks: lacks(machine),
        }
    }
}

impl From<&Axis> for AxisEntry {
    fn from(axis: &Axis) -> Self {
        let (_, unit) = shown_unit(axis.kind);
        let travel = (format!("travel_{unit}"), TravelEntry::of(axis));
        Self {
            name: axis.name.to_string(),
            carries: if axis.carries == AxisSide::Tool { "tool" } else { "workpiece" },
            direction: [axis.direction.x, axis.direction.y, axis.direction.z],
            sense: axis.sense,
            travel: Keyed(vec![travel]),
        }
    }
}

impl TravelEntry {
    /// The travel of an axis, if it is stated.
    pub fn of(axis: &Axis) -> Option<Self> {
        let (scale, _) = shown_unit(axis.kind);
        match axis.travel {
            Travel::Between(from, to) => {
                Some(Self::Between([rounded(from * scale), rounded(to * scale)]))
            }
            Travel::Unlimited => Some(Self::Unlimited("unlimited")),
            Travel::Unknown => None,
        }
    }
}

/// The document `trueaxis/check/1`; without a machine only why there is none.
pub fn check_json<'a>(
    machine: Option<&'a Machine>,
    diagnostics: impl IntoIterator<Item = &'a Diagnostic>,
) -> Value {
    document(&CheckDocument::of(machine, diagnostics))
}
