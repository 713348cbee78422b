//! Requests and answers about simulations.

use super::describe::SurfaceEntry;
use serde::{Deserialize, Serialize};
use trueaxis::JsonSchema;
use trueaxis::machine::Machine;
use trueaxis::report::{DiagnosticEntry, Keyed, SimulationDocument, array, issue_code, issue_text};
use trueaxis::simulate::{AxisRange, Issue, Moment, QuantityRange, SetUpTool, shown};

/// Simulates a program: a file of the project, or `name` and `text` of one that was dropped.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SimulateRequest {
    /// The machine file.
    pub(super) machine: String,
    /// The program.
    pub(super) program: Option<String>,
    /// The set-up file; the one beside the program if it is left out.
    pub(super) setup: Option<String>,
    /// The control that the program is for, as `--control` of the command line.
    pub(super) control: Option<String>,
    /// The name of a program that was dropped.
    pub(super) name: Option<String>,
    /// Its text.
    pub(super) text: Option<String>,
    /// Whether the simulation goes on after errors; false if it is left out.
    pub(super) keep_going: Option<bool>,
    /// Whether collisions are looked for; true if it is left out.
    pub(super) collisions: Option<bool>,
    /// Whether blocks with `/` are executed, as with the switch of the control off; true if it is left out.
    pub(super) optional_blocks: Option<bool>,
}

impl SimulateRequest {
    /// A program of the project on a machine.
    pub(super) fn of(machine: String, program: String) -> Self {
        Self { machine, program: Some(program), ..Self::default() }
    }
}

/// A simulation. Array: `corners_mm` (f32: the corners of the triangles of `on_workpiece`, nine numbers each).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SimulateAnswer<'a> {
    /// How long the program runs, s.
    pub(super) duration_s: f64,
    /// How many nodes the path has.
    pub(super) nodes: usize,
    /// How many of them are kept.
    pub(super) kept: usize,
    /// Whether some are not kept.
    pub(super) thinned: bool,
    /// The axes.
    pub(super) axes: Vec<SimulatedAxisEntry>,
    /// The quantities that can be shown as curves.
    pub(super) quantities: Vec<QuantityEntry>,
    /// The programs that ran, the main program first.
    pub(super) programs: Vec<ProgramEntry<'a>>,
    /// The issues in the order of time.
    pub(super) marks: Vec<MarkEntry>,
    /// The names of the bodies of the machine.
    pub(super) bodies: Vec<String>,
    /// The document of `trueaxis simulate`.
    pub(super) document: SimulationDocument<'a>,
    /// The tools of the set-up.
    pub(super) tools: Vec<SetUpToolEntry<'a>>,
    /// Stock, part and fixtures of the set-up.
    pub(super) on_workpiece: Vec<SurfaceEntry<'a>>,
    /// The problems of machine, set-up and program.
    pub(super) diagnostics: Vec<DiagnosticEntry<'a>>,
    /// The number of the simulation, for further requests; only the last few are kept.
    pub(super) simulation: u64,
}

/// An axis of the simulated machine.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SimulatedAxisEntry {
    /// Its name.
    name: String,
    /// The unit of its positions.
    #[schemars(extend("enum" = ["mm", "deg"]))]
    unit: &'static str,
    /// Its travel in that unit; null if it has no limits.
    travel: Option<[f64; 2]>,
    /// Its maximum velocity, mm/s or deg/s; null if it is not stated.
    velocity: Option<f64>,
    /// Its maximum acceleration, mm/s² or deg/s²; null if it is not stated.
    acceleration: Option<f64>,
}

impl From<AxisRange> for SimulatedAxisEntry {
    fn from(axis: AxisRange) -> Self {
        Self {
            name: axis.name,
            unit: axis.unit,
            travel: axis.travel,
            velocity: axis.velocity,
            acceleration: axis.acceleration,
        }
    }
}

/// A quantity that can be shown as a curve.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct QuantityEntry {
    /// Its name in requests, such as `X`, `X.speed`, `tip`.
    key: String,
    /// Its title.
    title: String,
    /// Its unit.
    unit: String,
    /// Its limits, from and to; null if it has none.
    limits: Option<[f64; 2]>,
}

impl From<QuantityRange> for QuantityEntry {
    fn from(q: QuantityRange) -> Self {
        Self { key: q.key, title: q.title, unit: q.unit, limits: q.limits }
    }
}

/// A program that ran.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ProgramEntry<'a> {
    /// Its name.
    pub(super) name: &'a str,
    /// Its path below the project folder; null if it is not a file there.
    pub(super) path: Option<&'a str>,
    /// How many lines it has.
    pub(super) lines: usize,
}

/// An issue of the simulation.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct MarkEntry {
    /// Its kind, such as `collision`.
    kind: &'static str,
    /// Whether part or machine are in danger.
    #[serde(rename = "grave")]
    critical: bool,
    /// When it begins, s.
    time_s: f64,
    /// When it ends, s; null if it is a moment.
    until_s: Option<f64>,
    /// The issue in one sentence.
    text: String,
    /// The number of the program where it begins.
    program: u32,
    /// The line there, from 1.
    line: u32,
    /// How many stretches it holds: above 1 where the nearest of many were put together.
    stretches: u64,
}

impl MarkEntry {
    pub(super) fn of(machine: &Machine, issue: &Issue) -> Self {
        Self {
            kind: issue_code(&issue.kind),
            critical: issue.critical,
            time_s: issue.from_s,
            until_s: Some(issue.to_s).filter(|to_s| *to_s > issue.from_s),
            text: issue_text(machine, issue),
            program: issue.first.program,
            line: issue.first.line,
            stretches: issue.stretches,
        }
    }
}

/// A tool of the set-up.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SetUpToolEntry<'a> {
    /// Its number.
    tool: u32,
    /// Its name.
    name: &'a str,
    /// Its tip in the frame of the tool holder, mm.
    tip_mm: [f64; 3],
    /// Diameter and length of each of its cylinders from the tip upwards, mm; empty if they are not stated.
    segments_mm: Vec<[f64; 2]>,
}

impl<'a> SetUpToolEntry<'a> {
    pub(super) fn of(number: u32, tool: &'a SetUpTool) -> Self {
        let shape = tool.tool_shape().into_iter().flat_map(|shape| shape.segments);
        Self {
            tool: number,
            name: &tool.name,
            tip_mm: array(tool.tip_mm),
            segments_mm: shape.map(|s| [s.diameter_mm, s.length_mm]).collect(),
        }
    }
}

/// Everything at one time.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SimulationAtRequest {
    /// The number of the simulation.
    pub(super) simulation: u64,
    /// The time, s.
    pub(super) time_s: f64,
}

/// The stock as it is at one time.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SimulationStockRequest {
    /// The number of the simulation.
    pub(super) simulation: u64,
    /// The time, s.
    pub(super) time_s: f64,
}

/// The stock at a time. Array: `corners_mm` (f32: the corners of the triangles of `on_workpiece`, nine numbers each).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SimulationStockAnswer<'a> {
    /// The time, s.
    pub(super) time_s: f64,
    /// What remains of the stock, mm³.
    pub(super) left_mm3: f64,
    /// What was removed, mm³.
    pub(super) removed_mm3: f64,
    /// Stock, part and fixtures of the set-up.
    pub(super) on_workpiece: Vec<SurfaceEntry<'a>>,
}

/// A moment. Arrays: `nominal`, `actual` (f64: for each body its rotation row by row, then its origin, mm, in the
/// machine frame).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SimulationAtAnswer {
    /// Program, axes and tool.
    pub(super) moment: MomentEntry,
}

/// Program, axes and tool at one time.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct MomentEntry {
    /// The time from the start of the program, s.
    time_s: f64,
    /// The number of the program.
    program: u32,
    /// Its line, from 1.
    line: u32,
    /// The positions of the axes by name, mm or degrees.
    axes: Keyed<f64>,
    /// The direction of the last motion of each axis: +1, −1, or 0 before the first.
    approach: Keyed<f64>,
    /// The nominal tip in the workpiece frame, mm.
    tip_mm: [f64; 3],
    /// The deviation of the tip, µm.
    off_tip_um: [f64; 3],
    /// The deviation of the tool axis, µrad.
    off_axis_urad: [f64; 3],
    /// The deviation of the tip along feed, normal and binormal, µm; null where the path has no direction.
    along_path_um: [Option<f64>; 3],
    /// The speed along the path, mm/min.
    speed_mm_per_min: f64,
    /// Whether the axes move in rapid traverse.
    rapid: bool,
    /// Whether the axes wait.
    waits: bool,
    /// The number of the tool in the spindle; null if there is none.
    tool: Option<u32>,
}

impl MomentEntry {
    pub(super) fn of(machine: &Machine, moment: &Moment) -> Self {
        let axes = || machine.axes().iter().enumerate().map(|(i, a)| (i, a.name.to_string()));
        Self {
            time_s: moment.time_s,
            program: moment.program,
            line: moment.line,
            axes: axes().map(|(i, name)| (name, shown(machine, i, moment.command[i]))).collect(),
            approach: axes().map(|(i, name)| (name, moment.approach[i])).collect(),
            tip_mm: array(moment.tip_mm),
            off_tip_um: array(moment.off_tip_um),
            off_axis_urad: array(moment.off_axis_urad),
            along_path_um: array(moment.along_path_um).map(|v| v.is_finite().then_some(v)),
            speed_mm_per_min: moment.speed * 60.0,
            rapid: moment.rapid,
            waits: moment.waits,
            tool: Some(moment.tool).filter(|tool| *tool != 0),
        }
    }
}

/// When a block ends: the one after or before a time (`step`, `from_s`), or that of a line (`program`, `line`).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SimulationBlockRequest {
    /// The number of the simulation.
    pub(super) simulation: u64,
    /// Which block from `from_s`.
    pub(super) step: Option<BlockStep>,
    /// The time, s.
    pub(super) from_s: Option<f64>,
    /// The number of the program.
    pub(super) program: Option<usize>,
    /// The line, from 1.
    pub(super) line: Option<usize>,
}

/// From one block to another.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum BlockStep {
    /// The block after a time.
    Next,
    /// The block before it.
    Previous,
}

/// The end of a block.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SimulationBlockAnswer {
    /// When it ends, s.
    pub(super) time_s: f64,
}

/// The path of the tip.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SimulationPathRequest {
    /// The number of the simulation.
    pub(super) simulation: u64,
    /// From this time, s; from the start if it is left out.
    pub(super) from_s: Option<f64>,
    /// To this time, s; to the end if it is left out.
    pub(super) to_s: Option<f64>,
    /// At most so many points.
    pub(super) points: usize,
    /// The quantity that colours the path.
    pub(super) colour: PathColour,
}

/// A quantity that colours a path.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum PathColour {
    /// The deviation of the tip.
    Deviation,
    /// The speed along the path.
    Feed,
    /// The largest share of a velocity limit.
    Load,
}

/// A path. Arrays, for each point: `tip_mm` (f32: three, from `origin_mm`), `off_um` (f32: three), `value` (f32),
/// `rapid` (u8: 1 in rapid traverse), `time_s` (f64), `program`, `line` (u32).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SimulationPathAnswer {
    /// The origin of the points in the workpiece frame, mm.
    pub(super) origin_mm: [f64; 3],
    /// The unit of the values.
    pub(super) unit: &'static str,
    /// The title of the values.
    pub(super) title: &'static str,
    /// The lowest value.
    pub(super) low: f32,
    /// The highest value.
    pub(super) high: f32,
    /// How far the drawn path is from the simulated one, mm.
    pub(super) chord_mm: f64,
    /// Whether all points of the simulation are drawn.
    pub(super) complete: bool,
}

/// Curves over a range of time.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SimulationCurvesRequest {
    /// The number of the simulation.
    pub(super) simulation: u64,
    /// From this time, s.
    pub(super) from_s: f64,
    /// To this time, s.
    pub(super) to_s: f64,
    /// How many columns of equal time.
    pub(super) columns: usize,
    /// The names of the quantities.
    pub(super) quantities: Vec<String>,
}

/// Curves. Arrays: `low`, `high` (f32: the extent in each column, quantity after quantity).
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SimulationCurvesAnswer {
    /// From this time, s.
    pub(super) from_s: f64,
    /// To this time, s.
    pub(super) to_s: f64,
    /// How many columns of equal time.
    pub(super) columns: usize,
    /// The names of the quantities, in the order of the arrays.
    pub(super) quantities: Vec<String>,
}

/// The text of a program as it was simulated.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SimulationSourceRequest {
    /// The number of the simulation.
    pub(super) simulation: u64,
    /// The number of the program.
    pub(super) program: usize,
}

/// A program.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SimulationSourceAnswer<'a> {
    /// Its name.
    pub(super) name: &'a str,
    /// Its text.
    pub(super) text: &'a str,
}
