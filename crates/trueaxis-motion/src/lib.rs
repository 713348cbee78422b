//! Simulation of an NC program on a machine: path, times, nominal and actual tool, collisions.
//!
//! ```text
//!     program ──interpret──> moves ──axis_path──> nodes ──clock──> times
//!                                       nodes ──tool_path──> nominal and actual tool
//!                                                 └──> summary, issues, tables, plots
//! ```
//!
//! ```
//! use trueaxis_machine::{Machine, file::NoTables};
//! use trueaxis_motion::{Options, SetUp, Summary, simulate};
//! use trueaxis_nc::{Control, Program};
//! let text = "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n[location]\nEC0Y = \"10 urad\"\n";
//! let machine = Machine::check("mill.toml", text, &NoTables).0.unwrap();
//! let program = Program::new("line.ngc", b"G21 G90 G1 Y500 F3000\nM2\n".to_vec(), Control::LinuxCnc);
//! let mut summary = Summary::of(&machine);
//! let run = simulate(&machine, &program, &SetUp::default(), &Options::default(), &mut [&mut summary]);
//! assert!(!run.problems.has_errors());
//! assert!((summary.time_s - 10.0).abs() < 0.5); // 500 mm at 50 mm/s
//! ```
//!
//! [`simulate()`] reports what happens to every [`Observer`], in constant memory; [`Job`] is the same from files;
//! [`Recording`] keeps all of it to go back and forth in. It does not judge a part.

pub mod axis_path;
mod basic;
mod body_table;
mod clock;
pub mod collide;
mod collisions;
mod curve;
mod densify;
mod drift;
mod equipment;
mod issues;
mod job;
mod machining;
mod orientation;
mod parquet_log;
#[cfg(feature = "parquet")]
mod parquet_table;
mod pose_table;
mod program;
mod recording;
pub mod report;
mod series;
mod setup;
mod summary;
mod table;
mod temperature_log;
mod temperatures;
pub mod timing;
mod tool_check;
mod tool_path;
mod trace;
mod walk;

pub use axis_path::{Fault, Node, PathStep};
pub use body_table::{BODY_HEADINGS, BodyTable};
pub use clock::{Stamp, Timing, limit_name, limits};
pub use collisions::Collisions;
pub use densify::{Densify, pieces};
pub use drift::{Drift, SensorRange};
pub use issues::{AxisWatch, Issue, IssueKind, IssueList, Log};
pub use job::{Findings, Job, ProgramFiles, Progress};
pub use machining::{BlockUse, Machined, Machining};
#[cfg(feature = "parquet")]
pub use parquet_table::ParquetTable;
pub use pose_table::PoseTable;
pub use program::read_program;
pub use recording::{
    AxisRange, Colour, Curves, Moment, PathPoints, QuantityRange, Recorder, Recording,
};
pub use series::{PathPoint, Quantity, Series};
pub use setup::{
    CONTROLS, CutterShape, LifeBy, MeasuredSize, Nearness, SetUp, SetUpTool, ToolLife, ToolSetter,
    ToolState, control_named, parse_setup, read_setup,
};
pub use summary::{AxisUse, Reversal, Summary, ToolUse, Worst, shown, unit};
pub use table::{CsvTable, POSE_COLUMNS, headings};
pub use temperature_log::read_temperature_log;
pub use tool_check::{ToolStanding, standing, tool_standings};
pub use tool_path::Batch;
pub use trace::{Trace, TracedNode, block_lines, trace};
pub use trueaxis_nc::Stop;

use axis_path::AxisPath;
use equipment::EquipmentWatch;
use program::Folder;
use std::path::Path;
use temperatures::Present;
pub use tool_path::STILL;
use trueaxis_input::{Diagnostic, Diagnostics, Place};
use trueaxis_machine::Machine;
use trueaxis_machine::heat::TemperatureRun;
use trueaxis_machine::tcp::TipControl;
use trueaxis_nc::moves::Step;
use trueaxis_nc::{
    Follower, FollowingAxes, Outcome, Program, Settings, interpret_on, leaves_motion_out,
};
use walk::{Leader, Walk, Walked};

/// The JSON Schemas of the documents of this crate, by name.
#[cfg(feature = "schemas")]
pub fn schemas() -> Vec<trueaxis_report::NamedSchema> {
    use trueaxis_report::named_schema;
    vec![named_schema::<report::SimulationDocument<'_>>("simulate")]
}

/// Receives the results of a simulation, stretch by stretch, in constant memory.
pub trait Observer {
    /// The next stretch of the path.
    fn path(&mut self, batch: &Batch<'_>);

    /// A step of the interpreter, before its path.
    fn step(&mut self, _step: &Step) {}
}

/// How a program is simulated.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// How finely moves are cut.
    pub densify: Densify,
    /// How far corners may be rounded where the program does not state it, mm.
    pub rounding_mm: f64,
    /// How time runs.
    pub timing: Timing,
    /// Backward jumps and calls before the program counts as endless.
    pub most_jumps: u64,
    /// List errors and continue after them.
    pub keep_going: bool,
    /// The log that the temperatures follow; without one the machine keeps those that it has.
    pub temperatures: Option<TemperatureRun>,
    /// On request the simulation ends early; its results are then incomplete.
    pub stop: Stop,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            densify: Densify::default(),
            rounding_mm: 0.01,
            timing: Timing::default(),
            most_jumps: Settings::default().most_jumps,
            keep_going: false,
            temperatures: None,
            stop: Stop::default(),
        }
    }
}

/// How a simulation ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Everything that was found in the program; with errors the results are not complete.
    pub problems: Diagnostics,
    /// The programs by the number in [`trueaxis_nc::moves::Origin::program`].
    pub programs: Vec<String>,
    /// It was stopped before its end.
    pub stopped: bool,
}

impl Run {
    /// What the program asks of spindle, magazine and tools that the machine does not have.
    pub fn beyond_equipment(&self) -> impl Iterator<Item = &Diagnostic> {
        let is_beyond =
            |code| equipment::is_beyond_equipment(code) || tool_check::CODES.contains(&code);
        self.problems.iter().filter(move |problem| is_beyond(problem.code))
    }

    /// Functions that move the tool, or its place, and are not executed.
    pub fn motion_left_out(&self) -> impl Iterator<Item = &Diagnostic> {
        self.problems.iter().filter(|problem| leaves_motion_out(problem.code))
    }
}

/// Runs an NC program on a machine and reports all that happens to the observers.
///
/// Memory does not grow with the program. The workpiece frame of all results is that of the
/// machine file, or of a work offset if the set-up states it. Where the temperatures follow a log,
/// every place is evaluated on the machine of its own time; a program that outlasts its log is an
/// error at the block where the log ends.
pub fn simulate(
    machine: &Machine,
    program: &Program,
    setup: &SetUp,
    options: &Options,
    observers: &mut [&mut dyn Observer],
) -> Run {
    let machine = setup.mounted(machine);
    let settings = Settings {
        most_jumps: options.most_jumps,
        stop: options.stop.clone(),
        ..setup.settings(options.keep_going)
    };
    let mut log_problems = Diagnostics::new();
    let Some(present) = Present::of(&machine, options.temperatures.as_ref(), &mut log_problems)
    else {
        return Run { problems: log_problems, programs: Vec::new(), stopped: false };
    };
    let watch = EquipmentWatch::new(machine.equipment(), program.dialect().control);
    let (walk, path) = Walk::new(&machine, present, setup, (options, watch), observers);
    let lead = |leader: &mut Leader<'_>| execute_on(&machine, program, setup, &settings, leader);
    let Walked { outcome, faults, watch } = walk.along(path, lead);
    let mut problems = outcome.problems;
    watch.tell_in(program, &outcome.programs, &mut problems);
    problems.append(log_problems);
    setup.check_for(program, &mut problems);
    note_assumed_limits(&machine, program, &mut problems);
    for fault in faults {
        let place = place(program, &outcome.programs, &fault);
        problems.error(fault.code, place, fault.message, fault.hint);
    }
    Run { problems, programs: outcome.programs, stopped: options.stop.is_requested() }
}

/// Executes a program as its control would; subprograms are in its folder.
pub fn execute(
    mounted: &Machine,
    program: &Program,
    setup: &SetUp,
    settings: &Settings,
    take: &mut dyn FnMut(Step),
) -> Outcome {
    let path = AxisPath::new(mounted, setup, Densify::default(), 0.01);
    execute_on(mounted, program, setup, settings, &mut Followed { path, take, points: 0 })
}

/// The same on a machine that follows the moves.
pub fn execute_on(
    mounted: &Machine,
    program: &Program,
    setup: &SetUp,
    settings: &Settings,
    follower: &mut dyn Follower,
) -> Outcome {
    let length_mm = -mounted.tip_mm().z;
    let unlisted_length_mm = Some(length_mm).filter(|_| setup.tools.is_empty());
    let settings = &Settings { unlisted_length_mm, ..settings.clone() };
    let control = TipControl::of(mounted);
    let turn = basic::turn_to_workpiece(mounted, setup);
    let folder = Folder::beside(&setup.files, Path::new(program.file()), control.as_ref(), turn);
    interpret_on(program, &folder, settings, follower)
}

/// Time is as true as the limits of the axes.
fn note_assumed_limits(machine: &Machine, program: &Program, problems: &mut Diagnostics) {
    let lacks = |axis: &&trueaxis_machine::axis::Axis| {
        let limits = axis.limits;
        limits.velocity.is_none() || limits.acceleration.is_none() || limits.jerk.is_none()
    };
    let axes: Vec<String> =
        machine.axes().iter().filter(lacks).map(|a| a.name.to_string()).collect();
    if !axes.is_empty() {
        let message = format!(
            "typical limits are used where the machine file states none: {}",
            axes.join(" ")
        );
        let hint = "state max_velocity, max_acceleration and max_jerk for realistic times";
        problems.note("assumed-limits", Place::whole(program.file()), message, hint);
    }
}

/// Where a fault is: the line, and the column of its word if the text is available.
pub fn place(program: &Program, programs: &[String], fault: &Fault) -> Place {
    let index = fault.origin.program as usize;
    let mut place = Place::whole(programs.get(index).map_or(program.file(), String::as_str));
    place.line = fault.origin.line as usize;
    place.column = 1;
    if let (0, Some(word)) = (index, fault.word) {
        let line = program
            .source()
            .split(|b| *b == b'\n')
            .nth((fault.origin.line as usize).wrapping_sub(1));
        let at = line.and_then(|l| l.iter().position(|b| b.eq_ignore_ascii_case(&word)));
        place.column = at.map_or(1, |at| at + 1);
    }
    place
}

/// Hands the steps on, and follows them to know where the axes are.
struct Followed<'f, 'm> {
    path: AxisPath<'m>,
    take: &'f mut dyn FnMut(Step),
    points: u64,
}

impl Follower for Followed<'_, '_> {
    fn take(&mut self, step: Step) {
        let points = &mut self.points;
        self.path.take(&step, &mut |_| *points += 1);
        (self.take)(step);
    }

    fn points(&self) -> u64 {
        self.points
    }

    fn axes(&self) -> Option<&dyn FollowingAxes> {
        Some(&self.path)
    }
}
