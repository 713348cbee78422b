//! A simulation for programs: the document `trueaxis/simulate/1`.

use super::simulation::{Simulation, control_name, issue_code, issue_text, verdict};
use super::stock::StockEntry;
use super::tool_states::ToolStateEntry;
use crate::{AxisUse, Drift, Issue, IssueKind, Reversal, Worst, shown, tool_standings, unit};
use serde::Serialize;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Keyed, Verdict};

/// A simulation of a program on a machine: `trueaxis/simulate/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SimulationDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/simulate/1"))]
    pub schema: &'static str,
    /// The version of the program `trueaxis`.
    pub version: &'static str,
    /// The machine.
    pub machine: MachineEntry<'a>,
    /// The program file.
    pub program: &'a str,
    /// The program and its subprograms; `program` elsewhere is an index into this list.
    pub programs: &'a [String],
    /// The control.
    pub control: &'static str,
    /// Whether a set-up was given; without one work offsets and tool lengths are 0.
    pub set_up_given: bool,
    /// The result.
    pub verdict: Verdict,
    /// The whole time, s.
    pub time_s: f64,
    /// Time of rapid moves, s.
    pub rapid_s: f64,
    /// Time of dwells, s.
    pub dwell_s: f64,
    /// Path length of the tool tip in the workpiece with feed, mm.
    pub feed_mm: f64,
    /// The same of rapid moves, mm.
    pub rapid_mm: f64,
    /// How many moves the program makes.
    pub moves: u64,
    /// How many points of the path were computed.
    pub nodes: u64,
    /// Smallest and largest coordinates of the nominal tool tip with feed, workpiece frame, mm; null if it never
    /// moves with feed.
    pub tip_box_mm: Option<[[f64; 3]; 2]>,
    /// Every axis by its name, in chain order.
    pub axes: Keyed<AxisEntry>,
    /// The largest deviations of the actual tool from the nominal one.
    pub deviation: DeviationEntry,
    /// The first 1000 reversals of all axes, in order of time.
    pub reversals: Vec<ReversalEntry>,
    /// The issues that were found.
    #[serde(rename = "troubles")]
    pub issues: Vec<IssueEntry<'a>>,
    /// How many stretches of issues there are in all: the sum of `stretches`.
    #[serde(rename = "troubles_found")]
    pub issues_found: u64,
    /// How many functions of the program that move the tool or its place are not executed: they are among the
    /// diagnostics.
    pub motion_left_out: u64,
    /// How many times the program asks for a speed of the spindle or a tool that the machine does not have: they are
    /// among the diagnostics.
    pub beyond_equipment: u64,
    /// Messages of the program to the operator.
    pub messages: &'a [String],
    /// Stops in the program, optional ones not counted.
    pub stops: u64,
    /// The tools in the order of their numbers.
    pub tools: Vec<ToolEntry>,
    /// The file that the path was written to; null if none was asked for.
    pub path_file: Option<&'a str>,
    /// Temperatures during the program; null without a temperature log.
    pub temperatures: Option<TemperaturesEntry<'a>>,
    /// What became of the stock; null where it was not cut (`--stock`).
    pub stock: Option<StockEntry>,
}

/// The machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MachineEntry<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its kinematic chain from workpiece to tool.
    pub chain: String,
}

/// The motion of one axis.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AxisEntry {
    /// Its unit: `mm` or `deg`.
    pub unit: &'static str,
    /// The lowest position; null if the axis does not move. Unit: that of `unit`.
    pub lowest: Option<f64>,
    /// The highest position; null if the axis does not move. Unit: that of `unit`.
    pub highest: Option<f64>,
    /// The distance that it travels. Unit: that of `unit`.
    pub travelled: Option<f64>,
    /// How often it changes its direction.
    pub reversals: u64,
    /// Its highest speed, in its unit per second.
    pub fastest_per_s: Option<f64>,
    /// The line of the program where that is.
    pub fastest_line: u32,
    /// Its speed limit, in its unit per second; null if the machine file states none.
    pub velocity_limit_per_s: Option<f64>,
}

/// The largest deviations of the actual tool from the nominal one, in the workpiece. Those along feed, normal and
/// binormal have a sign; the others are lengths.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DeviationEntry {
    /// Tool tip with feed, µm.
    pub tip_um: WorstEntry,
    /// Root mean square of the tool tip over all points with feed, µm.
    pub tip_rms_um: f64,
    /// Tool tip along the feed, µm.
    pub feed_um: WorstEntry,
    /// Tool tip along the normal: across the feed, on the side of the tool axis, µm.
    pub normal_um: WorstEntry,
    /// Tool tip along the binormal: across feed and normal, µm.
    pub binormal_um: WorstEntry,
    /// Tool axis with feed, µrad.
    pub axis_urad: WorstEntry,
    /// Tool tip, rapid moves included, µm.
    pub tip_with_rapid_um: WorstEntry,
    /// Tool axis, rapid moves included, µrad.
    pub axis_with_rapid_urad: WorstEntry,
}

/// A largest value and where it occurs.
#[derive(Debug, Serialize, JsonSchema)]
pub struct WorstEntry {
    /// The value. Unit: that of the key.
    pub value: f64,
    /// The line.
    pub line: u32,
    /// The program, an index into `programs`.
    pub program: u32,
    /// The time, s.
    pub time_s: f64,
}

/// A reversal of an axis.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ReversalEntry {
    /// The axis.
    pub axis: String,
    /// Its position. Unit: mm or deg.
    pub at: f64,
    /// The line.
    pub line: u32,
    /// The program, an index into `programs`.
    pub program: u32,
    /// The time, s.
    pub time_s: f64,
}

/// An issue over a stretch of the path.
#[derive(Debug, Serialize, JsonSchema)]
pub struct IssueEntry<'a> {
    /// `collision`, `near-miss`, `rapid-in-stock`, `gouged-part`, `over-travel`, `over-speed`, `slowed-down` or `rotary-flip`.
    pub code: &'static str,
    /// Whether part or machine are in danger; other issues cost time only.
    #[serde(rename = "grave")]
    pub critical: bool,
    /// The issue in one sentence.
    pub text: String,
    /// The line where it begins.
    pub line: u32,
    /// The program, an index into `programs`.
    pub program: u32,
    /// The line where it ends.
    pub last_line: u32,
    /// When it begins, s.
    pub from_s: f64,
    /// When it ends, s.
    pub to_s: f64,
    /// How many points of the path are in it.
    pub nodes: u64,
    /// How many stretches it holds: above 1 where there are so many of its kind that the nearest were put together.
    pub stretches: u64,
    /// Its values.
    #[serde(flatten)]
    pub values: IssueValues<'a>,
}

/// The values of an issue, by its code.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum IssueValues<'a> {
    /// `collision`, `near-miss`, `rapid-in-stock`.
    Bodies {
        /// The two bodies.
        bodies: [&'a str; 2],
        /// Their smallest distance, mm.
        clearance_mm: f64,
    },
    /// `gouged-part`.
    Gouge {
        /// The tool.
        tool: u32,
        /// How deep it cuts into the part, mm.
        depth_mm: f64,
    },
    /// `over-travel`, `over-speed`.
    Limit {
        /// The axis.
        axis: String,
        /// The worst value: a position in mm or degrees, or a speed in mm/s or degrees/s.
        value: f64,
        /// The limit, in the same unit.
        limit: f64,
    },
    /// `slowed-down`.
    Feed {
        /// The axis.
        axis: String,
        /// Lowest ratio of the actual feed to the programmed one.
        feed_ratio: f64,
    },
    /// `rotary-flip`.
    Turn {
        /// The axis.
        axis: String,
        /// By how much it turns, degrees.
        turned_deg: f64,
    },
}

/// A tool.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ToolEntry {
    /// Its number.
    pub tool: u32,
    /// How many moves it makes.
    pub moves: u64,
    /// How long it moves with feed, s.
    pub with_feed_s: f64,
    /// How far its tip moves with feed in the workpiece, mm.
    pub with_feed_mm: f64,
    /// What is known of its wear and its life; null if the set-up states nothing.
    pub state: Option<ToolStateEntry>,
}

fn tool_entries(s: &Simulation<'_>) -> Vec<ToolEntry> {
    let standings = tool_standings(s.setup, s.summary);
    let entry = |(tool, moves): (&u32, &u64)| {
        let used = s.summary.tool_use.get(tool).copied().unwrap_or_default();
        let state = standings.iter().find(|t| t.number == *tool).map(ToolStateEntry::from);
        ToolEntry {
            tool: *tool,
            moves: *moves,
            with_feed_s: used.feed_s,
            with_feed_mm: used.feed_mm,
            state,
        }
    };
    s.summary.tools.iter().map(entry).collect()
}

/// Temperatures during the program, and the drift that they cause.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TemperaturesEntry<'a> {
    /// The file of the log.
    pub log: &'a str,
    /// The time of the log when the program begins, s.
    pub from_s: f64,
    /// The time of the log when the program ends, s.
    pub to_s: f64,
    /// Every sensor by its name.
    pub sensors: Keyed<SensorEntry>,
    /// How far the deviation of the tool tip has moved since the start, with feed: the largest value, µm.
    pub drift_um: WorstEntry,
    /// The same at the end, µm.
    pub drift_at_end_um: f64,
    /// How many points of the path have no known drift, because an error table ends before them.
    pub drift_unknown_places: u64,
}

/// The range of a temperature sensor.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SensorEntry {
    /// The lowest temperature; null without a reading. Unit: °C.
    #[serde(rename = "lowest_degC")]
    pub lowest: Option<f64>,
    /// The highest temperature; null without a reading. Unit: °C.
    #[serde(rename = "highest_degC")]
    pub highest: Option<f64>,
}

impl<'a> SimulationDocument<'a> {
    /// The document of a simulation.
    pub fn of(s: &Simulation<'a>) -> Self {
        let summary = s.summary;
        let axes = summary.axes.iter().enumerate();
        Self {
            schema: "trueaxis/simulate/1",
            version: trueaxis_report::VERSION,
            machine: MachineEntry { name: s.machine.name(), chain: s.machine.chain_text() },
            program: s.program,
            programs: &s.run.programs,
            control: control_name(s.control),
            set_up_given: s.setup.given,
            verdict: verdict(s),
            time_s: summary.time_s,
            rapid_s: summary.rapid_s,
            dwell_s: summary.dwell_s,
            feed_mm: summary.feed_mm,
            rapid_mm: summary.rapid_mm,
            moves: summary.moves,
            nodes: summary.nodes,
            tip_box_mm: summary.cut_box_mm.map(|b| b.map(|v| [v.x, v.y, v.z])),
            axes: axes.map(|(i, axis)| axis_entry(s, i, axis)).collect(),
            deviation: DeviationEntry::of(s),
            reversals: summary.reversals.iter().map(|r| ReversalEntry::of(s, r)).collect(),
            issues: s.issues.list.iter().map(|t| IssueEntry::of(s, t)).collect(),
            issues_found: s.issues.found(),
            motion_left_out: s.run.motion_left_out().count() as u64,
            beyond_equipment: s.run.beyond_equipment().count() as u64,
            messages: &summary.messages,
            stops: summary.stops,
            tools: tool_entries(s),
            path_file: s.path_file,
            temperatures: s.drift.map(TemperaturesEntry::from),
            stock: s.machined.map(StockEntry::from),
        }
    }
}

fn axis_entry(s: &Simulation<'_>, index: usize, axis: &AxisUse) -> (String, AxisEntry) {
    let value = |v: f64| v.is_finite().then(|| shown(s.machine, index, v));
    let of = &s.machine.axes()[index];
    let entry = AxisEntry {
        unit: unit(s.machine, index),
        lowest: value(axis.lowest),
        highest: value(axis.highest),
        travelled: value(axis.travelled),
        reversals: axis.reversals,
        fastest_per_s: value(axis.fastest.value.abs()),
        fastest_line: axis.fastest.origin.line,
        velocity_limit_per_s: of.limits.velocity.and_then(value),
    };
    (of.name.to_string(), entry)
}

impl DeviationEntry {
    fn of(s: &Simulation<'_>) -> Self {
        let summary = s.summary;
        let [feed, normal, binormal] = &summary.along_path;
        Self {
            tip_um: WorstEntry::of(&summary.feed_tip, 1e3),
            tip_rms_um: summary.feed_tip_rms_mm * 1e3,
            feed_um: WorstEntry::of(feed, 1e3),
            normal_um: WorstEntry::of(normal, 1e3),
            binormal_um: WorstEntry::of(binormal, 1e3),
            axis_urad: WorstEntry::of(&summary.feed_axis, 1e6),
            tip_with_rapid_um: WorstEntry::of(&summary.tip, 1e3),
            axis_with_rapid_urad: WorstEntry::of(&summary.axis, 1e6),
        }
    }
}

impl WorstEntry {
    fn of(w: &Worst, scale: f64) -> Self {
        Self {
            value: w.value * scale,
            line: w.origin.line,
            program: w.origin.program,
            time_s: w.time_s,
        }
    }
}

impl ReversalEntry {
    fn of(s: &Simulation<'_>, r: &Reversal) -> Self {
        Self {
            axis: s.machine.axes()[r.axis].name.to_string(),
            at: shown(s.machine, r.axis, r.at),
            line: r.origin.line,
            program: r.origin.program,
            time_s: r.time_s,
        }
    }
}

impl<'a> IssueEntry<'a> {
    fn of(s: &Simulation<'a>, t: &'a Issue) -> Self {
        Self {
            code: issue_code(&t.kind),
            critical: t.critical,
            text: issue_text(s.machine, t),
            line: t.first.line,
            program: t.first.program,
            last_line: t.last.line,
            from_s: t.from_s,
            to_s: t.to_s,
            nodes: t.nodes,
            stretches: t.stretches,
            values: IssueValues::of(s, t),
        }
    }
}

impl<'a> IssueValues<'a> {
    fn of(s: &Simulation<'a>, t: &'a Issue) -> Self {
        let name = |axis: usize| s.machine.axes()[axis].name.to_string();
        match &t.kind {
            IssueKind::Collision { first, second }
            | IssueKind::NearMiss { first, second }
            | IssueKind::RapidInStock { first, second } => {
                Self::Bodies { bodies: [first, second], clearance_mm: t.value }
            }
            IssueKind::Gouge { tool } => Self::Gouge { tool: *tool, depth_mm: t.value },
            IssueKind::OverTravel { axis } | IssueKind::OverSpeed { axis, .. } => Self::Limit {
                axis: name(*axis),
                value: shown(s.machine, *axis, t.value),
                limit: shown(s.machine, *axis, t.limit),
            },
            IssueKind::SlowedDown { axis, .. } => {
                Self::Feed { axis: name(*axis), feed_ratio: t.value }
            }
            IssueKind::RotaryFlip { axis } => {
                Self::Turn { axis: name(*axis), turned_deg: t.value.to_degrees() }
            }
        }
    }
}

impl<'a> From<&'a Drift> for TemperaturesEntry<'a> {
    fn from(drift: &'a Drift) -> Self {
        let run = drift.run();
        let sensors = drift.sensors().into_iter().map(|s| {
            let finite = |v: f64| v.is_finite().then_some(v);
            let (lowest, highest) = (finite(s.lowest_celsius), finite(s.highest_celsius));
            (s.sensor, SensorEntry { lowest, highest })
        });
        Self {
            log: run.log.file(),
            from_s: run.start_s,
            to_s: run.start_s + drift.time_s(),
            sensors: sensors.collect(),
            drift_um: WorstEntry::of(&drift.tip, 1e3),
            drift_at_end_um: drift.last_mm * 1e3,
            drift_unknown_places: drift.unknown,
        }
    }
}
