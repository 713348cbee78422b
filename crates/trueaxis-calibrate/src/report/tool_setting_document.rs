//! Tool setting for programs: `trueaxis/plan-tool-setting/1` and `trueaxis/identify-tools/1`.

use crate::identify::tool_setting::{MeasuredTool, ToolReadings};
use crate::plan::program::ProgramCheck;
use crate::plan::tool_setting::{ToolSetting, TouchOf};
use serde::Serialize;
use trueaxis_report::JsonSchema;

/// Touches at a tool setter.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ToolSettingDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/plan-tool-setting/1"))]
    pub schema: &'static str,
    /// The name of the machine.
    pub machine: &'a str,
    /// The touches in their order.
    pub touches: Vec<TouchEntry>,
    /// How long the program runs, s.
    pub duration_s: f64,
    /// Whether the program has neither errors nor critical issues.
    pub sound: bool,
    /// Errors of the program itself.
    pub errors: &'a [String],
    /// Critical issues, such as collisions.
    #[serde(rename = "troubles")]
    pub issues: &'a [String],
    /// Minor issues, such as lost time.
    pub notes: &'a [String],
}

/// One touch.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TouchEntry {
    /// The tool.
    pub tool: u32,
    /// What it measures: `length`, `plus` or `minus` (the sides of the diameter).
    pub of: &'static str,
    /// X, Y and Z where the nominal tool touches, mm.
    pub expected_mm: [f64; 3],
    /// X, Y and Z where the touch ends at the latest, mm.
    pub beyond_mm: [f64; 3],
}

/// Tools as they were measured.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MeasuredToolsDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify-tools/1"))]
    pub schema: &'static str,
    /// Whether a virtual machine wrote the log.
    pub is_virtual: bool,
    /// The tools in the order in which they were measured.
    pub tools: Vec<MeasuredToolEntry<'a>>,
    /// How far spindle and setter have drifted since the face was calibrated, µm; null without a gauge.
    pub drift_um: Option<f64>,
    /// Its expanded uncertainty (k = 2), µm.
    #[serde(rename = "U_drift_um")]
    pub expanded_drift_um: Option<f64>,
    /// What the uncertainties do not cover.
    pub missing: &'a [String],
}

/// A tool as it was measured.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MeasuredToolEntry<'a> {
    /// Its number.
    pub tool: u32,
    /// Its name.
    pub name: &'a str,
    /// `fit`, `not decided`, `worn` or `broken`.
    pub state: &'static str,
    /// Its length, mm.
    pub length_mm: f64,
    /// Its expanded uncertainty (k = 2), µm.
    #[serde(rename = "U_length_um")]
    pub expanded_length_um: f64,
    /// Measured − nominal length, µm.
    pub length_off_um: f64,
    /// Its diameter, mm; null if it was not measured.
    pub diameter_mm: Option<f64>,
    /// Its expanded uncertainty (k = 2), µm.
    #[serde(rename = "U_diameter_um")]
    pub expanded_diameter_um: Option<f64>,
    /// What stands against it.
    pub faults: Vec<&'a str>,
    /// What cannot be decided.
    pub doubts: &'a [String],
}

impl<'a> ToolSettingDocument<'a> {
    /// The document of a plan.
    pub fn of(setting: &'a ToolSetting, check: &'a ProgramCheck) -> Self {
        let touches = setting.touches.iter().map(|t| {
            let place = |command: &[f64; 6]| setting.axes.map(|i| command[i]);
            TouchEntry {
                tool: setting.tools[t.tool].number,
                of: match t.of {
                    TouchOf::Length => "length",
                    TouchOf::Plus => "plus",
                    TouchOf::Minus => "minus",
                },
                expected_mm: place(&t.expected),
                beyond_mm: place(&t.beyond),
            }
        });
        Self {
            schema: "trueaxis/plan-tool-setting/1",
            machine: setting.machine.name(),
            touches: touches.collect(),
            duration_s: check.duration_s,
            sound: check.is_sound(),
            errors: &check.errors,
            issues: &check.critical,
            notes: &check.minor,
        }
    }
}

impl<'a> MeasuredToolsDocument<'a> {
    /// The document of an evaluation.
    pub fn of(readings: &'a ToolReadings) -> Self {
        Self {
            schema: "trueaxis/identify-tools/1",
            is_virtual: readings.is_virtual,
            tools: readings.tools.iter().map(MeasuredToolEntry::from).collect(),
            drift_um: readings.drift.map(|d| d.mm * 1e3),
            expanded_drift_um: readings.drift.map(|d| 2e3 * d.u_mm),
            missing: &readings.missing,
        }
    }
}

impl<'a> From<&'a MeasuredTool> for MeasuredToolEntry<'a> {
    fn from(t: &'a MeasuredTool) -> Self {
        Self {
            tool: t.number,
            name: &t.name,
            state: t.standing.word(),
            length_mm: t.length.mm,
            expanded_length_um: 2e3 * t.length.u_mm,
            length_off_um: (t.length.mm - t.nominal_mm) * 1e3,
            diameter_mm: t.diameter.map(|d| d.mm),
            expanded_diameter_um: t.diameter.map(|d| 2e3 * d.u_mm),
            faults: t.standing.faults.iter().map(|f| f.1.as_str()).collect(),
            doubts: &t.standing.doubts,
        }
    }
}
