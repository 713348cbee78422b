//! The document `trueaxis/diff/1`.

use super::calibrations::CalibrationsReport;
use crate::verify::calibrations::{ErrorChange, TwoTemperatures};
use serde::Serialize;
use trueaxis_machine::Machine;
use trueaxis_machine::describe::{shown, unit};
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// Two calibrations of one machine: which errors have changed.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DiffDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/diff/1"))]
    pub schema: &'static str,
    /// The version of TrueAxis.
    pub version: &'static str,
    /// The name of the newer machine.
    pub machine: &'a str,
    /// Its kinematic chain from the workpiece to the tool.
    pub chain: String,
    /// The older file.
    pub old: &'a str,
    /// The newer file.
    pub new: &'a str,
    /// The names of the errors that have changed significantly.
    pub moved: Vec<String>,
    /// The bound of the change of one error in its standard uncertainty, so that among all errors none is
    /// above it by chance with 95 %. Unit: 1.
    pub limit_u: f64,
    /// All errors.
    pub errors: Vec<ErrorChangeEntry>,
    /// What the changes do to the tip.
    pub tip: TipChangeEntry,
    /// The tables that hold at two temperatures.
    pub temperatures: Vec<TwoTemperaturesEntry>,
}

/// A table of the older file, referred to the temperature of that of the newer one.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TwoTemperaturesEntry {
    /// The error.
    pub error: String,
    /// The temperature of the older table.
    #[serde(rename = "old_degC")]
    pub old_celsius: f64,
    /// That of the newer one.
    #[serde(rename = "new_degC")]
    pub new_celsius: f64,
    /// The expansion by which the older one is referred; null where no file states one: both are compared as they are.
    pub expansion_um_per_m_k: Option<f64>,
}

/// How one error has changed, where the change is clearest.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ErrorChangeEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// The unit of its values: `um` or `urad`.
    pub unit: &'static str,
    /// Its old value; null if the old file does not state it. Unit: that of `unit`.
    pub old: Option<f64>,
    /// Its new value; null if the new file does not state it. Unit: that of `unit`.
    pub new: Option<f64>,
    /// New − old. Unit: that of `unit`.
    pub change: Option<f64>,
    /// Root mean square of the change over the travel. Unit: that of `unit`.
    pub rms_change: f64,
    /// Standard uncertainty of the change; null if a file states none. Unit: that of `unit`.
    pub u_change: Option<f64>,
    /// |change| over its expanded uncertainty (k = 2), ISO 13528. Unit: 1.
    #[serde(rename = "E_n")]
    pub e_n: Option<f64>,
    /// The position; null for location errors.
    pub at: Option<AxisPositionEntry>,
    /// `yes`, `perhaps`, `no`, `unknown`, `new` (only in the new file) or `gone` (only in the old one).
    pub moved: &'static str,
}

/// A position of one axis.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AxisPositionEntry {
    /// The name of the axis.
    pub axis: String,
    /// Its position. Unit: that of `unit`.
    pub position: f64,
    /// `mm` or `deg`.
    pub unit: &'static str,
    /// The side from which it is approached: +1, −1, or 0 for the mean of both. Unit: 1.
    pub approach: f64,
}

/// What the changes do to the tip.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TipChangeEntry {
    /// How many poses were evaluated.
    pub poses: usize,
    /// The largest change of the tip, µm.
    pub largest_um: f64,
    /// Its standard uncertainty, µm.
    pub u_um: f64,
    /// The axis positions of the largest change, mm and degrees.
    pub at: Keyed<f64>,
    /// Root mean square over the poses, µm.
    pub rms_um: f64,
    /// The largest change of the tool axis, µrad.
    pub axis_largest_urad: f64,
    /// The largest difference of the nominal machines at the tip, mm; 0 if they are the same.
    pub nominal_difference_mm: f64,
    /// The change of each error alone, the largest first.
    pub shares: Vec<TipShareEntry>,
}

/// The change of one error alone.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TipShareEntry {
    /// Its ISO 230-1 name.
    pub error: String,
    /// How far it moves the tip at most, µm.
    pub largest_um: f64,
}

impl<'a> From<&CalibrationsReport<'a>> for DiffDocument<'a> {
    fn from(report: &CalibrationsReport<'a>) -> Self {
        let (old, found) = (report.old, report.found);
        let tip = &found.tip;
        let at = old.axes().iter().zip(&tip.at);
        let shares = tip
            .shares
            .iter()
            .map(|s| TipShareEntry { error: s.error.to_string(), largest_um: s.largest_mm * 1e3 });
        Self {
            schema: "trueaxis/diff/1",
            version: trueaxis_report::VERSION,
            machine: report.new.name(),
            chain: old.chain_text(),
            old: report.files[0],
            new: report.files[1],
            moved: found.moved().map(|e| e.error.to_string()).collect(),
            limit_u: found.limit,
            errors: found.errors.iter().map(|e| ErrorChangeEntry::of(old, e)).collect(),
            tip: TipChangeEntry {
                poses: tip.poses,
                largest_um: tip.largest_mm * 1e3,
                u_um: tip.u_mm * 1e3,
                at: at.map(|(a, q)| (a.name.to_string(), shown(a, *q))).collect(),
                rms_um: tip.rms_mm * 1e3,
                axis_largest_urad: tip.axis_rad * 1e6,
                nominal_difference_mm: tip.nominal_mm,
                shares: shares.collect(),
            },
            temperatures: found.temperatures.iter().map(TwoTemperaturesEntry::of).collect(),
        }
    }
}

impl TwoTemperaturesEntry {
    fn of(of: &TwoTemperatures) -> Self {
        Self {
            error: of.error.to_string(),
            old_celsius: of.old_celsius,
            new_celsius: of.new_celsius,
            expansion_um_per_m_k: of.expansion_per_k.map(|expansion| expansion.value * 1e6),
        }
    }
}

impl ErrorChangeEntry {
    fn of(machine: &Machine, e: &ErrorChange) -> Self {
        let (unit_of_error, scale) =
            if e.error.component.is_rotation() { ("urad", 1e6) } else { ("um", 1e3) };
        let scaled = |v: Option<f64>| v.map(|v| v * scale);
        let axis = machine.axes().iter().find(|a| a.name == e.error.body);
        let at = e.at.zip(axis).map(|(q, axis)| AxisPositionEntry {
            axis: axis.name.to_string(),
            position: shown(axis, q),
            unit: unit(axis),
            approach: e.approach,
        });
        Self {
            error: e.error.to_string(),
            unit: unit_of_error,
            old: scaled(e.old),
            new: scaled(e.new),
            change: scaled(e.change()),
            rms_change: e.rms * scale,
            u_change: scaled(e.u),
            e_n: e.e_n(),
            at,
            moved: e.moved.key(),
        }
    }
}
