//! From files to results: used by the command line and by the window.

use super::collide::{BodyModel, load_models};
use super::program::program_of;
use super::{
    AxisWatch, Batch, Collisions, Drift, Issue, IssueKind, IssueList, Machined, Machining,
    Observer, Options, Run, SetUp, Stop, Summary, read_program, read_setup, simulate,
};
use crate::report::issue_text;
use crate::tool_check;
use std::path::{Path, PathBuf};
use trueaxis_input::{Diagnostics, Files, Place};
use trueaxis_machine::Machine;
use trueaxis_nc::{Control, Program};

/// A program and what belongs to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgramFiles<'a> {
    /// Where the files are read from.
    pub files: &'a Files,
    /// The program; its subprograms are looked for in its folder.
    pub program: &'a Path,
    /// Its text if it is not to be read from the disk.
    pub text: Option<&'a [u8]>,
    /// The set-up; without it the file PROGRAM.setup.toml in the folder of a program on the disk.
    pub setup: Option<&'a Path>,
    /// The control that the program is for, if known.
    pub control: Option<Control>,
}

impl ProgramFiles<'_> {
    /// Reads the set-up; one without anything if there is none.
    pub fn setup(&self, machine: &Machine, problems: &mut Diagnostics) -> Option<SetUp> {
        let Some(path) = self.setup_path() else {
            return Some(SetUp { files: self.files.clone(), ..SetUp::default() });
        };
        problems.keep(read_setup(self.files, &path, machine))
    }

    /// Reads the program; its name and its text are all that is known of one that is on no disk.
    pub fn program(&self, setup: &SetUp, problems: &mut Diagnostics) -> Option<Program> {
        match self.text {
            None => read_program(self.files, self.program, self.control, setup, problems),
            Some(text) => {
                let control = self.control.or(setup.control);
                program_of(self.program, text.to_vec().into(), control, problems)
            }
        }
    }

    fn setup_path(&self) -> Option<PathBuf> {
        let beside = || self.program.with_extension("setup.toml");
        let found = || self.text.is_none().then(beside).filter(|path| self.files.is_file(path));
        self.setup.map(Path::to_owned).or_else(found)
    }
}

/// Everything that a simulation needs, read and checked.
pub struct Job {
    /// The machine with the tool that is in it, at the temperatures of the start.
    pub machine: Machine,
    /// The program.
    pub program: Program,
    /// The control that the program is for.
    pub control: Control,
    /// What is on the machine.
    pub setup: SetUp,
    /// How it is simulated.
    pub options: Options,
    /// Shapes of the bodies of the machine; empty where they are not needed.
    pub models: Vec<BodyModel>,
}

impl Job {
    /// Reads set-up and program; everything that is wrong goes to `problems`.
    ///
    /// ```no_run
    /// use trueaxis_input::Diagnostics;
    /// use trueaxis_motion::{Job, Options, ProgramFiles};
    /// # let files = trueaxis_input::Files::none();
    /// let (machine, mut problems) = trueaxis_machine::Machine::read(&files, "mill.toml".as_ref());
    /// let program = "part.mpf".as_ref();
    /// let files = ProgramFiles { files: &files, program, text: None, setup: None, control: None };
    /// let job = Job::read(machine.unwrap(), &files, Options::default(), &mut problems).unwrap();
    /// let found = job.run(job.collisions(), &mut []);
    /// assert!(!found.run.problems.has_errors());
    /// ```
    pub fn read(
        machine: Machine,
        files: &ProgramFiles<'_>,
        options: Options,
        problems: &mut Diagnostics,
    ) -> Option<Self> {
        let setup = files.setup(&machine, problems)?;
        let program = files.program(&setup, problems)?;
        let control = program.dialect().control;
        Some(Self { machine, program, control, setup, options, models: Vec::new() })
    }

    /// The same with the models of the machine, whose STL files are in the folder of the machine file.
    #[must_use]
    pub fn with_models(mut self, machine_file: &Path, problems: &mut Diagnostics) -> Self {
        self.models = load_models(&self.setup.files, &self.machine, machine_file, problems);
        self
    }

    /// Watches the bodies; `None` if there are not two.
    pub fn collisions(&self) -> Option<Collisions> {
        Collisions::watch(&self.machine, self.models.clone(), &self.setup)
    }

    /// Simulates; `collisions` are looked for if they are given, `observers` look on.
    pub fn run(
        &self,
        collisions: Option<Collisions>,
        observers: &mut [&mut dyn Observer],
    ) -> Findings {
        self.run_on(collisions, None, observers)
    }

    /// The same, and cuts the stock if it is given.
    pub fn run_on(
        &self,
        mut collisions: Option<Collisions>,
        mut machining: Option<Machining>,
        observers: &mut [&mut dyn Observer],
    ) -> Findings {
        let mut summary = Summary::of(&self.machine);
        let mut watch = AxisWatch::on(&self.machine).timed(self.options.timing);
        let temperatures = self.options.temperatures.as_ref();
        let mut drift = temperatures.and_then(|run| Drift::of(&self.machine, &self.setup, run));
        let mut all: Vec<&mut dyn Observer> = vec![&mut summary, &mut watch];
        for observer in observers {
            all.push(&mut **observer);
        }
        if let Some(collisions) = &mut collisions {
            all.push(collisions);
        }
        if let Some(machining) = &mut machining {
            all.push(machining);
        }
        if let Some(drift) = &mut drift {
            all.push(drift);
        }
        let mut run = simulate(&self.machine, &self.program, &self.setup, &self.options, &mut all);
        tool_check::tell(&self.setup, &summary, &mut run.problems);
        if let Some(collisions) = &collisions {
            run.problems.append(collisions.problems(&run.programs));
        }
        let (machined, log) = match machining {
            Some(machining) => {
                let (machined, log, problems) = machining.finish(&run.programs);
                run.problems.append(problems);
                (Some(machined), Some(log))
            }
            None => (None, None),
        };
        let logs = [Some(watch.log), collisions.map(|c| c.log), log];
        let issues = IssueList::of(logs.into_iter().flatten());
        self.warn_outside_travel(&summary, &issues, &mut run);
        Findings { run, summary, issues, drift, machined }
    }

    /// What became of the stock up to a time of the program, s: what comes later is not executed.
    ///
    /// `None` if it was given up, or if the run met errors before that time although they end it.
    pub fn machined_until(
        &self,
        machining: Machining,
        end_s: f64,
        given_up: &Stop,
    ) -> Option<Machined> {
        let mut machining = machining.until(end_s);
        let stop = Stop::default();
        let mut end = End { end_s, given_up, stop: &stop };
        let options = Options { stop: stop.clone(), ..self.options.clone() };
        let mut observers: [&mut dyn Observer; 2] = [&mut machining, &mut end];
        let run = simulate(&self.machine, &self.program, &self.setup, &options, &mut observers);
        let is_whole = options.keep_going || !run.problems.has_errors();
        (is_whole && !given_up.is_requested()).then(|| machining.finish(&[]).0)
    }

    /// The errors of a machine are known within its travel only: a deviation beyond it is a formula carried on.
    fn warn_outside_travel(&self, summary: &Summary, issues: &IssueList, run: &mut Run) {
        let worst = &summary.feed_tip;
        let is_beyond = |issue: &&Issue| {
            matches!(issue.kind, IssueKind::OverTravel { .. })
                && (issue.from_s..=issue.to_s).contains(&worst.time_s)
        };
        let Some(issue) = issues.list.iter().find(is_beyond).filter(|_| worst.value > 0.0) else {
            return;
        };
        let programs = &run.programs;
        let file = programs.get(worst.origin.program as usize).map_or(self.program.file(), |f| f);
        let place = Place { file: file.to_owned(), line: worst.origin.line as usize, column: 1 };
        let message = format!(
            "the largest deviation of the tip, {:.1} µm, stands outside the travel ({}): the errors of the \
             machine are not known there",
            worst.value * 1e3,
            issue_text(&self.machine, issue)
        );
        let hint = "correct the work offset, the tool length or the program, then read the deviations again";
        run.problems.warn("deviation-outside-travel", place, message, hint);
    }
}

/// The results of a simulation.
pub struct Findings {
    /// How it ended.
    pub run: Run,
    /// Its results.
    pub summary: Summary,
    /// The issues.
    pub issues: IssueList,
    /// The effect of changing temperatures, where they followed a log.
    pub drift: Option<Drift>,
    /// What became of the stock, where it was cut.
    pub machined: Option<Machined>,
}

/// Reports how far the main program has come: the part of its lines, 0 to 1. Loops go back; the part
/// does not.
pub struct Progress<'t> {
    lines: f64,
    line: u32,
    report: Box<dyn FnMut(f64) + 't>,
}

impl<'t> Progress<'t> {
    /// From the first line on.
    pub fn through(program: &Program, report: impl FnMut(f64) + 't) -> Self {
        let breaks = |part: &[u8]| part.iter().filter(|b| **b == b'\n').count();
        let lines = program.parts().map(breaks).sum::<usize>() as f64 + 1.0;
        Self { lines, line: 0, report: Box::new(report) }
    }
}

impl Observer for Progress<'_> {
    fn path(&mut self, batch: &Batch<'_>) {
        let Some(node) = batch.nodes.last() else { return };
        if node.origin.program == 0 && node.origin.line > self.line {
            self.line = node.origin.line;
            (self.report)((f64::from(self.line) / self.lines).min(1.0));
        }
    }
}

/// Ends a run at a time of the program, or as soon as it is given up.
struct End<'s> {
    end_s: f64,
    given_up: &'s Stop,
    stop: &'s Stop,
}

impl Observer for End<'_> {
    fn path(&mut self, batch: &Batch<'_>) {
        let is_past = batch.stamps.last().is_some_and(|stamp| stamp.time_s > self.end_s);
        if is_past || self.given_up.is_requested() {
            self.stop.request();
        }
    }
}
