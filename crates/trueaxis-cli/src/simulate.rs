//! `trueaxis simulate`: an NC program on the actual machine.

use crate::arguments::{LogStart, MachineArguments, control};
use crate::output::{Answer, Format, Outcome, report, report_and, show, tell};
use crate::path_file::{BODIES, PathTable, may_write_path};
use crate::report_file::{REPORT, may_write, unusable, write_report};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{BufWriter, IsTerminal};
use std::path::{Path, PathBuf};
use trueaxis::files::Part;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::machine::heat::TemperatureRun;
use trueaxis::nc::Program;
use trueaxis::report::{Simulation, simulation_json, simulation_report};
use trueaxis::simulate::{
    BodyTable, Collisions, Densify, Findings, Job, Observer, Options, ProgramFiles, Progress,
    Series, Timing,
};

/// The program to simulate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis simulate machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf
  trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --format json
  trueaxis simulate MACHINE.toml PART.ngc --setup PART.setup.toml --path path.csv --chord 0.002
  trueaxis simulate MACHINE.toml PART.mpf --temperature-log hall.csv --log-start \"2 h\"

With --log-start every point of the path is evaluated at the temperatures of its own time (within
0.01 K), and the summary shows the drift: the change of the deviation since the start. A program
that is longer than its log is an error. Without --setup work offsets and tool lengths are 0; a file
PROGRAM.setup.toml in the folder of the program is used automatically. Exit status: 0 no critical
issue, 1 a collision, a rapid move through stock or an axis beyond its travel, 2 unusable input; then
nothing is written.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    program: ProgramArguments,
    /// Write every point of the path to this file: CSV, or Parquet if its name ends in .parquet
    #[arg(long, value_name = "FILE")]
    path: Option<PathBuf>,
    /// Write the nominal and actual pose of every body at every point of the path to this CSV file
    #[arg(long, value_name = "FILE.csv")]
    bodies: Option<PathBuf>,
    /// File of the HTML report
    #[arg(long, value_name = "FILE", default_value = "simulation.html")]
    report: PathBuf,
    /// Write no report
    #[arg(long, conflicts_with = "report")]
    no_report: bool,
    /// Without the collision check
    #[arg(long)]
    no_collisions: bool,
    /// List errors of the program and continue after them
    #[arg(long)]
    keep_going: bool,
    /// Output as text or as one JSON document
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// The program, its set-up, and the division of its moves.
#[derive(Args)]
pub struct ProgramArguments {
    #[command(flatten)]
    pub log: LogStart,
    /// The NC program
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// Work offsets, tools, stock, fixtures
    #[arg(long, value_name = "SETUP.toml")]
    setup: Option<PathBuf>,
    /// The control of the program: sinumerik, fanuc, linuxcnc or heidenhain
    #[arg(long, value_name = "NAME")]
    control: Option<String>,
    /// Largest distance between path and chord, mm
    #[arg(long, value_name = "MM", default_value = "0.005", allow_negative_numbers = true)]
    chord: String,
    /// Longest piece of a move, mm (λ of Jiang et al.)
    #[arg(long, value_name = "MM", default_value = "10", allow_negative_numbers = true)]
    spacing: String,
    /// Largest rotation in a piece, deg (φ of Jiang et al.)
    #[arg(long, value_name = "DEG", default_value = "1", allow_negative_numbers = true)]
    angle: String,
    /// Divide moves by spacing and angle alone, as Jiang et al. do
    #[arg(long)]
    by_count: bool,
    /// Do not divide moves, except circles
    #[arg(long, conflicts_with = "by_count")]
    no_densify: bool,
    /// Corner rounding tolerance where the program states none, mm
    #[arg(long, value_name = "MM", default_value = "0.01", allow_negative_numbers = true)]
    rounding: String,
    /// Time each block by the three phases of Jiang et al., with this mean acceleration, mm/s^2,
    /// and exact stop, instead of looking ahead within the limits of the axes
    #[arg(long, value_name = "MM_PER_S2", allow_negative_numbers = true)]
    three_phase: Option<String>,
    /// Backward jumps and calls after which the program counts as an endless loop
    #[arg(long, value_name = "N", default_value = "1000000")]
    most_jumps: u64,
    /// With --three-phase: the velocity changes smoothly
    #[arg(long, requires = "three_phase")]
    smooth: bool,
}

impl ProgramArguments {
    /// Reads program and set-up; what is wrong goes to `problems`.
    pub fn read(
        &self,
        (machine, temperatures): (Machine, Option<TemperatureRun>),
        keep_going: bool,
        problems: &mut Diagnostics,
    ) -> Option<Job> {
        let files = ProgramFiles {
            files: &disk(),
            program: &self.program,
            text: None,
            setup: self.setup.as_deref(),
            control: None,
        };
        let control = match &self.control {
            Some(name) => match control(name, problems) {
                Some(control) => Some(control),
                None => return files.setup(&machine, problems).and(None),
            },
            None => None,
        };
        let options = self.options(keep_going, problems);
        let files = ProgramFiles { files: &disk(), control, ..files };
        // With bad options all problems of the files are reported as well.
        let job = Job::read(machine, &files, options.clone().unwrap_or_default(), problems);
        let options = Options { temperatures, ..options? };
        job.map(|job| Job { options, ..job })
    }

    fn options(&self, keep_going: bool, problems: &mut Diagnostics) -> Option<Options> {
        let mut read = |name: &str, text: &str| {
            let value = parse_quantity(text, Dimension::Ratio).ok().filter(|v| *v > 0.0);
            if value.is_none() {
                let message = format!("`{text}` is not a positive number");
                problems.error("bad-number", Place::whole(name), message, "such as 0.005");
            }
            value
        };
        let chord_mm = read("--chord", &self.chord);
        let spacing_mm = read("--spacing", &self.spacing);
        let angle_rad = read("--angle", &self.angle).map(f64::to_radians);
        let rounding_mm = read("--rounding", &self.rounding);
        let (chord_mm, spacing_mm, angle_rad) = (chord_mm?, spacing_mm?, angle_rad?);
        let densify = match (self.no_densify, self.by_count) {
            (true, _) => Densify::Off,
            (_, true) => Densify::Count { spacing_mm, angle_rad },
            _ => Densify::Tolerance { chord_mm, angle_rad, spacing_mm },
        };
        let acceleration = self.three_phase.as_ref().map(|text| read("--three-phase", text));
        let most_jumps = self.most_jumps;
        let timing = match acceleration {
            None => Timing::LookAhead,
            Some(a) => Timing::ThreePhase { acceleration: a?, smooth: self.smooth },
        };
        let rounding_mm = rounding_mm?;
        let usual = Options::default();
        Some(Options { densify, rounding_mm, timing, most_jumps, keep_going, ..usual })
    }
}

pub fn run(arguments: &Arguments) -> Outcome {
    let mut problems = Diagnostics::new();
    let job = arguments
        .machine
        .read_from(&arguments.program.log, &mut problems)
        .and_then(|m| arguments.program.read(m, arguments.keep_going, &mut problems))
        .map(|job| arguments.with_models(job, &mut problems));
    // Before the work, not after it.
    arguments.may_write(&mut problems);
    if report(problems) {
        return Outcome::Unusable;
    }
    let Some(job) = job else { return Outcome::Unusable };
    arguments.simulated(&job).unwrap_or_else(|outcome| outcome)
}

impl Arguments {
    fn with_models(&self, mut job: Job, problems: &mut Diagnostics) -> Job {
        if !self.no_collisions {
            job = job.with_models(self.machine.path(), problems);
        }
        job
    }

    fn may_write(&self, problems: &mut Diagnostics) {
        if let Some(path) = &self.path {
            may_write_path(path, problems);
        }
        if let Some(bodies) = &self.bodies {
            may_write(bodies, &BODIES, problems);
        }
        if !self.no_report {
            may_write(&self.report, &REPORT, problems);
        }
        let report = Some(&self.report).filter(|_| !self.no_report);
        let named = [self.path.as_ref(), self.bodies.as_ref(), report];
        let named: Vec<&PathBuf> = named.into_iter().flatten().collect();
        for (i, one) in named.iter().enumerate() {
            if named[..i].iter().any(|other| same_place(one, other)) {
                let place = Place::whole(&one.display().to_string());
                let message = "is named for two outputs".to_owned();
                problems.error("one-file-twice", place, message, "name a file for each");
            }
        }
    }

    fn simulated(&self, job: &Job) -> Result<Outcome, Outcome> {
        let part = match &self.path {
            Some(path) => Some(Part::beside(path).map_err(|e| unwritable(path, &e))?),
            None => None,
        };
        let bodies = match &self.bodies {
            Some(path) => Some(Part::beside(path).map_err(|e| unwritable(path, &e))?),
            None => None,
        };
        let (found, series, table) = self.walk(job, part.as_ref(), bodies.as_ref());
        let end = if self.keep_going {
            "the simulation continued after them"
        } else {
            "nothing was written"
        };
        let errors = report_and(found.run.problems.clone(), end);
        if errors && !self.keep_going {
            return Err(Outcome::Unusable);
        }
        if let Some(path) = self.path.as_ref().or(self.bodies.as_ref()) {
            table.map_err(|e| unwritable(path, &e))?;
        }
        let path_file = self.path.as_ref().map(|p| p.display().to_string());
        let simulation =
            Simulation { path_file: path_file.as_deref(), ..Simulation::of(job, &found) };
        if let (Some(path), Some(part)) = (&self.path, part) {
            part.put_in_place().map_err(|e| unwritable(path, &e))?;
        }
        if let (Some(path), Some(part)) = (&self.bodies, bodies) {
            part.put_in_place().map_err(|e| unwritable(path, &e))?;
        }
        if !self.no_report {
            write_report(&self.report, simulation_report(simulation, Some(&series)).html())?;
        }
        let answer = match self.format {
            Format::Json => Answer::Json(simulation_json(&simulation)),
            Format::Text => Answer::Text(simulation_report(simulation, None).text()),
        };
        Ok(match (show(&answer), errors, found.troubles.is_grave()) {
            (Outcome::Done, true, _) => Outcome::Unusable,
            (Outcome::Done, _, true) => Outcome::No,
            (shown, ..) => shown,
        })
    }

    /// Simulates, and writes the path into a temporary file, if one is asked for.
    fn walk(
        &self,
        job: &Job,
        part: Option<&Part>,
        bodies: Option<&Part>,
    ) -> (Findings, Series, std::io::Result<()>) {
        let begin = |(path, part)| PathTable::begin(&job.machine, path, part);
        let mut table = self.path.as_deref().zip(part).map(begin);
        let mut series = Series::of(&job.machine);
        let collisions = if self.no_collisions { None } else { watched(job) };
        let bar = progress_bar(&job.program);
        let length = bar.length().unwrap_or(0) as f64;
        let mut progress = Progress::through(&job.program, |part| {
            bar.set_position((part * length).round() as u64)
        });
        let mut observers: Vec<&mut dyn Observer> = vec![&mut progress];
        if !self.no_report {
            observers.push(&mut series);
        }
        if let Some(table) = &mut table {
            observers.push(table.observer());
        }
        let begin = |part: &'_ Part| {
            let out = BufWriter::with_capacity(1 << 16, part.file().try_clone()?);
            Ok::<_, std::io::Error>(BodyTable::new(out))
        };
        let mut bodies = bodies.map(begin).transpose();
        if let Ok(Some(bodies)) = &mut bodies {
            observers.push(bodies);
        }
        let found = job.run(collisions, &mut observers);
        drop(observers);
        drop(progress);
        bar.finish_and_clear();
        let written = table.map_or(Ok(()), PathTable::finish);
        let bodies = bodies.and_then(|b| b.map_or(Ok(()), |b| b.finish().map(drop)));
        (found, series, written.and(bodies))
    }
}

/// Whether two names stand for one file.
fn same_place(one: &Path, other: &Path) -> bool {
    let place = |path: &Path| {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some((folder.canonicalize().ok()?, path.file_name()?.to_owned()))
    };
    one == other || place(one).is_some_and(|p| Some(p) == place(other))
}

fn unwritable(path: &Path, error: &std::io::Error) -> Outcome {
    let (shown, message) = (path.display().to_string(), format!("cannot be written: {error}"));
    unusable("unwritable-file", &shown, &message, "name another --path")
}

/// The collision check; bodies that cannot be checked are reported.
fn watched(job: &Job) -> Option<Collisions> {
    let collisions = job.collisions()?;
    for (first, second) in collisions.left_out() {
        tell(&format!(
            "note: {first} and {second} overlap with all axes at 0: not checked for collisions"
        ));
    }
    Some(collisions)
}

/// The progress of the main program; shown on a terminal only, and only if it takes a while.
fn progress_bar(program: &Program) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let lines = program.source().iter().filter(|b| **b == b'\n').count();
    let bar = ProgressBar::new(lines as u64 + 1);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} line {pos}/{len}, {eta} remaining")
    {
        bar.set_style(style);
    }
    bar
}
