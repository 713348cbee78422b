//! A program on the machine, kept so that the page can move through it in time.

use super::describe::{SurfaceEntry, corners, twelve};
use super::simulate_document::{
    BlockStep, MarkEntry, MomentEntry, PathColour, ProgramEntry, SetUpToolEntry, SimulateAnswer,
    SimulateRequest, SimulationAtAnswer, SimulationAtRequest, SimulationBlockAnswer,
    SimulationBlockRequest, SimulationCurvesAnswer, SimulationCurvesRequest, SimulationPathAnswer,
    SimulationPathRequest, SimulationSourceAnswer, SimulationSourceRequest, SimulationStockAnswer,
    SimulationStockRequest,
};
use crate::body::{needed, short};
use crate::desk::{Desk, Job};
use crate::frame::Array;
use crate::refusal::{Refusal, entries};
use crate::request::{Reply, Request};
use crate::simulated::{Simulated, Source};
use std::path::Path;
use std::sync::Arc;
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::questions::{MachineChoice, ProgramChoice, Simulate};
use trueaxis::report::{Simulation, SimulationDocument};
use trueaxis::simulate::collide::BodyModel;
use trueaxis::simulate::{self, Colour, Findings, Machining, Observer, Progress, Recorder, Stop};

/// Columns of a picture of curves.
const MOST_COLUMNS: usize = 1 << 14;
/// Points of a picture of a path.
const MOST_POINTS: usize = 1 << 19;
/// The share of the time that the work after the program takes.
const REST: f64 = 0.05;

impl Request for SimulateRequest {
    type Answer<'a> = SimulateAnswer<'a>;

    /// Simulates as `trueaxis simulate --no-report` does, and keeps the recording.
    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let mut problems = Diagnostics::new();
        let dropped = self.text.is_some();
        let question = self.question(desk, job)?;
        let simulation = question.job(&disk(), &mut problems).filter(|_| !problems.has_errors());
        let Some(simulation) = simulation else { return Err(Refusal::unusable(&problems)) };
        let Some((collisions, machining)) = question.watchers(&simulation, &mut problems) else {
            return Err(Refusal::unusable(&problems));
        };
        for (first, second) in collisions.iter().flat_map(|c| c.left_out()) {
            let message = format!("{first} and {second} overlap with all axes at 0: not watched");
            let place = question.machine.place();
            problems.note("not-watched", place, message, "move one of them, or leave it as it is");
        }
        let mut progress =
            Progress::through(&simulation.program, |part| job.tell(part * (1.0 - REST)));
        let mut recorder =
            Recorder::of(&simulation.machine, &simulation.setup, &simulation.options);
        let mut observers: [&mut dyn Observer; 2] = [&mut progress, &mut recorder];
        let found = simulation.run_on(collisions, machining, &mut observers);
        if found.run.stopped {
            let message = "the simulation was stopped";
            return Err(Refusal::new(409, "stopped", message, "simulate again"));
        }
        problems.append(found.run.problems.clone());
        if problems.has_errors() && !simulation.options.keep_going {
            return Err(Refusal::unusable(&problems));
        }
        let programs = sources(desk, &simulation, &found, dropped);
        let simulation = Arc::new(again(simulation, &programs));
        let simulated = Simulated {
            machine: simulation.machine.clone(),
            recording: recorder.finish(),
            programs,
            cut: found.machined.is_some().then(|| Arc::clone(&simulation)),
        };
        job.tell(1.0);
        let simulated = desk.simulations.put(simulated);
        // The stock is drawn as the program leaves it.
        let bodies = match &found.machined {
            Some(machined) => machined.bodies(&simulation.setup.bodies),
            None => simulation.setup.bodies.clone(),
        };
        let answer = answer(&simulated, &simulation, (&found, &bodies), &problems);
        Ok(Reply::frame(&answer, vec![("corners_mm", corners(&bodies))]))
    }
}

impl SimulateRequest {
    /// As the library is asked.
    pub(super) fn question(self, desk: &Desk, job: &Job) -> Result<Simulate, Refusal> {
        if self.program.is_some() && (self.name.is_some() || self.text.is_some()) {
            let message =
                "`program` is a file of the project, `name` and `text` are one that was dropped";
            return Err(Refusal::bad(message, "one of both"));
        }
        let name = match self.text.is_some() {
            true => needed(self.name, "name")?,
            false => needed(self.program, "program")?,
        };
        let file = desk.project.path(&self.machine)?;
        let program = ProgramChoice {
            program: desk.project.path(&name)?,
            text: self.text,
            setup: self.setup.map(|name| desk.project.path(&name)).transpose()?,
            control: self.control,
            keep_going: self.keep_going.unwrap_or(false),
            without_optional: !self.optional_blocks.unwrap_or(true),
            stop: Stop::from(job.halt.flag.clone()),
            ..ProgramChoice::default()
        };
        let machine = MachineChoice { file, ..MachineChoice::default() };
        let no_collisions = !self.collisions.unwrap_or(true);
        Ok(Simulate { machine, program, no_collisions, ..Simulate::default() })
    }
}

/// What was simulated, to be run again for the stock: with the subprograms as they ran, without the bodies of the machine.
fn again(simulation: simulate::Job, programs: &[Source]) -> simulate::Job {
    // A text that could not be read any more is asked of the disk, which refuses it.
    let subprograms = programs.iter().skip(1).filter(|source| !source.text.is_empty());
    let ran = subprograms.map(|source| (source.name.clone().into(), source.text.clone()));
    let files = simulation.setup.files.clone().with_texts(ran);
    let setup = simulate::SetUp { files, ..simulation.setup };
    simulate::Job { setup, models: Vec::new(), ..simulation }
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
            // It could be read when it ran; if the file is gone by now, the text is empty.
            false => files::read_bytes(Path::new(name)).unwrap_or_default(),
        };
        let path = if is_main && dropped { None } else { desk.project.name_of(Path::new(name)) };
        Source { name: name.clone(), path, text: String::from_utf8_lossy(&content).into_owned() }
    };
    found.run.programs.iter().enumerate().map(source).collect()
}

fn answer<'a>(
    (number, simulated): &'a (u64, Arc<Simulated>),
    simulation: &'a simulate::Job,
    (found, bodies): (&'a Findings, &'a [BodyModel]),
    problems: &'a Diagnostics,
) -> SimulateAnswer<'a> {
    let Simulated { machine, recording, programs, .. } = &**simulated;
    let issues = found.issues.list.iter();
    let tools = simulation.setup.tools.iter();
    SimulateAnswer {
        duration_s: recording.end_s(),
        nodes: recording.nodes(),
        kept: recording.kept(),
        thinned: recording.is_thinned(),
        axes: recording.axes().into_iter().map(Into::into).collect(),
        quantities: recording.quantities().into_iter().map(Into::into).collect(),
        programs: programs.iter().map(Source::entry).collect(),
        marks: issues.map(|issue| MarkEntry::of(machine, issue)).collect(),
        bodies: machine.bodies().iter().map(|b| b.name.to_string()).collect(),
        document: SimulationDocument::of(&Simulation::of(simulation, found)),
        tools: tools.map(|(number, tool)| SetUpToolEntry::of(*number, tool)).collect(),
        on_workpiece: bodies.iter().map(SurfaceEntry::from).collect(),
        diagnostics: entries(problems),
        simulation: *number,
    }
}

impl Source {
    fn entry(&self) -> ProgramEntry<'_> {
        ProgramEntry {
            name: &self.name,
            path: self.path.as_deref(),
            lines: self.text.lines().count(),
        }
    }
}

impl Request for SimulationAtRequest {
    type Answer<'a> = SimulationAtAnswer;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let simulated = kept(desk, self.simulation)?;
        let moment = simulated.recording.at(self.time_s).ok_or_else(|| {
            Refusal::new(422, "nothing-simulated", "the simulation has no place", "simulate again")
        })?;
        let bodies = simulated.recording.bodies(&moment);
        let poses = |which: usize| bodies.iter().flat_map(move |poses| twelve(&poses[which]));
        let arrays = vec![
            ("nominal", Array::F64(poses(0).collect())),
            ("actual", Array::F64(poses(1).collect())),
        ];
        let moment = MomentEntry::of(&simulated.machine, &moment);
        Ok(Reply::frame(&SimulationAtAnswer { moment }, arrays))
    }
}

impl Request for SimulationStockRequest {
    type Answer<'a> = SimulationStockAnswer<'a>;

    /// The program runs again up to the time, as it was simulated, whatever has become of its file.
    fn answer(self, desk: &Desk, job: &Job) -> Result<Reply<Self>, Refusal> {
        let simulated = kept(desk, self.simulation)?;
        let cut = simulated.cut.as_ref().ok_or_else(|| {
            let hint = "state [stock] with a `resolution` in the set-up file, and simulate again";
            Refusal::new(422, "no-stock", "no stock was cut in this simulation", hint)
        })?;
        let machining = Machining::watch(&cut.setup)
            .map_err(|(message, hint)| Refusal::new(422, "no-stock", message, &hint))?;
        let given_up = Stop::from(job.halt.flag.clone());
        let machined = cut.machined_until(machining, self.time_s, &given_up).ok_or_else(|| {
            Refusal::new(409, "stopped", "the stock could not be cut again", "simulate again")
        })?;
        let bodies = machined.bodies(&cut.setup.bodies);
        let answer = SimulationStockAnswer {
            time_s: self.time_s,
            left_mm3: machined.stock.volume_mm3(),
            removed_mm3: machined.total().removed_mm3,
            on_workpiece: bodies.iter().map(SurfaceEntry::from).collect(),
        };
        Ok(Reply::frame(&answer, vec![("corners_mm", corners(&bodies))]))
    }
}

impl Request for SimulationBlockRequest {
    type Answer<'a> = SimulationBlockAnswer;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let simulated = kept(desk, self.simulation)?;
        let recording = &simulated.recording;
        let time_s = match self.step {
            Some(BlockStep::Next) => recording.next_block(needed(self.from_s, "from_s")?),
            Some(BlockStep::Previous) => recording.previous_block(needed(self.from_s, "from_s")?),
            None => {
                let (program, line) =
                    (needed(self.program, "program")?, needed(self.line, "line")?);
                let [program, line] = [program, line].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
                recording.block_of_line(program, line).ok_or_else(|| {
                    let message = format!("nothing moves in or after line {line}");
                    Refusal::new(404, "no-block", message, "choose a line before it")
                })?
            }
        };
        Ok(Reply::json(&SimulationBlockAnswer { time_s }))
    }
}

impl From<PathColour> for Colour {
    fn from(colour: PathColour) -> Self {
        match colour {
            PathColour::Deviation => Self::Deviation,
            PathColour::Feed => Self::Feed,
            PathColour::Load => Self::Load,
        }
    }
}

impl Request for SimulationPathRequest {
    type Answer<'a> = SimulationPathAnswer;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let simulated = kept(desk, self.simulation)?;
        let recording = &simulated.recording;
        let colour = Colour::from(self.colour);
        let from_s = self.from_s.unwrap_or(0.0);
        let to_s = self.to_s.unwrap_or(recording.end_s());
        let points = recording.path(from_s, to_s, self.points.min(MOST_POINTS), colour);
        let (title, unit) = colour.title();
        let answer = SimulationPathAnswer {
            origin_mm: points.origin_mm,
            unit,
            title,
            low: points.range[0],
            high: points.range[1],
            chord_mm: points.chord_mm,
            complete: points.is_complete,
        };
        let flat = |all: &[[f32; 3]]| Array::F32(all.concat());
        let arrays = vec![
            ("tip_mm", flat(&points.tip_mm)),
            ("off_um", flat(&points.off_um)),
            ("value", Array::F32(points.value)),
            ("rapid", Array::U8(points.rapid.into_iter().map(u8::from).collect())),
            ("time_s", Array::F64(points.time_s)),
            ("program", Array::U32(points.program)),
            ("line", Array::U32(points.line)),
        ];
        Ok(Reply::frame(&answer, arrays))
    }
}

impl Request for SimulationCurvesRequest {
    type Answer<'a> = SimulationCurvesAnswer;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let Self { from_s, to_s, columns, quantities: keys, .. } = self;
        let simulated = kept(desk, self.simulation)?;
        let ranges = simulated.recording.quantities();
        let of_key = |key: &String| {
            let range = ranges.iter().find(|range| range.key == *key);
            let known: Vec<&str> = ranges.iter().map(|range| range.key.as_str()).collect();
            let message = || format!("unknown quantity `{}`", short(key));
            range.map(|r| r.quantity).ok_or_else(|| Refusal::bad(message(), &known.join(", ")))
        };
        let quantities = keys.iter().map(of_key).collect::<Result<Vec<_>, _>>()?;
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
        let answer = SimulationCurvesAnswer { from_s, to_s, columns, quantities: keys };
        let arrays = vec![("low", Array::F32(curves.low)), ("high", Array::F32(curves.high))];
        Ok(Reply::frame(&answer, arrays))
    }
}

impl Request for SimulationSourceRequest {
    type Answer<'a> = SimulationSourceAnswer<'a>;

    fn answer(self, desk: &Desk, _: &Job) -> Result<Reply<Self>, Refusal> {
        let simulated = kept(desk, self.simulation)?;
        let source = simulated.programs.get(self.program).ok_or_else(|| {
            let message = format!("the simulation has no program {}", self.program);
            let hint = format!("0 to {}", simulated.programs.len().saturating_sub(1));
            Refusal::new(404, "no-program", message, &hint)
        })?;
        Ok(Reply::json(&SimulationSourceAnswer { name: &source.name, text: &source.text }))
    }
}

fn kept(desk: &Desk, number: u64) -> Result<Arc<Simulated>, Refusal> {
    desk.simulations.of_number(number).ok_or_else(|| {
        let message = format!("simulation {number} is gone: only the last few are kept");
        Refusal::new(404, "gone", message, "simulate again")
    })
}
