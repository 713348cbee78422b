//! Deviations of a surface for programs: `trueaxis/identify-surface/1`.

use crate::identify::surface::{HitsStudy, PointDeviation, SurfaceDeviations};
use serde::Serialize;
use trueaxis_report::JsonSchema;

/// Deviations of a surface from the hits of a probing program.
#[derive(Debug, Serialize, JsonSchema)]
pub struct HitsDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/identify-surface/1"))]
    pub schema: &'static str,
    /// Name of the study.
    pub name: &'a str,
    /// Whether a virtual machine made the hits.
    #[serde(rename = "virtual")]
    pub is_virtual: bool,
    /// The number of the probe in the control.
    pub tool: usize,
    /// The stylus of the calibration.
    pub stylus: &'a str,
    /// Number of hits in the log.
    pub hits: usize,
    /// Number of hits that were planned.
    pub planned: usize,
    /// The touch at the end less the first one at the same point, µm; null if there is none.
    pub drift_um: Option<f64>,
    /// Points without a hit.
    pub lost: &'a [usize],
    /// The points with their deviations.
    pub points: Vec<DeviationEntry>,
}

/// A point of the surface.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DeviationEntry {
    /// Its number in the table of points.
    pub point: usize,
    /// The nominal point, workpiece frame, mm.
    pub point_mm: [f64; 3],
    /// The normal there, out of the material. Unit: 1.
    pub normal: [f64; 3],
    /// Along the normal, positive where there is more material, µm.
    pub deviation_um: f64,
    /// Its expanded uncertainty (k = 2), µm.
    #[serde(rename = "U_um")]
    pub expanded_um: f64,
    /// With the nominal machine and the ball radius alone, µm.
    pub as_read_um: f64,
    /// What the errors of the machine did, µm.
    pub by_machine_um: f64,
    /// What offset and pre-travel of the probe did, µm.
    pub by_probe_um: f64,
    /// What the drift did, µm.
    pub by_drift_um: f64,
    /// Standard uncertainty: one trigger, µm.
    pub u_repeatability_um: f64,
    /// Standard uncertainty: calibration of the probe, µm.
    pub u_calibration_um: f64,
    /// Standard uncertainty: length of the probe, µm.
    pub u_length_um: f64,
    /// Standard uncertainty: errors of the machine, µm.
    pub u_machine_um: f64,
    /// Standard uncertainty: drift, µm.
    pub u_drift_um: f64,
    /// Its line in the log.
    pub line: usize,
}

impl<'a> HitsDocument<'a> {
    /// The document of an answer.
    pub fn of(study: &'a HitsStudy, found: &'a SurfaceDeviations) -> Self {
        Self {
            schema: "trueaxis/identify-surface/1",
            name: &study.name,
            is_virtual: study.log.is_virtual,
            tool: study.probe.tool,
            stylus: &study.probe.calibration.stylus,
            hits: study.log.hits.len(),
            planned: study.planned,
            drift_um: found.drift.map(|d| d.change_mm * 1e3),
            lost: &found.lost,
            points: found.points.iter().map(DeviationEntry::from).collect(),
        }
    }
}

impl From<&PointDeviation> for DeviationEntry {
    fn from(p: &PointDeviation) -> Self {
        Self {
            point: p.number,
            point_mm: p.point.point_mm.into(),
            normal: p.point.normal.into(),
            deviation_um: p.deviation_mm * 1e3,
            expanded_um: p.u.expanded_mm() * 1e3,
            as_read_um: p.as_read_mm * 1e3,
            by_machine_um: p.by_machine_mm * 1e3,
            by_probe_um: p.by_probe_mm * 1e3,
            by_drift_um: p.by_drift_mm * 1e3,
            u_repeatability_um: p.u.repeatability_mm * 1e3,
            u_calibration_um: p.u.calibration_mm * 1e3,
            u_length_um: p.u.length_mm * 1e3,
            u_machine_um: p.u.machine_mm * 1e3,
            u_drift_um: p.u.drift_mm * 1e3,
            line: p.place.line,
        }
    }
}
