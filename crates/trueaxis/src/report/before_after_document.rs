//! A laser before and after compensation for programs: `trueaxis/before-after/1`.

use super::before_after::BeforeAfterReport;
use crate::verify::before_after::{AppliedValues, Curve};
use serde::Serialize;
use trueaxis_measure::instruments::MaterialCompensation;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;
use trueaxis_standards::iso230_2::{Approached, Quantity};

/// Virtual lasers before and after compensation.
#[derive(Debug, Serialize, JsonSchema)]
pub struct BeforeAfterDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/before-after/1"))]
    pub schema: &'static str,
    /// Name of the campaign.
    pub name: &'a str,
    /// Name of the machine file.
    pub machine: &'a str,
    /// Name of the machine that was measured.
    pub measured: &'a str,
    /// Seed of the random numbers; each compensation has the next one.
    pub seed: u64,
    /// `values`, or `tables` of a control.
    pub added_by: &'static str,
    /// The least increment of a value of a linear axis, µm.
    pub increment_um: f64,
    /// The lasers.
    pub lasers: Vec<LaserEntry<'a>>,
    /// The readings, axis by axis.
    pub curves: Vec<CurveEntry<'a>>,
    /// The files that were written.
    pub files: &'a [String],
}

/// A laser.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LaserEntry<'a> {
    /// Its name in the campaign.
    pub name: &'a str,
    /// What it is set to; null if it reads the machine alone.
    pub material: Option<MaterialEntry<'a>>,
}

/// The compensation of a material in a laser.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MaterialEntry<'a> {
    /// Coefficient of expansion, 1e-6/K.
    pub expansion_um_per_m_k: f64,
    /// Temperature of the material, °C.
    pub celsius: f64,
    /// The sensor that it is read from; null if it was typed in.
    pub sensor: Option<&'a str>,
    /// How much longer the material is than at 20 °C, µm/m.
    pub share_um_per_m: f64,
    /// Standard uncertainty of that, µm/m.
    pub u_um_per_m: f64,
}

/// One laser on one axis under one compensation.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CurveEntry<'a> {
    /// The axis.
    pub axis: String,
    /// The laser.
    pub laser: &'a str,
    /// The path.
    pub path: &'a str,
    /// `none`, `machine` or `comprehensive`.
    pub compensation: &'static str,
    /// The mean of the runs that is farthest from 0, with its sign, µm.
    pub largest_um: f64,
    /// The target of it, mm.
    pub at_mm: f64,
    /// Standard uncertainty of this reading, µm.
    pub u_um: f64,
    /// Standard uncertainty of the error there by the machine file; null if it states none, µm.
    pub file_u_um: Option<f64>,
    /// The figures of ISO 230-2: `A_um`, `R_um` …; null where the readings do not allow one.
    #[serde(flatten)]
    pub figures: Keyed<Option<f64>>,
    /// Their expanded uncertainties (k = 2), by the same keys.
    #[serde(rename = "U_um")]
    pub expanded: Keyed<Option<f64>>,
    /// Every target.
    pub targets: Vec<TargetEntry>,
}

/// A target.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TargetEntry {
    /// Its position, mm.
    pub target_mm: f64,
    /// What was added to the command, mean of both directions, µm.
    pub added_um: f64,
    /// Mean deviation, rising; null if it was not approached so, µm.
    pub up_um: Option<f64>,
    /// Mean deviation, falling; null if it was not approached so, µm.
    pub down_um: Option<f64>,
}

impl<'a> BeforeAfterDocument<'a> {
    /// The document of the readings.
    pub fn of(shown: &'a BeforeAfterReport<'a>) -> Self {
        let study = shown.study;
        let lasers = study.campaign.instruments.iter().map(|instrument| LaserEntry {
            name: &instrument.name,
            material: instrument.material.as_ref().map(material),
        });
        Self {
            schema: "trueaxis/before-after/1",
            name: &study.campaign.name,
            machine: study.campaign.machine.name(),
            measured: study.real.truth.machine.name(),
            seed: study.real.truth.seed,
            added_by: match study.values {
                AppliedValues::Values => "values",
                AppliedValues::Tables(_) => "tables",
            },
            increment_um: study.increment_mm * 1e3,
            lasers: lasers.collect(),
            curves: shown.curves.iter().map(|curve| entry(shown, curve)).collect(),
            files: shown.files,
        }
    }
}

fn material(material: &MaterialCompensation) -> MaterialEntry<'_> {
    MaterialEntry {
        expansion_um_per_m_k: material.expansion_per_k.value * 1e6,
        celsius: material.celsius.value,
        sensor: material.sensor.as_deref(),
        share_um_per_m: material.share() * 1e6,
        u_um_per_m: material.u_share() * 1e6,
    }
}

fn entry<'a>(shown: &'a BeforeAfterReport<'a>, curve: &'a Curve) -> CurveEntry<'a> {
    let um = |value: Option<f64>| value.map(|v| v * 1e3);
    let keyed = |of: &dyn Fn(Quantity) -> Option<f64>, suffix: &str| {
        Quantity::ALL.map(|q| (format!("{}{suffix}", q.key()), um(of(q)))).into_iter().collect()
    };
    let mean = |side: Option<Approached>| um(side.map(|s| s.mean));
    let targets =
        curve.result.positions.iter().zip(&curve.added_mm).map(|(p, added)| TargetEntry {
            target_mm: p.target,
            added_um: added * 1e3,
            up_um: mean(p.up),
            down_um: mean(p.down),
        });
    CurveEntry {
        axis: shown.axis(curve),
        laser: shown.laser(curve),
        path: shown.path(curve),
        compensation: curve.compensation.name(),
        largest_um: curve.largest.deviation_mm * 1e3,
        at_mm: curve.largest.target_mm,
        u_um: curve.largest.u_mm * 1e3,
        file_u_um: um(curve.file_u_mm),
        figures: keyed(&|q| curve.result.value(q), "_um"),
        expanded: keyed(&|q| curve.result.expanded_of(q), ""),
        targets: targets.collect(),
    }
}
