//! What does a program do on the actual machine?

mod table;

use super::{Answer, Content, MachineChoice, NewFile, ProgramChoice, Question, Tell};
use crate::files::Part;
use crate::files::output::Output;
use crate::report::{self, Simulation};
use serde_json::Value;
use std::path::{Path, PathBuf};
use table::{PathTable, bodies_table};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_motion::{Collisions, Findings, Job, Machining, Observer, Progress, Series};
use trueaxis_report::{Language, Report, document};

/// An NC program on the actual machine: path, time, deviations, issues.
#[derive(Debug, Clone, Default)]
pub struct Simulate {
    /// The machine.
    pub machine: MachineChoice,
    /// The program.
    pub program: ProgramChoice,
    /// Where every point of the path goes: a CSV table, or Parquet by the ending of its name.
    pub path: Option<PathBuf>,
    /// Where the pose of every body at every point of the path goes.
    pub bodies: Option<PathBuf>,
    /// Whether pictures are wanted, for a page.
    pub pictures: bool,
    /// Without the collision check.
    pub no_collisions: bool,
    /// Whether the stock of the set-up is cut; one with a stated resolution always is.
    pub stock: bool,
}

/// A program with what it did.
pub struct Simulated {
    job: Job,
    found: Findings,
    series: Option<Series>,
    path: Option<String>,
    files: Vec<NewFile>,
    notes: Vec<String>,
}

impl Simulate {
    /// Machine, program and models of the bodies, read.
    pub fn job(&self, files: &Files, problems: &mut Diagnostics) -> Option<Job> {
        let job = self.program.read(&self.machine, files, problems)?;
        Some(match self.no_collisions {
            true => job,
            false => job.with_models(&self.machine.file, problems),
        })
    }
}

impl Simulate {
    /// What looks on for collisions, and the stock before the first cut: on request, or where the set-up states its resolution. Then what goes through
    /// stock and part is asked of the stock as it is at its time.
    pub fn watchers(
        &self,
        job: &Job,
        problems: &mut Diagnostics,
    ) -> Option<(Option<Collisions>, Option<Machining>)> {
        let is_cut = self.stock || job.setup.stock_resolution_mm.is_some();
        let machining = match is_cut.then(|| Machining::watch(&job.setup)) {
            None => None,
            Some(Ok(machining)) if machining.follows(&job.options.densify) => Some(machining),
            // Not asked for, and this run draws its path too coarsely for it.
            Some(Ok(_)) if !self.stock => None,
            Some(Ok(_)) => {
                let message = "the path of this run leaves the programmed one by more than a tenth of the resolution of the stock";
                let hint = "leave out --no-densify and --by-count, or state a smaller --chord";
                let place = Place::whole(job.program.file());
                problems.error("coarse-path", place, message.to_owned(), hint);
                return None;
            }
            Some(Err((message, hint))) => {
                problems.error("no-stock", Place::whole(job.program.file()), message, &hint);
                return None;
            }
        };
        let collisions = if self.no_collisions { None } else { job.collisions() };
        let collisions = match machining {
            Some(_) => collisions.map(Collisions::beside_cut_stock),
            None => collisions,
        };
        Some((collisions, machining))
    }
}

impl Question for Simulate {
    type Input = Job;
    type Answer = Simulated;
    const PROGRESS: &'static str = "Simulation";

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<Job> {
        let job = self.job(files, problems);
        if let Some(path) = &self.path {
            table::check(path, problems);
        }
        job
    }

    fn outputs(&self, _: Option<&Job>) -> Vec<Output> {
        let path = self.path.iter().map(|path| Output::file("--path", path));
        path.chain(self.bodies.iter().map(|path| Output::file("--bodies", path))).collect()
    }

    fn answer(
        &self,
        job: Job,
        progress: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<Simulated> {
        let path = begin(self.path.as_deref(), problems)?;
        let bodies = begin(self.bodies.as_deref(), problems)?;
        let mut table =
            path.as_ref().map(|(path, part)| PathTable::begin(&job.machine, path, part));
        let mut bodies_table = bodies.as_ref().map(|(_, part)| bodies_table(part));
        let mut series = self.pictures.then(|| Series::of(&job.machine));
        let (collisions, machining) = self.watchers(&job, problems)?;
        let left_out = collisions.iter().flat_map(|c| c.left_out());
        let note = |(first, second): (&str, &str)| {
            format!(
                "note: {first} and {second} overlap with all axes at 0: not checked for collisions"
            )
        };
        let notes = left_out.map(note).collect();
        let mut followed = Progress::through(&job.program, progress);
        let mut observers: Vec<&mut dyn Observer> = vec![&mut followed];
        observers.extend(series.as_mut().map(|series| series as &mut dyn Observer));
        observers.extend(table.as_mut().map(PathTable::observer));
        observers.extend(bodies_table.as_mut().map(|bodies| bodies as &mut dyn Observer));
        let found = job.run_on(collisions, machining, &mut observers);
        drop(observers);
        drop(followed);
        problems.append(found.run.problems.clone());
        if problems.has_errors() && !job.options.keep_going {
            return None;
        }
        let written = table.map_or(Ok(()), PathTable::finish);
        let bodies_written = bodies_table.map_or(Ok(()), |table| table.finish().map(drop));
        for (at, written) in [(&path, written), (&bodies, bodies_written)] {
            if let (Some((at, _)), Err(error)) = (at, written) {
                unwritable(at, &error, problems);
                return None;
            }
        }
        let files = path.into_iter().chain(bodies).map(|(path, part)| NewFile {
            name: "",
            path,
            content: Content::Part(part),
        });
        let (files, path) = (files.collect(), self.path.as_ref().map(|p| p.display().to_string()));
        Some(Simulated { job, found, series, path, files, notes })
    }
}

/// A temporary file beside each place that is named.
fn begin(path: Option<&Path>, problems: &mut Diagnostics) -> Option<Option<(PathBuf, Part)>> {
    let Some(path) = path else { return Some(None) };
    match Part::beside(path) {
        Ok(part) => Some(Some((path.to_owned(), part))),
        Err(error) => {
            unwritable(path, &error, problems);
            None
        }
    }
}

fn unwritable(path: &Path, error: &std::io::Error, problems: &mut Diagnostics) {
    let place = Place::whole(&path.display().to_string());
    let message = format!("cannot be written: {error}");
    problems.error("unwritable-file", place, message, "name another --path");
}

impl Simulated {
    fn shown(&self) -> Simulation<'_> {
        Simulation { path_file: self.path.as_deref(), ..Simulation::of(&self.job, &self.found) }
    }
}

impl Answer for Simulated {
    fn document(&self, _: &Diagnostics) -> Value {
        document(&report::SimulationDocument::of(&self.shown()))
    }

    fn report(&self) -> Report<'_> {
        report::simulation_report(self.shown(), self.series.as_ref())
    }

    /// Without pictures and their captions.
    fn text(&self, language: &dyn Language) -> String {
        report::simulation_report(self.shown(), None).in_language(language).text()
    }

    fn is_yes(&self) -> bool {
        let run = &self.found.run;
        let is_executed = run.motion_left_out().chain(run.beyond_equipment()).next().is_none();
        is_executed && !self.found.issues.is_critical()
    }

    fn in_spite_of_errors(&self) -> Option<&'static str> {
        self.job.options.keep_going.then_some("the simulation continued after them")
    }

    fn files(&mut self) -> Vec<NewFile> {
        std::mem::take(&mut self.files)
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }
}
