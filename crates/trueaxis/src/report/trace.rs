//! Every stage of the simulation for one block.

use super::pose::{Bodies, Budget, array, bodies, bodies_section, budget, budget_section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::AxisKind;
use trueaxis_machine::describe::to_shown;
use trueaxis_motion::{Job, Trace, TracedNode};
use trueaxis_nc::moves::{
    Axis, CompensationSide, Coolant, Event, FeedMode, Frame, Move, MoveKind, OrientationPath,
    PathControl, Plane, SpindleDirection, Step,
};
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Report, Section, Table};

/// A block with what the simulation makes of it.
pub struct TraceReport<'a> {
    /// The program with its machine and its set-up.
    pub job: &'a Job,
    /// The block that was asked for.
    pub block: usize,
    /// What it does.
    pub found: &'a Trace,
    /// The errors and the bodies at its end, if it moves anything.
    pub at_end: Option<(Budget, Bodies)>,
}

impl<'a> TraceReport<'a> {
    /// The report of a traced block.
    pub fn of(job: &'a Job, block: usize, found: &'a Trace) -> Self {
        let last = found.machine.as_ref().zip(found.nodes.last());
        let at_end = last.and_then(|(machine, node)| {
            let command = &node.node.command;
            let errors = machine.errors_at(command, &node.approach).ok()?;
            Some((budget(machine, command, &errors), bodies(machine, command, &errors)))
        });
        Self { job, block, found, at_end }
    }
}

/// The kind of a move in one word.
pub(super) fn kind(kind: &MoveKind) -> &'static str {
    match kind {
        MoveKind::Rapid => "rapid",
        MoveKind::Linear => "line",
        MoveKind::Arc(_) | MoveKind::SpatialArc(_) => "circle",
        MoveKind::Align { .. } => "align",
        MoveKind::Thread { .. } => "thread",
        MoveKind::RigidTap { .. } => "rigid tap",
        MoveKind::Probe => "probe",
        MoveKind::Dwell { .. } => "dwell",
    }
}

/// Its feed with the unit.
pub(super) fn feed(m: &Move) -> String {
    let unit = match m.feed.mode {
        FeedMode::PerMinute => "mm/min",
        FeedMode::InverseTime => "1/min",
        FeedMode::PerRevolution => "mm/rev",
    };
    match m.kind {
        MoveKind::Rapid | MoveKind::Align { .. } => "rapid".into(),
        MoveKind::Dwell { seconds } => format!("{seconds} s"),
        _ => format!("{} {unit}", m.feed.value),
    }
}

/// The axes that it names.
pub(super) fn named_axes(m: &Move) -> impl Iterator<Item = Axis> {
    Axis::ALL.into_iter().filter(|a| m.named.contains(*a))
}

/// How the tool axis is interpolated.
pub(super) fn orientation(path: &OrientationPath) -> &'static str {
    match path {
        OrientationPath::Axes => "axes",
        OrientationPath::GreatCircle => "great circle",
        OrientationPath::Cone(_) => "cone",
    }
}

/// What a block does besides its moves.
pub(super) fn event_texts(found: &Trace) -> Vec<String> {
    let events = found.steps.iter().filter_map(|step| match step {
        Step::Event(event, _) => Some(event_text(event)),
        Step::Move(_) => None,
    });
    events.collect()
}

fn event_text(event: &Event) -> String {
    match event {
        Event::Note(text) => (*text).to_owned(),
        Event::Message(text) => format!("message: {text}"),
        Event::ToolCentre(on) => format!("tool-centre point {}", on_off(*on)),
        Event::TiltedPlane(on) => format!("tilted plane {}", on_off(*on)),
        Event::DynamicOffset(origin) => {
            format!("work offset that goes round with the table {}", on_off(origin.is_some()))
        }
        Event::ToolChange(tool) => format!("tool {tool} into the spindle"),
        Event::ToolSelect(tool) => format!("tool {tool} is prepared"),
        Event::SpindleSpeed(speed) => format!("S {speed} 1/min"),
        Event::SpindleOrient { angle_deg } => format!("spindle oriented to {angle_deg} deg"),
        Event::WorkOffset { index, .. } => format!("work offset {index}"),
        Event::ToolName(name) => format!("tool: {name}"),
        Event::Orientation(path) => format!("tool axis led by {}", orientation(path)),
        Event::Compensation { side, radius_mm } => compensation(*side, *radius_mm),
        Event::Path { control: PathControl::Continuous, tolerance_mm } => {
            format!("corners rounded within {tolerance_mm} mm")
        }
        Event::Log(text) => format!("log: {text}"),
        other => state_text(other).to_owned(),
    }
}

fn compensation(side: CompensationSide, radius_mm: f64) -> String {
    match side {
        CompensationSide::Off => "radius compensation off".to_owned(),
        CompensationSide::Left => format!("radius compensation left, {radius_mm} mm"),
        CompensationSide::Right => format!("radius compensation right, {radius_mm} mm"),
    }
}

/// What has no value of its own.
fn state_text(event: &Event) -> &'static str {
    match event {
        Event::Spindle(SpindleDirection::Stopped) => "spindle stopped",
        Event::Spindle(SpindleDirection::Clockwise) => "spindle clockwise",
        Event::Spindle(SpindleDirection::CounterClockwise) => "spindle counter-clockwise",
        Event::Coolant(Coolant::Mist) => "coolant as mist",
        Event::Coolant(Coolant::Flood) => "coolant on",
        Event::Coolant(Coolant::Off) => "coolant off",
        Event::Path { control: PathControl::ExactStop, .. } => "stop at each corner",
        Event::Path { .. } => "corners as programmed",
        Event::Plane(Plane::Xy) => "plane XY",
        Event::Plane(Plane::Zx) => "plane ZX",
        Event::Plane(Plane::Yz) => "plane YZ",
        Event::Shift(_) => "shift of the axes",
        Event::ToolLength(_) => "tool length",
        Event::Frame(_) => "frame",
        Event::Stock { .. } => "stock stated",
        Event::Stop { optional: true } => "optional stop",
        Event::Stop { optional: false } => "stop",
        Event::End => "end of the program",
        _ => "block",
    }
}

fn on_off(on: bool) -> &'static str {
    if on { "on" } else { "off" }
}

/// A traced block as text and page.
pub fn trace_report(report: &TraceReport<'_>) -> Report<'static> {
    let TraceReport { job, found, at_end, .. } = report;
    let machine = &job.machine;
    let answer = Report::new(format!("{}:{}   {}", job.program.file(), found.line, found.text))
        .line(format!("on {}   {}", machine.name(), machine.chain_text()))
        .section(programmed(found));
    let Some(last) = found.nodes.last() else {
        return answer.section(Section::new("").paragraph("nothing moves in this block"));
    };
    let answer = answer.sections(moved(machine, found, last)).section(tool(last));
    match at_end {
        Some((budget, bodies)) => {
            answer.section(bodies_section(bodies)).section(budget_section(budget))
        }
        None => answer,
    }
}

fn programmed(found: &Trace) -> Section<'static> {
    let moves = found.moves().map(|m| {
        let words: Vec<String> = named_axes(m).map(|a| format!("{a} {}", m.target[a])).collect();
        let axis = m.direction.map(|d| format!("{} {} {}", d[0], d[1], d[2]));
        [kind(&m.kind).to_owned(), words.join("  "), axis.unwrap_or_default(), feed(m)]
    });
    let shift = &found.frame.shift.0;
    let is_turned = found.frame.linear != Frame::IDENTITY.linear;
    let frame = format!(
        "frame shift {} {} {} mm{}; tool-centre point {}; tilted plane {}; tool {}",
        shift[0],
        shift[1],
        shift[2],
        if is_turned { ", rotated" } else { "" },
        on_off(found.tool_centre),
        on_off(found.tilted),
        found.tool
    );
    Section::new("1 Programmed")
        .table(Table::new(["move", "target", "tool axis", "feed"]).rows(moves))
        .list(event_texts(found))
        .paragraph(frame)
}

fn moved(machine: &Machine, found: &Trace, last: &TracedNode) -> [Section<'static>; 3] {
    let length: f64 = found.nodes.iter().map(|n| n.node.length).sum();
    let pieces = format!(
        "{} pieces, {length:.4} mm (or deg); tool axis interpolated by {}",
        found.nodes.len(),
        orientation(&found.orientation)
    );
    let axes = machine.axes().iter().enumerate().map(|(i, axis)| {
        let unit = if axis.kind == AxisKind::Linear { "mm" } else { "deg" };
        let position = fixed(to_shown(machine, i, last.node.command[i]), 6);
        [axis.name.to_string(), position, unit.to_owned()]
    });
    let time = format!(
        "{:.6} s to {:.6} s ({:.6} s), {:.3} mm/min at the end",
        found.from_s,
        last.stamp.time_s,
        last.stamp.time_s - found.from_s,
        last.stamp.speed * 60.0
    );
    [
        Section::new("2 Path").paragraph(pieces),
        Section::new("3 Axes at the end").table(Table::new(["", "position", "unit"]).rows(axes)),
        Section::new("4 Time").paragraph(time),
    ]
}

fn tool(last: &TracedNode) -> Section<'static> {
    let d = &last.deviation;
    let (tip, axis) = (d.nominal_tip.vector(), d.nominal_axis.vector());
    let mut table = Table::new(["", "tip x", "y", "z", "axis i", "j", "k"]);
    let mut row = |name: &str, tip, axis, digits: [usize; 2]| {
        let numbers = |v, digits| array(v).map(|x| fixed(x, digits));
        let cells = numbers(tip, digits[0]).into_iter().chain(numbers(axis, digits[1]));
        table.push(std::iter::once(name.to_owned()).chain(cells));
    };
    row("nominal, mm", tip, axis, [6, 9]);
    row("actual, mm", tip + d.tip_mm, axis + d.axis, [6, 9]);
    row("deviation, µm and µrad", d.tip_mm * 1e3, d.axis * 1e6, [3, 3]);
    let along = array(last.along_path_mm * 1e3).map(|x| fixed(x, 3)).into_iter();
    let name = "tip along feed, normal, binormal, µm".to_owned();
    table.push(std::iter::once(name).chain(along));
    Section::new("5 Tool in the workpiece frame").table(table)
}
