//! The document `trueaxis/solve/1`.

use super::trace_document::axes;
use serde::Serialize;
use serde_json::Value;
use trueaxis_machine::axis::Command;
use trueaxis_machine::{Machine, Solutions};
use trueaxis_report::JsonSchema;
use trueaxis_report::{Keyed, document};

/// Axis positions for one tool pose.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SolveDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/solve/1"))]
    pub schema: &'static str,
    /// All solutions of the nominal machine, the best first.
    pub solutions: Vec<SolutionEntry>,
    /// Whether an axis has no effect on the tool pose there.
    pub singular: bool,
    /// The name of that axis, which keeps its angle; null if there is none.
    pub held_axis: Option<String>,
}

/// One solution.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SolutionEntry {
    /// The positions of the axes, mm and degrees.
    pub axes: Keyed<f64>,
    /// Whether all axes are within their travel.
    pub within_limits: bool,
    /// How far the rotary axes turn to get there, degrees.
    pub rotary_travel_deg: f64,
}

/// Axis positions for a path of tool poses.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SolvePathDocument {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/solve/1"))]
    pub schema: &'static str,
    /// One for each pose of the path.
    pub rows: Vec<SolveRowEntry>,
}

/// The axis positions for one pose of a path.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SolveRowEntry {
    /// The positions of the axes, mm and degrees.
    pub axes: Keyed<f64>,
}

/// The document `trueaxis/solve/1`.
pub fn solve_json(machine: &Machine, solved: &Solutions) -> Value {
    let solutions = solved.solutions.iter().map(|s| SolutionEntry {
        axes: axes(machine, &s.command),
        within_limits: s.within_travel,
        rotary_travel_deg: s.rotary_travel_rad.to_degrees(),
    });
    document(&SolveDocument {
        schema: "trueaxis/solve/1",
        solutions: solutions.collect(),
        singular: solved.singular.is_some(),
        held_axis: solved.singular.map(|s| s.axis.to_string()),
    })
}

/// The document `trueaxis/solve/1` of a path.
pub fn solve_path_json(machine: &Machine, commands: &[Command]) -> Value {
    let rows = commands.iter().map(|c| SolveRowEntry { axes: axes(machine, c) });
    document(&SolvePathDocument { schema: "trueaxis/solve/1", rows: rows.collect() })
}
