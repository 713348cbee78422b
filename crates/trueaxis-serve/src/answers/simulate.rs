//! A program on the machine, kept so that the page can go back and forth in it.

use super::describe::{surfaces, twelve};
use super::report::undrawn;
use crate::body::{Body, short};
use crate::desk::{Desk, Job, Reply};
use crate::frame::{Array, Frame};
use crate::refusal::{Refusal, diagnostics_json};
use serde_json::{Map, Value, json};
use std::path::Path;
use std::sync::Arc;
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Place};
use trueaxis::machine::Machine;
use trueaxis::report::{
    Simulation, array, simulation_html, simulation_json, trouble_code, trouble_text,
};
use trueaxis::simulate::{
    self, CONTROLS, Colour, Findings, Moment, Observer, Options, ProgramFiles, Progress, Recorder,
    Recording, Series, SetUp, Stop, TroubleList, control_named, shown,
};

/// Columns of a picture of curves.
const MOST_COLUMNS: usize = 1 << 14;
/// Points of a picture of a path.
const MOST_POINTS: usize = 1 << 19;
/// Recording what comes behind the program takes this part of the time.
const REST: f64 = 0.05;

/// One simulation.
pub(crate) struct Simulated {
    machine: Machine,
    recording: Recording,
    programs: Vec<Source>,
}

/// A program as it was simulated.
struct Source {
    name: String,
    /// Its name in the project, if it is a file there.
    path: Option<String>,
    text: String,
}

/// Simulates as `trueaxis simulate --no-report` does, and keeps all of it.
pub(super) fn simulate(desk: &Desk, body: &Value, job: &Job) -> Result<Reply, Refusal> {
    let known =
        ["machine", "program", "setup", "control", "name", "text", "keep_going", "collisions"];
    let body = Body::of(body, &known)?;
    let mut problems = Diagnostics::new();
    let simulation = read(desk, &body, job, &mut problems)?;
    let collisions = match body.flag("collisions", true)? {
        true => simulation.collisions(),
        false => None,
    };
    for (first, second) in collisions.iter().flat_map(|c| c.left_out()) {
        let message = format!("{first} and {second} overlap with all axes at 0: not watched");
        let place = Place::whole(body.text("machine")?);
        problems.note("not-watched", place, message, "move one of them, or leave it as it is");
    }
    let mut progress = Progress::through(&simulation.program, |part| job.tell(part * (1.0 - REST)));
    let mut recorder = Recorder::of(&simulation.machine, &simulation.setup, &simulation.options);
    let mut observers: [&mut dyn Observer; 2] = [&mut progress, &mut recorder];
    let found = simulation.run(collisions, &mut observers);
    if found.run.stopped {
        return Err(Refusal::new(409, "stopped", "the simulation was stopped", "simulate again"));
    }
    problems.append(found.run.problems.clone());
    if problems.has_errors() && !simulation.options.keep_going {
        return Err(Refusal::unusable(&problems));
    }
    let dropped = body.optional_text("text")?.is_some();
    let programs = sources(desk, &simulation, &found, dropped);
    let simulated =
        Simulated { machine: simulation.machine.clone(), recording: recorder.finish(), programs };
    job.tell(1.0);
    let document = simulation_json(&Simulation::of(&simulation, &found));
    let (bodies, corners) = surfaces(&simulation.setup.bodies);
    let frame = header(&simulated, &found.troubles)
        .say("document", document)
        .say("tools", tools(&simulation.setup))
        .say("on_workpiece", bodies)
        .with("corners_mm", corners)
        .say("diagnostics", diagnostics_json(&problems).into());
    let number = desk.simulations.put(simulated);
    Ok(Reply::Frame(frame.say("simulation", json!(number))))
}

/// The report of a simulation, as `trueaxis simulate --report` writes it.
pub(super) fn page(desk: &Desk, body: &Value, job: &Job) -> Result<String, Refusal> {
    let body = Body::of(body, &["machine", "program"])?;
    let mut problems = Diagnostics::new();
    let simulation = read(desk, &body, job, &mut problems)?;
    let mut progress = Progress::through(&simulation.program, |part| job.tell(part));
    let mut series = Series::of(&simulation.machine);
    let mut observers: [&mut dyn Observer; 2] = [&mut progress, &mut series];
    let found = simulation.run(simulation.collisions(), &mut observers);
    problems.append(found.run.problems.clone());
    if problems.has_errors() {
        return Err(Refusal::unusable(&problems));
    }
    simulation_html(&Simulation::of(&simulation, &found), &series).map_err(undrawn)
}

/// Everything that the request names.
fn read(
    desk: &Desk,
    body: &Body<'_>,
    job: &Job,
    problems: &mut Diagnostics,
) -> Result<simulate::Job, Refusal> {
    let machine_path = desk.project.path(body.text("machine")?)?;
    let text = body.optional_text("text")?;
    let name = body.text(if text.is_some() { "name" } else { "program" })?;
    let program = desk.project.path(name)?;
    let setup = body.optional_text("setup")?.map(|name| desk.project.path(name)).transpose()?;
    let control = body.optional_text("control")?.map(|name| {
        let message = || format!("`{}` is no control that is known", short(name));
        control_named(name).ok_or_else(|| Refusal::new(422, "unknown-control", message(), CONTROLS))
    });
    let files = ProgramFiles {
        files: &disk(),
        program: &program,
        text: text.map(str::as_bytes),
        setup: setup.as_deref(),
        control: control.transpose()?,
    };
    let options = Options {
        keep_going: body.flag("keep_going", false)?,
        stop: Stop::from(job.stop.clone()),
        ..Options::default()
    };
    let collisions = body.flag("collisions", true)?;
    let (machine, found) = files::machine(&machine_path);
    problems.append(found);
    let read = machine.and_then(|machine| simulate::Job::read(machine, &files, options, problems));
    let read = read.map(|job| match collisions {
        true => job.with_models(&machine_path, problems),
        false => job,
    });
    read.filter(|_| !problems.has_errors()).ok_or_else(|| Refusal::unusable(problems))
}

/// The texts of all programs that ran.
fn sources(
    desk: &Desk,
    simulation: &simulate::Job,
    found: &Findings,
    dropped: bool,
) -> Vec<Source> {
    let source = |(i, name): (usize, &String)| {
        let is_main = i == 0;
        let content = match is_main {
            true => simulation.program.source().to_vec(),
            // What could be run was there; if it is gone by now, its text is, too.
            false => files::read_bytes(Path::new(name)).unwrap_or_default(),
        };
        let path = if is_main && dropped { None } else { desk.project.name_of(Path::new(name)) };
        Source { name: name.clone(), path, text: String::from_utf8_lossy(&content).into_owned() }
    };
    found.run.programs.iter().enumerate().map(source).collect()
}

/// What the tools of the set-up look like: tip in the frame of the holder, then diameter and length of
/// each cylinder from the tip upwards.
fn tools(setup: &SetUp) -> Value {
    let tools = setup.tools.iter().map(|(number, tool)| {
        let shape = tool.tool_shape().into_iter().flat_map(|shape| shape.segments);
        let segments: Vec<_> = shape.map(|s| [s.diameter_mm, s.length_mm]).collect();
        json!({
            "tool": number,
            "name": tool.name,
            "tip_mm": array(tool.tip_mm),
            "segments_mm": segments,
        })
    });
    tools.collect()
}

fn header(simulated: &Simulated, troubles: &TroubleList) -> Frame {
    let recording = &simulated.recording;
    let axes = recording.axes().into_iter().map(|axis| {
        json!({
            "name": axis.name,
            "unit": axis.unit,
            "travel": axis.travel,
            "velocity": axis.velocity,
            "acceleration": axis.acceleration,
        })
    });
    let quantities = recording
        .quantities()
        .into_iter()
        .map(|q| json!({ "key": q.key, "title": q.title, "unit": q.unit, "limits": q.limits }));
    let programs = simulated
        .programs
        .iter()
        .map(|p| json!({ "name": p.name, "path": p.path, "lines": p.text.lines().count() }));
    let marks = troubles.list.iter().map(|t| {
        json!({
            "kind": trouble_code(&t.kind),
            "grave": t.grave,
            "time_s": t.from_s,
            "until_s": Some(t.to_s).filter(|to_s| *to_s > t.from_s),
            "text": trouble_text(&simulated.machine, t),
            "program": t.first.program,
            "line": t.first.line,
        })
    });
    let bodies = simulated.machine.bodies().iter().map(|b| b.name.to_string());
    Frame::new()
        .say("duration_s", json!(recording.end_s()))
        .say("nodes", json!(recording.nodes()))
        .say("kept", json!(recording.kept()))
        .say("thinned", json!(recording.is_thinned()))
        .say("axes", axes.collect())
        .say("quantities", quantities.collect())
        .say("programs", programs.collect())
        .say("marks", marks.collect())
        .say("bodies", bodies.collect())
}

/// Everything at one time.
pub(super) fn at(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["simulation", "time_s"])?;
    let simulated = kept(desk, &body)?;
    let moment = simulated.recording.at(body.number("time_s")?);
    let moment = moment.ok_or_else(|| {
        Refusal::new(422, "nothing-simulated", "the simulation has no place", "simulate again")
    })?;
    let bodies = simulated.recording.bodies(&moment);
    let all = |which: usize| bodies.iter().flat_map(|poses| twelve(&poses[which])).collect();
    let frame = Frame::new()
        .say("moment", moment_json(&simulated.machine, &moment))
        .with("nominal", Array::F64(all(0)))
        .with("actual", Array::F64(all(1)));
    Ok(Reply::Frame(frame))
}

fn moment_json(machine: &Machine, moment: &Moment) -> Value {
    let of_axes = |value: &dyn Fn(usize) -> f64| {
        let axes = machine.axes().iter().enumerate();
        axes.map(|(i, a)| (a.name.to_string(), json!(value(i)))).collect::<Map<String, Value>>()
    };
    json!({
        "time_s": moment.time_s,
        "program": moment.program,
        "line": moment.line,
        "axes": of_axes(&|i| shown(machine, i, moment.command[i])),
        "approach": of_axes(&|i| moment.approach[i]),
        "tip_mm": array(moment.tip_mm),
        "off_tip_um": array(moment.off_tip_um),
        "off_axis_urad": array(moment.off_axis_urad),
        "along_path_um": array(moment.along_path_um),
        "speed_mm_per_min": moment.speed * 60.0,
        "rapid": moment.rapid,
        "waits": moment.waits,
        "tool": Some(moment.tool).filter(|tool| *tool != 0),
    })
}

/// When a block ends: the one after or before a time, or that of a line.
pub(super) fn block(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["simulation", "from_s", "step", "program", "line"])?;
    let simulated = kept(desk, &body)?;
    let recording = &simulated.recording;
    let time_s = match body.optional_text("step")? {
        Some("next") => recording.next_block(body.number("from_s")?),
        Some("previous") => recording.previous_block(body.number("from_s")?),
        Some(other) => {
            let message = format!("`{}` is no step", short(other));
            return Err(Refusal::bad(message, "next or previous"));
        }
        None => {
            let (program, line) = (body.count("program")?, body.count("line")?);
            let [program, line] = [program, line].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
            recording.block_of_line(program, line).ok_or_else(|| {
                let message = format!("nothing moves in or behind line {line}");
                Refusal::new(404, "no-block", message, "choose a line before it")
            })?
        }
    };
    Ok(Reply::Json(json!({ "time_s": time_s })))
}

/// The path of the tip.
pub(super) fn path(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["simulation", "from_s", "to_s", "points", "colour"])?;
    let simulated = kept(desk, &body)?;
    let recording = &simulated.recording;
    let colour = match body.text("colour")? {
        "deviation" => Colour::Deviation,
        "feed" => Colour::Feed,
        "load" => Colour::Load,
        other => {
            let message = format!("`{}` is no colour of a path", short(other));
            return Err(Refusal::bad(message, "deviation, feed or load"));
        }
    };
    let from_s = body.optional_number("from_s")?.unwrap_or(0.0);
    let to_s = body.optional_number("to_s")?.unwrap_or(recording.end_s());
    let most = body.count("points")?.min(MOST_POINTS);
    let points = recording.path(from_s, to_s, most, colour);
    let (title, unit) = colour.title();
    let flat = |all: &[[f32; 3]]| Array::F32(all.concat());
    let frame = Frame::new()
        .say("origin_mm", json!(points.origin_mm))
        .say("unit", json!(unit))
        .say("title", json!(title))
        .say("low", json!(points.range[0]))
        .say("high", json!(points.range[1]))
        .say("chord_mm", json!(points.chord_mm))
        .say("complete", json!(points.is_complete))
        .with("tip_mm", flat(&points.tip_mm))
        .with("off_um", flat(&points.off_um))
        .with("value", Array::F32(points.value))
        .with("rapid", Array::U8(points.rapid.into_iter().map(u8::from).collect()))
        .with("time_s", Array::F64(points.time_s))
        .with("program", Array::U32(points.program))
        .with("line", Array::U32(points.line));
    Ok(Reply::Frame(frame))
}

/// Curves over a stretch of time.
pub(super) fn curves(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let known = ["simulation", "from_s", "to_s", "columns", "quantities"];
    let body = Body::of(body, &known)?;
    let simulated = kept(desk, &body)?;
    let ranges = simulated.recording.quantities();
    let keys = body.texts("quantities")?;
    let of_key = |key: &&str| {
        let range = ranges.iter().find(|range| range.key == *key);
        let known: Vec<&str> = ranges.iter().map(|range| range.key.as_str()).collect();
        let message = || format!("`{}` is no quantity", short(key));
        range.map(|r| r.quantity).ok_or_else(|| Refusal::bad(message(), &known.join(", ")))
    };
    let quantities = keys.iter().map(of_key).collect::<Result<Vec<_>, _>>()?;
    let (from_s, to_s) = (body.number("from_s")?, body.number("to_s")?);
    let columns = body.count("columns")?;
    let sound =
        from_s < to_s && (1..=MOST_COLUMNS).contains(&columns) && keys.len() <= ranges.len();
    if !sound {
        let hint = format!(
            "from_s before to_s, 1 to {MOST_COLUMNS} columns, {} quantities at most",
            ranges.len()
        );
        return Err(Refusal::bad("these curves cannot be drawn", &hint));
    }
    let curves = simulated.recording.curves(from_s, to_s, columns, &quantities);
    let frame = Frame::new()
        .say("from_s", json!(from_s))
        .say("to_s", json!(to_s))
        .say("columns", json!(columns))
        .say("quantities", json!(keys))
        .with("low", Array::F32(curves.low))
        .with("high", Array::F32(curves.high));
    Ok(Reply::Frame(frame))
}

/// The text of a program as it was simulated.
pub(super) fn source(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let body = Body::of(body, &["simulation", "program"])?;
    let simulated = kept(desk, &body)?;
    let number = body.count("program")?;
    let source = simulated.programs.get(number).ok_or_else(|| {
        let message = format!("the simulation has no program {number}");
        let hint = format!("0 to {}", simulated.programs.len().saturating_sub(1));
        Refusal::new(404, "no-program", message, &hint)
    })?;
    Ok(Reply::Json(json!({ "name": source.name, "text": source.text })))
}

fn kept(desk: &Desk, body: &Body<'_>) -> Result<Arc<Simulated>, Refusal> {
    let number = body.count("simulation")?;
    desk.simulations.of_number(number as u64).ok_or_else(|| {
        let message = format!("simulation {number} is gone: only the last few are kept");
        Refusal::new(404, "gone", message, "simulate again")
    })
}
