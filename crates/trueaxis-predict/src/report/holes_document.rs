//! The document of a prediction for holes.

use crate::predict::holes::{Hole, HolePrediction, HoleSet, HoleStudy};
use serde::Serialize;
use trueaxis_geometry::Vec3;
use trueaxis_report::JsonSchema;

/// Holes before they are made, under each compensation: `trueaxis/predict/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct HolesDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/predict/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// The least increment of the control, mm.
    pub increment_mm: f64,
    /// The tolerance of the place of a hole; null if none is stated, mm.
    pub tolerance_mm: Option<f64>,
    /// The tolerance of the location diameter, either way; null if none is stated, mm.
    pub location_tolerance_mm: Option<f64>,
    /// The compensation that is applied: `none`, `machine`, `comprehensive`, or `acted`: what a live run has recorded.
    pub applied: &'static str,
    /// Whether all stated tolerances are kept with it; null if none is stated.
    pub in_tolerance: Option<bool>,
    /// The log that the temperatures follow; null if there is none.
    pub temperature_log: Option<&'a str>,
    /// The record of what acted; null without one.
    pub acted_record: Option<&'a str>,
    /// The holes under each compensation.
    pub sets: Vec<SetEntry>,
    /// The same at the temperatures of the start, held; null where no log runs.
    pub sets_at_start: Option<Vec<SetEntry>>,
    /// What grows with the temperature though the uncertainty of its coefficient is not stated: u lacks it.
    pub u_lacks: &'a [String],
    /// What to know of this prediction.
    pub warnings: Vec<&'a str>,
}

/// The holes under one compensation.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SetEntry {
    /// `none`, `machine`, `comprehensive` or `acted`.
    pub compensation: &'static str,
    /// The largest distance of a hole from its place in X and Y, mm.
    pub worst_mm: f64,
    /// Its standard uncertainty, mm.
    pub u_worst_mm: f64,
    /// Whether all places are in tolerance; null if none is stated.
    pub in_tolerance: Option<bool>,
    /// Whether the location diameter is in its tolerance; null if none is stated.
    pub location_in_tolerance: Option<bool>,
    /// The circle on which the holes are; null for fewer than three.
    pub location_diameter: Option<LocationEntry>,
    /// The holes in the order of the study.
    pub holes: Vec<HoleEntry>,
}

/// The circle of the holes at 20 °C, less the nominal one.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LocationEntry {
    /// Its diameter by least squares, µm.
    pub error_um: f64,
    /// Standard uncertainty of that, µm.
    pub u_um: f64,
    /// Smallest and largest distance of opposite holes; null where the number of holes is odd, µm.
    pub opposite_um: Option<[f64; 2]>,
    /// Standard uncertainties of these two, µm.
    pub u_opposite_um: Option<[f64; 2]>,
    /// Where its centre is along X and Y, µm.
    pub centre_um: [f64; 2],
}

/// One hole.
#[derive(Debug, Serialize, JsonSchema)]
pub struct HoleEntry {
    /// Where it should be in the workpiece frame, mm.
    pub nominal_mm: [f64; 3],
    /// Where it is at 20 °C, mm.
    pub actual_mm: [f64; 3],
    /// The difference, µm.
    pub error_um: [f64; 3],
    /// Its standard uncertainty, µm.
    pub u_um: [f64; 3],
    /// What the control adds, in least increments along X, Y, Z.
    pub compensation_increments: [i64; 3],
    /// When it is made, from the start, s.
    pub time_s: f64,
}

impl<'a> HolesDocument<'a> {
    /// The document of a prediction.
    pub fn of(study: &'a HoleStudy, prediction: &'a HolePrediction) -> Self {
        let applied = prediction.sets.iter().find(|set| set.compensation == study.applied);
        let set = |set: &HoleSet| SetEntry::of(study, prediction, set);
        Self {
            schema: "trueaxis/predict/1",
            name: &study.name,
            increment_mm: study.increment_mm,
            tolerance_mm: study.tolerance_mm,
            location_tolerance_mm: study.location_tolerance_mm,
            applied: study.applied.name(),
            in_tolerance: applied.and_then(HoleSet::keeps_tolerances),
            temperature_log: study.temperatures.as_ref().map(|t| t.run.log.file()),
            acted_record: study.acted.as_ref().map(|record| record.file.as_str()),
            sets: prediction.sets.iter().map(set).collect(),
            sets_at_start: prediction.held.as_ref().map(|held| held.iter().map(set).collect()),
            u_lacks: &prediction.without_u,
            warnings: prediction.warnings.iter().map(|(_, text)| text.as_str()).collect(),
        }
    }
}

impl SetEntry {
    fn of(study: &HoleStudy, prediction: &HolePrediction, set: &HoleSet) -> Self {
        let places = study.holes_mm.iter().zip(&prediction.times_s);
        let holes = set.holes.iter().zip(places);
        Self {
            compensation: set.compensation.name(),
            worst_mm: set.worst_mm,
            u_worst_mm: set.u_worst_mm,
            in_tolerance: set.in_tolerance,
            location_in_tolerance: set.location_in_tolerance,
            location_diameter: set.location.map(|circle| LocationEntry {
                error_um: circle.diameter_error_mm * 1e3,
                u_um: circle.u_diameter_mm * 1e3,
                opposite_um: circle.opposite_mm.map(|both| both.map(|mm| mm * 1e3)),
                u_opposite_um: circle.u_opposite_mm.map(|both| both.map(|mm| mm * 1e3)),
                centre_um: circle.centre_mm.map(|mm| mm * 1e3),
            }),
            holes: holes.map(|(hole, (at, time))| HoleEntry::of(hole, at, *time)).collect(),
        }
    }
}

impl HoleEntry {
    fn of(hole: &Hole, nominal_mm: &Vec3, time_s: f64) -> Self {
        // + 0.0: no minus before a zero.
        let vector = |v: &Vec3, scale: f64| [v.x, v.y, v.z].map(|x| x * scale + 0.0);
        Self {
            nominal_mm: vector(nominal_mm, 1.0),
            actual_mm: vector(&(nominal_mm + hole.error_mm), 1.0),
            error_um: vector(&hole.error_mm, 1e3),
            u_um: vector(&hole.u_mm, 1e3),
            compensation_increments: hole.increments,
            time_s,
        }
    }
}
