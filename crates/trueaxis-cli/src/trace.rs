//! Every stage of the walk for one block.

use crate::arguments::{MachineArguments, argument, to_shown};
use crate::output::{Answer, Format, Outcome, finish};
use crate::simulate::ProgramArguments;
use clap::Args;
use serde_json::{Map, Value, json};
use std::fmt::Write;
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command};
use trueaxis::nc::moves::{Axis, Event, FeedMode, Move, MoveKind, OrientationPath, Position, Step};
use trueaxis::report::numbers::fixed;
use trueaxis::report::{self, Bodies, Budget};
use trueaxis::simulate::{Job, Trace, TracedNode, block_line, trace};

/// The block to trace.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis trace machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf --block 120
  trueaxis trace MACHINE.toml PART.ngc --block 42 --format json

--block takes the number behind N; where no block has it, the line. Exit status: 0 done, 2 unusable
input.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    program: ProgramArguments,
    /// The block: its number N, else its line
    #[arg(long, value_name = "N")]
    block: usize,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let mut problems = Diagnostics::new();
    let answer = answer(arguments, &mut problems);
    finish(problems, answer)
}

fn answer(arguments: &Arguments, problems: &mut Diagnostics) -> Option<Answer> {
    let machine = arguments.machine.read_from(&arguments.program.log, problems)?;
    let job = arguments.program.read(machine, false, problems)?;
    let Some(line) = block_line(&job.program, arguments.block) else {
        let message = format!("the program has no block {}", arguments.block);
        let hint = "give the number behind N, or a line of the program";
        problems.error("no-such-block", argument("--block"), message, hint);
        return None;
    };
    let (found, run) = trace(&job.machine, &job.program, &job.setup, &job.options, line);
    problems.append(run.problems);
    if found.executions == 0 && !problems.has_errors() {
        let message = format!("line {line} is never executed, or does nothing: {}", found.text);
        problems.warn("nothing-to-trace", argument("--block"), message, "choose another block");
    }
    let last = found.machine.as_ref().zip(found.nodes.last());
    let budget = last.and_then(|(machine, node)| budget(machine, node));
    Some(match arguments.format {
        Format::Json => Answer::Json(document(&job, arguments.block, &found, budget)),
        Format::Text => Answer::Text(text(&job, &found, budget)),
    })
}

fn budget(machine: &Machine, node: &TracedNode) -> Option<(Budget, Bodies)> {
    let errors = machine.errors_at(&node.node.command, &node.approach).ok()?;
    let budget = report::budget(machine, &node.node.command, &errors);
    Some((budget, report::bodies(machine, &node.node.command, &errors)))
}

fn axes(machine: &Machine, command: &Command) -> Value {
    let axes = machine.axes().iter().enumerate();
    let map: Map<String, Value> =
        axes.map(|(i, a)| (a.name.to_string(), to_shown(machine, i, command[i]).into())).collect();
    Value::Object(map)
}

fn named(position: &Position, m: &Move) -> Value {
    let named = Axis::ALL.into_iter().filter(|a| m.named.contains(*a));
    let map: Map<String, Value> = named.map(|a| (a.to_string(), position[a].into())).collect();
    Value::Object(map)
}

fn kind(kind: &MoveKind) -> &'static str {
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

fn feed(m: &Move) -> String {
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

fn orientation(path: &OrientationPath) -> &'static str {
    match path {
        OrientationPath::Axes => "axes",
        OrientationPath::GreatCircle => "great circle",
        OrientationPath::Cone(_) => "cone",
    }
}

fn document(job: &Job, block: usize, found: &Trace, budget: Option<(Budget, Bodies)>) -> Value {
    let machine = &job.machine;
    let moves: Vec<Value> = found
        .moves()
        .map(|m| {
            json!({ "kind": kind(&m.kind), "target": named(&m.target, m),
                    "direction": m.direction, "feed": feed(m) })
        })
        .collect();
    let nodes: Vec<Value> = found.nodes.iter().map(|n| node(machine, n)).collect();
    let mut document = json!({
        "schema": "trueaxis/trace/1",
        "machine": { "name": machine.name(), "chain": machine.chain_text() },
        "program": job.program.file(),
        "block": block,
        "line": found.line,
        "text": found.text,
        "executions": found.executions,
        "programmed": {
            "moves": moves,
            "events": events(found),
            "frame": { "linear": found.frame.linear, "shift": found.frame.shift.0 },
            "tool_centre": found.tool_centre,
            "tilted_plane": found.tilted,
            "orientation": orientation(&found.orientation),
            "tool": found.tool,
            "tool_length_mm": found.tool_length.0[..3],
        },
        "nodes": nodes,
    });
    if let Some(last) = found.nodes.last() {
        let end = node(machine, last);
        for key in ["axes", "nominal", "actual", "deviation"] {
            document[key] = end[key].clone();
        }
        document["time"] = json!({
            "from_s": found.from_s,
            "to_s": last.stamp.time_s,
            "speed_mm_per_min": last.stamp.speed * 60.0,
        });
    }
    if let Some((budget, bodies)) = budget {
        document["budget"] = report::budget_json(&budget);
        document["bodies"] = report::bodies_json(&bodies);
    }
    document
}

fn node(machine: &Machine, n: &TracedNode) -> Value {
    let mut value = report::deviation_json(&n.deviation);
    let along = n.along_path_mm * 1e3;
    value["deviation"]["feed_um"] = along.x.into();
    value["deviation"]["normal_um"] = along.y.into();
    value["deviation"]["binormal_um"] = along.z.into();
    value["axes"] = axes(machine, &n.node.command);
    value["time_s"] = n.stamp.time_s.into();
    value
}

fn events(found: &Trace) -> Vec<String> {
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
        Event::ToolChange(tool) => format!("tool {tool} into the spindle"),
        Event::ToolSelect(tool) => format!("tool {tool} is prepared"),
        Event::SpindleSpeed(speed) => format!("S {speed} 1/min"),
        other => format!("{other:?}"),
    }
}

fn on_off(on: bool) -> &'static str {
    if on { "on" } else { "off" }
}

fn text(job: &Job, found: &Trace, budget: Option<(Budget, Bodies)>) -> String {
    let mut out = String::new();
    // Writing into a text cannot fail.
    let _ = write_text(job, found, budget, &mut out);
    out
}

fn write_text(
    job: &Job,
    found: &Trace,
    budget: Option<(Budget, Bodies)>,
    out: &mut String,
) -> std::fmt::Result {
    let machine = &job.machine;
    writeln!(out, "{}:{}   {}", job.program.file(), found.line, found.text)?;
    writeln!(out, "on {}   {}\n", machine.name(), machine.chain_text())?;
    writeln!(out, "1 programmed")?;
    for m in found.moves() {
        let words: Vec<String> = Axis::ALL
            .into_iter()
            .filter(|a| m.named.contains(*a))
            .map(|a| format!("{a} {}", m.target[a]))
            .collect();
        let direction = m.direction.map(|d| format!("   tool axis {} {} {}", d[0], d[1], d[2]));
        let (kind, feed, words) = (kind(&m.kind), feed(m), words.join("  "));
        writeln!(out, "  {kind:<9} {words}{}   {feed}", direction.unwrap_or_default())?;
    }
    for event in events(found) {
        writeln!(out, "  {event}")?;
    }
    let shift = &found.frame.shift.0;
    writeln!(
        out,
        "  frame     shift {} {} {} mm{}   tool-centre point {}   tilted plane {}   tool {}",
        shift[0],
        shift[1],
        shift[2],
        if found.frame.linear == trueaxis::nc::moves::Frame::IDENTITY.linear {
            ""
        } else {
            ", turned"
        },
        on_off(found.tool_centre),
        on_off(found.tilted),
        found.tool
    )?;
    let Some(last) = found.nodes.last() else {
        return writeln!(out, "\n  nothing moves in this block");
    };
    write_path(machine, found, last, out)?;
    write_pose(last, out)?;
    let Some((budget, bodies)) = budget else { return Ok(()) };
    writeln!(out, "{}{}", report::bodies_table(&bodies), report::budget_table(&budget))
}

fn write_path(
    machine: &Machine,
    found: &Trace,
    last: &TracedNode,
    out: &mut String,
) -> std::fmt::Result {
    let length: f64 = found.nodes.iter().map(|n| n.node.length).sum();
    let how = orientation(&found.orientation);
    writeln!(out, "\n2 path       {} pieces, {length:.4} mm (or deg)", found.nodes.len())?;
    writeln!(out, "             tool axis by {how}")?;
    let words: Vec<String> = machine
        .axes()
        .iter()
        .enumerate()
        .map(|(i, axis)| {
            let unit = if axis.kind == AxisKind::Linear { "mm" } else { "deg" };
            format!("{} {} {unit}", axis.name, fixed(to_shown(machine, i, last.node.command[i]), 6))
        })
        .collect();
    writeln!(out, "3 axes       {}", words.join("   "))?;
    let took = last.stamp.time_s - found.from_s;
    writeln!(
        out,
        "4 time       {:.6} s to {:.6} s ({took:.6} s), {:.3} mm/min at the end",
        found.from_s,
        last.stamp.time_s,
        last.stamp.speed * 60.0
    )
}

fn write_pose(last: &TracedNode, out: &mut String) -> std::fmt::Result {
    let d = &last.deviation;
    let row = |v: &trueaxis::geometry::Vec3, digits: usize| {
        v.iter().map(|x| format!("{:>14}", fixed(*x, digits))).collect::<String>()
    };
    let (tip, axis) = (d.nominal_tip.vector(), d.nominal_axis.vector());
    writeln!(out, "5 tool in the workpiece")?;
    writeln!(out, "  nominal tip, mm        {}   axis {}", row(&tip, 6), row(&axis, 9))?;
    writeln!(
        out,
        "  actual tip, mm         {}   axis {}",
        row(&(tip + d.tip_mm), 6),
        row(&(axis + d.axis), 9)
    )?;
    writeln!(
        out,
        "  deviation, µm          {}   µrad {}",
        row(&(d.tip_mm * 1e3), 3),
        row(&(d.axis * 1e6), 3)
    )?;
    let along = row(&(last.along_path_mm * 1e3), 3);
    writeln!(out, "  along feed, normal, binormal, µm {along}")
}
