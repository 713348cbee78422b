//! The document `trueaxis/pose/1`.

use super::pose::{Bodies, Budget, PoseReport, array, heat_shares};
use serde::Serialize;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Bed, Body, Pose};
use trueaxis_machine::Deviation;
use trueaxis_machine::errors::ErrorValues;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// The tool at one position of the axes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PoseDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/pose/1"))]
    pub schema: &'static str,
    /// Nominal and actual tool.
    #[serde(flatten)]
    pub tool: ToolEntry,
    /// The deviation under each error alone.
    pub budget: Vec<ShareEntry>,
    /// Nominal and actual place of every body; absent unless it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bodies: Option<Vec<BodyEntry>>,
    /// The deviation by its causes; absent unless temperatures were given.
    #[serde(flatten)]
    pub heat: Option<HeatEntry>,
}

/// The tool at many positions of the axes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PoseRowsDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/pose/1"))]
    pub schema: &'static str,
    /// One object for each row of the input: its columns as they were given, then `tip_x_mm` … `axis_k` (the
    /// nominal tool in the workpiece frame), `dev_x_um` … `dev_k_urad` (actual − nominal).
    pub rows: Vec<Keyed<f64>>,
}

/// Nominal and actual tool in the workpiece frame.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ToolEntry {
    /// As the control commands it.
    pub nominal: ToolPoseEntry,
    /// As the machine with its errors moves it.
    pub actual: ToolPoseEntry,
    /// Actual − nominal.
    pub deviation: DeviationEntry,
}

/// A tool in the workpiece frame.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ToolPoseEntry {
    /// Its tip, mm.
    pub tip_mm: [f64; 3],
    /// Its axis from the tip to the spindle, a unit vector. Unit: 1.
    pub axis: [f64; 3],
}

/// A deviation of the tool.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DeviationEntry {
    /// Of the tip, µm.
    pub tip_um: [f64; 3],
    /// Of the axis, µrad.
    pub axis_urad: [f64; 3],
}

/// One error alone.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ShareEntry {
    /// The ISO 230-1 name of the error; `EXX(scale)`, `workpiece` and the like for the parts of temperatures.
    pub error: String,
    /// What it does to the tool.
    #[serde(flatten)]
    pub deviation: DeviationEntry,
}

/// A body of the machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct BodyEntry {
    /// Its name.
    pub body: String,
    /// Its nominal place in the machine frame.
    pub nominal: PlaceEntry,
    /// Its actual place there.
    pub actual: PlaceEntry,
}

/// The place of a body.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PlaceEntry {
    /// Its origin, mm.
    pub origin_mm: [f64; 3],
    /// Its rotation, row by row. Unit: 1.
    pub rotation: [[f64; 3]; 3],
}

/// The deviation of the tip by its causes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct HeatEntry {
    /// By the name of the cause: `geometric`, `scale`, `structure`, `workpiece`.
    pub split: Keyed<TipEntry>,
    /// Of the machine without the growth of the workpiece.
    pub machine: TipEntry,
    /// Of all together.
    pub comprehensive: ComprehensiveEntry,
    /// How fast the workpiece takes the temperature of the air; absent where that is not stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settling: Option<SettlingEntry>,
}

/// A deviation of the tip.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TipEntry {
    /// Deviation of the tip, µm.
    pub tip_um: [f64; 3],
}

/// The deviation of the tip from all causes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ComprehensiveEntry {
    /// Deviation of the tip, µm.
    pub tip_um: [f64; 3],
    /// How it is made up.
    pub formula: &'static str,
}

/// How fast the workpiece takes the temperature of the air.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SettlingEntry {
    /// Its time constant, s.
    pub time_constant_s: f64,
    /// The time until a tenth of a difference remains, s.
    pub time_to_a_tenth_s: f64,
}

impl From<&PoseReport<'_>> for PoseDocument {
    fn from(report: &PoseReport<'_>) -> Self {
        Self {
            schema: "trueaxis/pose/1",
            tool: ToolEntry::from(&report.deviation),
            budget: share_entries(&report.budget()),
            bodies: report.with_bodies.then(|| body_entries(&report.bodies())),
            heat: report.machine.is_at_temperatures().then(|| HeatEntry::from(report)),
        }
    }
}

impl From<&Deviation> for ToolEntry {
    fn from(deviation: &Deviation) -> Self {
        let (tip, axis) = (deviation.nominal_tip.vector(), deviation.nominal_axis.vector());
        let pose = |tip, axis| ToolPoseEntry { tip_mm: array(tip), axis: array(axis) };
        Self {
            nominal: pose(tip, axis),
            actual: pose(tip + deviation.tip_mm, axis + deviation.axis),
            deviation: DeviationEntry::from(deviation),
        }
    }
}

impl From<&Deviation> for DeviationEntry {
    fn from(deviation: &Deviation) -> Self {
        Self { tip_um: array(deviation.tip_mm * 1e3), axis_urad: array(deviation.axis * 1e6) }
    }
}

/// Each error alone.
pub(super) fn share_entries(budget: &Budget) -> Vec<ShareEntry> {
    let share = |(name, deviation): &(String, Deviation)| ShareEntry {
        error: name.clone(),
        deviation: DeviationEntry::from(deviation),
    };
    budget.iter().map(share).collect()
}

/// Nominal and actual place of every body.
pub(super) fn body_entries(bodies: &Bodies) -> Vec<BodyEntry> {
    let body = |(name, [nominal, actual]): &(String, [Pose<Bed, Body>; 2])| BodyEntry {
        body: name.clone(),
        nominal: PlaceEntry::from(nominal),
        actual: PlaceEntry::from(actual),
    };
    bodies.iter().map(body).collect()
}

impl From<&Pose<Bed, Body>> for PlaceEntry {
    fn from(pose: &Pose<Bed, Body>) -> Self {
        Self {
            origin_mm: array(*pose.shift_mm()),
            rotation: [0, 1, 2].map(|i| array(pose.linear().row(i).transpose())),
        }
    }
}

impl From<&PoseReport<'_>> for HeatEntry {
    fn from(PoseReport { machine, command, errors, .. }: &PoseReport<'_>) -> Self {
        let without = ErrorValues { workpiece_mm: Vec3::zeros(), ..*errors };
        let tip_um = |errors| array(machine.deviation(command, errors).tip_mm * 1e3);
        let split = heat_shares(machine, command, errors).into_iter();
        let settling = machine.heat().workpiece.as_ref().and_then(|w| w.settling);
        Self {
            split: split.map(|(part, um)| (part.name(), TipEntry { tip_um: array(um) })).collect(),
            machine: TipEntry { tip_um: tip_um(&without) },
            comprehensive: ComprehensiveEntry {
                tip_um: tip_um(errors),
                formula: "machine - workpiece = geometric + scale + structure - workpiece",
            },
            settling: settling.map(|settling| SettlingEntry {
                time_constant_s: settling.time_constant_s,
                time_to_a_tenth_s: settling.time_to_s(1.0, 0.1),
            }),
        }
    }
}
