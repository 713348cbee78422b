use crate::arguments::MachineArguments;
use crate::output::{Answer, Format, Outcome, report, show, tell};
use clap::Args;
use std::io::BufWriter;
use std::path::PathBuf;
use trueaxis::files;
use trueaxis::geometry::input::{Diagnostics, Dimension, Place, parse_quantity};
use trueaxis::machine::Machine;
use trueaxis::nc::{Control, Program};
use trueaxis::report::{Simulation, simulation_json, simulation_text};
use trueaxis::simulate::{
    AxisWatch, CONTROLS, CsvTable, Densify, Observer, Options, Run, Series, SetUp, Summary, Timing,
    TroubleList, control_named, read_program, read_setup, simulate,
};

/// The program to simulate.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trueaxis simulate machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf
  trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --format json
  trueaxis simulate MACHINE.toml PART.ngc --setup PART.setup.toml --path path.csv --chord 0.002

Without --setup work offsets and tool lengths are 0; a file PROGRAM.setup.toml beside the program is
taken by itself. Exit status: 0 no grave trouble, 1 a collision, a rapid move through stock or an
axis beyond its travel, 2 unusable input; then nothing is written.")]
pub struct Arguments {
    #[command(flatten)]
    machine: MachineArguments,
    #[command(flatten)]
    program: ProgramArguments,
    /// Write every place of the path to this CSV file
    #[arg(long, value_name = "FILE.csv")]
    path: Option<PathBuf>,
    /// Where the HTML report goes
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// List errors of the program and go on behind them
    #[arg(long)]
    keep_going: bool,
    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// The program, its set-up, and how finely it is cut.
#[derive(Args)]
pub struct ProgramArguments {
    /// The NC program
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// Work offsets, tools, stock, fixtures
    #[arg(long, value_name = "SETUP.toml")]
    setup: Option<PathBuf>,
    /// Whose program it is: sinumerik, fanuc, linuxcnc or heidenhain
    #[arg(long, value_name = "NAME")]
    control: Option<String>,
    /// Largest distance between path and chord, mm
    #[arg(long, value_name = "MM", default_value = "0.005")]
    chord: String,
    /// Longest piece of a move, mm (λ of document 002)
    #[arg(long, value_name = "MM", default_value = "10")]
    spacing: String,
    /// Largest turn of a piece, deg (φ of document 002)
    #[arg(long, value_name = "DEG", default_value = "1")]
    angle: String,
    /// Cut moves by spacing and angle alone, as document 002 does
    #[arg(long)]
    by_count: bool,
    /// Do not cut moves at all, except circles
    #[arg(long, conflicts_with = "by_count")]
    no_densify: bool,
    /// How far corners may be rounded where the program does not say it, mm
    #[arg(long, value_name = "MM", default_value = "0.01")]
    rounding: String,
    /// Time each block by the three phases of document 002, with this mean acceleration, mm/s^2,
    /// and exact stop, instead of looking ahead within the limits of the axes
    #[arg(long, value_name = "MM_PER_S2")]
    three_phase: Option<String>,
    /// With --three-phase: the velocity changes smoothly
    #[arg(long, requires = "three_phase")]
    smooth: bool,
}

/// What the arguments name, read and checked.
pub struct Job {
    pub machine: Machine,
    pub program: Program,
    pub control: Control,
    pub setup: SetUp,
    pub options: Options,
}

impl ProgramArguments {
    /// Reads program and set-up; what is wrong goes to `problems`.
    pub fn read(
        &self,
        machine: Machine,
        keep_going: bool,
        problems: &mut Diagnostics,
    ) -> Option<Job> {
        let setup = self.read_setup(&machine, problems);
        let control = match &self.control {
            Some(name) => Some(named_control(name, problems)?),
            None => None,
        };
        let options = self.options(keep_going, problems);
        let setup = setup?;
        let program = read_program(&self.program, control, &setup, problems)?;
        let control = program.dialect().control;
        Some(Job { machine, program, control, setup, options: options? })
    }

    fn read_setup(&self, machine: &Machine, problems: &mut Diagnostics) -> Option<SetUp> {
        let beside = self.program.with_extension("setup.toml");
        let path = match &self.setup {
            Some(path) => path,
            None if beside.is_file() => &beside,
            None => return Some(SetUp::default()),
        };
        let (setup, found) = read_setup(path, machine);
        problems.append(found);
        setup
    }

    fn options(&self, keep_going: bool, problems: &mut Diagnostics) -> Option<Options> {
        let mut read = |name: &str, text: &str| {
            let value = parse_quantity(text, Dimension::Ratio).ok().filter(|v| *v > 0.0);
            if value.is_none() {
                let message = format!("`{text}` is no positive number");
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
        let timing = match acceleration {
            None => Timing::LookAhead,
            Some(a) => Timing::ThreePhase { acceleration: a?, smooth: self.smooth },
        };
        Some(Options { densify, rounding_mm: rounding_mm?, timing, keep_going })
    }
}

fn named_control(name: &str, problems: &mut Diagnostics) -> Option<Control> {
    let control = control_named(name);
    if control.is_none() {
        let message = format!("`{name}` is no control that is known");
        problems.error("unknown-control", Place::whole("--control"), message, CONTROLS);
    }
    control
}

pub fn run(arguments: &Arguments) -> Outcome {
    let mut problems = Diagnostics::new();
    let job = arguments
        .machine
        .read(&mut problems)
        .and_then(|m| arguments.program.read(m, arguments.keep_going, &mut problems));
    if report(problems) {
        return Outcome::Unusable;
    }
    let Some(job) = job else { return Outcome::Unusable };
    let found = match &arguments.path {
        Some(path) => with_table(&job, path),
        None => Ok(walk(&job, &mut [])),
    };
    let (run, summary, troubles, series) = match found {
        Ok(found) => found,
        Err(outcome) => return outcome,
    };
    let errors = report(run.problems.clone());
    if errors && !arguments.keep_going {
        return Outcome::Unusable;
    }
    let path_file = arguments.path.as_ref().map(|p| p.display().to_string());
    let simulation = Simulation {
        machine: &job.machine,
        program: job.program.file(),
        control: job.control,
        setup: &job.setup,
        run: &run,
        summary: &summary,
        troubles: &troubles,
        path_file: path_file.as_deref(),
    };
    let _ = &series;
    let answer = match arguments.format {
        Format::Json => Answer::Json(simulation_json(&simulation)),
        Format::Text => Answer::Text(simulation_text(&simulation)),
    };
    match (show(&answer), errors, troubles.is_grave()) {
        (Outcome::Done, true, _) => Outcome::Unusable,
        (Outcome::Done, _, true) => Outcome::No,
        (shown, ..) => shown,
    }
}

type Found = (Run, Summary, TroubleList, Series);

fn walk(job: &Job, more: &mut [&mut dyn Observer]) -> Found {
    let mut summary = Summary::of(&job.machine);
    let mut watch = AxisWatch::on(&job.machine);
    let mut series = Series::of(&job.machine);
    let mut observers: Vec<&mut dyn Observer> = vec![&mut summary, &mut watch, &mut series];
    for observer in more {
        observers.push(&mut **observer);
    }
    let run = simulate(&job.machine, &job.program, &job.setup, &job.options, &mut observers);
    (run, summary, TroubleList::of([watch.log]), series)
}

/// The table is written beside its place and moved there when all is well.
fn with_table(job: &Job, path: &std::path::Path) -> Result<Found, Outcome> {
    let refuse = |error: std::io::Error| {
        tell(&format!("error[unwritable-output]: {}: {error}", path.display()));
        Outcome::Unusable
    };
    let part = files::Part::beside(path).map_err(refuse)?;
    let mut table = CsvTable::new(&job.machine, BufWriter::new(part.file()));
    let found = walk(job, &mut [&mut table]);
    table.finish().map_err(refuse)?;
    if found.0.problems.has_errors() && !job.options.keep_going {
        return Ok(found);
    }
    part.put_in_place().map_err(refuse)?;
    Ok(found)
}
