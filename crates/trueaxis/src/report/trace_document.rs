//! The document `trueaxis/trace/1`.

use super::pose_document::{
    BodyEntry, DeviationEntry, ShareEntry, ToolEntry, ToolPoseEntry, body_entries, share_entries,
};
use super::trace::{TraceReport, event_texts, feed, kind, named_axes, orientation};
use serde::Serialize;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::describe::to_shown;
use trueaxis_motion::TracedNode;
use trueaxis_nc::moves::Move;
use trueaxis_report::JsonSchema;
use trueaxis_report::Keyed;

/// One block of a program through every stage of the simulation.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TraceDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/trace/1"))]
    pub schema: &'static str,
    /// The machine.
    pub machine: MachineEntry<'a>,
    /// The file of the program.
    pub program: &'a str,
    /// The block that was asked for: its number N, else its line.
    pub block: usize,
    /// Its line in the program.
    pub line: usize,
    /// Its text.
    pub text: &'a str,
    /// How often it is executed; the first time is traced.
    pub executions: u64,
    /// What the interpreter of the control makes of it.
    pub programmed: ProgrammedEntry<'a>,
    /// The points into which its path is divided.
    pub nodes: Vec<NodeEntry>,
    /// The tool at its end; absent if nothing moves.
    #[serde(flatten)]
    pub end: Option<EndEntry>,
    /// The deviation at its end under each error alone; absent if nothing moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget: Option<Vec<ShareEntry>>,
    /// The place of every body at its end; absent if nothing moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bodies: Option<Vec<BodyEntry>>,
}

/// A machine by its name.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MachineEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its kinematic chain from the workpiece to the tool.
    pub chain: String,
}

/// A block as the control reads it.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProgrammedEntry<'a> {
    /// Its moves.
    pub moves: Vec<MoveEntry>,
    /// What else it does, in words.
    pub events: Vec<String>,
    /// The program frame.
    pub frame: FrameEntry<'a>,
    /// Whether the tip of the tool is programmed (RTCP, TRAORI, TCPM).
    pub tool_centre: bool,
    /// Whether the frame is that of a tilted working plane.
    pub tilted_plane: bool,
    /// How the tool axis is interpolated: `axes`, `great circle` or `cone`.
    pub orientation: &'static str,
    /// The number of the tool in the spindle.
    pub tool: u32,
    /// The tool length that is in effect, mm along X, Y and Z.
    pub tool_length_mm: &'a [f64],
}

/// A move as it is programmed.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MoveEntry {
    /// `rapid`, `line`, `circle`, `thread` and so on.
    pub kind: &'static str,
    /// The position of the axes that are named, mm and degrees, in the program frame.
    pub target: Keyed<f64>,
    /// The tool axis if it is programmed as a vector. Unit: 1.
    pub direction: Option<[f64; 3]>,
    /// The feed with its unit, or `rapid`.
    pub feed: String,
}

/// A program frame.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FrameEntry<'a> {
    /// Rotation, scale and mirror of X, Y and Z, row by row. Unit: 1.
    pub linear: &'a [[f64; 3]; 3],
    /// Its origin: X Y Z A B C U V W, mm and degrees. Unit: mm or deg.
    pub shift: &'a [f64; 9],
}

/// A point of the path.
#[derive(Debug, Serialize, JsonSchema)]
pub struct NodeEntry {
    /// The nominal tool in the workpiece frame.
    pub nominal: ToolPoseEntry,
    /// The actual tool there.
    pub actual: ToolPoseEntry,
    /// Actual − nominal.
    pub deviation: PathDeviationEntry,
    /// The positions of the axes, mm and degrees.
    pub axes: Keyed<f64>,
    /// The time since the start of the program, s.
    pub time_s: f64,
}

/// A deviation of the tool on its path.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PathDeviationEntry {
    /// Of tip and axis.
    #[serde(flatten)]
    pub tool: DeviationEntry,
    /// Of the tip along the feed, µm.
    pub feed_um: f64,
    /// Of the tip along the principal normal of the path, µm.
    pub normal_um: f64,
    /// Of the tip along the binormal of the path, µm.
    pub binormal_um: f64,
}

/// The tool at the end of a block.
#[derive(Debug, Serialize, JsonSchema)]
pub struct EndEntry {
    /// The positions of the axes, mm and degrees.
    pub axes: Keyed<f64>,
    /// The nominal tool in the workpiece frame.
    pub nominal: ToolPoseEntry,
    /// The actual tool there.
    pub actual: ToolPoseEntry,
    /// Actual − nominal.
    pub deviation: PathDeviationEntry,
    /// When the block runs.
    pub time: TimeEntry,
}

/// When a block runs.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TimeEntry {
    /// Its start, s since the start of the program.
    pub from_s: f64,
    /// Its end, s.
    pub to_s: f64,
    /// The speed of the tip at its end, mm/min.
    pub speed_mm_per_min: f64,
}

impl<'a> From<&TraceReport<'a>> for TraceDocument<'a> {
    fn from(report: &TraceReport<'a>) -> Self {
        let TraceReport { job, block, found, at_end } = report;
        let machine = &job.machine;
        let nodes = found.nodes.iter().map(|n| NodeEntry::of(machine, n));
        let end = found.nodes.last().map(|last| EndEntry::of(machine, found.from_s, last));
        Self {
            schema: "trueaxis/trace/1",
            machine: MachineEntry { name: machine.name(), chain: machine.chain_text() },
            program: job.program.file(),
            block: *block,
            line: found.line,
            text: &found.text,
            executions: found.executions,
            programmed: ProgrammedEntry {
                moves: found.moves().map(MoveEntry::from).collect(),
                events: event_texts(found),
                frame: FrameEntry { linear: &found.frame.linear, shift: &found.frame.shift.0 },
                tool_centre: found.tool_centre,
                tilted_plane: found.tilted,
                orientation: orientation(&found.orientation),
                tool: found.tool,
                tool_length_mm: &found.tool_length.0[..3],
            },
            nodes: nodes.collect(),
            end,
            budget: at_end.as_ref().map(|(budget, _)| share_entries(budget)),
            bodies: at_end.as_ref().map(|(_, bodies)| body_entries(bodies)),
        }
    }
}

impl From<&Move> for MoveEntry {
    fn from(m: &Move) -> Self {
        Self {
            kind: kind(&m.kind),
            target: named_axes(m).map(|a| (a.to_string(), m.target[a])).collect(),
            direction: m.direction,
            feed: feed(m),
        }
    }
}

impl NodeEntry {
    fn of(machine: &Machine, n: &TracedNode) -> Self {
        let ToolEntry { nominal, actual, deviation } = ToolEntry::from(&n.deviation);
        let along = n.along_path_mm * 1e3;
        let (feed_um, normal_um, binormal_um) = (along.x, along.y, along.z);
        Self {
            nominal,
            actual,
            deviation: PathDeviationEntry { tool: deviation, feed_um, normal_um, binormal_um },
            axes: axes(machine, &n.node.command),
            time_s: n.stamp.time_s,
        }
    }
}

impl EndEntry {
    fn of(machine: &Machine, from_s: f64, last: &TracedNode) -> Self {
        let NodeEntry { nominal, actual, deviation, axes, time_s } = NodeEntry::of(machine, last);
        let speed_mm_per_min = last.stamp.speed * 60.0;
        let time = TimeEntry { from_s, to_s: time_s, speed_mm_per_min };
        Self { axes, nominal, actual, deviation, time }
    }
}

/// The positions of the axes by name, mm and degrees.
pub(super) fn axes(machine: &Machine, command: &Command) -> Keyed<f64> {
    let axes = machine.axes().iter().enumerate();
    axes.map(|(i, a)| (a.name.to_string(), to_shown(machine, i, command[i]))).collect()
}
