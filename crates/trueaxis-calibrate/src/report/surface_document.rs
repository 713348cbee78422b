//! A probing path over a surface for programs: `trueaxis/plan-probe-surface/1`.

use crate::plan::program::ProgramCheck;
use crate::plan::surface::{Pose, SurfaceStudy};
use serde::Serialize;
use trueaxis_report::JsonSchema;

/// A probing path over a surface.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SurfaceDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/plan-probe-surface/1"))]
    pub schema: &'static str,
    /// Name of the study.
    pub name: &'a str,
    /// Number of points that were spread over the surface.
    pub asked: usize,
    /// The points that the probe touches, in their order.
    pub points: Vec<PointEntry>,
    /// Least distance of two points, mm.
    pub spacing_mm: f64,
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

/// A point that the probe touches.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PointEntry {
    /// Where it is, workpiece frame, mm.
    pub point_mm: [f64; 3],
    /// The normal of the surface there, out of the material. Unit: 1.
    pub normal: [f64; 3],
    /// Its line in the file of the surface.
    pub line: u32,
}

impl<'a> SurfaceDocument<'a> {
    /// The document of a path; `asked`: the number of points that were spread over the surface.
    pub fn of(
        study: &'a SurfaceStudy,
        poses: &[Pose],
        asked: usize,
        check: &'a ProgramCheck,
    ) -> Self {
        Self {
            schema: "trueaxis/plan-probe-surface/1",
            name: &study.name,
            asked,
            points: poses.iter().map(PointEntry::from).collect(),
            spacing_mm: study.spacing_mm,
            duration_s: check.duration_s,
            sound: check.is_sound(),
            errors: &check.errors,
            issues: &check.critical,
            notes: &check.minor,
        }
    }
}

impl From<&Pose> for PointEntry {
    fn from(pose: &Pose) -> Self {
        let point = &pose.point;
        Self { point_mm: point.point_mm.into(), normal: point.normal.into(), line: point.line }
    }
}
