//! Where must the axes stand?

use super::words::{self, argument};
use super::{Answer, MachineChoice, Question, Tell};
use crate::report;
use serde_json::Value;
use std::path::PathBuf;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_input::{CsvTable, Diagnostics, Files, Place};
use trueaxis_machine::axis::Command;
use trueaxis_machine::describe::to_shown;
use trueaxis_machine::{FollowError, FollowFault, Machine, Solutions, SolveError, Target};
use trueaxis_report::{English, Language, Report, Section};

/// Positions of the axes for a pose of the tool, or for a path.
#[derive(Debug, Clone)]
pub struct Solve {
    /// The machine.
    pub machine: MachineChoice,
    /// The pose of the tool.
    pub target: SolveTarget,
    /// Where the axes stand at present, as typed: `A=30 C=0`.
    pub from: Option<String>,
}

/// What is wanted.
#[derive(Debug, Clone)]
pub enum SolveTarget {
    /// Tip and tool axis, as typed: three numbers each.
    Pose(String, String),
    /// A table of poses.
    Path(PathBuf),
}

/// Poses that were read.
#[derive(Debug)]
pub struct SolveInput {
    machine: Machine,
    from: Command,
    targets: Vec<Target>,
    table: Option<CsvTable>,
}

/// All solutions for a pose, or one for each pose of a path.
#[derive(Debug)]
pub enum SolveAnswer {
    /// For a pose.
    Pose(Box<Machine>, Solutions),
    /// For a path.
    Path(Box<Machine>, Vec<Command>),
}

const COLUMNS: [&str; 6] = ["tip_x_mm", "tip_y_mm", "tip_z_mm", "axis_i", "axis_j", "axis_k"];

impl Question for Solve {
    type Input = SolveInput;
    type Answer = SolveAnswer;

    fn read(&self, files: &Files, problems: &mut Diagnostics) -> Option<SolveInput> {
        let machine = self.machine.read(files, problems)?;
        if self.machine.has_temperatures() {
            let message = "temperatures do not change what the nominal machine does".to_owned();
            let hint = "leave them out; pose and simulate show what they do";
            problems.warn("no-effect", argument("--temperature"), message, hint);
        }
        let from = match &self.from {
            Some(text) => words::command(&machine, "--from", text, problems),
            // Where 0 is not within a travel, the axis stands at the end next to it.
            None => Some(machine.nearest_in_travel(&Command::default())),
        };
        let (targets, table) = match &self.target {
            SolveTarget::Pose(tip, axis) => {
                let tip = words::vector("--tip", tip, problems);
                let axis = words::vector("--axis", axis, problems);
                let upright = (argument("--axis"), "write \"0 0 1\" for upright");
                let target = axis.and_then(|axis| target(tip, axis, upright, problems));
                (vec![target?], None)
            }
            SolveTarget::Path(path) => {
                let table = words::table(files, path, "a CSV table of tool poses", problems)?;
                (targets(&table, problems)?, Some(table))
            }
        };
        Some(SolveInput { machine, from: from?, targets, table })
    }

    fn answer(
        &self,
        SolveInput { machine, from, targets, table }: SolveInput,
        _: Tell<'_>,
        problems: &mut Diagnostics,
    ) -> Option<SolveAnswer> {
        let Some(table) = table else {
            let solved = solve(&machine, &targets[0], &from, problems)?;
            return Some(SolveAnswer::Pose(Box::new(machine), solved));
        };
        let refuse = |error: FollowError| {
            let hint = match &error.fault {
                FollowFault::Solve(_) => "tilt the part or change the path there",
                _ => "move the part, or split the path where the rotary axes may turn back",
            };
            let code = match &error.fault {
                FollowFault::Solve(fault) => code(fault),
                FollowFault::LeavesTravel { .. } => "path-leaves-travel",
                FollowFault::Jump { .. } => "path-jumps",
            };
            problems.error(code, table.row_place(error.index), error.fault.to_string(), hint);
        };
        let commands = machine.follow(&targets, &from).map_err(refuse).ok()?;
        warn_of_poles(&machine, &table, (&targets, &commands), problems);
        Some(SolveAnswer::Path(Box::new(machine), commands))
    }
}

/// A pose; an axis without length has no direction.
fn target(
    tip: Option<Vec3>,
    axis: Vec3,
    (place, hint): (Place, &str),
    problems: &mut Diagnostics,
) -> Option<Target> {
    let direction = Direction::of(axis);
    if direction.is_none() {
        let message = "the tool axis has no length".to_owned();
        problems.error("zero-axis", place, message, hint);
    }
    Some(Target { tip: Point::from_vector(tip?), axis: direction? })
}

fn solve(
    machine: &Machine,
    target: &Target,
    from: &Command,
    problems: &mut Diagnostics,
) -> Option<Solutions> {
    let refuse = |error: SolveError| {
        let (place, hint) = match &error {
            SolveError::Unreachable { .. } => {
                ("--axis", "tilt the part, or ask for the closest direction")
            }
            SolveError::TipUnreachable { .. } => {
                ("--tip", "the linear axes of this machine do not span space here")
            }
            SolveError::NotFinite => ("--tip", "write finite numbers"),
        };
        problems.error(code(&error), argument(place), error.to_string(), hint);
    };
    let solved = machine.solve(target, from).map_err(refuse).ok()?;
    if let Some(singular) = &solved.singular {
        let hint = "every angle of that axis points the tool the same way; choose it with --from";
        problems.warn("singular-pose", argument("--axis"), singular.to_string(), hint);
    }
    if !solved.solutions.iter().any(|s| s.within_travel) {
        let message = "no solution lies within the travel of all axes".to_owned();
        let hint = "move or tilt the part, or take another tool";
        problems.warn("outside-travel", argument("--tip"), message, hint);
    }
    Some(solved)
}

fn code(error: &SolveError) -> &'static str {
    match error {
        SolveError::Unreachable { .. } => "unreachable-direction",
        SolveError::TipUnreachable { .. } => "unreachable-tip",
        SolveError::NotFinite => "not-finite",
    }
}

/// Names the first singular pose of a path, and how many there are.
fn warn_of_poles(
    machine: &Machine,
    table: &CsvTable,
    (targets, commands): (&[Target], &[Command]),
    problems: &mut Diagnostics,
) {
    let singular =
        targets.iter().zip(commands).enumerate().filter_map(|(row, (target, command))| {
            let solved = machine.solve(target, command).ok()?;
            Some((row, solved.singular?))
        });
    let all: Vec<_> = singular.collect();
    if let Some((row, first)) = all.first() {
        let message = format!("{first}; singular poses on the path: {}", all.len());
        let hint = "the idle axis turns there while the tool stands";
        problems.warn("singular-pose", table.row_place(*row), message, hint);
    }
}

fn targets(table: &CsvTable, problems: &mut Diagnostics) -> Option<Vec<Target>> {
    let mut columns = Vec::new();
    for name in COLUMNS {
        match table.column(name) {
            Some(column) => columns.push(&column.values),
            None => {
                let place = argument(&table.file);
                let message = format!("the table has no column `{name}`");
                problems.error("missing-column", place, message, &COLUMNS.join(","));
            }
        }
    }
    for column in table.columns.iter().filter(|c| !COLUMNS.contains(&c.name.as_str())) {
        let message = format!("the column `{}` is not used", column.name);
        problems.warn("unused-column", column.place.clone(), message, &COLUMNS.join(","));
    }
    let [x, y, z, i, j, k] = columns[..] else { return None };
    let mut targets = Vec::new();
    for row in 0..table.rows() {
        let [tip, axis] = [[x, y, z], [i, j, k]].map(|v| Vec3::from(v.map(|values| values[row])));
        let upright = (table.row_place(row), "write 0,0,1 for upright");
        targets.extend(target(Some(tip), axis, upright, problems));
    }
    (!problems.has_errors()).then_some(targets)
}

impl Answer for SolveAnswer {
    fn document(&self, _: &Diagnostics) -> Value {
        match self {
            Self::Pose(machine, solved) => report::solve_json(machine, solved),
            Self::Path(machine, commands) => report::solve_path_json(machine, commands),
        }
    }

    fn report(&self) -> Report<'_> {
        match self {
            Self::Pose(machine, solved) => report::solve_report(machine, solved),
            Self::Path(machine, _) => {
                let section =
                    Section::new("Axis positions, mm and degrees").code(self.text(&English));
                Report::new(machine.name()).section(section)
            }
        }
    }

    /// A path is a table again.
    fn text(&self, language: &dyn Language) -> String {
        let Self::Path(machine, commands) = self else {
            return self.report().in_language(language).text();
        };
        let names: Vec<String> = machine.axes().iter().map(|a| a.name.to_string()).collect();
        let row = |command: &Command| {
            let values = command.iter().take(names.len()).enumerate();
            values.map(|(i, q)| to_shown(machine, i, *q)).collect()
        };
        let rows: Vec<Vec<f64>> = commands.iter().map(row).collect();
        words::csv(&names, &rows)
    }
}
